"""What a follower says on <system>/follow becomes alerts of the monitor, and clears with its cause."""
import math
import os
import time

from whirl_twin.msg import AlertArray, FollowState, WhirlState

from node_trial import PATIENCE, TRIAL_SCENES, NodeTrial, load_scene


class FollowAlerts(NodeTrial):
    def setUp(self):
        super().setUp()
        load_scene(os.path.join(TRIAL_SCENES, 'drift.yaml'))
        self.alerts = {}
        self.time = None  # s, simulated
        self.topic = self.publisher('/twin/rotor/follow', FollowState)
        self.listen('/twin/alerts', AlertArray, self.on_alerts)
        self.listen('/twin/rotor/whirl', WhirlState, self.on_whirl)
        self.start('simulation_node', '_realtime:=ignore', '_real_time_factor:=2')
        self.start('monitor_node')

    def on_alerts(self, message):
        self.alerts = {alert.type: alert.text for alert in message.alerts}

    def on_whirl(self, message):
        self.time = message.time

    def tell_until(self, done, **news):
        end = time.monotonic() + PATIENCE
        while not done() and time.monotonic() < end:
            if self.time is not None:
                follow = FollowState(time=self.time, shaft_known=True, mismatch=1.0, mismatch_least=0.9,
                                     mismatch_limit=1.1, whiteness=0.0, whiteness_limit=0.1, drift_limit=5.0,
                                     parameter=['stiffness'], parameter_unit=['N/m'], value=[1.0e4],
                                     deviation=[math.nan], clock_offset=math.nan, clock_drift=math.nan)
                follow.header.frame_id = 'rotor'
                for name, value in news.items():
                    setattr(follow, name, value)
                self.topic.publish(follow)
            time.sleep(0.1)
        self.assertTrue(done(), self.alerts)

    def test_drift_and_mismatch_are_raised_and_clear(self):
        self.tell_until(lambda: 'DRIFT' in self.alerts, drift_parameter='stiffness', drift_from=1.0e4, drift_to=9.7e3,
                        drift_since=1.5)
        self.assertIn('stiffness changed from 1e+04 to 9700 N/m (-3 %)', self.alerts['DRIFT'])
        self.tell_until(lambda: 'DRIFT' not in self.alerts)
        self.tell_until(lambda: 'MODEL_MISMATCH' in self.alerts, mismatch=1.3)
        self.tell_until(lambda: 'SENSOR' in self.alerts, shaft_known=False)
        self.tell_until(lambda: not {'SENSOR', 'MODEL_MISMATCH'} & set(self.alerts))
