"""`rosparam set` on a node that runs: limits of the monitor are obeyed, or refused in words, and what is read only at
the start is said to be; all of it until it is put back."""
import os

import rospy
from whirl_twin.srv import SetAlarmSettings

from node_trial import OK, SCENES, WARN, NodeTrial, load_scene, wait_until

MONITOR = 'monitor_node: private parameters'
SIMULATION = 'simulation_node: private parameters'


class ChangedParameters(NodeTrial):
    def setUp(self):
        super().setUp()
        load_scene(os.path.join(SCENES, 'demo.yaml'))

    def expect_diagnosed(self, name, level, pattern=''):
        self.assertTrue(wait_until(lambda: self.diagnosed(name, level, pattern)), (name, pattern, self.status))

    def test_limits_of_the_monitor(self):
        monitor = self.start('monitor_node', '_dwell_limit:=3.0')
        self.expect_diagnosed(MONITOR, OK)
        in_force = rospy.ServiceProxy('/monitor_node/set_alarm_settings', SetAlarmSettings)
        rospy.set_param('/monitor_node/dwell_limit', 2.5)
        self.assertTrue(wait_until(lambda: 'dwell_limit: 2.5' in in_force('').in_force), in_force(''))
        self.assertTrue(self.says(monitor, 'changed by parameters'))
        rospy.set_param('/monitor_node/dwel_limit', 1.0)
        self.expect_diagnosed(MONITOR, WARN, "dwel_limit: unknown.*did you mean 'dwell_limit'")
        self.assertTrue(self.says(monitor, "did you mean 'dwell_limit'"))
        rospy.delete_param('/monitor_node/dwel_limit')
        self.expect_diagnosed(MONITOR, OK)
        rospy.set_param('/monitor_node/dwell_limit', -1.0)
        self.expect_diagnosed(MONITOR, WARN, 'dwell_limit: must be')
        self.assertIn('dwell_limit: 2.5', in_force('').in_force)
        rospy.set_param('/monitor_node/source', 'lcm')
        self.expect_diagnosed(MONITOR, WARN, 'dwell_limit: .*; source: changed, but read only when the node starts')
        # The service and the parameters do not work against each other.
        self.assertTrue(in_force('{dwell_limit: 4}').success)
        rospy.delete_param('/monitor_node/source')
        self.expect_diagnosed(MONITOR, OK)
        self.assertIn('dwell_limit: 4', in_force('').in_force)

    def test_what_is_read_at_the_start(self):
        simulation = self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=', '_publish_rate:=100')
        self.expect_diagnosed(SIMULATION, OK)
        rospy.set_param('/simulation_node/publish_rate', 50)
        self.expect_diagnosed(SIMULATION, WARN, 'publish_rate: changed, but read only when the node starts')
        self.assertTrue(self.says(simulation, 'publish_rate: changed'))
        rospy.set_param('/simulation_node/publish_rate', 100)
        self.expect_diagnosed(SIMULATION, OK)
