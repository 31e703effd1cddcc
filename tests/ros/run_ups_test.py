"""Run-ups through a critical speed at three accelerations, a speed that ripples about the edge of its band, one that
dwells in it, and trip multiply: what the monitor wrote into its history of each."""
import json
import os
import pathlib

from whirl_twin.msg import DriveState, MonitorStatus
from whirl_twin.srv import SetAlarmSettings, SetSpeed

from node_trial import TRIAL_SCENES, NodeTrial, call, load_scene, wait_until

LOW = 30.0  # rad/s
HIGH = 120.0
WARNING, DANGER = 1, 2


class RunUps(NodeTrial):
    def setUp(self):
        super().setUp()
        load_scene(os.path.join(TRIAL_SCENES, 'run_ups.yaml'))
        self.history = pathlib.Path(self.path('alarms'))
        self.shaft = self.monitor_status = None
        self.listen('/twin/drives/shaft', DriveState, lambda m: setattr(self, 'shaft', m))
        self.listen('/twin/monitor', MonitorStatus, lambda m: setattr(self, 'monitor_status', m))
        self.start('simulation_node', '_realtime:=ignore', '_real_time_factor:=6')
        self.start('monitor_node', '_history:=%s' % self.history)
        self.assertTrue(wait_until(lambda: self.shaft and self.monitor_status))
        self.before = 0  # the last id of before the test
        self.run_to(LOW, 60.0)
        self.calm()
        self.before = max([event['id'] for event in self.events()], default=0)

    def events(self, kind=None):
        if not self.history.exists():
            return []
        lines = [json.loads(line) for line in self.history.read_text().splitlines() if line]
        return [e for e in lines if e['event'] == 'alert' and e['id'] > self.before and kind in (None, e['type'])]

    def ids(self, kind):
        return {event['id'] for event in self.events(kind)}

    def worst(self, kind):
        return max(event['severity'] for event in self.events(kind))

    def run_to(self, speed, acceleration):
        told = call('/simulation_node/set_speed', SetSpeed, 'shaft', speed, acceleration, 0.0)
        self.assertTrue(told.success, told.message)
        self.assertTrue(wait_until(lambda: abs(self.shaft.speed - speed) < 1e-9))

    def calm(self):
        """All that was raised has cleared, for so long [s] that what comes is no repeat of it."""
        now = self.shaft.time
        self.assertTrue(wait_until(lambda: self.monitor_status.time > now and self.monitor_status.alerts == 0))
        now = self.shaft.time
        self.assertTrue(wait_until(lambda: self.monitor_status.time > now + 4.0))

    def set_alarms(self, settings):
        told = call('/monitor_node/set_alarm_settings', SetAlarmSettings, settings)
        self.assertTrue(told.success, told.message)

    def test_three_accelerations_are_announced_accompanied_and_cleared_once_each(self):
        for passed, acceleration in enumerate((10.0, 30.0, 90.0), start=1):
            self.run_to(HIGH, acceleration)
            self.calm()
            self.assertEqual(len(self.ids('CRITICAL_SPEED_APPROACH')), 2 * passed - 1)
            self.assertEqual(len(self.ids('IN_CRITICAL_BAND')), 2 * passed - 1)
            self.run_to(LOW, 60.0)  # down through it, again one of each
            self.calm()
        self.assertEqual(self.worst('IN_CRITICAL_BAND'), WARNING)
        self.assertEqual({event['type'] for event in self.events()}, {'CRITICAL_SPEED_APPROACH', 'IN_CRITICAL_BAND'})

    def test_a_ripple_about_the_edge_is_one_alert(self):
        self.run_to(47.9, 10.0)
        for _ in range(4):
            self.run_to(48.4, 10.0)
            self.run_to(47.9, 10.0)
        self.run_to(LOW, 10.0)
        self.calm()
        self.assertEqual(len(self.ids('IN_CRITICAL_BAND')), 1)
        self.assertEqual(len(self.ids('CRITICAL_SPEED_APPROACH')), 1)

    def test_to_dwell_is_danger(self):
        self.run_to(60.0, 30.0)
        self.assertTrue(wait_until(lambda: self.events('IN_CRITICAL_BAND') and
                                   self.worst('IN_CRITICAL_BAND') == DANGER))
        self.run_to(HIGH, 30.0)
        self.calm()
        self.assertEqual(len(self.ids('IN_CRITICAL_BAND')), 1)

    def test_trip_multiply_lets_a_run_up_pass_and_nothing_else(self):
        self.set_alarms('{amplitude: {rotor: {alert: 0.4e-3}}, trip_multiply: 5}')
        self.run_to(HIGH, 20.0)
        self.calm()
        self.assertFalse(self.ids('WHIRL_AMPLITUDE'))
        self.run_to(LOW, 20.0)  # no start-up
        self.calm()
        self.assertEqual(len(self.ids('WHIRL_AMPLITUDE')), 1)
        self.set_alarms('{trip_multiply: ~}')
        self.run_to(HIGH, 20.0)
        self.calm()
        self.assertEqual(len(self.ids('WHIRL_AMPLITUDE')), 2)
