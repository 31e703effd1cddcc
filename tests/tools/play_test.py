#!/usr/bin/python3
"""`twin play` and `twin record`, with real processes and LCM's multicast in a network of their own: what is played arrives
as it was, whoever records it; of a damaged log all but the damage; what `twin record` writes is what was sent.

usage: in_private_network play_test.py TWIN SOURCE
"""
import json
import os
import pty
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from lcm_log import event, events
from mcap_file import McapFile

TWIN, SOURCE = sys.argv[1:3]
SCENE = os.path.join(SOURCE, 'config/scenes/demo.yaml')
PATIENCE = 60.0  # s
LOOP = b'TWIN_LOOP'


def read(path):
    with open(path, 'rb') as file:
        return file.read()


def said(found):
    """Channel and payload, without what the player says of its own run."""
    return [(channel, data) for _, _, channel, data in found if channel != LOOP]


class Trial(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.mkdtemp()
        cls.log = os.path.join(cls.shared, 'demo.lcmlog')
        subprocess.run([TWIN, 'simulate', SCENE, '--duration', '3', '--sample', '0.02', '--output', cls.log], check=True)
        cls.bytes = read(cls.log)
        cls.events = events(cls.bytes)
        subprocess.run(['lcm-gen', '--python', '--ppath', cls.shared, os.path.join(SOURCE, 'msg/alarm_command_t.lcm')],
                       check=True, stdout=subprocess.DEVNULL)
        sys.path.insert(0, cls.shared)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.shared)

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.processes = []

    def tearDown(self):
        for process in self.processes:
            if process.poll() is None:
                process.kill()
            process.communicate()
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def file(self, name, data):
        with open(self.path(name), 'wb') as file:
            file.write(data)
        return self.path(name)

    def start(self, *arguments, **options):
        process = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True,
                                   **options)
        self.processes.append(process)
        return process

    def recorder(self, name, *arguments):
        process = self.start(TWIN, 'record', self.path(name), '--json', *arguments)
        self.assertIn('listening', process.stderr.readline())
        return process

    def ended(self, process, status=0):
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, status, err)
        return json.loads(out) if out else err

    def play(self, log, *arguments, status=0):
        done = subprocess.run([TWIN, 'play', log, '--json'] + list(arguments), stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, universal_newlines=True, timeout=PATIENCE)
        self.assertEqual(done.returncode, status, done.stderr)
        return json.loads(done.stdout) if status == 0 else done.stderr

    def played(self, log, *arguments):
        """What the player says, and what a recorder heard."""
        recorder = self.recorder('heard.lcmlog', '--all', '--force')
        told = self.play(log, *arguments)
        counts = self.ended(recorder)
        self.assertEqual(counts['rejected'], 0)
        return told, events(read(self.path('heard.lcmlog')))


