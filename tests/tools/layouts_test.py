#!/usr/bin/python3
"""What the layouts for viewers name is in an MCAP file of the demo scene: every topic, and every field as a number there.

usage: layouts_test.py TWIN SOURCE
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

from mcap_file import McapFile

TWIN, SOURCE = sys.argv[1:3]
LAYOUTS = os.path.join(SOURCE, 'config/layouts')


def numbers(kind):
    """The fields of a message that can be drawn: "speed" and, of an array, "angle[]"."""
    with open(os.path.join(SOURCE, 'msg', kind.split('/')[1] + '.msg'), encoding='utf-8') as file:
        found = re.findall(r'^(?:float64|u?int\d+|bool)(\[\])? +(\w+) *(?:#.*)?$', file.read(), re.MULTILINE)
    return {name + array for array, name in found}


class Layouts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'demo.mcap')
            scene = os.path.join(SOURCE, 'config/scenes/demo.yaml')
            subprocess.run([TWIN, 'simulate', scene, '--duration', '0.1', '--output', path], check=True)
            cls.topics = {topic: kind for topic, kind, _, _, _ in McapFile(path).told()}

    def assert_there(self, name, separator):
        topics = [topic for topic in self.topics if name.startswith(topic + separator)]
        self.assertTrue(topics, name)
        topic = max(topics, key=len)
        field = name[len(topic) + len(separator):]
        self.assertIn(re.sub(r'\[\d+\]', '[]', field), numbers(self.topics[topic]), name)

    def test_plotjuggler(self):
        layout = xml.etree.ElementTree.parse(os.path.join(LAYOUTS, 'plotjuggler.xml')).getroot()
        curves = [curve.get('name') for curve in layout.iter('curve')]
        self.assertGreater(len(curves), 5)
        for curve in curves:
            self.assert_there(curve, '/')

    def test_lichtblick(self):
        with open(os.path.join(LAYOUTS, 'lichtblick.json'), encoding='utf-8') as file:
            layout = json.load(file)
        paths = [path['value'] for panel in layout['configById'].values() for path in panel['paths']]
        self.assertGreater(len(paths), 5)
        for path in paths:
            self.assert_there(path, '.')

        def shown(part):
            return [part] if isinstance(part, str) else shown(part['first']) + shown(part['second'])
        self.assertEqual(sorted(shown(layout['layout'])), sorted(layout['configById']))


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
