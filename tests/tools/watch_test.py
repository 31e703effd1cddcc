#!/usr/bin/python3
"""`twin watch`, with real processes and LCM's multicast in a network of their own: it shows the systems, the loop and the
alerts of whoever sends them, and only what stands.

usage: in_private_network watch_test.py TWIN SOURCE
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


class Watch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        log = os.path.join(cls.folder, 'demo.lcmlog')
        subprocess.run([TWIN, 'simulate', SCENE, '--duration', '1', '--sample', '0.02', '--output', log], check=True)
        with open(log, 'rb') as file:
            cls.states = [(channel, data) for _, _, channel, data in events(file.read())]
        subprocess.run(['lcm-gen', '--python', '--ppath', cls.folder] +
                       [os.path.join(SOURCE, 'msg', name) for name in ('alert_t.lcm', 'monitor_status_t.lcm')],
                       check=True, stdout=subprocess.DEVNULL)
        sys.path.insert(0, cls.folder)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def watch(self, *arguments, **options):
        process = subprocess.Popen([TWIN, 'watch'] + list(arguments), stderr=subprocess.PIPE, **options)
        self.addCleanup(process.stderr.close)
        self.assertIn(b'listening', process.stderr.readline())
        return process

    def play(self, parts):
        path = os.path.join(self.folder, 'played.lcmlog')
        with open(path, 'wb') as file:
            file.write(b''.join(event(i, 1000 * i, channel, data) for i, (channel, data) in enumerate(parts)))
        subprocess.run([TWIN, 'play', path, '--json'], check=True, stdout=subprocess.DEVNULL)

    def alert(self, number, state, text):
        from whirl_twin import alert_t
        alert = alert_t()
        alert.id, alert.type, alert.system, alert.severity, alert.state = number, 'IN_CRITICAL_BAND', 'rotor', 2, state
        alert.raised_time, alert.time, alert.utime, alert.text = 0.5, 1.0, 1000000, text
        return b'TWIN_ALERTS', alert.encode()

    def monitor(self):
        from whirl_twin import monitor_status_t
        monitor = monitor_status_t()
        monitor.load, monitor.alerts, monitor.dangers = 0.01, 1, 1
        return b'TWIN_MONITOR', monitor.encode()

    def everything(self):
        return self.states + [self.alert(7, 0, 'in the band of 84 rad/s'), self.alert(8, 0, 'it grows'),
                              self.alert(8, 1, 'it grows'), self.monitor()]

    def test_systems_loop_and_the_alerts_that_stand(self):
        process = self.watch('--json', stdout=subprocess.PIPE)
        self.play(self.everything())
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 0)
        told = json.loads(out)
        self.assertEqual(told['time'], 1.0)
        self.assertEqual(set(told['systems']), {'rotor', 'pendulum'})
        self.assertEqual(told['systems']['rotor']['whirl']['time'], 1.0)
        self.assertTrue(told['loop']['paused'])  # as the player ends
        self.assertEqual(told['monitor']['alerts'], 1)
        self.assertEqual([alert['id'] for alert in told['alerts']], [7])

    def test_a_terminal_shows_them_and_is_left_in_order(self):
        master, slave = pty.openpty()
        process = self.watch(stdout=slave)
        os.close(slave)
        self.play(self.everything())
        shown, whole = b'', []  # the last frame may have come in part
        while not whole or b'84 rad/s' not in whole[-1]:
            shown += os.read(master, 65536)
            whole = shown.split(b'\x1b[J')[1:-1]
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(PATIENCE), 0)
        os.close(master)
        frame = whole[-1].decode().replace('\r\n', '\n')
        self.assertRegex(frame, r'rotor: speed [0-9.]+ rad/s')
        self.assertIn('\n  DANGER since 0.500 s: in the band of 84 rad/s\n', frame)
        self.assertIn('1 active alerts, 1 of them DANGER', frame)
        self.assertNotIn('it grows', frame)

    def test_another_twin_is_not_heard(self):
        process = self.watch('--json', '--lcm-prefix', 'PLANT_', stdout=subprocess.PIPE)
        self.play(self.states)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual((process.returncode, json.loads(out)['systems']), (1, {}))


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
