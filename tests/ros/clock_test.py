"""/clock goes at the rate asked for, and a reset, which begins the twin's own time anew, does not turn it back. States that
leave together are all there, each as it would be alone."""
import os
import time

import rospy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger
from whirl_twin.msg import MonitorStatus, WhirlState

from node_trial import SCENES, NodeTrial, call, load_scene, wait_until


class ClockOfTheTwin(NodeTrial):
    def test_a_reset_does_not_turn_it_back(self):
        load_scene(os.path.join(SCENES, 'demo.yaml'))
        clocks, whirls = [], []
        self.listen('/clock', Clock, lambda m: clocks.append(m.clock.to_nsec()))
        self.listen('/twin/rotor/whirl', WhirlState, whirls.append)
        self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=', '_clock:=true', '_clock_rate:=20')
        self.assertTrue(wait_until(lambda: len(clocks) > 20))
        self.assertEqual({after - before for before, after in zip(clocks[:20], clocks[1:21])}, {50_000_000})
        for _ in range(2):
            begun = len(whirls)
            self.assertTrue(call('/simulation_node/reset', Trigger).success)
            self.assertTrue(wait_until(lambda: any(w.step == 0 for w in whirls[begun:])))
            heard = len(clocks)
            self.assertTrue(wait_until(lambda: len(clocks) > heard + 10))
        self.assertEqual(clocks, sorted(clocks))
        stamps = [whirl.header.stamp.to_nsec() for whirl in whirls]
        self.assertEqual(stamps, sorted(set(stamps)), 'no instant twice')
        self.assertEqual(sum(whirl.step == 0 for whirl in whirls[1:]), 2, 'the time of the twin begins anew')
        self.assertGreater(clocks[-1], 1e9 * whirls[-1].time)

    def test_states_that_leave_together(self):
        load_scene(os.path.join(SCENES, 'demo.yaml'))
        whirls, joints = [], []
        self.listen('/twin/rotor/whirl', WhirlState, whirls.append)
        self.listen('/twin/pendulum/joint_states', JointState, joints.append)
        self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=', '_batch:=0.05', '_clock:=true')
        self.assertTrue(wait_until(lambda: len(whirls) > 500 and len(joints) > 500))
        steps = [whirl.step for whirl in whirls]
        self.assertEqual(steps, list(range(steps[0], steps[0] + len(steps))))
        self.assertEqual([whirl.header.stamp.to_nsec() for whirl in whirls], [1000000 * step for step in steps])
        for heard in (whirls, joints):
            counted = [message.header.seq for message in heard]
            self.assertEqual(counted, list(range(counted[0], counted[0] + len(counted))))

    def test_simulated_time_without_a_clock_is_reported_and_all_stamps_are_of_the_wall(self):
        """As a session with a bag leaves it behind (ros_comm #2111, #354)."""
        load_scene(os.path.join(SCENES, 'demo.yaml'))
        whirls, beats = [], []
        self.listen('/twin/rotor/whirl', WhirlState, whirls.append)
        self.listen('/twin/monitor', MonitorStatus, beats.append)
        rospy.set_param('/use_sim_time', True)
        nodes = [self.start('simulation_node', '_realtime:=ignore', '_lcm_url:='), self.start('monitor_node', '_lcm_url:=')]
        self.assertTrue(wait_until(lambda: whirls and beats))
        for message in (whirls[-1], beats[-1]):
            self.assertAlmostEqual(message.header.stamp.to_sec(), time.time(), delta=30.0)
        for node in nodes:
            self.assertTrue(wait_until(lambda: 'without a publisher of /clock' in self.log(node)))
            self.assertEqual(self.log(node).count('without a publisher of /clock'), 1)

    def test_two_publishers_of_the_clock_are_named(self):
        load_scene(os.path.join(SCENES, 'demo.yaml'))
        self.publisher('/clock', Clock)
        node = self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=', '_clock:=true')
        self.assertTrue(wait_until(lambda: '/clock must have one publisher' in self.log(node)))
        said, = [line for line in self.log(node).splitlines() if 'have one publisher' in line]
        self.assertIn('/simulation_node', said)
        self.assertIn(rospy.get_name(), said)
