#!/usr/bin/python3
"""What is measured is taken in the order of its time, whatever order a bag, a log or a table has it in, and angles go on
from turn to turn. The motions are of a pendulum of point mass,

    theta'' = -g/l sin(theta) - c/(m l^2) theta',

integrated here (Runge-Kutta of order four, steps of 0.1 ms, which changes no digit that counts), the bags are written as
their format says. What cannot be one recording of one motion is refused with its cause.

usage: recordings_test.py TWIN FITS     FITS: ON where `twin fit` was built
"""
import csv
import json
import math
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

from lcm_log import event, events
from mcap_file import McapFile

TWIN, FITS = sys.argv[1:3]
GRAVITY = 9.80665
LENGTH, DAMPING = 0.2, 0.012
SCENE = """name: swing
step: 0.001
systems:
  p: {model: pendulum, parameters: {mass: 1.0, length: %g, damping: %g}, initial: {theta: 0.2}}
sensors:
  enc: {rate: 100.0, channels: {theta: {measures: p.theta, noise: 1.0e-3}}}
"""
JOINT_STATE = ('Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n' + 80 * '=' +
               '\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n')
MD5 = '3066dcd76a6cfaef579bd0f34173e9fd'


def swing(theta, rate, seconds, every=0.01, length=LENGTH, torque=lambda t: 0.0):
    """(time, angle) of the pendulum of 1 kg, with 1 mrad of noise."""
    noise = random.Random(7)

    def slope(t, q, v):
        return v, -GRAVITY / length * math.sin(q) + (torque(t) - DAMPING * v) / length**2

    h, rows, t = 1.0e-4, [], 0.0
    steps = round(every / h)
    for k in range(round(seconds / h) + 1):
        if k % steps == 0:
            rows.append((round(t, 6), theta + noise.gauss(0.0, 1.0e-3)))
        k1 = slope(t, theta, rate)
        k2 = slope(t + h / 2, theta + h / 2 * k1[0], rate + h / 2 * k1[1])
        k3 = slope(t + h / 2, theta + h / 2 * k2[0], rate + h / 2 * k2[1])
        k4 = slope(t + h, theta + h * k3[0], rate + h * k3[1])
        theta += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
        rate += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
        t = (k + 1) * h
    return rows


SWING = swing(1.2, 0.0, 3.0)
ROUND = swing(0.2, 16.0, 3.0)  # goes round some times, then swings


def text(value):
    return struct.pack('<I', len(value)) + value.encode()


