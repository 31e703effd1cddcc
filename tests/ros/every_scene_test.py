"""Every shipped scene runs live, loaded as demo.launch loads it: each system publishes finite states,
rotors their orders, and a stability margin, with no alert that its model does not hold. The verdict is
uncertain of what is being swung up, and of nothing else."""
import glob
import math
import os

import rospy
import rosparam
from whirl_twin.msg import AlertArray, OrderState, PendulumState, StabilityMargin, WhirlState

from node_trial import PATIENCE, SCENES, NodeTrial, load_scene

ROTORS = ['flexible_rotor', 'jeffcott_rotor', 'rigid_disc_rotor']
START = ['_lcm_url:=', '_realtime:=ignore']


def swung_up(scene):
    """Systems under a law that has no small motions to be judged by."""
    return {acted.split('.')[0] for law in scene.get('controllers', {}).values()
            if law['type'] == 'swing_up' for acted in law['acts_on']}


class EveryScene(NodeTrial):
    def run_scene(self, path):
        (scene, _), = rosparam.load_file(path)
        load_scene(path)
        nodes = [self.start('simulation_node', *START), self.start('monitor_node', '_lcm_url:=')]
        try:
            for name, system in scene['systems'].items():
                rotor = system['model'] in ROTORS
                kind, topic = (WhirlState, 'whirl') if rotor else (PendulumState, 'pendulum')
                state = rospy.wait_for_message('/twin/%s/%s' % (name, topic), kind, PATIENCE)
                while state.step < 20:  # a first step from rest has no energy to be measured by
                    state = rospy.wait_for_message('/twin/%s/%s' % (name, topic), kind, PATIENCE)
                numbers = [state.x, state.y] if rotor else list(state.angle) + list(state.rate)
                self.assertTrue(numbers and all(math.isfinite(x) for x in numbers), name)
                self.assertLess(abs(state.energy_residual), 1e-6, name)
                if rotor:
                    orders = rospy.wait_for_message('/twin/%s/orders' % name, OrderState, PATIENCE)
                    self.assertTrue(math.isfinite(orders.mean_x + orders.peak_to_peak), name)
                    self.assertEqual(len(orders.forward_lag), len(orders.order), name)
                margin = rospy.wait_for_message('/twin/%s/stability' % name, StabilityMargin, PATIENCE)
                self.assertEqual(margin.model, system['model'])
                if name not in swung_up(scene):
                    self.assertNotEqual(margin.verdict_name, 'uncertain', name)
            alerts = rospy.wait_for_message('/twin/alerts', AlertArray, PATIENCE).alerts
            self.assertFalse([a.text for a in alerts if a.type == 'MODEL_INVALID'])
        finally:
            statuses = [self.end(node) for node in nodes]
        self.assertEqual(statuses, [0, 0], [self.log(node) for node in nodes])

    def test_runs_live(self):
        scenes = sorted(glob.glob(os.path.join(SCENES, '*.yaml')))
        self.assertGreater(len(scenes), 10)
        wrong = []  # rostest reports no subtests
        for path in scenes:
            try:
                self.run_scene(path)
            except Exception as error:
                wrong.append('%s: %s' % (os.path.basename(path), error))
        self.assertFalse(wrong, '\n'.join(wrong))
