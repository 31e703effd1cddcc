#!/usr/bin/python3
"""Cross-coupling that drifts up is announced half a minute before any growth shows, and by the margin, not the motion."""
import sys
import time
import unittest

import rospy
import rostest
from whirl_twin.msg import AlertArray, OrderState
from whirl_twin.srv import SetParameter

PATIENCE = 80.0  # s, wall
DRIFT = 5.0  # N/m each second: 600 N/m, where it begins to grow, after two minutes
SHOWS = 1.5  # times as wide as at first


class Drift(unittest.TestCase):
    def setUp(self):
        self.raised = {}
        self.orders = None
        self.narrow = None  # m, as it was at first
        self.grown_at = None  # s, simulated
        rospy.Subscriber('/twin/alerts', AlertArray, self.on_alerts)
        rospy.Subscriber('/twin/rotor/orders', OrderState, self.on_orders)

    def on_alerts(self, message):
        for alert in message.alerts:
            self.raised.setdefault(alert.type, alert)

    def on_orders(self, message):
        self.orders = message
        if self.narrow is None and message.valid and message.time > 5.0:
            self.narrow = message.peak_to_peak
        if self.narrow and self.grown_at is None and message.peak_to_peak > SHOWS * self.narrow:
            self.grown_at = message.time

    def test_it_is_announced_before_it_shows(self):
        rospy.wait_for_service('/simulation_node/set_parameter', PATIENCE)
        change = rospy.ServiceProxy('/simulation_node/set_parameter', SetParameter)
        end = time.monotonic() + PATIENCE
        while self.grown_at is None and time.monotonic() < end:
            if self.narrow:
                told = change('rotor', 'cross_coupling', DRIFT * self.orders.time, 0.0, [], [])
                self.assertTrue(told.success, told.message)
            time.sleep(0.05)
        self.assertIsNotNone(self.grown_at)
        self.assertIn('LOW_DAMPING', self.raised)
        self.assertIn('UNSTABLE', self.raised)
        # Log decrement below 0.1: from q = 600 (1 - 0.1 / 0.1885) N/m on, after 56 s.
        self.assertGreater(self.raised['LOW_DAMPING'].raised_time, 55.0)
        self.assertLess(self.raised['LOW_DAMPING'].raised_time + 30.0, self.grown_at)
        self.assertLess(self.raised['UNSTABLE'].raised_time, self.grown_at)


if __name__ == '__main__':
    rospy.init_node('drift_test')
    rostest.rosrun('whirl_twin', 'drift_test', Drift, sys.argv)
