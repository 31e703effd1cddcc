"""A broken scene, wrong parameters: the nodes report all errors at once and exit with status 2."""
import subprocess

import roslib.packages
import rospy

from node_trial import NodeTrial

SCENE = {
    'step': 0.001,
    'systems': {
        'rotor': {
            'model': 'jeffcott_rotor',
            'parameters': {'mass': -1, 'stifness': 1.0e4, 'stiffness': 1.0e4, 'speed': 10.0},
        },
    },
}
SCENE_THAT_RUNS = {
    'step': 0.001,
    'systems': {'rotor': {'model': 'jeffcott_rotor',
                          'parameters': {'mass': 1, 'stiffness': 1.0e4, 'speed': 10.0}}},
}


def run(node):
    return subprocess.run(roslib.packages.find_node('whirl_twin', node)[:1], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True, timeout=60)


class BrokenScene(NodeTrial):
    def check(self, node):
        rospy.set_param('/twin/scene', SCENE)
        rospy.set_param('/twin/scene_file', 'bad.yaml')
        done = run(node)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn('bad.yaml: systems.rotor.parameters.mass: must be > 0 kg, found -1',
                      done.stdout)
        self.assertIn("bad.yaml: systems.rotor.parameters.stifness: unknown parameter of "
                      "jeffcott_rotor; did you mean 'stiffness'?", done.stdout)

    def test_simulation_node_refuses_it(self):
        self.check('simulation_node')

    def test_monitor_node_refuses_it(self):
        self.check('monitor_node')

    def test_misspelt_parameters_of_a_node_are_refused(self):
        for node, wrong, right in [('simulation_node', 'publsh_rate', 'publish_rate'),
                                   ('monitor_node', 'dwel_limit', 'dwell_limit')]:
            rospy.set_param('/twin/scene', SCENE_THAT_RUNS)
            rospy.set_param('/%s/%s' % (node, wrong), 1.0)
            done = run(node)
            rospy.delete_param('/%s/%s' % (node, wrong))
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("%s: unknown parameter; did you mean '%s'?" % (wrong, right),
                          done.stdout)

    def test_all_wrong_parameters_are_reported_at_once(self):
        wrong = {'batch': 0.5, 'priority': 50.5, 'real_time_factor': -1.0, 'overrun': 'ignore',
                 'lcm_prefix': '9', 'paused': 'maybe'}
        rospy.set_param('/twin/scene', SCENE_THAT_RUNS)
        rospy.set_param('/simulation_node', wrong)
        done = run('simulation_node')
        rospy.delete_param('/simulation_node')
        self.assertEqual(done.returncode, 2, done.stdout)
        for text in ('batch: must be from 0 to 0.1 s, found 0.5',
                     'priority: must be a whole number from 1 to 98, found another type',
                     'real_time_factor: must be 0 (as fast as possible), or from 0.01 to 1000, found -1',
                     "overrun: must be skip, catch_up or stop, found 'ignore'",
                     'paused: must be true or false, found another type'):
            self.assertIn('/simulation_node/' + text, done.stdout)
        self.assertIn('lcm_prefix: ', done.stdout)

    def test_a_bridge_needs_lcm(self):
        rospy.set_param('/lcm_bridge_node/lcm_url', '')
        done = run('lcm_bridge_node')
        rospy.delete_param('/lcm_bridge_node/lcm_url')
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn('lcm_url: must be an LCM URL, found nothing', done.stdout)

    def test_no_scene_at_all(self):
        done = run('simulation_node')
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn('scene: missing', done.stdout)
