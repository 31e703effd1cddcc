"""A twin that was killed goes on from its checkpoint by another process, byte for byte as the one that was killed did,
with what was changed live; one that was ended goes on where it ended; a file it cannot go on from is refused."""
import io
import os
import signal

import rospy
from whirl_twin.msg import ControllerState, DriveState, PendulumState, WhirlState
from whirl_twin.srv import SetParameter, SetSpeed

from node_trial import NodeTrial, load_scene, wait_until

SCENE = """
step: 0.002
drives: {shaft: {speed: 20.0}}
systems:
  rotor:
    model: rigid_disc_rotor
    drive: shaft
    parameters: {mass: 6.0, polar_inertia: 0.0768, transverse_inertia: 0.03845,
                 overhung: {length: 0.3, bending_stiffness: 1610.066}, damping_displacement: 20.0,
                 eccentricity: 2.0e-5}
  mass:
    model: linear_system
    parameters: {names: [x], mass: [[1.0]], damping: [[4.0]], stiffness: [[50.0]]}
controllers:
  hold: {type: pid, rate: 230.0, measures: [mass.x], acts_on: [mass.force_x], delay: 0.006,
         sensor: {noise: 1.0e-4, bandwidth: 60.0, seed: 3},
         parameters: {kp: 20.0, ki: 100.0, kd: 1.0, setpoint: 0.02}}
"""
TOPICS = [('/twin/rotor/whirl', WhirlState), ('/twin/mass/pendulum', PendulumState),
          ('/twin/drives/shaft', DriveState), ('/twin/controllers/hold', ControllerState)]


def bytes_of(message):
    message.header.seq = 0  # a publisher counts its messages
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


class CheckpointOfTheTwin(NodeTrial):
    def setUp(self):
        super().setUp()
        self.scene = os.path.join(self.folder.name, 'scene.yaml')
        with open(self.scene, 'w') as file:
            file.write(SCENE)
        load_scene(self.scene)
        self.file = os.path.join(self.folder.name, 'run.checkpoint')
        self.heard = {}
        for topic, kind in TOPICS:
            self.listen(topic, kind, lambda m, topic=topic: self.heard.setdefault((topic, m.step), bytes_of(m)))

    def begin(self, *arguments):
        if rospy.has_param('/simulation_node'):
            rospy.delete_param('/simulation_node')  # what was given to the one before
        # By the clock of the twin stamps, too, are its own.
        return self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=', '_clock:=true', *arguments,
                          ROSCONSOLE_STDOUT_LINE_BUFFERED='1')

    def newest(self):
        return max((step for _, step in list(self.heard)), default=0)

    def saved(self):
        return os.path.exists(self.file) and os.stat(self.file).st_mtime_ns

    def change_live(self):
        for service, kind, arguments in [('set_parameter', SetParameter, ('rotor', 'damping_displacement', 30.0, 0.0, [], [])),
                                         ('set_speed', SetSpeed, ('shaft', 60.0, 20.0, 100.0)),
                                         ('set_parameter', SetParameter, ('hold', 'kp', 35.0, 0.0, [], []))]:
            name = '/simulation_node/' + service
            rospy.wait_for_service(name, 30)
            answer = rospy.ServiceProxy(name, kind)(*arguments)
            self.assertTrue(answer.success, answer.message)

    def test_killed_it_goes_on_to_the_bit(self):
        first = self.begin('_checkpoint:=' + self.file, '_checkpoint_period:=0.5')
        self.assertTrue(wait_until(lambda: self.newest() > 300), self.log(first))
        self.change_live()
        before = self.saved()
        self.assertTrue(wait_until(lambda: self.saved() != before))
        before = self.saved()
        self.assertTrue(wait_until(lambda: self.saved() != before))
        step = self.newest()
        self.assertTrue(wait_until(lambda: self.newest() > step + 400))
        first[0].send_signal(signal.SIGKILL)
        first[0].wait(20)
        lived, self.heard = self.heard, {}
        last = max(step for _, step in lived)
        second = self.begin('_resume:=' + self.file)
        self.assertTrue(wait_until(lambda: self.newest() > last + 100), self.log(second))
        self.assertTrue(self.says(second, 'resumed from step [1-9]'), self.log(second))
        for topic, _ in TOPICS:
            both = [key for key in list(self.heard) if key in lived and key[0] == topic]
            self.assertGreater(len(both), 50, topic)
            other = [key for key in both if self.heard[key] != lived[key]]
            self.assertEqual(other, [], '%d of %d are other' % (len(other), len(both)))

    def test_ended_it_goes_on_where_it_ended(self):
        first = self.begin('_checkpoint:=' + self.file, '_checkpoint_period:=1000')
        self.assertTrue(wait_until(lambda: self.newest() > 300), self.log(first))
        self.end(first)
        ended = self.says(first, r'stopped after (\d+) steps').group(1)
        second = self.begin('_resume:=' + self.file, '_checkpoint:=' + self.file)
        self.assertTrue(wait_until(lambda: self.says(second, 'resumed from step %s,' % ended)), self.log(second))
        self.assertTrue(wait_until(lambda: self.newest() > int(ended) + 100))

    def refused(self, words):
        process = self.begin('_resume:=' + self.file)
        self.assertEqual(process[0].wait(30), 2, self.log(process))
        self.assertTrue(self.says(process, words), self.log(process))

    def test_what_it_cannot_go_on_from_is_refused(self):
        self.refused('run.checkpoint: must be a checkpoint of a twin, found no such file')
        self.end(self.begin_and_wait())
        with open(self.file, 'rb') as file:
            whole = file.read()
        load_scene_with(self.scene, 'mass: 6.0', 'mass: 7.0')
        self.refused('systems.rotor.parameters.mass: expected 7, found 6')
        load_scene(self.scene)
        with open(self.file, 'wb') as file:
            file.write(whole[:len(whole) // 2])
        self.refused('run.checkpoint: truncated: must have [0-9]+ bytes')

    def begin_and_wait(self):
        process = self.begin('_checkpoint:=' + self.file)
        self.assertTrue(wait_until(lambda: self.newest() > 100))
        return process


def load_scene_with(scene, text, other):
    with open(scene) as file:
        changed = file.read().replace(text, other, 1)
    with open(scene + '.changed.yaml', 'w') as file:
        file.write(changed)
    load_scene(scene + '.changed.yaml')
