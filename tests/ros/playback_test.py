"""The demo is recorded and played by lcm-logplayer: what the bridge then publishes is, bit for bit,
what the live twin published. (Only Header.seq is left out: each publisher counts its own.) By
playback.launch a damaged log is played to its end, and nobody is alarmed there.
"""
import os
import random
import struct
import subprocess
import threading
import time

import rospy
from whirl_twin.msg import AlertArray, StabilityMargin
from whirl_twin_lcm.whirl_twin.scene_text_t import scene_text_t

from node_trial import PATIENCE, SCENES, NodeTrial, load_scene, wait_until

URL = 'udpm://239.255.76.67:7667?ttl=0'
STATES = ['/twin/rotor/whirl', '/twin/pendulum/pendulum', '/twin/drives/shaft']
TOPICS = STATES + ['/twin/loop']
ENOUGH = 2000  # messages a topic


class Recorder:
    """Keeps the raw messages of the topics, by step."""

    def __init__(self, listen):
        self.messages = {topic: {} for topic in TOPICS}
        self.lock = threading.Lock()
        self.subscribers = [listen(topic, rospy.AnyMsg, self.take, topic) for topic in TOPICS]

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


class Playback(NodeTrial):
    def setUp(self):
        super().setUp()
        self.recorded = self.path('demo.lcmlog')
        self.scene = os.path.join(SCENES, 'demo.yaml')
        load_scene(self.scene)

    def record(self, logger):
        """Messages of the live demo while `logger` writes the log."""
        live = Recorder(self.listen)
        simulation = self.start('simulation_node', '_realtime:=ignore')
        self.assertTrue(wait_until(lambda: live.least() >= ENOUGH))
        self.assertEqual(self.end(simulation), 0)
        time.sleep(0.5)  # the logger takes what was sent last
        self.end(logger)
        live.stop()
        return live.messages

    def play(self, last):
        """Messages of the bridge while lcm-logplayer plays the log, up to its last steps."""
        replayed = Recorder(self.listen)
        bridge = self.start('lcm_bridge_node')
        rospy.wait_for_service('/lcm_bridge_node/ready', timeout=PATIENCE)
        subprocess.check_call(['lcm-logplayer', '--speed=4', '--lcm-url=' + URL, self.recorded])
        wait_until(lambda: all(last[topic] in replayed.messages[topic] for topic in TOPICS))
        self.end(bridge)
        replayed.stop()
        return replayed.messages

    def test_the_replay_of_our_recording_is_complete_and_equal(self):
        recorder = self.start('lcm_recorder_node', '_log:=' + self.recorded, '_lcm_url:=' + URL)
        self.assertTrue(wait_until(lambda: os.path.exists(self.recorded)))
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
        logger = self.start_program('lcm-logger', '--quiet', '--lcm-url=' + URL, self.recorded)
        self.assertTrue(wait_until(lambda: os.path.exists(self.recorded)))
        live = self.record(logger)
        replayed = self.play({topic: max(live[topic]) for topic in TOPICS})
        for topic in STATES:
            common = set(live[topic]) & set(replayed[topic])
            self.assertGreater(len(common), ENOUGH // 2)
            for step in common:
                self.assertEqual(replayed[topic][step], live[topic][step],
                                 '%s, step %d' % (topic, step))

    def test_playback_launch_plays_beyond_the_damage_and_ends_without_an_alarm(self):
        subprocess.check_call([os.environ['WHIRL_TWIN_PROGRAM'], 'simulate', self.scene, '--duration', '6', '--output',
                               self.recorded, '--json'], stdout=subprocess.DEVNULL)
        with open(self.recorded, 'r+b') as log:
            log.seek(os.path.getsize(self.recorded) // 3)
            log.write(random.Random(5).randbytes(5000))
        replayed, alerts = Recorder(self.listen), set()
        self.listen('/twin/alerts', AlertArray, lambda all: alerts.update(alert.type for alert in all.alerts))
        self.start_program('roslaunch', 'whirl_twin', 'playback.launch', 'log:=' + self.recorded, 'rviz:=false',
                           'speed:=2', 'scene:=' + self.scene, 'lcm_url:=' + URL)
        # The last step is far beyond the damage, where a player that gives up ends.
        self.assertTrue(wait_until(lambda: 6000 in replayed.messages['/twin/rotor/whirl']))
        self.assertGreater(len(replayed.messages['/twin/rotor/whirl']), ENOUGH)
        time.sleep(5.0)  # in which silence would be an alarm
        self.assertNotIn('DATA_LOST', alerts)

    def test_playback_launch_takes_the_scene_of_the_log(self):
        """A log of another scene than `demo`, which says so: the monitor judges by that one."""
        scene = self.path('small.yaml')
        with open(scene, 'w') as out:
            out.write('name: small\nstep: 0.002\ndrives: {shaft: {speed: 20.0}}\nsystems:\n  wheel:\n'
                      '    {model: jeffcott_rotor, drive: shaft, parameters: {mass: 1.0, stiffness: 900.0, damping: 1.0}}\n')
        subprocess.check_call([os.environ['WHIRL_TWIN_PROGRAM'], 'simulate', scene, '--duration', '8', '--output',
                               self.recorded, '--json'], stdout=subprocess.DEVNULL)
        text = scene_text_t()
        text.source, text.line = 'small.yaml', open(scene).read().splitlines()
        text.lines = len(text.line)
        payload, channel = text.encode(), b'TWIN_SCENE'
        with open(self.recorded, 'rb') as log:
            rest = log.read()
        with open(self.recorded, 'wb') as log:
            log.write(struct.pack('>IqqII', 0xEDA1DA01, 0, 0, len(channel), len(payload)) + channel + payload + rest)
        margins = []
        self.listen('/twin/wheel/stability', StabilityMargin, margins.append)
        self.start_program('roslaunch', 'whirl_twin', 'playback.launch', 'log:=' + self.recorded, 'rviz:=false',
                           'lcm_url:=' + URL)
        self.assertTrue(wait_until(lambda: margins))
        self.assertAlmostEqual(margins[0].decay_rate, 0.5)  # c / 2m
        self.assertEqual(rospy.get_param('/twin/scene/name'), 'small')
