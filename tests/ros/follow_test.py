"""A twin that follows a machine moves as it does, knows its stiffness, and says so when it hears no more of it."""
import math
import os
import time

import yaml
from whirl_twin.msg import AlertArray, FollowState, Measurement, SceneText, WhirlState

from node_trial import PACKAGE, SCENES, NodeTrial, load_parameters, load_scene, wait_until

NOISE = 3.0e-6  # m, of the probes
STIFFNESS = 7200.0  # N/m
SAMPLES = 300  # of the twin's motion, 100 a second


class Follow(NodeTrial):
    def setUp(self):
        super().setUp()
        self.machine, self.twin = {}, {}  # step: x + i y
        self.follow, self.raw, self.alerts, self.scene = None, None, {}, None
        self.listen('/machine/rotor/whirl', WhirlState, lambda m: self.machine.update({m.step: complex(m.x, m.y)}))
        self.listen('/twin/rotor/whirl', WhirlState, lambda m: self.twin.update({m.step: complex(m.x, m.y)}))
        self.listen('/twin/rotor/follow', FollowState, lambda m: setattr(self, 'follow', m))
        self.listen('/twin/measured/probes', Measurement, lambda m: setattr(self, 'raw', m))
        self.listen('/twin/scene', SceneText, lambda m: setattr(self, 'scene', m))
        self.listen('/twin/alerts', AlertArray, lambda m: self.alerts.update({a.type: a for a in m.alerts}))
        # The machine is simulated in /machine and publishes what its sensors see; /twin follows it.
        for place in ('/machine', '/twin'):
            load_scene(os.path.join(SCENES, 'followed_rotor.yaml'), place)
        load_parameters(os.path.join(PACKAGE, 'config/follow/followed_rotor.yaml'), '/follow_node/follow')
        load_parameters(os.path.join(PACKAGE, 'config/monitor.yaml'), '/monitor_node')
        self.simulation = self.start('simulation_node', '__ns:=/machine', '_realtime:=ignore', '_measure:=true')
        self.start('follow_node', '_publish_rate:=100')
        self.start('monitor_node')

    def apart(self, ahead):
        """rms between both, if the twin's step 0 was the machine's step `ahead`; m."""
        pairs = [(self.twin[k], self.machine[k + ahead]) for k in self.newest if k + ahead in self.machine]
        if len(pairs) < len(self.newest) // 2:
            return math.inf
        return math.sqrt(sum(abs(a - b) ** 2 for a, b in pairs) / len(pairs))

    def test_the_twin_moves_as_the_machine_and_says_that_it_is_gone(self):
        # It has settled for two seconds, and then has moved for SAMPLES.
        self.assertTrue(wait_until(lambda: self.follow and self.follow.time > 2.0), self.follow)
        self.twin.clear()
        self.assertTrue(wait_until(lambda: len(self.twin) >= SAMPLES))
        time.sleep(0.5)
        self.newest = sorted(self.twin)[:SAMPLES]
        first = min(self.machine)
        # Whichever sample of the machine was the first that the twin had: a turn is 140 ms long, two of which would
        # be as good as one another.
        lag = range(0, max(self.machine) - self.newest[-1] + 1)
        nearest = min(lag, key=self.apart)
        self.assertLess(self.apart(nearest), NOISE, f'machine from step {first}, {nearest} ahead')
        self.assertGreater(abs(self.twin[self.newest[-1]]), 20.0 * NOISE)

        self.assertEqual(self.follow.channel, ['probes/x', 'probes/y'])
        self.assertEqual(list(self.follow.channel_status), [FollowState.USED, FollowState.USED])
        self.assertTrue(self.follow.shaft_known)
        self.assertEqual(self.follow.parameter, ['stiffness'])
        self.assertLess(self.follow.deviation[0], 0.02 * STIFFNESS)
        self.assertLess(abs(self.follow.value[0] - STIFFNESS), 4.0 * self.follow.deviation[0])
        self.assertEqual(list(self.raw.channel), ['x', 'y'])
        self.assertEqual(yaml.safe_load('\n'.join(self.scene.line))['systems']['rotor']['model'], 'jeffcott_rotor')
        self.assertNotIn('SENSOR', self.alerts)

        self.end(self.simulation)
        # Beside it a machine that is held up, as on a loaded computer, has a clock that is off.
        self.assertTrue(wait_until(lambda: 'SENSOR' in self.alerts and
                                   'probes/x has no new samples' in self.alerts['SENSOR'].text), self.alerts)
        self.assertEqual(self.follow.channel_status[0], FollowState.SILENT)
