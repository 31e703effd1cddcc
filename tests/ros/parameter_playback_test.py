"""A change of parameters is recorded in the LCM log and told again in playback, where a monitor that
knows only the scene follows it.
"""
import os
import subprocess
import time

import rospy
from whirl_twin.msg import ParameterChange, StabilityMargin, WhirlState
from whirl_twin.srv import SetParameter

from node_trial import PATIENCE, TRIAL_SCENES, NodeTrial, load_scene, wait_until

URL = 'udpm://239.255.76.67:7667?ttl=0'


def once(messages):
    """Without repetitions: roscpp sends what is latched twice where a subscriber comes as it is published."""
    return [m for k, m in enumerate(messages) if k == 0 or m.header.stamp != messages[k - 1].header.stamp]


class ParameterPlayback(NodeTrial):
    def setUp(self):
        super().setUp()
        self.recorded = self.path('changed.lcmlog')
        load_scene(os.path.join(TRIAL_SCENES, 'supercritical.yaml'))

    def heard(self, topic, kind):
        """The messages of a topic that come from now on, and the subscription."""
        messages = []
        return messages, self.listen(topic, kind, messages.append)

    def record(self):
        """Changes told by the live twin while it is recorded."""
        recorder = self.start('lcm_recorder_node', '_log:=' + self.recorded, '_lcm_url:=' + URL)
        self.assertTrue(wait_until(lambda: os.path.exists(self.recorded)))
        changes, of_changes = self.heard('/twin/rotor/parameters', ParameterChange)
        whirls, of_whirls = self.heard('/twin/rotor/whirl', WhirlState)
        simulation = self.start('simulation_node', '_realtime:=ignore')
        rospy.wait_for_service('/simulation_node/set_parameter', timeout=PATIENCE)
        self.assertTrue(wait_until(lambda: len(whirls) > 300))
        change = rospy.ServiceProxy('/simulation_node/set_parameter', SetParameter)
        answer = change(system='rotor', parameter='internal_damping', value=16.0, ramp=0.0,
                        further_parameters=['damping', 'damping_y'],
                        further_values=[8.0, 8.0])
        self.assertTrue(answer.success, answer.message)
        self.assertTrue(wait_until(lambda: whirls[-1].step > answer.step + 1000))
        self.assertEqual(self.end(simulation), 0)
        time.sleep(0.5)  # the recorder takes what was sent last
        self.end(recorder)
        of_changes.unregister()
        of_whirls.unregister()
        return once(changes)

    def test_a_recorded_change_is_told_again_and_followed(self):
        live = self.record()
        self.assertEqual([list(m.changed) for m in live], [[], ['internal_damping', 'damping', 'damping_y']])

        changes, _ = self.heard('/twin/rotor/parameters', ParameterChange)
        margins, of_margins = self.heard('/twin/rotor/stability', StabilityMargin)
        self.start('lcm_bridge_node')
        self.start('monitor_node', '_source:=lcm', '_lcm_url:=' + URL)
        rospy.wait_for_service('/lcm_bridge_node/ready', timeout=PATIENCE)
        self.assertTrue(wait_until(lambda: of_margins.get_num_connections() > 0))
        subprocess.check_call(['lcm-logplayer', '--lcm-url=' + URL, self.recorded])
        self.assertTrue(wait_until(lambda: len(once(changes)) >= 2))
        # 60 (1 + 8 / 16): only who has taken the change over knows this threshold.
        self.assertTrue(wait_until(lambda: margins and abs(margins[-1].instability_speed - 90.0) < 1e-6))
        for told, again in zip(live, once(changes)):
            self.assertEqual(told.header.stamp, again.header.stamp)
            for field in ('step', 'time', 'names', 'values', 'changed', 'previous'):
                self.assertEqual(getattr(told, field), getattr(again, field), field)
