#!/usr/bin/python3
"""A change of parameters is recorded in the LCM log and told again in playback, where a monitor that
knows only the scene follows it.
"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from whirl_twin.msg import ParameterChange, StabilityMargin, WhirlState
from whirl_twin.srv import SetParameter

URL = 'udpm://239.255.76.67:7667?ttl=0'
PATIENCE = 20.0  # s


def wait_until(condition):
    end = time.monotonic() + PATIENCE
    while not condition() and time.monotonic() < end:
        time.sleep(0.02)
    return condition()


def interrupt(process):
    process.send_signal(signal.SIGINT)
    return process.wait(timeout=20)


class Heard:
    """The messages of a topic that have come so far."""

    def __init__(self, topic, kind):
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, kind, self.messages.append)

    def stop(self):
        self.subscriber.unregister()


def once(messages):
    """Without repetitions: roscpp sends what is latched twice where a subscriber comes as it is published."""
    return [m for k, m in enumerate(messages) if k == 0 or m.header.stamp != messages[k - 1].header.stamp]


class ParameterPlayback(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.log = os.path.join(self.folder, 'changed.lcmlog')
        package = rospkg.RosPack().get_path('whirl_twin')
        scene = os.path.join(package, 'tests', 'ros', 'scenes', 'supercritical.yaml')
        subprocess.check_call(['rosparam', 'load', scene, '/twin/scene'])

    def tearDown(self):
        shutil.rmtree(self.folder)

    def node(self, name, *arguments):
        program = roslib.packages.find_node('whirl_twin', name)[:1]
        process = subprocess.Popen(program + list(arguments))
        self.addCleanup(process.kill)  # should a check fail before it is interrupted
        return process

    def record(self):
        """Changes told by the live twin while it is recorded."""
        recorder = self.node('lcm_recorder_node', '_log:=' + self.log, '_lcm_url:=' + URL)
        self.assertTrue(wait_until(lambda: os.path.exists(self.log)))
        changes = Heard('/twin/rotor/parameters', ParameterChange)
        whirls = Heard('/twin/rotor/whirl', WhirlState)
        simulation = self.node('simulation_node', '_realtime:=ignore')
        rospy.wait_for_service('/simulation_node/set_parameter', timeout=PATIENCE)
        self.assertTrue(wait_until(lambda: len(whirls.messages) > 300))
        change = rospy.ServiceProxy('/simulation_node/set_parameter', SetParameter)
        answer = change(system='rotor', parameter='internal_damping', value=16.0, ramp=0.0,
                        further_parameters=['damping', 'damping_y'],
                        further_values=[8.0, 8.0])
        self.assertTrue(answer.success, answer.message)
        self.assertTrue(wait_until(lambda: whirls.messages[-1].step > answer.step + 1000))
        self.assertEqual(interrupt(simulation), 0)
        time.sleep(0.5)  # the recorder takes what was sent last
        interrupt(recorder)
        changes.stop()
        whirls.stop()
        return once(changes.messages)

    def test_a_recorded_change_is_told_again_and_followed(self):
        live = self.record()
        self.assertEqual([list(m.changed) for m in live], [[], ['internal_damping', 'damping', 'damping_y']])

        changes = Heard('/twin/rotor/parameters', ParameterChange)
        margins = Heard('/twin/rotor/stability', StabilityMargin)
        bridge = self.node('lcm_bridge_node')
        monitor = self.node('monitor_node', '_source:=lcm', '_lcm_url:=' + URL)
        rospy.wait_for_service('/lcm_bridge_node/ready', timeout=PATIENCE)
        self.assertTrue(wait_until(lambda: margins.subscriber.get_num_connections() > 0))
        subprocess.check_call(['lcm-logplayer', '--lcm-url=' + URL, self.log])
        self.assertTrue(wait_until(lambda: len(once(changes.messages)) >= 2))
        # 60 (1 + 8 / 16): only who has taken the change over knows this threshold.
        self.assertTrue(wait_until(lambda: margins.messages and
                                   abs(margins.messages[-1].instability_speed - 90.0) < 1e-6))
        interrupt(monitor)
        interrupt(bridge)
        for told, again in zip(live, once(changes.messages)):
            self.assertEqual(told.header.stamp, again.header.stamp)
            for field in ('step', 'time', 'names', 'values', 'changed', 'previous'):
                self.assertEqual(getattr(told, field), getattr(again, field), field)


if __name__ == '__main__':
    rospy.init_node('parameter_playback_test')
    rostest.rosrun('whirl_twin', 'parameter_playback_test', ParameterPlayback, sys.argv)
