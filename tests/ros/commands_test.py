"""Commands go from ROS to LCM and from LCM to a twin on ROS, of one commander at a time; who else commands is told whose
turn it is, but may always pause. What is malformed, or comes a played log, is not carried out."""
import itertools
import os
import socket
import struct
import subprocess
import sys
import threading
import time

import rospkg
import rospy
from std_srvs.srv import Trigger
from whirl_twin.srv import SetInput, SetParameter, SetSpeed, StepN
from whirl_twin_lcm.whirl_twin import command_answer_t, twin_command_t

from node_trial import ERROR, OK, WARN, NodeTrial, load_scene, wait_until

sys.path.append(os.path.join(rospkg.RosPack().get_path('whirl_twin'), 'examples/listeners'))
from lcm_receiver import LcmReceiver  # noqa: E402

TWIN = os.environ['WHIRL_TWIN_PROGRAM']
GROUP = ('239.255.76.67', 7667)
LEASE = 5.0  # s, long beside what a command takes on a busy machine
SCENE = """
step: 0.001
drives: {shaft: {speed: 20.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    inputs: {force_x: 0.0}
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4}
"""


class Commands(NodeTrial):
    def setUp(self):
        super().setUp()
        scene = os.path.join(self.folder.name, 'scene.yaml')
        with open(scene, 'w') as file:
            file.write(SCENE)
        load_scene(scene)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.numbers = itertools.count(1)
        self.answers, self.channels = {}, []
        self.over = threading.Event()
        self.addCleanup(self.over.set)
        threading.Thread(target=self.hear, daemon=True).start()
        self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=')
        self.start('command_bridge_node', '__name:=taker', '_lease:=%g' % LEASE)
        self.remote = self.start('command_bridge_node', '__name:=remote', '_role:=send')
        self.assertTrue(wait_until(lambda: self.diagnosed('taker: commands', OK, 'no commander')),
                        '\n'.join(map(self.log, self.processes)) + str(self.status))
        for service in ('pause', 'resume', 'step', 'set_speed', 'set_parameter', 'set_input'):
            rospy.wait_for_service('/simulation_node/' + service, 30)

    def hear(self):
        for channel, data in LcmReceiver('udpm://239.255.76.67:7667'):
            if self.over.is_set():
                break
            self.channels.append(channel)
            if channel == 'TWIN_COMMAND_ANSWERS':
                answer = command_answer_t.decode(data)
                self.answers[answer.sender, answer.number] = answer

    def datagram(self, channel, data):
        self.socket.sendto(b'LC02' + struct.pack('>I', 1) + channel.encode() + b'\0' + data, GROUP)

    def encoded(self, sender, command, name='', numbers=(), duration=0.0, age=0.0):
        message = twin_command_t()
        message.utime = int(1e6 * (time.time() - age))
        message.sender, message.number, message.command, message.name = sender, next(self.numbers), command, name
        message.keys, message.values = [key for key, _ in numbers], [value for _, value in numbers]
        message.count, message.time = len(message.keys), duration
        return message.number, message.encode()

    def command(self, sender, *arguments, **more):
        """By LCM; its answer."""
        number, data = self.encoded(sender, *arguments, **more)
        self.datagram('TWIN_COMMANDS', data)
        self.assertTrue(wait_until(lambda: (sender, number) in self.answers, 10), (sender, arguments))
        return self.answers[sender, number]

    def ask(self, service, kind, *arguments):
        """By ROS, of the bridge that sends."""
        rospy.wait_for_service('/remote/' + service, 30)
        return rospy.ServiceProxy('/remote/' + service, kind)(*arguments)

    def test_from_ros_by_lcm_to_ros(self):
        self.assertTrue(self.ask('pause', Trigger).success)
        before = self.ask('step', StepN, 0).step
        answer = self.ask('step', StepN, 25)
        self.assertEqual((answer.success, answer.step - before), (True, 25), answer.message)
        self.assertAlmostEqual(answer.time, 1e-3 * answer.step)
        answer = self.ask('set_speed', SetSpeed, 'shaft', 40.0, 100.0, 0.0)
        self.assertEqual((answer.success, answer.speed), (True, 40.0), answer.message)
        self.assertAlmostEqual(answer.duration, 0.2)
        answer = self.ask('set_parameter', SetParameter, 'rotor', 'damping', 15.0, 0.0, ['stiffness'], [7000.0])
        self.assertEqual((answer.success, answer.previous), (True, 12.0), answer.message)
        answer = self.ask('set_input', SetInput, 'rotor', 'force_x', 3.0, 0.5)
        self.assertEqual((answer.success, answer.step), (True, before + 25), answer.message)
        answer = self.ask('set_parameter', SetParameter, 'rotor', 'damping', -1.0, 0.0, [], [])
        self.assertFalse(answer.success)
        self.assertIn('must be', answer.message, 'the words of the simulation')
        self.assertTrue(wait_until(lambda: self.diagnosed('taker: commands', OK, '^/remote on .* has the command')))
        values = {value.key: value.value for value in self.status['taker: commands'].values}
        self.assertGreater(float(values['time from command to answer, 50 % [s]']), 0.0)

    def test_one_commander_at_a_time(self):
        speed = ('set_speed', 'shaft', [('speed', 30.0), ('max_acceleration', 50.0), ('max_jerk', 0.0)])
        rospy.wait_for_service('/remote/resume', 30)
        answer = self.command('first', *speed)
        self.assertTrue(answer.done, answer.message)
        answer = self.command('second', *speed)
        self.assertFalse(answer.done)
        self.assertRegex(answer.message, r'^first has the command for another [0-9.]+ s')
        self.assertIn('first has the command', self.ask('resume', Trigger).message)
        self.assertTrue(wait_until(lambda: self.diagnosed('taker: commands', WARN, 'commands are refused')))
        self.assertTrue(self.command('first', *speed).done)
        begun = time.monotonic()
        self.assertTrue(self.command('second', 'pause').done, 'anybody may stop it')
        self.assertFalse(self.command('second', 'resume').done, 'and has no lease by that')
        time.sleep(max(0.0, LEASE + 0.2 - (time.monotonic() - begun)))
        self.assertTrue(self.command('second', 'resume').done, 'the lease has run out')
        self.assertRegex(self.command('first', *speed).message, '^second has the command')
        self.assertTrue(self.command('second', 'release').done)
        self.assertTrue(self.command('first', *speed).done)

    def test_two_that_take_them_name_each_other(self):
        name = 'taker: commands'
        self.assertFalse(self.diagnosed(name, ERROR))
        second = self.start('command_bridge_node', '__name:=second')
        self.assertTrue(wait_until(lambda: self.diagnosed(name, ERROR, '/second on .* also executes the commands of TWIN_')))
        self.assertTrue(wait_until(lambda: self.diagnosed('second: commands', ERROR, '/taker on ')))
        self.end(second)
        self.assertTrue(wait_until(lambda: self.diagnosed(name, OK)), 'forgotten when it has gone')

    def test_a_pause_ends_a_step_under_way(self):
        self.assertTrue(self.command('first', 'pause').done)
        number, data = self.encoded('first', 'step', '', [('steps', 4e9)])
        self.datagram('TWIN_COMMANDS', data)
        time.sleep(0.3)
        self.assertTrue(self.command('second', 'pause').done)
        self.assertTrue(wait_until(lambda: ('first', number) in self.answers, 10))
        self.assertIn('interrupted by a pause', self.answers['first', number].message)

    def test_what_is_not_carried_out(self):
        for words, arguments, more in [
                ('a played log', ('resume',), {'age': 60.0}),
                ("found 'resum'; did you mean 'resume'", ('resum',), {}),
                ('speed: missing; .*torque: unknown key', ('set_speed', 'shaft', [('torque', 1.0)]), {}),
                ('steps: must be a whole number', ('step', '', [('steps', -1.0)]), {}),
                ("drive: must be a drive of the scene, found 'shaff'",
                 ('set_speed', 'shaff', [('speed', 1.0), ('max_acceleration', 1.0), ('max_jerk', 0.0)]), {})]:
            answer = self.command('first', *arguments, **more)
            self.assertFalse(answer.done)
            self.assertRegex(answer.message, words)
        _, data = self.encoded('first', 'resume')
        for garbage in (data[:-3], b'', b'\0' * 200, data[:24] + b'\x7f\xff\xff\xff' + data[28:]):
            self.datagram('TWIN_COMMANDS', garbage)
        malformed = lambda: {v.key: v.value for v in self.status['taker: commands'].values}['malformed']  # noqa: E731
        self.assertTrue(wait_until(lambda: malformed() == '4'), malformed)
        self.assertTrue(self.command('first', 'resume').done)

    def test_a_log_that_is_played_commands_only_if_asked(self):
        log = os.path.join(self.folder.name, 'run.lcmlog')
        with open(log, 'wb') as file:
            for number, channel in enumerate(('TWIN_COMMANDS', 'OTHER')):
                data = self.encoded('first', 'resume')[1]
                file.write(struct.pack('>IqqII', 0xEDA1DA01, number, 1000000 + number, len(channel), len(data)))
                file.write(channel.encode() + data)
        play = [TWIN, 'play', log, '--rate', 'max']
        for options, heard in (([], ['OTHER']), (['--commands'], ['TWIN_COMMANDS', 'OTHER'])):
            del self.channels[:]
            subprocess.check_call(play + options, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
            self.assertTrue(wait_until(lambda: 'OTHER' in self.channels))
            self.assertEqual([c for c in self.channels if c in ('TWIN_COMMANDS', 'OTHER')], heard)
