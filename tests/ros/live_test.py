"""The tests of live_tests (*_test.cpp), each file by a process of its own, on nodes that run a scene."""
import os
import subprocess

import roslib.packages
import rosparam

from node_trial import PACKAGE, SCENES, TRIAL_SCENES, NodeTrial, load_parameters, load_scene

DEMO = os.path.join(SCENES, 'demo.yaml')
TIME = 100  # s, for the tests of a file


class LiveTrial(NodeTrial):
    def begin(self, scene, namespace='/', source='ros', settings=None):
        """The simulation and the monitor, as demo.launch starts them."""
        twin = '/twin' if namespace == '/' else namespace
        load_scene(os.path.join(TRIAL_SCENES, scene), twin)
        place = namespace.rstrip('/') + '/monitor_node'
        if settings is None:
            load_parameters(os.path.join(PACKAGE, 'config', 'monitor.yaml'), place)
        else:
            rosparam.upload_params(place, settings)
        there = [] if namespace == '/' else ['__ns:=' + namespace]
        self.start('simulation_node', '_realtime:=ignore', *there)
        self.start('monitor_node', '_source:=' + source, *there)

    def passes(self, suite):
        program = roslib.packages.find_node('whirl_twin', 'live_tests')[0]
        try:
            done = subprocess.run([program, '--gtest_filter=%s.*' % suite], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, universal_newlines=True, errors='replace', timeout=TIME)
        except subprocess.TimeoutExpired as late:
            self.fail('%s: not done after %d s: %s' % (suite, TIME, late.output))
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r'\[  PASSED  \] [1-9]', 'no test has this name')


class Live(LiveTrial):
    def test_topics_services_and_a_silent_monitor(self):
        self.begin(DEMO)
        self.passes('LiveTopics')
        self.passes('Services')
        self.passes('MonitorSilent')

    def test_live_change(self):
        self.begin('changed_live.yaml')
        self.passes('LiveChange')

    def test_set_input(self):
        self.begin('inputs.yaml')
        self.passes('SetInput')

    def test_motor(self):
        self.begin('motor.yaml')
        self.passes('Motor')

    def test_ensemble(self):
        self.begin('ensemble.yaml')
        # What the twin sends on LCM, back on ROS beside what it publishes there itself.
        self.start('lcm_bridge_node', *('/twin/%s:=/bridged/%s' % (topic, topic) for topic in (
            'rotor/whirl', 'rotor/joint_states', 'rotor/parameters', 'loop', 'rotor/ensemble')))
        self.passes('Ensemble')

    def test_stopped_system(self):
        self.begin('diverging.yaml')
        self.passes('StoppedSystem')

    def test_stopped_system_of_a_monitor_that_hears_nothing_but_lcm(self):
        self.begin('diverging.yaml', source='lcm')
        self.passes('StoppedSystem')


class LiveAlarms(LiveTrial):
    def test_alerts(self):
        self.begin('run_up.yaml')
        self.passes('Alerts')

    def test_alarm_commands(self):
        self.begin('threshold.yaml', settings={
            'latch': 'danger', 'amplitude': {'rotor': {'alert': 0.5e-3, 'danger': 1.0e-3}}})
        self.passes('AlarmCommandsTest')


class LiveLog(LiveTrial):
    def test_live_log(self):
        self.begin('all_messages.yaml')
        self.passes('LiveLog')


class TwoTwins(LiveTrial):
    def test_two_twins(self):
        """Under one master, each with a rotor of the same name."""
        self.begin('supercritical.yaml')
        self.begin('ensemble.yaml', namespace='/plant/machine', source='lcm')
        self.passes('TwoTwins')
