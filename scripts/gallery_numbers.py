"""Tools of scripts/gallery_cases.py: the cases of the lecture notes, runs of `twin`, and rows that compare them."""

import json
import math
import pathlib
import subprocess
import tempfile

REFERENCE = pathlib.Path(__file__).resolve().parent.parent / "tests" / "reference" / "note_cases.json"
CASES = {case["id"]: case for case in json.loads(REFERENCE.read_text(encoding="utf-8"))}


class Twin:
    """Runs `twin` on scenes of one system."""

    def __init__(self, program):
        self.program = program
        self.runs = 0

    def run(self, *arguments):
        self.runs += 1
        done = subprocess.run([self.program, *arguments, "--json"], capture_output=True, text=True, check=True)
        return json.loads(done.stdout)

    def on_scene(self, command, model, parameters, gravity=9.81, initial=None, options=()):
        system = {"model": model, "parameters": parameters, **({"initial": initial} if initial else {})}
        scene = {"name": "gallery", "step": 0.001, "gravity": gravity, "systems": {"it": system}}
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.yaml")
            path.write_text(json.dumps(scene), encoding="utf-8")  # JSON is YAML
            return self.run(command, str(path), *options)["systems"]["it"]

    def analyze(self, model, parameters, gravity=9.81, initial=None):
        return self.on_scene("analyze", model, parameters, gravity, initial)

    def routh(self, *coefficients):
        return self.run("routh", *(repr(c) for c in coefficients))


class Row:
    """One line of a table: `notes` is the correct number, `in_print` the one that the notes print, if any."""

    def __init__(self, quantity, notes, computed, source, unit="", in_print=None, digits=None, tolerance=1e-6):
        self.quantity, self.notes, self.computed, self.source = quantity, notes, computed, source
        self.unit, self.in_print, self.digits, self.tolerance = unit, in_print, digits, tolerance

    def with_unit(self, text):
        return f"{text} {self.unit}".strip()

    def printed(self):
        if self.in_print is None:
            return self.with_unit(f"{self.notes:.7g}")
        text = f"{self.in_print:.{self.digits}f}"
        return self.with_unit(text if self.matches_print() else f"{text}; correct: {self.notes:.6g}")

    def shown(self):
        rounded = 0.0 if abs(self.computed) < 1e-12 else self.computed
        return self.with_unit(f"{rounded:.7g}")

    def matches_print(self):
        return abs(self.in_print - self.notes) <= 0.5001 * 10 ** -self.digits

    def agrees(self):
        return abs(self.computed - self.notes) <= self.tolerance * max(1.0, abs(self.notes))

    def complaint(self):
        return f"{self.quantity}: expected {self.notes:.9g}, computed {self.computed:.9g}"


def of_case(identity, quantity, computed, erratum="", unit="", tolerance=1e-6):
    """A row of a case of tests/reference/note_cases.json."""
    case = CASES[identity]
    source = "printed" if "printed" in case or case["source"] == "notes" else "from the notes' equations"
    return Row(quantity, case["expected"], computed, source + (f", {erratum}" if erratum else ""), unit,
               case.get("printed"), case.get("printed_digits"), tolerance)


def parameters(identity):
    return CASES[identity]["params"]


def hertz(frequency):
    return frequency / (2.0 * math.pi)
