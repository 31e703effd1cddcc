#!/usr/bin/python3
"""The bridge passes on every message, or of states the newest at a rate: never an older one behind it, and the last one
too. Parameters are never left out, and who comes later gets them."""
import os
import subprocess
import sys

import rospy
import rostest
from whirl_twin.msg import DriveState, ParameterChange, WhirlState

from node_trial import NodeTrial, wait_until

TWIN = os.environ['WHIRL_TWIN_PROGRAM']
LAST = 2000  # steps
SCENE = """
step: 0.001
drives: {shaft: {speed: 20.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4}
"""


class NewestStates(NodeTrial):
    def play(self, *arguments):
        """The steps of both states that come through, and what the bridge counts."""
        scene, log = (os.path.join(self.folder.name, name) for name in ('scene.yaml', 'run.lcmlog'))
        with open(scene, 'w') as file:
            file.write(SCENE)
        subprocess.check_call([TWIN, 'simulate', scene, '--duration', str(0.001 * LAST), '--output', log],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        steps = {'whirl': [], 'drive': []}
        self.listen('/twin/rotor/whirl', WhirlState, lambda m: steps['whirl'].append(m.step))
        self.listen('/twin/drives/shaft', DriveState, lambda m: steps['drive'].append(m.step))
        bridge = self.start('lcm_bridge_node', *arguments)
        rospy.wait_for_service('/lcm_bridge_node/ready', 30)
        subprocess.check_call([TWIN, 'play', log], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        self.assertTrue(wait_until(lambda: all(told and told[-1] == LAST for told in steps.values())), self.log(bridge))
        late = []
        self.listen('/twin/rotor/parameters', ParameterChange, late.append)
        self.assertTrue(wait_until(lambda: late), 'latched')
        self.assertIn('stiffness', late[0].names)
        name = 'lcm_bridge_node: received from LCM'
        self.status.clear()
        self.assertTrue(wait_until(lambda: name in self.status))
        counts = {value.key: value.value for value in self.status[name].values}
        self.assertGreater(float(counts['s from arrival to publication, 50 %']), 0.0)
        for told in steps.values():
            self.assertEqual(told, sorted(set(told)))
        return steps, counts

    def test_every_message(self):
        steps, counts = self.play()
        self.assertEqual(int(counts['left out for newer ones']), 0)
        self.assertGreaterEqual(len(steps['whirl']) + int(counts['lost']), LAST, counts)

    def test_the_newest(self):
        steps, counts = self.play('_newest:=10')
        told = sum(map(len, steps.values()))
        self.assertGreater(told, 4)
        self.assertLess(told, LAST / 2)
        self.assertGreater(int(counts['left out for newer ones']), LAST)


if __name__ == '__main__':
    rospy.init_node('newest_test')
    rostest.rosrun('whirl_twin', 'newest_test', NewestStates, sys.argv)
