#!/usr/bin/python3
"""What rviz is given: instruments with a live verdict, limits, the loop's health, a frame for the camera; and where the
monitor has died no margin that looks live."""
import subprocess
import sys
import time
import unittest

import rospy
import rostest
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

PATIENCE = 30.0  # s


def wait_until(condition):
    end = time.monotonic() + PATIENCE
    while not condition() and time.monotonic() < end:
        time.sleep(0.05)
    return condition()


class Visualization(unittest.TestCase):
    def setUp(self):
        self.markers = {}
        self.frames = set()
        rospy.Subscriber('/twin/markers', MarkerArray, self.take)
        rospy.Subscriber('/tf', TFMessage,
                         lambda m: self.frames.update(t.child_frame_id for t in m.transforms))

    def take(self, array):
        self.markers = {(m.ns, m.id): m for m in array.markers}

    def shown(self, part, number=0):
        marker = self.markers.get((part, number))
        return marker is not None and marker.action == Marker.ADD

    def text(self, part):
        marker = self.markers.get((part, 0))
        return marker.text if marker else ''

    def test_a_margin_is_shown_while_it_is_live(self):
        self.assertTrue(wait_until(lambda: self.shown('rotor/margin_pointer')))
        self.assertTrue(wait_until(lambda: self.shown('pendulum/margin_pointer')))
        self.assertTrue(self.shown('rotor/speed_avoid'))
        self.assertFalse(self.shown('pendulum/speed_avoid'))
        self.assertIn('avoid 48.1 to 70.7', self.text('rotor/speed_caption'))
        self.assertIn('log decrement 0.315 (0.1 asked for)', self.text('rotor/margin_caption'))
        self.assertTrue(wait_until(lambda: 'zone C 110 um' in self.text('rotor/text')), self.text('rotor/text'))
        self.assertTrue(wait_until(lambda: self.text('(twin)/loop').startswith('loop: 1000 steps/s')))
        self.assertTrue(wait_until(lambda: 'oldest verdict' in self.text('(twin)/monitor')), self.text('(twin)/monitor'))
        self.assertTrue(wait_until(lambda: 'twin_view' in self.frames))

        subprocess.check_call(['rosnode', 'kill', '/monitor_node'], stdout=subprocess.DEVNULL)
        self.assertTrue(wait_until(lambda: not self.shown('rotor/margin_pointer')))
        self.assertFalse(self.shown('rotor/speed_avoid'))
        self.assertTrue(self.shown('rotor/speed_pointer'))  # the states go on
        self.assertEqual(self.text('rotor/margin_caption'), 'margin: the monitor is silent')
        self.assertTrue(self.text('(twin)/title').startswith('alarms not known'))


if __name__ == '__main__':
    rospy.init_node('visualization_test')
    rostest.rosrun('whirl_twin', 'visualization_test', Visualization, sys.argv)
