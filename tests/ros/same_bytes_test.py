"""The same scene and the same commands at the same steps give the same bytes, with the clock of the twin: two runs of
simulation_node, in which the commands come at other instants of the wall clock and the steps in other portions, on
every topic and on every channel; the log of the one as tables and as a bag has what ROS had; and before the first
command it is what `twin simulate` writes."""
import collections
import csv
import os
import struct
import subprocess
import time

import rosbag
import rospy
from std_srvs.srv import Trigger
from whirl_twin.msg import ControllerState, DriveState, ParameterChange, PendulumState, WhirlState
from whirl_twin.srv import SetInput, SetParameter, SetSpeed, StepN

from node_trial import NodeTrial, load_scene, wait_until

TWIN = os.environ['WHIRL_TWIN_PROGRAM']
SCENE = """
step: 0.001
drives:
  shaft: {speed: 20.0}
  engine: {speed: 10.0, motor: {stall_torque: 0.5, no_load_speed: 100.0, drag: 0.001}}
systems:
  rotor:
    model: rigid_disc_rotor
    drive: shaft
    parameters: {mass: 6.0, polar_inertia: 0.0768, transverse_inertia: 0.03845,
                 overhung: {length: 0.3, bending_stiffness: 1610.066}, damping_displacement: 20.0,
                 eccentricity: 2.0e-5}
  driven:
    model: jeffcott_rotor
    drive: engine
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4, polar_inertia: 0.02}
  many:
    model: jeffcott_rotor
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 48.0, eccentricity: 1.0e-4, speed: 30.0}
    count: 20
    spread: {stiffness: {relative_half_width: 0.1}}
  mass:
    model: linear_system
    inputs: {force_x2: 0.0}
    parameters: {names: [x, x2], mass: [[1.0, 0.0], [0.0, 1.0]], damping: [[4.0, 0.0], [0.0, 1.0]],
                 stiffness: [[50.0, -5.0], [-5.0, 50.0]]}
  arms:
    model: double_pendulum
    integrator: runge_kutta_4
    parameters: {mass1: 1.0, mass2: 1.0, length1: 1.0, length2: 1.0, damping1: 0.01}
    initial: {theta1: 0.2, theta2: -0.1}
controllers:
  hold: {type: pid, rate: 230.0, measures: [mass.x], acts_on: [mass.force_x], delay: 0.006,
         sensor: {noise: 1.0e-4, bandwidth: 60.0, seed: 3},
         parameters: {kp: 20.0, ki: 100.0, kd: 1.0, setpoint: 0.02}}
sensors:
  probes: {rate: 1000.0, channels: {x: {measures: rotor.x, noise: 3.0e-6}, y: {measures: rotor.y, noise: 3.0e-6}}}
"""
KINDS = {'/twin/rotor/whirl': WhirlState, '/twin/driven/whirl': WhirlState, '/twin/mass/pendulum': PendulumState,
         '/twin/drives/shaft': DriveState, '/twin/controllers/hold': ControllerState,
         '/twin/rotor/parameters': ParameterChange}
FIRST_COMMAND = 60  # steps
ATTEMPTS = 3
# What is done, and how many steps are between.
COMMANDS = [
    FIRST_COMMAND,
    ('set_speed', SetSpeed, ('shaft', 60.0, 500.0, 1e5)), 70,
    ('set_parameter', SetParameter, ('rotor', 'damping_displacement', 30.0, 0.0, [], [])), 50,
    ('set_parameter', SetParameter, ('arms', 'damping1', 0.5, 0.13, [], [])), 31,
    ('set_input', SetInput, ('mass', 'force_x2', 2.0, 0.05)), 170,  # ramp and input end on the way
    ('set_parameter', SetParameter, ('hold', 'kp', 35.0, 0.0, [], [])), 90,
    ('reset', Trigger, ()), 40]
# Not of the twin alone: how the loop kept its time, which statistics of ensembles there was time to make, when the scene
# is told again.
EXEMPT = ('loop', 'ensemble', 'scene')


def call(service, kind, arguments):
    name = '/simulation_node/' + service
    rospy.wait_for_service(name, 30)
    answer = rospy.ServiceProxy(name, kind)(*arguments)
    assert answer.success, answer.message


def events(log):
    """(channel, payload) of an LCM log."""
    with open(log, 'rb') as file:
        content = file.read()
    at = 0
    while at < len(content):
        sync, _, _, name, size = struct.unpack_from('>IqqII', content, at)
        assert sync == 0xEDA1DA01
        at += 28
        yield content[at:at + name].decode(), content[at + name:at + name + size]
        at += name + size


def told_in_steps(clocks, before):
    """Without those that are told every tenth of a second in a pause, for nodes that come later, and those of before."""
    nanoseconds = [int(1e9) * sec + nsec for sec, nsec in (struct.unpack('<II', data) for data in clocks
                                                           if data not in before)]
    told = list(dict.fromkeys(nanoseconds))
    phase = collections.Counter(n % 4_000_000 for n in told).most_common(1)[0][0]
    return [n for n in told if n % 4_000_000 == phase]


def counts(channels):
    return {channel: len(messages) for channel, messages in channels.items()}


def without_count(data):
    """A message with a header, whose first number counts what the publisher has sent since its start."""
    return data[4:]


