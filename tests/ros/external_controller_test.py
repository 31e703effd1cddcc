"""The controllers of examples/external_controller, in processes of their own: in lockstep what they hold moves as what the
built-in law holds, byte for byte; free-running their age is told; killed, one is named by an alert and nothing else
stops."""
import collections
import os
import struct
import subprocess

import rospkg
import rospy
from std_msgs.msg import Float64
from std_srvs.srv import Trigger
from whirl_twin.msg import AlertArray, ControllerState, LoopStatistics, PendulumState

from node_trial import NodeTrial, load_scene, wait_until

EXAMPLES = os.path.join(rospkg.RosPack().get_path('whirl_twin'), 'examples/external_controller')
STEPS = 1500


class ExternalController(NodeTrial):
    def setUp(self):
        super().setUp()
        self.states = collections.defaultdict(dict)
        self.restarts = collections.Counter()
        self.controller = ControllerState()
        self.alerts = {}
        self.loop = LoopStatistics()

    def take_state(self, state):
        if state.step < self.states[state.header.frame_id].get('newest', -1):
            self.states[state.header.frame_id] = {}
            self.restarts[state.header.frame_id] += 1
        self.states[state.header.frame_id]['newest'] = state.step
        self.states[state.header.frame_id][state.step] = struct.pack('2d', state.angle[0], state.rate[0])

    def take_controller(self, controller):
        self.controller = controller

    def take_alerts(self, message):
        self.alerts = {(alert.type, alert.system) for alert in message.alerts}
        self.texts = [alert.text for alert in message.alerts]

    def take_loop(self, loop):
        self.loop = loop

    def begin(self, mode):
        with open(os.path.join(EXAMPLES, 'levitated.yaml')) as file:
            text = file.read().replace('mode: lockstep', 'mode: ' + mode)
        scene = os.path.join(self.folder.name, 'scene.yaml')
        with open(scene, 'w') as file:
            file.write(text)
        load_scene(scene)
        self.listen('/twin/controllers/pd', ControllerState, self.take_controller)
        self.listen('/twin/alerts', AlertArray, self.take_alerts)
        self.listen('/twin/loop', LoopStatistics, self.take_loop)
        for system in ('inside', 'outside', 'pendulum'):
            self.listen('/twin/%s/pendulum' % system, PendulumState, self.take_state)
        self.simulation = self.start('simulation_node')
        self.start('monitor_node')
        self.assertTrue(wait_until(lambda: self.controller.samples > 0), self.log(self.simulation))

    def control(self, *command):
        process = subprocess.Popen(command)
        self.addCleanup(process.kill)
        self.assertTrue(wait_until(lambda: self.controller.age >= 0), 'it has not answered')
        return process

    def newest(self, system):
        return self.states[system].get('newest', -1)

    def assert_alike_from_a_reset_on(self):
        before = self.restarts.copy()
        rospy.ServiceProxy('/simulation_node/reset', Trigger)()
        self.assertTrue(wait_until(lambda: min(self.restarts[name] - before[name] for name in ('inside', 'outside')) > 0))
        self.assertTrue(wait_until(lambda: min(map(self.newest, ('inside', 'outside'))) >= STEPS))
        both = [step for step in range(1, STEPS + 1) if step in self.states['inside'] and step in self.states['outside']]
        self.assertGreater(len(both), 100)  # a slow machine drops some on their way to us
        self.assertGreater(max(both), STEPS // 2)
        for step in both:
            self.assertEqual(self.states['inside'][step], self.states['outside'][step], 'step %d' % step)
        self.assertFalse(self.controller.lost)

    def assert_killed_it_is_named(self, process):
        process.kill()
        process.wait()
        self.assertTrue(wait_until(lambda: ('CONTROLLER_LOST', 'pd') in self.alerts), self.alerts)
        self.assertTrue(wait_until(lambda: self.controller.lost))
        reached = self.newest('pendulum')
        self.assertTrue(wait_until(lambda: self.newest('pendulum') > reached + 500), 'nothing else stops')

    def test_by_ros_in_lockstep(self):
        self.begin('lockstep')
        process = self.control(os.path.join(EXAMPLES, 'pd_by_ros.py'), 'pd', '50', '2', '1')
        self.assert_alike_from_a_reset_on()
        self.assert_killed_it_is_named(process)
        self.control(os.path.join(EXAMPLES, 'pd_by_ros.py'), 'pd', '50', '2', '1')
        self.assertTrue(wait_until(lambda: not self.controller.lost), 'it is there again')

    def test_by_lcm_in_lockstep(self):
        self.begin('lockstep')
        process = self.control(os.environ['PD_BY_LCM'], 'TWIN_PD', '50', '2', '1')
        self.assert_alike_from_a_reset_on()
        self.assert_killed_it_is_named(process)

    def test_free_running(self):
        self.begin('free_running')
        process = self.control(os.path.join(EXAMPLES, 'pd_by_ros.py'), 'pd', '50', '2', '1')
        self.assertTrue(wait_until(lambda: self.controller.age >= 1), 'its age is told')
        self.assertTrue(wait_until(lambda: self.loop.external == ['pd'] and self.loop.age_max[0] >= 1.0), self.loop)
        self.assertLessEqual(self.loop.age_p50[0], self.loop.age_p99[0])
        self.assertLessEqual(self.loop.age_p99[0], self.loop.age_max[0])
        self.assert_killed_it_is_named(process)

    def test_plain_numbers_are_commands(self):
        self.begin('free_running')
        numbers = self.publisher('/twin/controllers/pd/command_value', Float64)
        self.assertTrue(wait_until(lambda: numbers.get_num_connections() > 0))
        self.assertTrue(wait_until(lambda: numbers.publish(0.0025) or list(self.controller.output) == [0.0025]))
        self.assertGreaterEqual(self.controller.age, 0, 'it answers a sample')

    def test_lost_it_stops_what_it_acts_on(self):
        self.begin('free_running, on_timeout: stop')
        process = self.control(os.path.join(EXAMPLES, 'pd_by_ros.py'), 'pd', '50', '2', '1')
        self.assert_killed_it_is_named(process)
        self.assertTrue(wait_until(lambda: ('STOPPED', 'outside') in self.alerts), self.alerts)
        self.assertTrue(any('controller pd has not answered for 0.5 s' in text for text in self.texts), self.texts)
        self.assertNotIn(('STOPPED', 'inside'), self.alerts)
        reached = self.newest('inside')
        self.assertTrue(wait_until(lambda: self.newest('inside') > reached + 100), 'nothing else stops')
