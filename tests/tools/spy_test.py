#!/usr/bin/python3
"""`twin spy`, with real processes and LCM's multicast in a network of their own: what it shows is what was sent.

usage: in_private_network spy_test.py TWIN SOURCE
"""
import json
import os
import pty
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

from lcm_log import event, events

TWIN, SOURCE = sys.argv[1:3]
SCENE = os.path.join(SOURCE, 'config/scenes/demo.yaml')
PATIENCE = 60.0  # s


class Spy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.log = os.path.join(cls.folder, 'demo.lcmlog')
        subprocess.run([TWIN, 'simulate', SCENE, '--duration', '1', '--sample', '0.02', '--output', cls.log], check=True)
        with open(cls.log, 'rb') as file:
            cls.events = events(file.read())

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.processes = []

    def tearDown(self):
        for process in self.processes:
            if process.poll() is None:
                process.kill()
            process.communicate()

    def spy(self, *arguments, **options):
        process = subprocess.Popen([TWIN, 'spy'] + list(arguments), stderr=subprocess.PIPE, **options)
        self.processes.append(process)
        self.assertIn(b'listening', process.stderr.readline())
        return process

    def send(self, log=None):
        subprocess.run([TWIN, 'play', log or self.log, '--rate', '10', '--json'], check=True, stdout=subprocess.DEVNULL)

    def sent(self, name, parts):
        path = os.path.join(self.folder, name)
        with open(path, 'wb') as file:
            file.write(b''.join(event(i, 1000 * i, channel, data) for i, (channel, data) in enumerate(parts)))
        self.send(path)

    def told(self, process, status=0):
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, status)
        return json.loads(out)

    def test_counts_and_last_fields_are_what_was_sent(self):
        process = self.spy('--json', stdout=subprocess.PIPE)
        self.send()
        told = self.told(process)
        self.assertEqual((told['lost'], told['rejected']), (0, 0))
        whirl = told['channels']['TWIN_ROTOR_WHIRL']
        sent = [data for _, _, channel, data in self.events if channel == b'TWIN_ROTOR_WHIRL']
        self.assertEqual((whirl['kind'], whirl['events'], whirl['bytes']), ('whirl', len(sent), sum(map(len, sent))))
        self.assertEqual((whirl['last']['system'], whirl['last']['time']), ('rotor', 1.0))
        self.assertAlmostEqual(whirl['rate'], len(sent) / told['duration'], delta=0.1 * whirl['rate'])
        self.assertEqual(set(told['channels']), {channel.decode() for _, _, channel, _ in self.events} | {'TWIN_LOOP'})

    def test_what_is_missing_damaged_or_of_others_is_told(self):
        whirls = [data for _, _, channel, data in self.events if channel == b'TWIN_ROTOR_WHIRL']
        process = self.spy('--json', '--channel', 'TWIN_ROTOR_*', '--channel', 'CAM*', stdout=subprocess.PIPE)
        self.sent('odd.lcmlog', [(b'TWIN_ROTOR_WHIRL', whirls[k]) for k in (0, 1, 2, 6)] +
                  [(b'TWIN_DISC_WHIRL', whirls[0]), (b'CAMERA', b'x' * 99), (b'CAMERA', b'x')])
        told = self.told(process)
        self.assertEqual(set(told['channels']), {'TWIN_ROTOR_WHIRL', 'CAMERA'})
        self.assertEqual(told['channels']['TWIN_ROTOR_WHIRL']['lost'], 3)
        camera = told['channels']['CAMERA']
        self.assertEqual([camera[what] for what in ('kind', 'events', 'bytes', 'last')], ['other', 2, 100, None])

    def test_a_table_that_no_terminal_obeys(self):
        process = self.spy('--once', '--duration', '3', stdout=subprocess.PIPE)
        self.sent('bell.lcmlog', [(b'BELL\x07\x1b[2J', b'x')] + [(c, d) for _, _, c, d in self.events[-20:]])
        out, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 0)
        self.assertNotIn(b'\x1b', out)
        self.assertNotIn(b'\x07', out)
        table = out.decode()
        self.assertEqual(table.count('TWIN_ROTOR_WHIRL'), 1)
        self.assertIn(r'BELL\x07\x1b[2J', table)
        self.assertRegex(table, r'TWIN_ROTOR_WHIRL +whirl .* radius [0-9.e-]+ m, .*speed [0-9.]+ rad/s')

    def test_a_terminal_is_drawn_anew_and_left_in_order(self):
        master, slave = pty.openpty()
        process = self.spy(stdout=slave)
        os.close(slave)
        self.send()
        shown = b''
        while shown.count(b'\x1b[J') < 3 or b'TWIN_ROTOR_WHIRL' not in shown:  # three frames in the place of the first
            shown += os.read(master, 65536)
        process.send_signal(signal.SIGINT)
        process.stderr.read()
        self.assertEqual(process.wait(PATIENCE), 0)
        os.close(master)
        frames = shown.decode().split('\x1b[J')
        for frame in frames:
            for line in frame.split('\r\n')[:-1]:
                self.assertLessEqual(len(line), 80)  # of a terminal that does not say how wide it is

    def test_silence_and_misuse_have_their_status(self):
        out = subprocess.run([TWIN, 'spy', '--duration', '0.2', '--json'], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.assertEqual((out.returncode, json.loads(out.stdout)['channels']), (1, {}))
        for arguments in (['--duration', '-1'], ['--duration', 'nan'], ['--lcm-prefix', '1_']):
            done = subprocess.run([TWIN, 'spy'] + arguments, stderr=subprocess.PIPE)
            self.assertEqual(done.returncode, 2)
            self.assertIn(arguments[0].strip('-').split('-')[-1].encode(), done.stderr.lower())


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
