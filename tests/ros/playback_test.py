#!/usr/bin/python3
"""The demo is recorded and played by lcm-logplayer: what the bridge then publishes is, bit for bit,
what the live twin published. (Only Header.seq is left out: each publisher counts its own.) By
playback.launch a damaged log is played to its end, and nobody is alarmed there.
"""
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from whirl_twin.msg import AlertArray

URL = 'udpm://239.255.76.67:7667?ttl=0'
STATES = ['/twin/rotor/whirl', '/twin/pendulum/pendulum', '/twin/drives/shaft']
TOPICS = STATES + ['/twin/loop']
ENOUGH = 2000  # messages a topic
PATIENCE = 25.0  # s


class Recorder:
    """Keeps the raw messages of the topics, by step."""

    def __init__(self):
        self.messages = {topic: {} for topic in TOPICS}
        self.lock = threading.Lock()
        self.subscribers = [rospy.Subscriber(topic, rospy.AnyMsg, self.take, topic)
                            for topic in TOPICS]

    def take(self, message, topic):
        raw = message._buff
        frame_length, = struct.unpack_from('<I', raw, 12)
        step, = struct.unpack_from('<q', raw, 16 + frame_length)
        with self.lock:
            self.messages[topic][step] = raw[4:]  # without Header.seq

    def least(self):
        with self.lock:
            return min(len(self.messages[topic]) for topic in STATES)

    def stop(self):
        for subscriber in self.subscribers:
            subscriber.unregister()


def wait_until(condition):
    end = time.monotonic() + PATIENCE
    while not condition() and time.monotonic() < end:
        time.sleep(0.05)
    return condition()


def interrupt(process):
    process.send_signal(signal.SIGINT)
    return process.wait(timeout=60)


def node(name, *arguments):
    return subprocess.Popen(roslib.packages.find_node('whirl_twin', name)[:1] + list(arguments))


class Playback(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.log = os.path.join(self.folder, 'demo.lcmlog')
        package = rospkg.RosPack().get_path('whirl_twin')
        scene = os.path.join(package, 'config', 'scenes', 'demo.yaml')
        subprocess.check_call(['rosparam', 'load', scene, '/twin/scene'])

    def tearDown(self):
        shutil.rmtree(self.folder)

    def record(self, logger):
        """Messages of the live demo while `logger` writes the log."""
        live = Recorder()
        simulation = node('simulation_node', '_realtime:=ignore')
        self.assertTrue(wait_until(lambda: live.least() >= ENOUGH))
        self.assertEqual(interrupt(simulation), 0)
        time.sleep(0.5)  # the logger takes what was sent last
        interrupt(logger)
        live.stop()
        return live.messages

    def play(self, last):
        """Messages of the bridge while lcm-logplayer plays the log, up to its last steps."""
        replayed = Recorder()
        bridge = node('lcm_bridge_node')
        rospy.wait_for_service('/lcm_bridge_node/ready', timeout=PATIENCE)
        subprocess.check_call(['lcm-logplayer', '--speed=4', '--lcm-url=' + URL, self.log])
        wait_until(lambda: all(last[topic] in replayed.messages[topic] for topic in TOPICS))
        interrupt(bridge)
        replayed.stop()
        return replayed.messages

    def test_the_replay_of_our_recording_is_complete_and_equal(self):
        recorder = node('lcm_recorder_node', '_log:=' + self.log, '_lcm_url:=' + URL)
        self.assertTrue(wait_until(lambda: os.path.exists(self.log)))
        live = self.record(recorder)
        replayed = self.play({topic: max(live[topic]) for topic in TOPICS})
        for topic in TOPICS:
            steps = range(min(live[topic]), max(live[topic]) + 1) if topic in STATES else live[topic]
            for step in steps:
                self.assertIn(step, replayed[topic], topic)
                self.assertEqual(replayed[topic][step], live[topic][step],
                                 '%s, step %d' % (topic, step))

    def test_the_replay_of_lcm_logger_is_equal(self):
        # The stock logger may drop messages on a busy machine: those it kept must be equal.
        logger = subprocess.Popen(['lcm-logger', '--quiet', '--lcm-url=' + URL, self.log])
        self.assertTrue(wait_until(lambda: os.path.exists(self.log)))
        live = self.record(logger)
        replayed = self.play({topic: max(live[topic]) for topic in TOPICS})
        for topic in STATES:
            common = set(live[topic]) & set(replayed[topic])
            self.assertGreater(len(common), ENOUGH // 2)
            for step in common:
                self.assertEqual(replayed[topic][step], live[topic][step],
                                 '%s, step %d' % (topic, step))

    def test_playback_launch_plays_beyond_the_damage_and_ends_without_an_alarm(self):
        scene = os.path.join(rospkg.RosPack().get_path('whirl_twin'), 'config/scenes/demo.yaml')
        subprocess.check_call([os.environ['WHIRL_TWIN_PROGRAM'], 'simulate', scene, '--duration', '6', '--output', self.log, '--json'],
                              stdout=subprocess.DEVNULL)
        with open(self.log, 'r+b') as log:
            log.seek(os.path.getsize(self.log) // 3)
            log.write(random.Random(5).randbytes(5000))
        replayed, alerts = Recorder(), set()
        rospy.Subscriber('/twin/alerts', AlertArray, lambda all: alerts.update(alert.type for alert in all.alerts))
        launch = subprocess.Popen(['roslaunch', 'whirl_twin', 'playback.launch', 'log:=' + self.log, 'rviz:=false',
                                   'speed:=2', 'scene:=' + scene, 'lcm_url:=' + URL])
        try:
            # The last step is far beyond the damage, where a player that gives up ends.
            self.assertTrue(wait_until(lambda: 6000 in replayed.messages['/twin/rotor/whirl']))
            self.assertGreater(len(replayed.messages['/twin/rotor/whirl']), ENOUGH)
            time.sleep(5.0)  # in which silence would be an alarm
            self.assertNotIn('DATA_LOST', alerts)
        finally:
            interrupt(launch)
            replayed.stop()


if __name__ == '__main__':
    rospy.init_node('playback_test')
    rostest.rosrun('whirl_twin', 'playback_test', Playback, sys.argv)
