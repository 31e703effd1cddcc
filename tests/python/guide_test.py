"""Every block of Python of docs/python.md and README.md runs, those of a page after one another."""

import os
import pathlib
import re
import tempfile
import unittest

PROJECT = pathlib.Path(__file__).resolve().parents[2]
os.environ["PATH"] = os.path.dirname(os.environ["WHIRL_TWIN_PROGRAM"]) + os.pathsep + os.environ["PATH"]


class Pages(unittest.TestCase):
    def run_page(self, name):
        text = (PROJECT / name).read_text(encoding="utf-8")
        blocks = list(re.finditer(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL))
        self.assertTrue(blocks, name)
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                space = {}
                for block in blocks:
                    lines = "\n" * text[:block.start(1)].count("\n")  # so that errors name the line of the page
                    exec(compile(lines + block[1], name, "exec"), space)
            finally:
                os.chdir(before)
        return space

    def test_python_page(self):
        space = self.run_page("docs/python.md")
        self.assertLess(abs(space["twin"].state("arm")["q"][0]), 0.3)
        self.assertGreater(len(space["table"]), 10)

    def test_readme(self):
        self.run_page("README.md")


if __name__ == "__main__":
    unittest.main()
