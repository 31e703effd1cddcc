#!/usr/bin/python3
"""What `twin export` writes is read by others: MCAP by a strict reader made from the specification (mcap_file.py), bags by
rosbag where there is ROS, tables by Python's csv. All three say the same, message by message, and damage costs no more
than what is damaged.

usage: export_test.py TWIN SCENE
"""
import csv
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

from lcm_log import SYNC, event, events
from mcap_file import McapFile, whole_chunks
from ros_messages import Definition

TWIN, SCENE = sys.argv[1:3]


def bag_tools():
    """rosbag and roslz4, or none."""
    try:
        import rosbag
        import roslz4
        return rosbag, roslz4
    except ImportError:
        return None, None


ROSBAG, ROSLZ4 = bag_tools()


def a_bag(topic, kind, definition, message):
    """A rosbag with one message, without the index at its end."""
    def record(header, data):
        fields = b''.join(struct.pack('<I', len(name) + 1 + len(value)) + name + b'=' + value for name, value in header)
        return struct.pack('<I', len(fields)) + fields + struct.pack('<I', len(data)) + data

    def fields(**values):
        return b''.join(struct.pack('<I', len(name) + 1 + len(value)) + name.encode() + b'=' + value
                        for name, value in values.items())

    number = struct.pack('<I', 0)
    connection = record([(b'op', b'\7'), (b'conn', number), (b'topic', topic.encode())],
                        fields(topic=topic.encode(), type=kind.encode(), md5sum=b'0' * 32,
                               message_definition=definition.encode()))
    chunk = connection + record([(b'op', b'\2'), (b'conn', number), (b'time', struct.pack('<II', 1, 0))], message)
    head = record([(b'op', b'\3'), (b'index_pos', bytes(8)), (b'conn_count', struct.pack('<I', 1)),
                   (b'chunk_count', struct.pack('<I', 1))], b' ' * 4000)
    return b'#ROSBAG V2.0\n' + head + record(
        [(b'op', b'\5'), (b'compression', b'none'), (b'size', struct.pack('<I', len(chunk)))], chunk)


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.mkdtemp()
        cls.log = os.path.join(cls.shared, 'demo.lcmlog')
        subprocess.run([TWIN, 'simulate', SCENE, '--duration', '3', '--output', cls.log], check=True)
        with open(cls.log, 'rb') as file:
            cls.bytes = file.read()
        cls.events = events(cls.bytes)
        out = os.path.join(cls.shared, 'demo.mcap')
        cls.told = json.loads(subprocess.run([TWIN, 'export', cls.log, '--mcap', out, '--json'], check=True,
                                             stdout=subprocess.PIPE).stdout)
        cls.whole = McapFile(out)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.shared)

    def setUp(self):
        self.folder = tempfile.mkdtemp()

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def file(self, name, data):
        with open(self.path(name), 'wb') as file:
            file.write(data)
        return self.path(name)

    def twin(self, *arguments):
        return subprocess.run([TWIN] + list(arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              universal_newlines=True)

    def export(self, log, *arguments):
        ended = self.twin('export', log, *arguments, '--json')
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return json.loads(ended.stdout)

    def refused(self, log, *arguments, status=2):
        ended = self.twin('export', log, *arguments)
        self.assertEqual(ended.returncode, status, ended.stderr)
        self.assertEqual(ended.stdout, '')
        self.assertEqual([name for name in os.listdir(self.folder) if '.part' in name], [])
        return ended.stderr

    def mcap(self, log, *arguments):
        told = self.export(log, '--mcap', self.path('out.mcap'), '--force', *arguments)
        return told, McapFile(self.path('out.mcap'), ROSLZ4 and ROSLZ4.decompress)

    def test_every_event_of_a_log_is_a_message(self):
        told, mcap = self.told, self.whole
        self.assertEqual(mcap.profile, 'ros1')
        self.assertEqual(told['messages'], len(self.events))
        self.assertEqual((told['rejected'], told['damaged'], told['foreign']), (0, 0, {}))
        self.assertEqual([time for _, _, _, time, _ in mcap.told()], [1000 * stamp for _, stamp, _, _ in self.events])
        names = {b'TWIN_ROTOR_WHIRL': '/twin/rotor/whirl', b'TWIN_SHAFT_DRIVE': '/twin/drives/shaft',
                 b'TWIN_PENDULUM_PENDULUM': '/twin/pendulum/pendulum'}
        for (_, _, channel, _), (topic, _, _, _, _) in zip(self.events, mcap.told()):
            self.assertEqual(names.get(channel, topic), topic)
        for i, (channel, _, _) in mcap.channels.items():
            sequence = [s for c, s, _, _, _ in mcap.messages if c == i]
            self.assertEqual(sequence, list(range(len(sequence))), channel)
        self.assertGreater(len(mcap.chunks), 1, 'a log of several chunks is what this asks about')

    def test_messages_of_ros_2_have_the_same_values(self):
        _, mcap = self.mcap(self.log, '--profile', 'ros2')
        self.assertEqual(mcap.profile, 'ros2')
        self.assertEqual([m[2] for m in mcap.messages], [m[2] for m in self.whole.messages])
        read = {}
        for old, new in zip(self.whole.messages, mcap.messages):
            (topic, old_schema, _), (new_topic, new_schema, metadata) = self.whole.channels[old[0]], mcap.channels[new[0]]
            (old_name, old_text), (new_name, new_text) = self.whole.schemas[old_schema], mcap.schemas[new_schema]
            self.assertEqual((topic, old_name.replace('/', '/msg/')), (new_topic, new_name))
            self.assertIn('offered_qos_profiles', metadata)
            if topic not in read:
                read[topic] = Definition(old_text, ros2=False), Definition(new_text, ros2=True)
            before, after = (definition.read(data) for definition, data in zip(read[topic], (old[4], new[4])))
            if 'header' in before:
                del before['header']['seq']
                stamp = before['header']['stamp']
                before['header']['stamp'] = {'sec': stamp['secs'], 'nanosec': stamp['nsecs']}
            self.assertEqual(repr(before), repr(after))  # NaN is itself
        self.assertGreater(len(read), 5)
        self.assertIn('--profile: must be with --mcap', self.refused(self.log, '--bag', self.path('x.bag'), '--profile', 'ros2'))

    def test_cdr_of_a_bag_that_has_everything(self):
        """Alignment and lengths of each kind, to the byte."""
        text = ('uint8 a\nfloat64 b\nstring c\nint16[] d\nuint8[3] e\nfloat64[] f\ntime g\nduration[] h\nstring[] i\nbyte j\n'
                'char k\na_package/Empty l\nbool m\n' + '=' * 80 + '\nMSG: a_package/Empty\n')
        ros1 = (b'\x07' + struct.pack('<d', 1.5) + b'\3\0\0\0abc' + b'\2\0\0\0\xff\xff\1\0' + b'\1\2\3' + b'\0\0\0\0' +
                b'\5\0\0\0\6\0\0\0' + b'\1\0\0\0\xff\xff\xff\xff\7\0\0\0' + b'\1\0\0\0\0\0\0\0' + b'\xfe' + b'\xfd' + b'\1')
        cdr = (b'\0\1\0\0' b'\7' + bytes(7) + struct.pack('<d', 1.5) + b'\4\0\0\0abc\0' + b'\2\0\0\0\xff\xff\1\0' + b'\1\2\3' +
               b'\0' + b'\0\0\0\0' + b'\5\0\0\0\6\0\0\0' + b'\1\0\0\0\xff\xff\xff\xff\7\0\0\0' + b'\1\0\0\0' + b'\1\0\0\0\0' +
               b'\xfe' + b'\xfd' + b'\0' + b'\1')
        bag = self.file('every.bag', a_bag('/every', 'a_package/Every', text, ros1))
        _, mcap = self.mcap(bag, '--profile', 'ros2')
        self.assertEqual(mcap.messages[0][4], cdr)
        (name, definition), = mcap.schemas.values()
        self.assertEqual(name, 'a_package/msg/Every')
        fields = Definition(definition, ros2=True).fields(definition.partition('=' * 80)[0])
        self.assertEqual([kind for _, kind, _ in fields],
                         ['uint8', 'float64', 'string', 'int16', 'uint8', 'float64', 'builtin_interfaces/Time',
                          'builtin_interfaces/Duration', 'string', 'int8', 'uint8', 'a_package/Empty', 'bool'])

    @unittest.skipUnless(ROSBAG, 'rosbag is not installed')
    def test_a_bag_says_what_the_mcap_file_says(self):
        mcap = self.whole
        self.export(self.log, '--bag', self.path('out.bag'))
        self.assertEqual(self.in_bag('out.bag'), sorted(mcap.told(), key=lambda m: m[3]))
        with ROSBAG.Bag(self.path('out.bag')) as bag:
            definitions = {c.topic: c.msg_def for c in bag._get_connections()}
        self.assertEqual(definitions, {topic: mcap.schemas[schema][1] for topic, schema, _ in mcap.channels.values()})

    @unittest.skipUnless(ROSBAG, 'rosbag is not installed')
    def test_a_bag_passes_on_as_it_is(self):
        self.export(self.log, '--bag', self.path('out.bag'))
        told, mcap = self.mcap(self.path('out.bag'))
        self.assertEqual(told['messages'], len(self.events))
        self.assertEqual(sorted(mcap.told(), key=lambda m: m[3]), self.in_bag('out.bag'))
        by_rosbag = self.path('other.bag')  # of a type that is no twin's, compressed by rosbag
        from std_msgs.msg import String
        import rospy
        with ROSBAG.Bag(by_rosbag, 'w', compression='lz4') as bag:
            for i in range(100):
                bag.write('/said', String('word %d, "quoted"' % i), rospy.Time(i, 7))
        self.mcap(by_rosbag)
        self.export(by_rosbag, '--csv', self.path('tables'))
        with open(self.path('tables/said.csv'), newline='') as table:
            rows = list(csv.reader(table))
        self.assertEqual(rows[0], ['recorded', 'data'])
        self.assertEqual(rows[3], ['2.000000007', 'word 2, "quoted"'])

    def in_bag(self, name):
        with ROSBAG.Bag(self.path(name)) as bag:
            return [(topic, raw[0], raw[2], t.to_nsec(), raw[1]) for topic, raw, t in bag.read_messages(raw=True)]

    @unittest.skipUnless(ROSLZ4, 'roslz4 is not installed')
    def test_compression_changes_the_size_and_nothing_else(self):
        plain = self.whole
        _, packed = self.mcap(self.log, '--compress', 'lz4')
        self.assertEqual(packed.told(), plain.told())
        self.assertLess(len(packed.data), 0.9 * len(plain.data))

    def test_tables_have_every_number_to_the_bit(self):
        mcap = self.whole
        self.export(self.log, '--csv', self.path('tables'))
        with open(self.path('tables/twin.rotor.whirl.csv'), newline='') as table:
            rows = list(csv.DictReader(table))
        whirls = [(time, data) for topic, _, _, time, data in mcap.told() if topic == '/twin/rotor/whirl']
        self.assertEqual(len(rows), len(whirls))
        for row, (time, data) in zip(rows, whirls):
            seq, seconds, nanoseconds, length = struct.unpack_from('<IIII', data)
            step, at, radius, phase = struct.unpack_from('<qddd', data, 16 + length)
            self.assertEqual((int(row['header.seq']), row['header.frame_id']), (seq, 'rotor'))
            self.assertEqual(int(row['header.stamp']), 10**9 * seconds + nanoseconds)
            self.assertEqual(row['recorded'], '%d.%09d' % divmod(time, 10**9))
            self.assertEqual(int(row['step']), step)
            self.assertEqual([struct.pack('<d', float(row[n])) for n in ('time', 'radius')],
                             [struct.pack('<d', x) for x in (at, radius)])
            self.assertEqual(struct.pack('<d', float(row['phase'])) if phase == phase else row['phase'],
                             struct.pack('<d', phase) if phase == phase else 'nan')
        with open(self.path('tables/twin.pendulum.pendulum.csv'), newline='') as table:
            head = next(csv.reader(table))
        self.assertIn('angle[0]', head)
        self.assertLess(head.index('step'), head.index('time'), 'the order of the message')

    def test_a_simulation_writes_what_its_log_would_be_exported_to(self):
        direct = self.path('direct.mcap')
        self.assertEqual(self.twin('simulate', SCENE, '--duration', '3', '--output', direct).returncode, 0)
        mcap = self.whole
        with open(direct, 'rb') as file:
            self.assertEqual(file.read(), mcap.data)
        ended = self.twin('simulate', SCENE, '--duration', '3', '--output', self.path('none/x.mcap'))
        self.assertEqual((ended.returncode, os.path.exists(self.path('none'))), (1, False))

    def test_channels_are_selected_like_files(self):
        told, mcap = self.mcap(self.log, '--channel', '*_WHIRL', '--channel', 'TWIN_SHAFT_*')
        self.assertEqual({topic for topic, _, _ in mcap.channels.values()}, {'/twin/rotor/whirl', '/twin/drives/shaft'})
        self.assertEqual(told['messages'] + told['not_selected'], len(self.events))
        self.assertIn('--channel', self.refused(self.log, '--mcap', self.path('none.mcap'), '--channel', 'NONE'))

    def test_damage_costs_what_is_damaged(self):
        begin = len(self.bytes) // 3
        garbled = self.bytes[:begin] + bytes(i * i * 37 % 251 for i in range(5000)) + self.bytes[begin + 5000:]
        told, mcap = self.mcap(self.file('garbled.lcmlog', garbled))
        kept = [i for i, (at, _, name, data) in enumerate(self.events)
                if at + 28 + len(name) + len(data) <= begin or at >= begin + 5000]
        self.assertEqual(told['messages'], len(kept))
        whole = self.whole.told()
        self.assertEqual(mcap.told(), [whole[i] for i in kept])
        self.assertGreaterEqual(told['damaged'], 1)
        self.assertLessEqual(begin - 400, told['defects'][0]['offset'])
        self.assertLess(told['defects'][0]['offset'], begin + 5000)

    def test_a_file_that_is_broken_off_has_its_chunks(self):
        mcap = self.whole
        first = min(mcap.chunks)
        in_first = len(mcap.chunks[first]['placed'])
        self.assertEqual(whole_chunks(mcap.data[:first + mcap.chunks[first]['length'] + 1000]), in_first)

    def test_logs_that_are_hard(self):
        whirl = next(e for e in self.events if e[2] == b'TWIN_ROTOR_WHIRL')
        told, mcap = self.mcap(self.file('one.lcmlog', event(0, 5, whirl[2], whirl[3])))
        self.assertEqual((told['messages'], mcap.messages[0][2]), (1, 5000))
        told, mcap = self.mcap(self.file('backwards.lcmlog',
                                         b''.join(event(i, 9000 - 1000 * i, whirl[2], whirl[3]) for i in range(10))))
        self.assertEqual([m[2] for m in mcap.messages], [10**6 * i for i in range(10)], 'in the order of time')
        told, _ = self.mcap(self.file('before.lcmlog', event(0, -1, whirl[2], whirl[3]) + event(1, 1, whirl[2], whirl[3])))
        self.assertEqual((told['messages'], told['rejected'], told['defects'][0]['offset']), (1, 1, 0))
        told, _ = self.mcap(self.file('others.lcmlog', event(0, 1, b'CAMERA', b'x' * 10) + event(1, 1, whirl[2], whirl[3])))
        self.assertEqual((told['messages'], told['foreign']), (1, {'CAMERA': 1}))
        told, _ = self.mcap(self.file('huge.lcmlog',
                                      event(0, 1, b'TWIN_' + b'A' * 60000 + b'_WHIRL', b'') + event(1, 1, whirl[2], whirl[3])))
        self.assertEqual((told['messages'], told['damaged']), (1, 1))
        told, _ = self.mcap(self.file('truncated.lcmlog', event(0, 1, whirl[2], whirl[3]) + SYNC + b'\0' * 10))
        self.assertEqual((told['messages'], told['damaged']), (1, 1))

    def test_what_cannot_be_exported_is_said(self):
        out = self.path('out.mcap')
        self.assertIn('0 bytes', self.refused(self.file('empty.lcmlog', b''), '--mcap', out))
        self.assertIn('CAMERA', self.refused(self.file('others.lcmlog', event(0, 1, b'CAMERA', b'')), '--mcap', out))
        self.assertIn('directory', self.refused(self.folder, '--mcap', out))
        self.assertIn('none.lcmlog', self.refused(self.path('none.lcmlog'), '--mcap', out))
        self.assertIn('found 0', self.refused(self.log))
        self.assertIn('found 2', self.refused(self.log, '--mcap', out, '--csv', self.path('tables')))
        self.assertFalse(os.path.exists(out))

    def test_what_exists_stays_unless_told_otherwise(self):
        for option, name in (('--mcap', 'a.mcap'), ('--bag', 'a.bag')):
            old = self.file(name, b'precious')
            self.assertIn("'%s' exists" % old, self.refused(self.log, option, old))
            with open(old, 'rb') as file:
                self.assertEqual(file.read(), b'precious')
            self.export(self.log, option, old, '--force')
            self.assertGreater(os.path.getsize(old), 1000)
        os.mkdir(self.path('tables'))
        self.file('tables/mine.txt', b'precious')
        self.refused(self.log, '--csv', self.path('tables'))
        self.export(self.log, '--csv', self.path('tables'), '--force')
        self.assertIn('mine.txt', os.listdir(self.path('tables')))
        self.assertIn('must differ from', self.refused(self.log, '--mcap', self.log, '--force'))

    def test_a_full_disk_is_said(self):
        for option in ('--mcap', '--bag'):
            self.assertIn('No space left', self.refused(self.log, option, '/dev/full', status=1))


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