class SameBytes(NodeTrial):
    def run_twin(self, name, portion, rest):
        """Topics and channels, each with its messages in order. Steps go in portions, and after each is a rest [s]."""
        heard = {}
        log = os.path.join(self.folder.name, name + '.lcmlog')
        recorder = subprocess.Popen([TWIN, 'record', log], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.processes.append((recorder, os.devnull))
        twin = self.start('simulation_node', '_realtime:=ignore', '_clock:=true', '_measure:=true', '_paused:=true',
                          '__log:=' + os.path.join(self.folder.name, 'ros.log'))
        rospy.wait_for_message('/twin/loop', rospy.AnyMsg, 30)  # it runs, and has advertised all
        topics = [topic for topic, _ in rospy.get_published_topics('/twin')] + ['/clock']
        for topic in topics:
            self.listen(topic, rospy.AnyMsg, lambda m, topic=topic: heard.setdefault(topic, []).append(m._buff))
        self.assertTrue(wait_until(lambda: all(s.get_num_connections() == 1 for s in self.subscribers[1:])))
        time.sleep(1.0)  # the newest of each latched topic is here, and the recorder listens
        begun = set(heard['/clock'])
        heard.clear()
        call('reset', Trigger, ())
        told = 1
        self.await_states(heard, told)
        for command in COMMANDS:
            time.sleep(rest)
            if isinstance(command, tuple):
                call(*command)
                told += command[0] == 'reset'
                self.await_states(heard, told)
                continue
            for done in range(0, command, portion):
                steps = min(portion, command - done)
                call('step', StepN, (steps,))
                told += steps
                self.await_states(heard, told)
        self.end(twin)
        recorder.send_signal(2)
        recorder.wait(20)
        for subscriber in self.subscribers[1:]:
            subscriber.unregister()
        del self.subscribers[1:]
        channels = {}
        for channel, data in events(log):
            channels.setdefault(channel, []).append(data)
        heard['/clock'] = told_in_steps(heard['/clock'], begun)
        return ({topic: heard[topic] for topic in heard if not topic.endswith(EXEMPT)},
                {channel: channels[channel] for channel in channels if not channel.lower().endswith(EXEMPT)}, log)

    def await_states(self, heard, count):
        self.assertTrue(wait_until(lambda: len(heard.get('/twin/rotor/whirl', [])) >= count), count)

    def test_two_runs(self):
        self.scene = os.path.join(self.folder.name, 'scene.yaml')
        with open(self.scene, 'w') as file:
            file.write(SCENE)
        load_scene(self.scene)
        for attempt in range(ATTEMPTS):
            topics, channels, log = self.run_twin('first%d' % attempt, 8, 0.0)
            again_topics, again_channels, _ = self.run_twin('second%d' % attempt, 5, 0.05)
            if counts(channels) == counts(again_channels):
                break  # no datagram was lost before a recorder that had no time
        self.compare(topics, again_topics)
        self.compare(channels, again_channels)
        self.assertEqual(len(channels['TWIN_ROTOR_WHIRL']), 2 + 471 + 41)  # with the state before the first reset
        states = {topic: [self.message(kind, data) for data in topics[topic]] for topic, kind in KINDS.items()}
        self.check_reached(states)
        self.check_tables(log, states)
        self.check_bag(log, topics)
        self.check_simulate(states)

    def compare(self, once, again):
        self.assertEqual(sorted(once), sorted(again))
        for name in once:
            headed = name.startswith('/') and name != '/clock'
            a, b = ([without_count(data) if headed else data for data in run[name]] for run in (once, again))
            other = [i for i, (x, y) in enumerate(zip(a, b)) if x != y]
            self.assertEqual((len(a), other[:5]), (len(b), []), name)

    def message(self, kind, data):
        message = kind()
        message.deserialize(data)
        return message

    def check_reached(self, states):
        """The commands did what they say, each at its step."""
        last = 471 - 1
        self.assertAlmostEqual(states['/twin/drives/shaft'][last].speed, 60.0)
        damping = [m.values[m.names.index('damping_displacement')] for m in states['/twin/rotor/parameters']]
        self.assertEqual(damping[-2:], [30.0, 20.0])
        self.assertEqual(states['/twin/rotor/parameters'][-2].step, 130)

    def check_tables(self, log, states):
        folder = os.path.join(self.folder.name, 'tables')
        subprocess.check_call([TWIN, 'export', log, '--csv', folder], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(os.path.join(folder, 'twin.rotor.whirl.csv')) as file:
            rows = list(csv.DictReader(file))
        for row, message in zip(rows[-len(states['/twin/rotor/whirl']):], states['/twin/rotor/whirl']):
            self.assertEqual(int(row['step']), message.step)
            for field in ('time', 'x', 'y', 'x_rate', 'y_rate', 'shaft_angle', 'energy_residual'):
                self.assertEqual(float(row[field]), getattr(message, field), field)

    def check_bag(self, log, topics):
        path = os.path.join(self.folder.name, 'run.bag')
        subprocess.check_call([TWIN, 'export', log, '--bag', path], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        bagged = {}
        with rosbag.Bag(path) as bag:
            for topic, raw, _ in bag.read_messages(raw=True):
                bagged.setdefault(topic, []).append(without_count(raw[1]))
        shared = sorted(set(bagged) & set(topics))
        self.assertGreater(len(shared), 10)
        for topic in shared:
            on_ros = [without_count(data) for data in topics[topic]]
            self.assertEqual(bagged[topic][-len(on_ros):], on_ros, topic)

    def check_simulate(self, states):
        path = os.path.join(self.folder.name, 'run.csv')
        subprocess.check_call([TWIN, 'simulate', self.scene, '--duration', str(FIRST_COMMAND * 0.001), '--output', path],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(path) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), FIRST_COMMAND + 1)
        for row, whirl, arms in zip(rows, states['/twin/rotor/whirl'], states['/twin/mass/pendulum']):
            self.assertEqual(float(row['time']), whirl.time)
            self.assertEqual(float(row['rotor.whirl_radius']), whirl.radius)
            self.assertEqual([float(row['mass.' + name]) for name in arms.name], list(arms.angle))
