"""A twin in lockstep goes as fast as those who listen: a slow one hears every step, and no step is taken before it has
dealt with the one before. One that is killed is named, and the twin stands until it is told to go on without it, or
it is there again."""
import os
import subprocess

import rospy
from std_srvs.srv import Trigger
from whirl_twin.msg import LoopStatistics
from whirl_twin.srv import SetRealTimeFactor, StepN

from node_trial import ERROR, SCENES, NodeTrial, load_scene, wait_until

LISTENER = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'lockstep_listener.py')
SLOW = 0.01  # s
LOOP = 'simulation_node: real-time loop'


def call(service, kind=Trigger, *arguments):
    rospy.wait_for_service('/simulation_node/' + service, 30)
    return rospy.ServiceProxy('/simulation_node/' + service, kind)(*arguments)


class InLockstep(NodeTrial):
    def begin_listener(self, name, seconds):
        path = os.path.join(self.folder.name, name)
        process = subprocess.Popen(['/usr/bin/python3', LISTENER, path, str(seconds), '__name:=' + name])
        self.processes.append((process, os.devnull))
        return process

    def heard(self, name):
        """(step, heard at, acknowledged at) of all that a listener has dealt with."""
        try:
            with open(os.path.join(self.folder.name, name)) as file:
                lines = file.read().split('\n')[:-1]
        except FileNotFoundError:
            return []
        return [(int(step), float(at), float(done)) for step, at, done in map(str.split, lines)]

    def steps(self, name):
        return [step for step, _, _ in self.heard(name)]

    def await_steps(self, name, count):
        begun = len(self.steps(name))
        self.assertTrue(wait_until(lambda: len(self.steps(name)) >= begun + count), self.log(self.twin))

    def test_lockstep(self):
        load_scene(os.path.join(SCENES, 'demo.yaml'))
        loops = []
        self.listen('/twin/loop', LoopStatistics, loops.append)
        self.twin = self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=', '_real_time_factor:=0',
                               '_lockstep:=fast, slow', '_lockstep_timeout:=1', '__log:=' + self.folder.name + '/ros.log')
        self.begin_listener('fast', 0.0)
        self.assertTrue(wait_until(lambda: loops and loops[-1].waits_for == '/slow'), 'fast is there')
        self.assertEqual(self.steps('fast'), [], 'nothing is told before both are')
        slow = self.begin_listener('slow', SLOW)
        self.await_steps('slow', 100)
        self.assertTrue(wait_until(self.nobody_is_missed))

        self.assertTrue(call('reset').success)
        self.await_steps('slow', 20)
        self.assertTrue(call('pause').success)
        reached = call('step', StepN, 0).step
        self.assertEqual(call('step', StepN, 30).step, reached + 30)
        self.assertTrue(wait_until(lambda: self.steps('slow')[-1] == reached + 30))
        self.assertTrue(call('resume').success)
        self.check_every_step('fast', 'slow', resets=1)
        self.check_order()

        self.assertTrue(call('set_real_time_factor', SetRealTimeFactor, 0.02).success)
        self.assertTrue(wait_until(lambda: loops[-1].real_time_factor == 0.02 and loops[-1].achieved_factor < 0.05))
        self.assertTrue(call('set_real_time_factor', SetRealTimeFactor, 0.0).success)
        self.await_steps('slow', 20)

        slow.kill()
        self.assertTrue(wait_until(lambda: self.diagnosed(LOOP, ERROR, 'no acknowledgement by /slow')))
        self.assertRegex(self.log(self.twin), 'paused at step [0-9]+: no acknowledgement for 1 s by /slow')
        self.assertTrue(wait_until(lambda: loops[-1].paused))
        self.assertLessEqual(self.steps('fast')[-1], self.steps('slow')[-1] + 2, 'it did not go on by itself')
        self.assertTrue(call('resume').success)
        self.await_steps('fast', 100)
        self.check_every_step('fast', resets=1)

        begun = len(self.steps('slow'))
        self.begin_listener('slow', SLOW)
        self.assertTrue(wait_until(lambda: len(self.steps('slow')) > begun + 10 and self.told_to_all() < 2))
        caught_up = self.steps('slow')[-1] + 2
        self.await_steps('slow', 50)
        self.assertTrue(wait_until(self.nobody_is_missed), self.status.get(LOOP))
        again = self.steps('slow')[begun:]
        self.assertEqual(again, list(range(again[0], again[0] + len(again))))
        self.check_order(caught_up)
        self.assertEqual(loops[-1].dropped_snapshots, 0)
        self.assertEqual(loops[-1].ros_lost, 0)

    def told_to_all(self):
        """Steps that the slow one is behind."""
        return self.steps('fast')[-1] - self.steps('slow')[-1]

    def nobody_is_missed(self):
        return LOOP in self.status and 'lockstep' not in self.status[LOOP].message

    def check_every_step(self, *names, resets):
        for name in names:
            steps = self.steps(name)
            self.assertEqual(steps[0], 0)
            self.assertEqual([b for a, b in zip(steps, steps[1:]) if b != a + 1], [0] * resets, name)

    def check_order(self, first=0):
        """In the run since the last reset no step was told before the one before it was dealt with."""
        runs = []
        for name in ('fast', 'slow'):
            heard = self.heard(name)
            runs.append(heard[max(i for i, (step, _, _) in enumerate(heard) if step == 0):])
        begun = {step: at for step, at, _ in runs[0]}
        checked = [(begun[step + 1], done) for step, _, done in runs[1] if step >= first and step + 1 in begun]
        self.assertGreater(len(checked), 10)
        for next_begun, done in checked:
            self.assertGreater(next_begun, done)
