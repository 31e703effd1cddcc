"""An alert is acknowledged, outlives a monitor that is killed, latches, is reset, and is held back, by the services
of the monitor."""
import os

from std_srvs.srv import Trigger
from whirl_twin.msg import AlertArray, MonitorStatus, StabilityMargin
from whirl_twin.srv import Acknowledge, Inhibit, SetSpeed

from node_trial import TRIAL_SCENES, NodeTrial, call, load_scene, wait_until


class Alarms(NodeTrial):
    def setUp(self):
        super().setUp()
        load_scene(os.path.join(TRIAL_SCENES, 'threshold.yaml'))
        self.list = self.margin = self.monitor_status = None
        self.listen('/twin/alerts', AlertArray, lambda m: setattr(self, 'list', m))
        self.listen('/twin/rotor/stability', StabilityMargin, lambda m: setattr(self, 'margin', m))
        self.listen('/twin/monitor', MonitorStatus, lambda m: setattr(self, 'monitor_status', m))
        self.start('simulation_node', '_realtime:=ignore')
        self.start_monitor()

    def start_monitor(self):
        self.monitor, _ = self.start('monitor_node', '_latch:=danger', '_history:=' + self.path('of/alarms'))

    def unstable(self):
        alerts = [a for a in self.list.alerts if a.type == 'UNSTABLE'] if self.list else []
        return alerts[0] if alerts else None

    def run_to(self, speed):
        self.assertTrue(call('/simulation_node/set_speed', SetSpeed, 'shaft', speed, 200.0, 0.0).success)

    def test_a_danger_from_raised_to_reset(self):
        self.assertTrue(wait_until(lambda: self.margin))
        self.assertFalse(call('/monitor_node/acknowledge', Acknowledge, 'rotor', 'UNSTABLE').success)
        self.run_to(250.0)
        self.assertTrue(wait_until(self.unstable))
        raised = self.unstable()
        self.assertFalse(raised.acknowledged)
        self.assertTrue(call('/monitor_node/acknowledge', Acknowledge, 'rotor', 'UNSTABLE').success)
        self.assertTrue(wait_until(lambda: self.unstable().acknowledged))

        self.monitor.kill()
        self.monitor.wait()
        self.list = self.margin = None
        self.start_monitor()
        self.assertTrue(wait_until(lambda: self.list))
        self.assertEqual(self.unstable().id, raised.id)
        self.assertTrue(self.unstable().acknowledged)
        self.assertTrue(wait_until(lambda: self.margin and self.margin.time > raised.time + 4.0))
        self.assertEqual(self.unstable().id, raised.id)
        self.assertFalse(self.unstable().latched)

        self.assertTrue(call('/monitor_node/reset_alarms', Trigger).success)
        self.assertTrue(self.unstable())  # its cause is there
        self.run_to(150.0)
        self.assertTrue(wait_until(lambda: self.unstable().latched))
        self.assertEqual(self.unstable().id, raised.id)
        self.assertTrue(call('/monitor_node/reset_alarms', Trigger).success)
        self.assertTrue(wait_until(lambda: not self.unstable()))

        self.assertFalse(call('/monitor_node/inhibit', Inhibit, 'roter', 60.0).success)
        self.assertTrue(call('/monitor_node/inhibit', Inhibit, 'rotor', 60.0).success)
        self.run_to(250.0)
        self.assertTrue(wait_until(lambda: self.margin.verdict == StabilityMargin.UNSTABLE and
                                   self.monitor_status.inhibited[0] > 0.0))
        self.assertFalse(self.unstable())
        self.assertTrue(call('/monitor_node/inhibit', Inhibit, '', 0.0).success)
        self.assertTrue(wait_until(self.unstable))
        self.assertGreater(self.unstable().id, raised.id)
