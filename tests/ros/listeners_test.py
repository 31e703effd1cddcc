"""The programs of examples/listeners, on ROS and LCM, in C++ and Python, say the same of a rotor, and what the simulation
says; the receiver in Python puts together what came in fragments, and gives nothing of a message that lost one."""
import itertools
import math
import os
import subprocess
import sys

import rospkg
from whirl_twin.msg import WhirlState
from whirl_twin_lcm.whirl_twin import measurement_t

from node_trial import SCENES, NodeTrial, load_scene, wait_until

LISTENERS = os.path.join(rospkg.RosPack().get_path('whirl_twin'), 'examples/listeners')
sys.path.append(LISTENERS)
from lcm_receiver import LcmReceiver  # noqa: E402

ROWS, COLUMNS = 3, 10000


class Listeners(NodeTrial):
    def begin(self, *command):
        process = subprocess.Popen(command, stdout=subprocess.PIPE, universal_newlines=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def lines(self, process, count):
        return dict(line.split('  ', 1) for line in itertools.islice(process.stdout, count))

    def test_all_say_the_same(self):
        load_scene(os.path.join(SCENES, 'demo.yaml'))
        states = {}
        self.listen('/twin/rotor/whirl', WhirlState, lambda state: states.setdefault('%.3f s' % state.time, state))
        self.start('simulation_node', '_realtime:=ignore')
        listeners = [self.begin(*command) for command in (
            (os.environ['WHIRL_BY_ROS'], 'rotor'),
            (os.path.join(LISTENERS, 'whirl_by_ros.py'), 'rotor'),
            (os.environ['WHIRL_BY_LCM'], 'TWIN_ROTOR_WHIRL'),
            (os.path.join(LISTENERS, 'whirl_by_lcm.py'), 'TWIN_ROTOR_WHIRL'))]
        self.assertTrue(wait_until(lambda: states))
        said = [self.lines(listener, 40) for listener in listeners]
        both = set.intersection(*(set(lines) for lines in said))
        self.assertGreater(len(both), 5, said)
        for instant in both:
            self.assertEqual(len({lines[instant] for lines in said}), 1, [lines[instant] for lines in said])
        self.assertTrue(wait_until(lambda: all(instant in states for instant in both)))
        for instant in both:
            state, (speed, radius, lag) = states[instant], said[0][instant].split('  ')
            self.assertEqual(speed, '%.3f rad/s' % state.speed)
            self.assertEqual(radius, '%.5f mm' % (1e3 * state.radius))
            self.assertEqual(lag, '%.2f deg\n' % math.degrees(state.phase))

    def test_fragments_are_put_together(self):
        receiver = LcmReceiver()
        receiver.socket.settimeout(30.0)
        table = os.path.join(self.folder.name, 'table.csv')
        with open(table, 'w') as file:
            file.write('time,%s\n' % ','.join('probe_%d[m]' % column for column in range(COLUMNS)))
            for row in range(ROWS):
                file.write('%.3f,%s\n' % (0.001 * row, ','.join(str(row * COLUMNS + column) for column in range(COLUMNS))))
        self.begin(os.environ['CSV_TO_LCM'], table, 'probes', 'udpm://239.255.76.67:7667?ttl=0', '0.5')
        sizes, values = [], []
        for channel, data in receiver:
            self.assertEqual(channel, 'TWIN_PROBES_MEASUREMENT')
            sizes.append(len(data))
            values.extend(measurement_t.decode(data).value)
            if len(values) >= ROWS * COLUMNS:
                break
        self.assertGreater(max(sizes), 1 << 16, 'none was in fragments')
        self.assertEqual(values, [float(value) for value in range(ROWS * COLUMNS)])

    def test_a_lost_fragment_loses_its_message_alone(self):
        def fragment(message, number, content):
            return b'LC03' + b''.join(part.to_bytes(size, 'big') for part, size in
                                      ((message, 4), (6, 4), (3 * number, 4), (number, 2), (2, 2))) + content
        receiver = LcmReceiver()
        self.assertIsNone(receiver.take(fragment(1, 0, b'A\0abc'), 'here'))
        self.assertIsNone(receiver.take(fragment(1, 1, b'xyz'), 'elsewhere'), 'of another sender')
        self.assertIsNone(receiver.take(fragment(2, 1, b'def'), 'here'))
        self.assertEqual(receiver.take(fragment(2, 0, b'A\0abc'), 'here'), ('A', b'abcdef'))
        self.assertIsNone(receiver.take(b'LC03', 'here'))
        self.assertIsNone(receiver.take(b'something else', 'here'))
        self.assertEqual(receiver.take(b'LC02\0\0\0\3B\0xy', 'here'), ('B', b'xy'))
