#!/usr/bin/python3
"""What cannot be judged (a gap, numbers that are none, a channel that is stuck) is told apart from the alarms, raises
none, clears none, and is over when the states are good again."""
import math
import subprocess
import sys
import threading
import time
import unittest

import roslib.packages
import rospy
import rostest
from whirl_twin.msg import AlertArray, MonitorStatus, WhirlState

PATIENCE = 30.0  # s
PERIOD = 0.01  # s, between states
SPEED = 30.0  # rad/s
NARROW, WIDE = 0.1e-3, 0.5e-3  # m
LEVEL = 0.3e-3  # m


def wait_until(condition):
    end = time.monotonic() + PATIENCE
    while not condition() and time.monotonic() < end:
        time.sleep(0.02)
    return condition()


class Machine(threading.Thread):
    """Publishes a whirl, with whatever is wrong with its sensor."""

    def __init__(self):
        super().__init__(daemon=True)
        self.radius = NARROW
        self.fault = lambda state: state
        self.over = False

    def run(self):
        topic = rospy.Publisher('/twin/rotor/whirl', WhirlState, queue_size=100)
        begin = time.monotonic()
        step = 0
        while not self.over:
            step += 1
            state = WhirlState(step=step, time=step * PERIOD, speed=SPEED, radius=self.radius, phase_valid=True)
            state.header.stamp = rospy.Time.now()
            state.header.frame_id = 'rotor'
            angle = SPEED * state.time
            state.x, state.y = self.radius * math.cos(angle), self.radius * math.sin(angle)
            state = self.fault(state)
            if state is not None:
                topic.publish(state)
            time.sleep(max(0.0, begin + step * PERIOD - time.monotonic()))


def with_nan(state):
    state.x = state.radius = math.nan
    return state


def with_infinity(state):
    state.y_rate = math.inf
    return state


def stuck(state):
    state.x, state.y, state.radius = 0.05e-3, 0.0, 0.05e-3
    return state


class NotOk(unittest.TestCase):
    def setUp(self):
        rospy.set_param('/monitor_node/amplitude', {'rotor': {'alert': LEVEL}})
        self.list = self.status = None
        rospy.Subscriber('/twin/alerts', AlertArray, lambda m: setattr(self, 'list', m))
        rospy.Subscriber('/twin/monitor', MonitorStatus, lambda m: setattr(self, 'status', m))
        program = roslib.packages.find_node('whirl_twin', 'monitor_node')[0]
        self.monitor = subprocess.Popen([program])
        self.machine = Machine()
        self.machine.start()

    def tearDown(self):
        self.machine.over = True
        self.machine.join()
        self.monitor.kill()
        self.monitor.wait()

    def wide(self):
        return [a.id for a in self.list.alerts if a.type == 'WHIRL_AMPLITUDE'] if self.list else []

    def not_ok(self):
        return self.status.not_ok[0] if self.status else None

    def test_each_fault_is_told_and_neither_raises_nor_clears(self):
        self.assertTrue(wait_until(lambda: self.not_ok() == ''))
        for fault, told in ((with_nan, 'not finite: x'), (with_infinity, 'not finite: y_rate'),
                            (lambda state: None, 'stale: no state for'), (stuck, 'stuck: x, y')):
            self.machine.radius = WIDE
            self.assertTrue(wait_until(self.wide), told)
            raised = self.wide()
            # The machine is narrow again, but nothing says so.
            self.machine.fault = fault
            self.machine.radius = NARROW
            self.assertTrue(wait_until(lambda: self.not_ok().startswith(told)), (told, self.not_ok()))
            time.sleep(1.6)  # beyond clear_delay
            self.assertEqual(self.wide(), raised, told)
            # It comes back.
            self.machine.fault = lambda state: state
            self.assertTrue(wait_until(lambda: self.not_ok() == ''), told)
            self.assertTrue(wait_until(lambda: not self.wide()), told)
            # The machine is wide, but nothing says so.
            self.machine.fault = fault
            self.assertTrue(wait_until(lambda: self.not_ok().startswith(told)), (told, self.not_ok()))
            self.machine.radius = WIDE
            time.sleep(0.5)
            self.assertFalse(self.wide(), told)
            self.machine.fault = lambda state: state
            self.assertTrue(wait_until(self.wide), told)
            self.machine.radius = NARROW
            self.assertTrue(wait_until(lambda: not self.wide()), told)


if __name__ == '__main__':
    rospy.init_node('not_ok_test')
    rostest.rosrun('whirl_twin', 'not_ok_test', NotOk, sys.argv)