class Play(Trial):
    def test_all_arrives_as_it_was(self):
        told, heard = self.played(self.log, '--rate', '3')
        self.assertEqual(said(heard), said(self.events))
        self.assertEqual(told['sent'], len(self.events))
        self.assertEqual([told[what] for what in ('failed', 'commands', 'rejected', 'damaged', 'repeated', 'gaps', 'jumps')],
                         [0] * 7)
        self.assertEqual(heard[-1][2], LOOP, 'that it is held is the last that is said')

    def test_the_stock_logger_hears_the_same(self):
        logger = self.start('lcm-logger', '--quiet', '--flush-interval=100', self.path('stock.lcmlog'))
        time.sleep(2.0)  # it does not say when it listens
        self.play(self.log)
        deadline = time.monotonic() + 5.0  # it writes later than it hears, and its last buffer when it ends
        while os.path.getsize(self.path('stock.lcmlog')) <= len(self.bytes) and time.monotonic() < deadline:
            time.sleep(0.1)
        self.ended(logger)
        self.assertEqual(said(events(read(self.path('stock.lcmlog')))), said(self.events))

    def test_of_a_damaged_log_all_but_the_damage_is_played(self):
        log = b''.join(event(i, stamp, channel, data) for i, (_, stamp, channel, data) in enumerate(self.events))
        begin = len(log) // 3
        garbled = log[:begin] + bytes(i * i * 37 % 251 for i in range(5000)) + log[begin + 5000:]
        told, heard = self.played(self.file('garbled.lcmlog', garbled[:-10]), '--rate', '3')
        kept = [(channel, data) for at, _, channel, data in events(log)
                if (at + 28 + len(channel) + len(data) <= begin or at >= begin + 5000)
                and at + 28 + len(channel) + len(data) <= len(log) - 10]
        self.assertGreater(len(self.events), len(kept))
        self.assertEqual(said(heard), kept)
        self.assertEqual((told['sent'], told['rejected']), (len(kept), 0))
        self.assertGreaterEqual(told['damaged'], 2)  # and the truncated tail
        self.assertTrue(begin - 400 < told['defects'][0]['offset'] < begin + 5000)
        self.assertGreater(told['gaps'], 0)

    def test_a_part_of_it(self):
        told, heard = self.played(self.log, '--start', '1', '--duration', '0.5')
        self.assertEqual(said(heard), [(channel, data) for _, stamp, channel, data in self.events
                                       if 1_000_000 <= stamp <= 1_500_000])
        told, heard = self.played(self.log, '--channel', 'TWIN_ROTOR_*', '--rate', '10')
        self.assertEqual({channel for channel, _ in said(heard)}, {c for _, _, c, _ in self.events if c.startswith(b'TWIN_ROTOR_')})
        self.assertEqual(told['sent'] + told['not_selected'], len(self.events))

    def test_every_instant_is_found(self):
        for start in (0.0, 0.02, 1.4999, 2.98, 3.0):
            told = self.play(self.log, '--start', str(start), '--rate', 'max')
            self.assertEqual(told['sent'], sum(1 for _, stamp, _, _ in self.events if stamp >= round(1e6 * start)), start)

    def test_commands_are_sent_when_asked_for(self):
        from whirl_twin import alarm_command_t
        command = alarm_command_t()
        command.command, command.step, command.time, command.utime = 2, 0, 0.0, 0
        whirl = next(e for e in self.events if e[2] == b'TWIN_ROTOR_WHIRL')
        log = self.file('commands.lcmlog', event(0, 0, whirl[2], whirl[3]) + event(1, 1, b'TWIN_ALARM_COMMANDS', command.encode()))
        told, heard = self.played(log)
        self.assertEqual((told['sent'], told['commands'], told['rejected']), (1, 1, 0))
        self.assertEqual([channel for channel, _ in said(heard)], [b'TWIN_ROTOR_WHIRL'])
        told, heard = self.played(log, '--commands')
        self.assertEqual((told['sent'], told['commands']), (2, 0))
        self.assertEqual([channel for channel, _ in said(heard)], [b'TWIN_ROTOR_WHIRL', b'TWIN_ALARM_COMMANDS'])

    def test_what_is_told_twice_is_played_once_and_what_is_missing_is_named(self):
        whirls = [e for e in self.events if e[2] == b'TWIN_ROTOR_WHIRL']
        order = [0, 1, 2, 2, 3, 7, 8]
        parts = [event(i, whirls[k][1], whirls[k][2], whirls[k][3]) for i, k in enumerate(order)]
        told, heard = self.played(self.file('twice.lcmlog', b''.join(parts)))
        self.assertEqual([data for _, data in said(heard)], [whirls[k][3] for k in (0, 1, 2, 3, 7, 8)])
        self.assertEqual((told['repeated'], told['gaps']), (1, 1))
        self.assertEqual([defect['offset'] for defect in told['defects']],
                         [sum(map(len, parts[:3])), sum(map(len, parts[:5]))])

    def test_logs_that_are_hard(self):
        whirl = next(e for e in self.events if e[2] == b'TWIN_ROTOR_WHIRL')
        self.assertEqual(self.play(self.file('one.lcmlog', event(0, 5, whirl[2], whirl[3])))['sent'], 1)
        others = b''.join(event(i, 1000 * i, b'CAMERA', b'x' * i) for i in range(5))
        self.assertEqual(self.play(self.file('others.lcmlog', others))['sent'], 5)
        wide = event(0, 0, b'A', b'') + event(1, 10**15, b'A', b'') + event(2, 5, b'A', b'')  # 30 years of nothing, and back
        self.assertEqual([self.play(self.file('wide.lcmlog', wide))[what] for what in ('sent', 'jumps')], [3, 2])
        head = event(0, 0, whirl[2], whirl[3]) + b'\xed\xa1\xda\x01\0\0\0'
        self.assertEqual([self.play(self.file('head.lcmlog', head))[what] for what in ('sent', 'damaged')], [1, 1])
        for log, why in ((self.file('empty.lcmlog', b''), 'no event'), (self.folder, 'directory'),
                         (self.path('none.lcmlog'), 'none.lcmlog'), (self.file('noise.lcmlog', b'noise' * 100), 'no event'),
                         (self.file('a.bag', b'#ROSBAG V2.0\n'), 'rosbag')):
            self.assertIn(why, self.play(log, status=2))
        for option, value in (('--rate', '0.05'), ('--rate', '2000'), ('--rate', 'fast'), ('--start', '4'), ('--start', '-1')):
            self.assertIn(option, self.play(self.log, option, value, status=2))

    def test_keys_hold_step_and_end(self):
        log = self.file('slow.lcmlog', b''.join(event(i, 50_000_000 * i, b'A', b'%d' % i) for i in range(6)))
        master, slave = pty.openpty()
        player = self.start(TWIN, 'play', log, '--json', stdin=slave)
        os.close(slave)
        os.write(master, b' sssq')  # the first event, three more one by one: without keys they last 150 s
        out, _ = player.communicate(timeout=PATIENCE)
        os.close(master)
        self.assertEqual(player.returncode, 0)
        self.assertEqual(json.loads(out)['sent'], 4)

    def test_it_ends_when_asked_to(self):
        log = self.file('slow.lcmlog', b''.join(event(i, 50_000_000 * i, b'A', b'') for i in range(6)))
        recorder = self.recorder('heard.lcmlog', '--all')
        player = self.start(TWIN, 'play', log, '--json')
        while not (os.path.exists(self.part()) and os.path.getsize(self.part())):
            time.sleep(0.05)
        self.assertEqual(self.ended(player)['sent'], 1)
        self.ended(recorder)

    def part(self):
        parts = [name for name in os.listdir(self.folder) if name.endswith('.part')]
        return self.path(parts[0]) if parts else self.path('none')


