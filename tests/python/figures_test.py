#!/usr/bin/python3
"""Figures of the shipped scenes, as the commands make them: all texts are on the sheet, none covers another; units are
those of --units; curves end where their data end.

usage: PYTHONPATH=python WHIRL_TWIN_PROGRAM=build/bin/twin figures_test.py
"""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    from matplotlib.text import Text
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

from whirl_twin import drawing

PROGRAM = os.environ["WHIRL_TWIN_PROGRAM"]
SCENES = pathlib.Path(__file__).resolve().parents[2] / "config" / "scenes"
ROTOR_COMMANDS = ("campbell", "response", "modes", "map", "stability")
RPM = math.pi / 30.0


def figures_of(*arguments):
    """Name and data of every figure that a command writes; none where the scene is not one for it."""
    with tempfile.TemporaryDirectory() as folder:
        where = ["--format", "json", "--output", folder] if arguments[0] == "plot" else ["--plot", f"{folder}/figure.json"]
        done = subprocess.run([PROGRAM, *arguments, *where], capture_output=True, text=True)
        if done.returncode not in (0, 2):
            raise AssertionError(f"twin {' '.join(arguments)}: {done.stderr}")
        return {path.stem: json.loads(path.read_text()) for path in sorted(pathlib.Path(folder).glob("*.json"))}


def texts_of(figure):
    """The texts of a drawn figure: text, and place [px]."""
    found = [*figure.texts]
    for ax in [child for ax in figure.axes for child in (ax, *ax.child_axes)]:
        found += [*ax.texts, ax.title]
        if not ax.axison:
            continue
        found += [text for legend in ax.get_children() if hasattr(legend, "get_texts") for text in legend.get_texts()]
        for axis in (ax.xaxis, ax.yaxis):
            found.append(axis.label)
            found += [label for tick in axis._update_ticks() for label in (tick.label1, tick.label2)]
    return [(text.get_text(), Text.get_window_extent(text)) for text in found  # without an arrow
            if text.get_visible() and text.get_text().strip()]


def text_faults(content):
    """Of a figure's data: texts beyond its edges, and pairs of texts that cover each other."""
    figure = drawing.draw(content)
    figure.savefig(os.devnull, format="png", dpi=figure.dpi)
    texts = texts_of(figure)
    for i, (text, box) in enumerate(texts):
        if min(box.x0, box.y0) < -1.0 or box.x1 > figure.bbox.x1 + 1.0 or box.y1 > figure.bbox.y1 + 1.0:
            yield f"'{text}' is not on the sheet"
        for other, its in texts[i + 1:]:
            if min(box.x1, its.x1) - max(box.x0, its.x0) > 1.5 and min(box.y1, its.y1) - max(box.y0, its.y0) > 3.0:
                yield f"'{text}' and '{other}' cover each other"


class Texts(unittest.TestCase):
    def test_texts_of_the_shipped_scenes_are_legible(self):
        for scene in sorted(SCENES.glob("*.yaml")):
            text = scene.read_text(encoding="utf-8")
            commands = [("plot", str(scene), "--duration", "3")]
            commands += [(name, str(scene)) for name in ROTOR_COMMANDS if "drives:" in text]
            commands += [("loop", str(scene))] if "controllers:" in text else []
            for command in commands:
                for name, content in figures_of(*command).items():
                    with self.subTest(scene=scene.stem, command=command[0], figure=name):
                        self.assertEqual(list(text_faults(content)), [])


class Units(unittest.TestCase):
    def chart(self, command, place, *units):
        (figure,) = figures_of(command, "friswell_rotor", *(("--points", "40") if command != "orbit" else ("--speed", "84")),
                               *units).values()
        return figure["charts"][place]

    def test_a_response_is_drawn_in_the_units_that_are_chosen(self):
        for place, y_unit in ((0, 0.5 * 25.4e-6), (1, 1.0)):
            si = self.chart("response", place)
            shown = self.chart("response", place, "--units", "rpm, mil pp, deg")
            for one, other in zip(si["series"], shown["series"]):
                np.testing.assert_allclose(np.array(one["x"]), np.array(other["x"]) * RPM, rtol=1e-12)
                np.testing.assert_allclose(np.array(one["y"], float), np.array(other["y"], float) * y_unit, rtol=1e-9)
            self.assertIn("(rpm)", shown["x"]["label"])
        amplitude = self.chart("response", 0, "--units", "rpm, mil pp, deg")
        self.assertIn("(mil pp)", amplitude["y"]["label"])
        self.assertEqual(amplitude["x"]["second"]["label"], "rad/s")
        self.assertAlmostEqual(amplitude["x"]["second"]["factor"], RPM)

    def test_a_campbell_diagram_has_speeds_and_frequencies_in_their_units(self):
        si, shown = self.chart("campbell", 0), self.chart("campbell", 0, "--units", "rpm, Hz")
        for one, other in zip(si["series"], shown["series"]):
            np.testing.assert_allclose(np.array(one["x"]), np.array(other["x"]) * RPM, rtol=1e-12)
            np.testing.assert_allclose(np.array(one["y"], float), np.array(other["y"], float) * 2 * math.pi, rtol=1e-12)
        for one, other in zip(si["vertical"] + si["bands"], shown["vertical"] + shown["bands"]):
            at = "at" if "at" in one else "low"
            self.assertAlmostEqual(one[at], other[at] * RPM)
        self.assertIn("Hz", shown["y"]["label"])
        self.assertRegex(shown["vertical"][0]["label"], r"^\d+ rpm, [\d.]+ rad/s$")

    def test_orbits_are_in_the_unit_of_lengths(self):
        si, shown = self.chart("orbit", 1), self.chart("orbit", 1, "--units", "um")
        np.testing.assert_allclose(np.array(si["series"][0]["x"]), np.array(shown["series"][0]["x"]) * 1e-6)
        self.assertEqual(shown["x"]["label"], "x (um)")


class Overlays(unittest.TestCase):
    def plot(self, folder, *arguments):
        done = subprocess.run([PROGRAM, "plot", *arguments, "--output", folder], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    def test_two_systems_are_drawn_over_each_other(self):
        with tempfile.TemporaryDirectory() as folder:
            names = [os.path.join(folder, f"{system}_time.json") for system in ("soft", "stiff")]
            status, text = self.plot(folder, "sprung_inverted_pendulum", "--duration", "1", "--format", "json")
            self.assertEqual(status, 0, text)
            status, text = self.plot(folder, names[0], "--over", names[1])
            self.assertEqual((status, text), (0, os.path.join(folder, "soft_time_stiff_time.svg") + "\n"))
            drawn = pathlib.Path(text.strip()).read_text(encoding="utf-8")
            self.assertIn(">soft_time<", drawn)
            self.assertIn(">stiff_time<", drawn)

    def test_what_is_no_figure_is_an_error(self):
        with tempfile.TemporaryDirectory() as folder:
            wrong = pathlib.Path(folder, "wrong.json")
            wrong.write_text("{}", encoding="utf-8")
            for arguments, expected in (((str(wrong),), "must be the data of a figure"),
                                        (("demo", "--over", str(wrong)), "--over: needs a figure"),
                                        ((str(wrong), "--format", "json"), "--format: must be svg, png or pdf")):
                status, text = self.plot(folder, *arguments)
                self.assertEqual(status, 2, text)
                self.assertIn(expected, text)
            self.assertEqual([path.name for path in pathlib.Path(folder).iterdir()], ["wrong.json"])


if __name__ == "__main__":
    unittest.main()