def joint_state(time, names, angles):
    stamp = round(time * 1e9)
    return (struct.pack('<III', 0, stamp // 10**9, stamp % 10**9) + text('') + struct.pack('<I', len(names)) +
            b''.join(map(text, names)) + struct.pack('<I', len(angles)) + struct.pack('<%dd' % len(angles), *angles) +
            struct.pack('<II', 0, 0))


def record(fields, data):
    head = b''.join(struct.pack('<I', len(f)) + f for f in fields)
    return struct.pack('<I', len(head)) + head + struct.pack('<I', len(data)) + data


def bag(messages, chunks=3):
    """Of (time, topic, publisher, joints, angles) in the order in which they come."""
    connections, done = {}, []
    for part in range(chunks):
        chunk = b''
        for time, topic, publisher, names, angles in messages[part * len(messages) // chunks:(part + 1) * len(messages) //
                                                              chunks]:
            if (topic, publisher) not in connections:
                connections[topic, publisher] = len(connections)
                fields = [('topic', topic), ('type', 'sensor_msgs/JointState'), ('md5sum', MD5),
                          ('message_definition', JOINT_STATE), ('callerid', publisher)]
                data = b''.join(struct.pack('<I', len(k + v) + 1) + (k + '=' + v).encode() for k, v in fields)
                number = struct.pack('<I', connections[topic, publisher])
                chunk += record([b'conn=' + number, b'op=\7', b'topic=' + topic.encode()], data)
            stamp = round((100.0 + time) * 1e9)
            number = struct.pack('<I', connections[topic, publisher])
            chunk += record([b'conn=' + number, b'op=\2', b'time=' + struct.pack('<II', stamp // 10**9, stamp % 10**9)],
                            joint_state(time, names, angles))
        done.append(record([b'compression=none', b'op=\5', b'size=' + struct.pack('<I', len(chunk))], chunk))
    head = record([b'op=\3', b'index_pos=' + bytes(8), b'conn_count=' + bytes(4), b'chunk_count=' + bytes(4)], 4027 * b' ')
    return b'#ROSBAG V2.0\n' + head + b''.join(done)


def encoder(rows, topic='/machine/enc', joint='theta'):
    return [(time, topic, '/encoder', [joint], [angle]) for time, angle in rows]


class Recordings(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.file('scene.yaml', SCENE % (0.21, 0.01))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def file(self, name, data):
        with open(self.path(name), 'wb') as file:
            file.write(data if isinstance(data, bytes) else data.encode())
        return self.path(name)

    def table(self, rows, name='run.csv'):
        return self.file(name, 'time,angle\n' + ''.join('%.6f,%.9g\n' % row for row in rows))

    def twin(self, *arguments):
        return subprocess.run([TWIN] + list(arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              universal_newlines=True)

    def followed(self, recording, settings, scene='scene.yaml'):
        ended = self.twin('follow', self.path(scene), recording, '--lcm-prefix', 'MACHINE_', '--settings',
                          self.file('follow.yaml', settings), '--json')
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return json.loads(ended.stdout)

    def refused(self, cause, *arguments):
        ended = self.twin(*arguments)
        self.assertEqual(ended.returncode, 2, ended.stdout + ended.stderr)
        self.assertIn(cause, ended.stderr)

    FOLLOW = 'systems: {p: {disturbance: 0.01, parameters: {length: 0.1, damping: 0.5}}}\n'

    def test_a_bag_is_followed_by_time(self):
        in_order = self.followed(self.file('run.bag', bag(encoder(SWING))), self.FOLLOW)['systems']['p']
        self.assertAlmostEqual(in_order['parameters']['length']['value'], LENGTH, delta=1e-3 * LENGTH)
        self.assertEqual(in_order['samples']['used'], len(SWING))
        half = len(SWING) // 2
        swapped = [row for pair in zip(SWING[1::2], SWING[::2]) for row in pair] + SWING[-1:]
        shuffled = random.Random(1).sample(SWING, len(SWING))
        for rows in (SWING[half:] + SWING[:half], swapped, shuffled):
            other = self.followed(self.file('run.bag', bag(encoder(rows))), self.FOLLOW)
            self.assertEqual(other['systems']['p'], in_order)
            self.assertEqual(other['restarts'], 0)
            self.assertAlmostEqual(other['duration'], 3.0, delta=0.02)
            self.assertIn('taken in the order of their recorded times', other['remarks'][0])

    def test_a_bag_written_topic_by_topic_is_followed_by_time(self):
        two = (SCENE % (0.21, 0.01)).replace('p: {model', 'a: {model').replace('measures: p', 'measures: a')
        system = two.splitlines()[3]
        two = two.replace(system, system + '\n' + system.replace('  a:', '  b:'))
        two += '  other: {rate: 100.0, channels: {theta: {measures: b.theta, noise: 1.0e-3}}}\n'
        self.file('two.yaml', two)
        other = swing(-0.7, 0.0, 3.0)
        run = self.followed(
            self.file('run.bag', bag(encoder(SWING) + encoder(other, '/machine/other'))),
            'systems: {a: {disturbance: 0.01, parameters: {length: 0.1}}, b: {disturbance: 0.01, parameters: '
            '{length: 0.1}}}\n', 'two.yaml')
        self.assertAlmostEqual(run['duration'], 3.0, delta=0.02)
        for system in run['systems'].values():
            self.assertEqual(system['samples']['used'], len(SWING))
            self.assertAlmostEqual(system['parameters']['length']['value'], LENGTH, delta=2e-3 * LENGTH)

    def test_two_runs_in_one_bag_are_refused(self):
        run = bag(encoder(SWING) + encoder(swing(-0.7, 0.0, 3.0)))
        self.refused('must be one run, found two', 'follow', self.path('scene.yaml'), self.file('run.bag', run),
                     '--lcm-prefix', 'MACHINE_')

    def test_an_input_without_a_sample_is_refused(self):
        def torque(t):
            return 0.2 * math.sin(3.0 * t)
        rows = swing(0.3, 0.0, 3.0, torque=torque)
        moved = encoder(rows) + [(t, '/machine/motor', '/motor', ['tau'], [torque(t)]) for t, _ in rows]
        recording = self.file('run.bag', bag(moved))
        settings = 'systems: {p: {disturbance: 0.01, inputs: {torque: motor/tau}, parameters: {length: 0.1}}}\n'
        right = self.followed(recording, settings)['systems']['p']['parameters']['length']['value']
        self.assertAlmostEqual(right, LENGTH, delta=1e-3 * LENGTH)
        for missing in ('motors/tau', 'motor/tua', 'enc/tau'):
            other = self.file('other.yaml', settings.replace('motor/tau', missing))
            self.refused(missing + ', an input of the settings, must have a valid sample', 'follow',
                         self.path('scene.yaml'), recording, '--lcm-prefix', 'MACHINE_', '--settings', other)
        table = self.file('run.csv', 'time,theta\n' + ''.join('%g,%.9g\n' % row for row in rows))
        self.refused("no column 'tua'", 'follow', self.path('scene.yaml'), table, '--settings',
                     self.file('other.yaml', settings.replace('motor/tau', 'enc/tua')))

    def test_publishers_of_a_topic_are_in_one_table(self):
        both = [(t, '/joint_states', '/' + who, [who], [angle])
                for who in ('arm', 'base') for t, angle in SWING[:30]]
        recording = self.file('run.bag', bag(both))
        ended = self.twin('export', recording, '--csv', self.path('tables'))
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertEqual(os.listdir(self.path('tables')), ['joint_states.csv'])
        with open(self.path('tables/joint_states.csv'), newline='') as table:
            rows = list(csv.DictReader(table))
        self.assertEqual(len(rows), 60)
        times = [float(row['recorded']) for row in rows]
        self.assertEqual(times, sorted(times))
        for who in ('arm', 'base'):
            self.assertEqual([float(row['position[0]']) for row in rows if row['name[0]'] == who],
                             [angle for _, angle in SWING[:30]])
        self.assertEqual(self.twin('export', recording, '--mcap', self.path('run.mcap')).returncode, 0)
        times = [message[2] for message in McapFile(self.path('run.mcap')).messages]
        self.assertEqual(times, sorted(times))
        self.assertEqual(len(times), 60)

    def test_a_row_with_more_values_than_names_is_refused(self):
        rows = ['%g,%.9g,%g' % (t, angle, 0.5) for t, angle in SWING]
        self.study('run.csv', 'angle')
        self.file('run.csv', 'time,angle\n' + '\n'.join(rows) + '\n')
        self.refused('line 2: expected at most 2 values, as many as line 1 has names, found 3', 'fit',
                     self.path('study.yaml'))

    def study(self, name, column, more=''):
        self.file('study.yaml', 'scene: scene.yaml\nsystem: p\nruns:\n  - {file: %s, use: train, time: time, measured: '
                  '{theta: {column: %s%s}}}\nwindows: {length: 1.0, start: estimated}\n'
                  'fit: {length: {min: 0.05, max: 1.0}, damping: {min: 0.0}}\n' % (name, column, more))

    def fitted(self, name, column, more=''):
        self.study(name, column, more)
        return self.twin('fit', self.path('study.yaml'), '--lcm-prefix', 'MACHINE_', '--json')

    def assertRight(self, ended):
        self.assertEqual(ended.returncode, 0, ended.stderr)
        told = json.loads(ended.stdout)
        self.assertAlmostEqual(told['parameters']['length']['value'], LENGTH, delta=2e-3 * LENGTH)
        self.assertAlmostEqual(told['parameters']['damping']['value'], DAMPING, delta=5e-2 * DAMPING)
        return told

    @unittest.skipUnless(FITS == 'ON', 'without Ceres there is no fit')
    def test_what_follows_a_parameter_by_default_is_fitted_with_it(self):
        """The table is of scipy's DOP853: 2 kg, 7200 N/m, 12 N s/m along x and y, 1.0e-4 m at 0.4 rad, run up by 8 rad/s^2
        from 30 rad/s."""
        folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'recordings')
        parameters = 'mass: 2.0, stiffness: 6800.0, damping: 9.0, eccentricity: 1.2e-4, eccentricity_angle: 0.2'
        scene = ('step: 0.004\ndrives: {shaft: {speed: 30.0, profile: [{speed: 126.0, max_acceleration: 8.0, max_jerk: 1.0e7, '
                 'dwell: 0.0}]}}\nsystems:\n  r: {model: jeffcott_rotor, drive: shaft, parameters: {%s}}\n')
        study = ('scene: rotor.yaml\nsystem: r\nruns: [{file: %s/fit_rotor.csv, use: train, time: time, measured: {x: x, y: y}}]'
                 '\nwindows: {length: all, start: estimated}\nfit: {%s}\n')
        every = 'stiffness: {}, damping: {}, eccentricity: {}, eccentricity_angle: {}'

        def fit(parameters, unknowns):
            self.file('rotor.yaml', scene % parameters)
            ended = self.twin('fit', self.file('rotor_study.yaml', study % (folder, unknowns)), '--json', '--output',
                              self.path('fitted.yaml'))
            self.assertEqual(ended.returncode, 0, ended.stderr)
            return {name: one['value'] for name, one in json.loads(ended.stdout)['parameters'].items()}
        right = {'stiffness': 7200.0, 'damping': 12.0, 'eccentricity': 1.0e-4, 'eccentricity_angle': 0.4}
        found = fit(parameters, every)
        for name, value in right.items():
            self.assertAlmostEqual(found[name], value, delta=1e-3 * value, msg=name)
        with open(self.path('fitted.yaml')) as fitted:
            self.assertNotIn('stiffness_y', fitted.read())
        # One that is given does not follow, though it has the same value; one that is fitted is found for itself.
        given = fit(parameters + ', stiffness_y: 6800.0', every)
        self.assertGreater(abs(given['stiffness'] - 7200.0), 20.0)
        both = fit(parameters, 'stiffness_y: {start: 7000}, ' + every)
        for name in ('stiffness', 'stiffness_y'):
            self.assertAlmostEqual(both[name], 7200.0, delta=7.2, msg=name)

    @unittest.skipUnless(FITS == 'ON', 'without Ceres there is no fit')
    def test_angles_that_count_within_a_turn_are_unwrapped(self):
        self.assertRight(self.fitted(os.path.basename(self.table(ROUND)), 'angle'))
        for low, cells in ((-math.pi, 'angle'), (0.0, 'angle'), (0.0, '"angle[deg]"')):
            rows = [(t, low + (q - low) % (2 * math.pi)) for t, q in ROUND]
            scale = 180.0 / math.pi if 'deg' in cells else 1.0
            self.file('run.csv', 'time,' + cells.strip('"') + '\n' +
                      ''.join('%g,%.9g\n' % (t, scale * q) for t, q in rows))
            told = self.assertRight(self.fitted('run.csv', cells))
            remarks = ' '.join(told['runs']['run.csv']['remarks'])
            self.assertIn('counts within a turn', remarks)
        # As it is: the remark stays, and nothing is changed.
        told = json.loads(self.fitted('run.csv', cells, ', wrap: false').stdout)
        self.assertNotIn('counts within', ' '.join(told['runs']['run.csv']['remarks']))
        self.assertIn('jumps by', ' '.join(told['runs']['run.csv']['remarks']))

    @unittest.skipUnless(FITS == 'ON', 'without Ceres there is no fit')
    def test_whatever_becomes_of_a_recording_the_result_is_right_or_refused(self):
        dice = random.Random(3)
        causes = ('gap', 'found two', 'three rows per turn', 'counts within a turn')
        right = 0
        kinds = ('table', 'bag')
        for trial in range(12):
            rows = list(dice.choice((SWING, ROUND)))
            wrapped = dice.random() < 0.5
            if wrapped:
                low = dice.choice((-math.pi, 0.0, -1.0))
                rows = [(t, low + (q - low) % (2 * math.pi)) for t, q in rows]
            if dice.random() < 0.4:  # cut off, or out of it
                a, b = sorted(dice.sample(range(len(rows)), 2))
                rows = rows[a:b] if b - a > 150 else rows[:max(a, 100)] + rows[max(a, 100) + dice.randrange(40):]
            if dice.random() < 0.4:
                rows += dice.sample(rows, dice.randrange(len(rows)))
            order = dice.randrange(4)
            if order == 1:
                dice.shuffle(rows)
            elif order == 2:
                cut = dice.randrange(len(rows))
                rows = rows[cut:] + rows[:cut]
            elif order == 3:
                blocks = [rows[i:i + 25] for i in range(0, len(rows), 25)]
                dice.shuffle(blocks)
                rows = [row for block in blocks for row in block]
            kind = dice.choice(kinds)
            if kind == 'table':
                self.table(rows)
                ended = self.fitted('run.csv', 'angle')
            else:
                self.file('run.bag', bag(encoder(rows)))
                ended = self.fitted('run.bag', 'theta')
            with self.subTest(trial=trial, kind=kind, order=order, wrapped=wrapped):
                if ended.returncode == 2:
                    self.assertTrue(any(cause in ended.stderr for cause in causes), ended.stderr)
                else:
                    self.assertRight(ended)
                    right += 1
        self.assertGreater(right, 8)

    def test_a_log_is_followed_by_time(self):
        self.file('truth.yaml', (SCENE % (LENGTH, DAMPING)).replace('theta: 0.2', 'theta: 1.2'))
        log = self.path('run.lcmlog')
        ended = self.twin('simulate', self.path('truth.yaml'), '--duration', '3', '--measure', 'sensors', '--output', log)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        with open(log, 'rb') as file:
            told = [(stamp, channel, data) for _, stamp, channel, data in events(file.read())]

        def follow(told):
            data = b''.join(event(i, *one) for i, one in enumerate(told))
            ended = self.twin('follow', self.path('scene.yaml'), self.file('other.lcmlog', data), '--settings',
                              self.file('follow.yaml', self.FOLLOW), '--json')
            self.assertEqual(ended.returncode, 0, ended.stderr)
            return json.loads(ended.stdout)
        in_order = follow(told)
        self.assertAlmostEqual(in_order['systems']['p']['parameters']['length']['value'], LENGTH, delta=1e-3 * LENGTH)
        other = follow(random.Random(5).sample(told, len(told)))
        self.assertEqual(other['systems'], in_order['systems'])
        self.assertEqual(other['restarts'], 0)
        half = len(told) // 2
        self.file('halves.lcmlog', b''.join(event(i, *one) for i, one in enumerate(told[half:] + told[:half])))
        self.assertEqual(self.twin('export', self.path('halves.lcmlog'), '--mcap', self.path('run.mcap')).returncode, 0)
        times = [message[2] for message in McapFile(self.path('run.mcap')).messages]
        self.assertEqual(times, sorted(times))


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
