#!/usr/bin/python3
"""What is made of a machine that is only measured: probes and a keyphasor, no twin beside it. The machine is a Jeffcott rotor
whose response is known in closed form; its keyphasor's clock is coarser than the scene states; single samples are wild.

usage: measured_alone_test.py TWIN
"""
import csv
import glob
import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import unittest

from lcm_log import event, events

TWIN = sys.argv[1]
MASS, STIFFNESS, ECCENTRICITY = 10.0, 1.44e5, 3.0e-5  # critical speed 120 rad/s
SCENE = """name: machine
step: 0.0005
drives: {shaft: %s}
systems:
  rotor: {model: jeffcott_rotor, drive: shaft,
          parameters: {mass: 10.0, stiffness: 1.44e5, damping: %g, eccentricity: 3.0e-5}}
sensors:
  probes: {rate: 2000.0, channels: {x: {measures: rotor.x, noise: 3.0e-7}, y: {measures: rotor.y, noise: 3.0e-7}}}
  tacho: {keyphasor: shaft%s}
"""
RUN_UP = '{speed: 30.0, profile: [{speed: 230.0, max_acceleration: 10.0}]}'


def twin(*arguments):
    return subprocess.run([TWIN, *arguments], capture_output=True, text=True, timeout=120)


class MeasuredAlone(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name):
        return os.path.join(self.folder.name, name)

    def scene(self, name, shaft, clock='', damping=120.0):
        with open(self.file(name), 'w', encoding='utf-8') as out:
            out.write(SCENE % (shaft, damping, clock))
        return self.file(name)

    def measured(self, scene, seconds, change=lambda payload: payload):
        """A log that has nothing of a twin."""
        done = twin('simulate', scene, '--duration', str(seconds), '--measure', 'sensors', '--output', self.file('all.lcmlog'))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.file('all.lcmlog'), 'rb') as log:
            kept = [e for e in events(log.read()) if b'MEASUREMENT' in e[2]]
        self.assertGreater(len(kept), 10)
        with open(self.file('measured.lcmlog'), 'wb') as log:
            for number, (_, stamp, channel, payload) in enumerate(kept):
                log.write(event(number, stamp, channel, change(payload)))
        return self.file('measured.lcmlog')

    def monitor(self, scene, log, *more):
        done = twin('monitor', scene, log, '--json', *more)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return json.loads(done.stdout)['systems']['rotor']

    def test_spectrum_cascade_and_orbit(self):
        speed = 90.0
        scene = self.scene('steady.yaml', '{speed: %g}' % speed, damping=240.0)
        log = self.measured(scene, 12)
        rotor = self.monitor(scene, log)
        self.assertIsNotNone(rotor['spectrum'])
        line = rotor['spectrum']['lines'][0]
        ratio = speed / math.sqrt(STIFFNESS / MASS)
        damping = 240.0 / (2.0 * math.sqrt(STIFFNESS * MASS))
        right = ECCENTRICITY * ratio**2 / math.hypot(1 - ratio**2, 2 * damping * ratio)
        self.assertAlmostEqual(line['frequency'] / speed, 1.0, delta=2e-3)
        self.assertAlmostEqual(line['amplitude'] / right, 1.0, delta=5e-3)
        page = self.file('page.html')
        done = twin('monitor', scene, log, '--output', page)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(page, encoding='utf-8') as text:
            self.assertIn('orbit, last revolutions', text.read())

    def test_a_keyphasor_whose_clock_is_coarser_than_stated(self):
        right = self.scene('real.yaml', RUN_UP, ', resolution: 39 us')
        log = self.measured(right, 20)
        other = self.scene('stated.yaml', RUN_UP)
        passed, told = self.monitor(right, log)['resonances'], self.monitor(other, log)
        self.assertEqual(len(passed), 1, passed)
        self.assertEqual(len(told['resonances']), 1, told['resonances'])
        for name in ('speed', 'amplitude', 'amplification_factor'):
            self.assertAlmostEqual(told['resonances'][0][name] / passed[0][name], 1.0, delta=1e-3)
        # At 10 rad/s^2 the resonance of 120 rad/s is passed later, and with about its amplification of 10.
        self.assertAlmostEqual(passed[0]['speed'], 122.5, delta=2.5)
        self.assertAlmostEqual(passed[0]['amplification_factor'], 10.0, delta=0.5)
        self.assertEqual([n for n in told['not_ok'] if 'pulses' in n['why']], [])
        done = twin('balance', other, '--measured', log)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the keyphasor's pulses scatter by 1", done.stdout)  # 39 us over the root of 12 are 11.3 us

    def test_one_wild_sample_decides_nothing(self):
        scene = self.scene('machine.yaml', RUN_UP)
        once = []

        def spoil(payload):
            """One value of a probe becomes 1 m, in the middle of the run."""
            value = struct.pack('>d', self.value)
            if not once and value in payload:
                once.append(True)
                payload = payload.replace(value, struct.pack('>d', 1.0), 1)
            return payload

        log = self.measured(scene, 20)
        done = twin('export', log, '--csv', self.file('csv'))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(glob.glob(self.file('csv/*probes*'))[0], encoding='utf-8') as table:
            rows = list(csv.DictReader(table))
        self.value = float(rows[len(rows) // 2]['value[3]'])
        truth = ECCENTRICITY * MASS
        found = []
        for change in (lambda payload: payload, spoil):
            done = twin('balance', scene, '--measured', self.measured(scene, 20, change), '--json')
            self.assertEqual(done.returncode, 0, done.stderr)
            report = json.loads(done.stdout)
            plane, = report['unbalance'].values()
            found.append(plane['mass_radius'])
        self.assertTrue(once)
        for mass_radius in found:
            self.assertAlmostEqual(mass_radius / truth, 1.0, delta=0.01)
        self.assertTrue(any('1 wild sample' in note for note in report['notes']), report['notes'])


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
