"""Of a file that grows while examples/acquisition/csv_to_ros.py reads it every row arrives once, with its instant."""
import os
import subprocess
import tempfile
import time

from whirl_twin.msg import Measurement

from node_trial import PACKAGE, PATIENCE, NodeTrial

ROWS = 400
PERIOD = 1000001  # ns


class Acquisition(NodeTrial):
    def setUp(self):
        super().setUp()
        self.blocks = []
        self.listen('/twin/measured/probes', Measurement, self.blocks.append)

    def test_every_row_arrives_once(self):
        adapter = os.path.join(PACKAGE, 'examples/acquisition/csv_to_ros.py')
        with tempfile.NamedTemporaryFile('w', suffix='.csv') as file:
            file.write('time,probe_x[m],probe_y[m]\n')
            file.flush()
            process = subprocess.Popen([adapter, file.name, 'probes', '--quiet', '3'])
            for k in range(ROWS):
                line = '%d.%09d,%.17g,%s\n' % (*divmod(k * PERIOD, 10**9), 1e-6 * k, '' if k % 7 == 3 else '2e-6')
                file.write(line[:10])
                file.flush()
                time.sleep(0.002)
                file.write(line[10:])
            file.flush()
            self.assertEqual(process.wait(PATIENCE), 0)
        self.assertEqual([block.step for block in self.blocks], list(range(len(self.blocks))))
        instants = [instant for block in self.blocks for instant in block.instant]
        self.assertEqual(instants, [k * PERIOD for k in range(ROWS)])
        values = [value for block in self.blocks for value in block.value[0::2]]
        self.assertEqual(values, [1e-6 * k for k in range(ROWS)])
        valid = [valid for block in self.blocks for valid in block.valid[1::2]]
        self.assertEqual(valid, [k % 7 != 3 for k in range(ROWS)])
        self.assertEqual(self.blocks[0].header.frame_id, 'probes')
