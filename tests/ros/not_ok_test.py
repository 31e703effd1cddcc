"""What cannot be judged (a gap, numbers that are none, a channel that is stuck) is told apart from the alarms, raises
none, clears none, and is over when the states are good again."""
import math
import os
import threading
import time

import rospy
from whirl_twin.msg import AlertArray, MonitorStatus, WhirlState

from node_trial import TRIAL_SCENES, NodeTrial, load_scene, wait_until

PERIOD = 0.01  # s, between states
SPEED = 30.0  # rad/s
NARROW, WIDE = 0.1e-3, 0.5e-3  # m
LEVEL = 0.3e-3  # m


class Machine(threading.Thread):
    """Is the machine, there is no simulation: publishes a whirl, with whatever is wrong with its sensor."""

    def __init__(self, topic):
        super().__init__(daemon=True)
        self.topic = topic
        self.radius = NARROW
        self.fault = lambda state: state
        self.over = False

    def run(self):
        begin = time.monotonic()
        step = 0
        while not self.over:
            step += 1
            state = WhirlState(step=step, time=step * PERIOD, speed=SPEED, radius=self.radius, phase_valid=True)
            state.header.stamp = rospy.Time.now()
            state.header.frame_id = 'rotor'
            angle = state.shaft_angle = SPEED * state.time
            state.x, state.y = self.radius * math.cos(angle), self.radius * math.sin(angle)
            state = self.fault(state)
            if state is not None:
                self.topic.publish(state)
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


class NotOk(NodeTrial):
    def setUp(self):
        super().setUp()
        load_scene(os.path.join(TRIAL_SCENES, 'run_ups.yaml'))
        rospy.set_param('/monitor_node/amplitude', {'rotor': {'alert': LEVEL}})
        self.list = self.monitor_status = None
        self.listen('/twin/alerts', AlertArray, lambda m: setattr(self, 'list', m))
        self.listen('/twin/monitor', MonitorStatus, lambda m: setattr(self, 'monitor_status', m))
        self.start('monitor_node')
        self.machine = Machine(self.publisher('/twin/rotor/whirl', WhirlState, 100))
        self.machine.start()
        self.addCleanup(self.stop_machine)

    def stop_machine(self):
        self.machine.over = True
        self.machine.join()

    def wide(self):
        return [a.id for a in self.list.alerts if a.type == 'WHIRL_AMPLITUDE'] if self.list else []

    def not_ok(self):
        return self.monitor_status.not_ok[0] if self.monitor_status else None

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
