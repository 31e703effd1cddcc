"""Cross-coupling that drifts up is announced half a minute before any growth shows, and by the margin, not the motion."""
import os
import time

import rospy
from whirl_twin.msg import AlertArray, OrderState, StabilityMargin
from whirl_twin.srv import SetParameter

from node_trial import TRIAL_SCENES, NodeTrial, load_scene

PATIENCE = 80.0  # s, wall
DRIFT = 5.0  # N/m each second: 600 N/m, where it begins to grow, after two minutes
SHOWS = 1.5  # times as wide as at first


class Drift(NodeTrial):
    def setUp(self):
        super().setUp()
        load_scene(os.path.join(TRIAL_SCENES, 'drift.yaml'))
        self.raised = {}
        self.coupling = 0.0  # N/m, the last that was set
        self.coupling_when_low = None  # N/m, when LOW_DAMPING arrived
        self.judged = False
        self.orders = None
        self.narrow = None  # m, as it was at first
        self.grown_at = None  # s, simulated
        self.listen('/twin/alerts', AlertArray, self.on_alerts)
        self.listen('/twin/rotor/orders', OrderState, self.on_orders)
        self.listen('/twin/rotor/stability', StabilityMargin, self.on_margin)
        self.start('simulation_node', '_realtime:=ignore', '_real_time_factor:=10')
        self.start('monitor_node')

    def on_alerts(self, message):
        for alert in message.alerts:
            self.raised.setdefault(alert.type, alert)
        if self.coupling_when_low is None and 'LOW_DAMPING' in self.raised:
            self.coupling_when_low = self.coupling

    def on_margin(self, message):
        self.judged = True

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
        start = None  # s, simulated
        while self.grown_at is None and time.monotonic() < end:
            if self.narrow and self.judged:
                start = start or self.orders.time
                self.coupling = DRIFT * (self.orders.time - start)
                changed = change('rotor', 'cross_coupling', self.coupling, 0.0, [], [])
                self.assertTrue(changed.success, changed.message)
            time.sleep(0.05)
        self.assertIsNotNone(self.grown_at)
        self.assertIn('LOW_DAMPING', self.raised)
        self.assertIn('UNSTABLE', self.raised)
        # Log decrement below 0.1: from q = 600 (1 - 0.1 / 0.1885) = 282 N/m on.
        self.assertGreater(self.coupling_when_low, 281.0)
        self.assertLess(self.raised['LOW_DAMPING'].raised_time + 30.0, self.grown_at)
        self.assertLess(self.raised['UNSTABLE'].raised_time, self.grown_at)