class Record(Trial):
    def test_log_and_mcap_say_the_same(self):
        log, mcap = self.recorder('run.lcmlog'), self.recorder('run.mcap')
        self.assertEqual([n for n in os.listdir(self.folder) if not n.endswith('.part')], [])
        self.start('lcm-logplayer', '--speed=3', self.log).wait()
        for counts in (self.ended(log), self.ended(mcap)):
            self.assertEqual((counts['events'], counts['lost'], counts['rejected']), (len(self.events), 0, 0))
        self.assertEqual(said(events(read(self.path('run.lcmlog')))), said(self.events))
        subprocess.run([TWIN, 'export', self.log, '--mcap', self.path('direct.mcap')], check=True, stdout=subprocess.DEVNULL)
        self.assertEqual([(topic, kind, md5, data) for topic, kind, md5, _, data in McapFile(self.path('run.mcap')).told()],
                         [(topic, kind, md5, data) for topic, kind, md5, _, data in McapFile(self.path('direct.mcap')).told()])

    def test_what_is_missing_is_counted(self):
        whirls = [e for e in self.events if e[2] == b'TWIN_ROTOR_WHIRL']
        log = self.file('gap.lcmlog', b''.join(event(i, whirls[k][1], whirls[k][2], whirls[k][3])
                                               for i, k in enumerate([0, 1, 2, 3, 7, 8])))
        recorder = self.recorder('run.lcmlog')
        self.play(log)
        self.assertEqual(self.ended(recorder)['channels']['TWIN_ROTOR_WHIRL']['lost'], 3)

    def test_files_follow_one_another(self):
        recorder = self.recorder('run.lcmlog', '--split-size', '0.02')
        self.play(self.log, '--rate', '3')
        files = self.ended(recorder)['files']
        self.assertGreater(len(files), 3)
        self.assertEqual(files, [self.path('run-%03d.lcmlog' % i) for i in range(len(files))])
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(map(os.path.basename, files)))
        self.assertEqual(said(e for file in files for e in events(read(file))), said(self.events))
        for file in files:
            self.assertEqual(subprocess.run([TWIN, 'log', file], stdout=subprocess.DEVNULL).returncode, 0, file)

    def test_what_cannot_be_recorded_is_said(self):
        precious = self.file('old.lcmlog', b'precious')
        for name, arguments, why in (('old.lcmlog', [], 'exists'), ('a.txt', [], '.lcmlog or .mcap'),
                                     ('a.mcap', ['--all'], '--all'), ('a.lcmlog', ['--split-size', '-1'], '--split-size')):
            done = subprocess.run([TWIN, 'record', self.path(name)] + arguments, stderr=subprocess.PIPE, universal_newlines=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn(why, done.stderr)
        self.assertEqual(read(precious), b'precious')
        done = subprocess.run([TWIN, 'record', self.path('a.mcap'), '--duration', '0.1'], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE)
        self.assertEqual((done.returncode, McapFile(self.path('a.mcap')).messages), (1, []))

    def test_a_full_disk_is_said(self):
        os.symlink('/dev/full', self.path('full.lcmlog'))
        recorder = self.start(TWIN, 'record', self.path('full.lcmlog'))
        self.assertIn('listening', recorder.stderr.readline())
        self.play(self.log, '--rate', '3')
        _, err = recorder.communicate(timeout=PATIENCE)
        self.assertEqual(recorder.returncode, 1)
        self.assertIn('No space left', err)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
