"""The bridge passes on every message, or of states the newest at a rate: never an older one behind it, and the last one
too. Parameters are never left out, and who comes later gets them. One that comes late to a twin that has long stood hears
by LCM what ROS would have latched: the scene, the parameters, the alerts that stand."""
import os
import subprocess

import rospy
from std_srvs.srv import Trigger
from whirl_twin.msg import AlertArray, DriveState, ParameterChange, WhirlState

from node_trial import NodeTrial, load_scene, wait_until

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
        self.assertGreater(float(counts['time from reception to publication, 50 % [s]']), 0.0)
        for told in steps.values():
            self.assertEqual(told, sorted(set(told)))
        return steps, counts

    def test_every_message(self):
        steps, counts = self.play()
        self.assertEqual(int(counts['superseded by newer ones']), 0)
        self.assertGreaterEqual(len(steps['whirl']) + int(counts['lost']), LAST, counts)

    def test_the_newest(self):
        steps, counts = self.play('_newest:=10')
        told = sum(map(len, steps.values()))
        self.assertGreater(told, 4)
        self.assertLess(told, LAST / 2)
        self.assertGreater(int(counts['superseded by newer ones']), LAST)

    def test_who_comes_late(self):
        scene = os.path.join(self.folder.name, 'critical.yaml')
        with open(scene, 'w') as file:
            file.write(SCENE.replace('20.0', '60.0') + '    initial: {x: 250 um}\n')
        load_scene(scene)
        alerts, far_alerts, far_parameters = [], [], []
        self.listen('/twin/alerts', AlertArray, lambda m: alerts.append(m.alerts))
        self.start('simulation_node', '_realtime:=ignore')
        self.start('monitor_node')
        self.assertTrue(wait_until(lambda: alerts and alerts[-1]))
        rospy.wait_for_service('/simulation_node/pause', 30)
        self.assertTrue(rospy.ServiceProxy('/simulation_node/pause', Trigger)().success)
        self.listen('/far/alerts', AlertArray, lambda m: far_alerts.append(m.alerts))
        self.listen('/far/rotor/parameters', ParameterChange, far_parameters.append)
        self.start('lcm_bridge_node', '__ns:=/far', '_lcm_prefix:=TWIN_', '_derived:=true')
        self.assertTrue(wait_until(lambda: far_parameters and rospy.has_param('/far/scene') and far_alerts and far_alerts[-1]))
        self.assertEqual(rospy.get_param('/far/scene'), rospy.get_param('/twin/scene'))
        self.assertEqual(dict(zip(far_parameters[-1].names, far_parameters[-1].values))['stiffness'], 7200.0)
        stand = [(alert.id, alert.text) for alert in alerts[-1]]
        self.assertTrue(wait_until(lambda: [(alert.id, alert.text) for alert in far_alerts[-1]] == stand))
