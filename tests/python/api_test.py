"""Scenes, errors and reports of the Python package: physics, and what the command line prints."""

import json
import math
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest

import numpy
import whirl_twin as wt

PROGRAM = os.environ["WHIRL_TWIN_PROGRAM"]

MASS, STIFFNESS = 2.0, 8.0e4  # kg, N/m
JEFFCOTT = f"""
name: jeffcott
step: 1 ms
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {{mass: {MASS}, stiffness: {STIFFNESS}, damping: 4.0, eccentricity: 0.1 mm}}
drives:
  shaft: {{speed: 50 rad/s}}
"""


def printed(*arguments, status=0):
    """What the command prints as JSON."""
    done = subprocess.run([PROGRAM, *arguments, "--json"], capture_output=True, text=True, check=False)
    assert done.returncode == status, done.stderr
    return json.loads(done.stdout)


def complaint(*arguments):
    """What the command prints on standard error, without its name."""
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode != 0, done.stdout
    return done.stderr.rstrip("\n").removeprefix("twin: ")


class Scenes(unittest.TestCase):
    def test_name_file_text_and_mapping_are_the_same_scene(self):
        by_name = wt.Scene.load("demo")
        self.assertTrue(pathlib.Path(by_name.source).is_file())
        for other in (by_name.source, pathlib.Path(by_name.source), by_name.to_yaml(), by_name.to_dict()):
            self.assertEqual(wt.Scene.load(other).to_dict(), by_name.to_dict())
        self.assertEqual(pickle.loads(pickle.dumps(by_name)), by_name)
        self.assertIn("demo", wt.shipped_scenes())

    def test_numbers_of_a_mapping_keep_their_bits(self):
        scene = wt.Scene.load(JEFFCOTT)
        for value in (0.1 + 0.2, 1.0 / 3.0, numpy.float64(1.0 / 7.0), numpy.float32(0.1), 3):
            changed = scene.with_(rotor={"mass": value})
            self.assertEqual(wt.Twin(changed).parameter("rotor", "mass"), float(value))

    def test_with_changes_a_copy_and_converts_units(self):
        scene = wt.Scene.load(JEFFCOTT)
        before = scene.to_dict()
        changed = scene.with_(rotor={"mass": "900 g", "initial.x": "1 mm", "integrator": "runge_kutta_4"},
                              shaft={"speed": "600 rpm"}, step="0.5 ms")
        self.assertEqual(scene.to_dict(), before)
        self.assertEqual(changed.step, 0.0005)
        twin = wt.Twin(changed)
        self.assertAlmostEqual(twin.parameter("rotor", "mass"), 0.9, 15)
        self.assertAlmostEqual(twin.state("rotor")["q"][0], 1.0e-3, 18)
        self.assertAlmostEqual(twin.state("rotor")["shaft_speed"], 20.0 * math.pi, 12)
        heavier = wt.Scene.load("friswell_rotor")
        system = next(iter(heavier.systems))
        heavier = heavier.with_(**{system: {"discs[0].mass": "33 kg"}})
        self.assertEqual(heavier.to_dict()["systems"][system]["parameters"]["discs"][0]["mass"], "33 kg")

    def test_with_changes_controllers_and_removes_keys(self):
        scene = wt.Scene.load("levitation").with_(magnets={"kp": 7e3, "delay": None})
        magnets = scene.to_dict()["controllers"]["magnets"]
        self.assertEqual((magnets["parameters"]["kp"], "delay" in magnets), (7e3, False))

    def test_with_names_what_is_not_there(self):
        scene = wt.Scene.load(JEFFCOTT)
        with self.assertRaisesRegex(wt.InputError, "motor.mass: there is no system, controller, drive or sensor 'motor'"):
            scene.with_(motor={"mass": 1.0})
        with self.assertRaisesRegex(wt.SceneError, "systems.rotor.parameters.mas: unknown.*did you mean 'mass'"):
            scene.with_(rotor={"mas": 1.0})
        for path in ("discs[9].mass", "mass[0]", "a..b", "", "mass.deep"):
            with self.assertRaises(wt.InputError):
                scene.with_(rotor={path: 1.0})
        with self.assertRaisesRegex(wt.InputError, "rotor: must name a value of rotor"):
            scene.with_(rotor=5.0)


class Errors(unittest.TestCase):
    def test_scene_errors_are_those_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "wrong.yaml")
            pathlib.Path(path).write_text(JEFFCOTT.replace("mass: 2.0", "mass: -1 furlong, colour: red")
                                          .replace("step: 1 ms", "step: 20 s"), encoding="utf-8")
            with self.assertRaises(wt.SceneError) as caught:
                wt.Scene.load(path)
            self.assertEqual(str(caught.exception), complaint("check", path))
            problems = caught.exception.problems
            self.assertGreaterEqual(len(problems), 3)
            step = next(problem for problem in problems if problem.path == "step")
            self.assertEqual(step.expected, "from 1e-09 to 10 s")
            self.assertEqual(step.found, "20 s")
            self.assertEqual("\n".join(problem.text for problem in problems), str(caught.exception))
            self.assertEqual(pickle.loads(pickle.dumps(caught.exception)).problems, problems)
        for missing in ("no_such_scene", "/no/such/file.yaml"):
            with self.assertRaises(wt.SceneError) as caught:
                wt.Scene.load(missing)
            self.assertEqual(str(caught.exception), complaint("check", missing))

    def test_errors_of_requests_are_those_of_the_command(self):
        cases = [
            (lambda: wt.campbell("pendulum"), ("campbell", "pendulum")),
            (lambda: wt.campbell("demo", modes=0), ("campbell", "demo", "--modes", "0")),
            (lambda: wt.campbell("demo", "rotr"), ("campbell", "demo", "--system", "rotr")),
            (lambda: wt.response("demo", "rotor", station="top"),
             ("response", "demo", "--system", "rotor", "--station", "top")),
            (lambda: wt.analyze("demo", modes="few"), ("analyze", "demo", "--modes", "few")),
            (lambda: wt.loop("demo"), ("loop", "demo")),
            (lambda: wt.routh([0, 0]), ("routh", "0", "0")),
            (lambda: wt.routh(["x", "2"]), ("routh", "x", "2")),
            (lambda: wt.simulate("demo", duration=-1), ("simulate", "demo", "--duration=-1", "--json")),
            (lambda: wt.simulate("demo", sample="1 furlong"), None),
            (lambda: wt.sweep("/no/such/study.yaml"), ("sweep", "/no/such/study.yaml", "--output", "/tmp/none")),
            (lambda: wt.fit("/no/such/study.yaml"), ("fit", "/no/such/study.yaml")),
        ]
        for call, arguments in cases:
            with self.subTest(arguments=arguments):
                with self.assertRaises(wt.InputError) as caught:
                    call()
                if arguments:
                    self.assertEqual(str(caught.exception), complaint(*arguments))

    def test_wrong_types_are_exceptions(self):
        cycle = []
        cycle.append(cycle)
        odd = [None, 5, 1.5, True, object(), b"demo", [], {}, (), {"systems": 5}, {5: 5}, {"systems": {"a": cycle}},
               {"step": float("nan"), "systems": {}}, "\n", "a\0b\n", "\ud800\n", {"systems": numpy.zeros(3)}, cycle]
        for value in odd:
            with self.subTest(scene=repr(value)[:40]), self.assertRaises((TypeError, ValueError)):
                wt.Scene.load(value)
        scene = wt.Scene.load(JEFFCOTT)
        twin = wt.Twin(scene)
        calls = [lambda x: wt.simulate(scene, x), lambda x: wt.simulate(scene, 0.01, x),
                 lambda x: wt.simulate(scene, 0.01, systems=x), lambda x: wt.campbell(scene, x),
                 lambda x: wt.campbell(scene, points=x), lambda x: wt.campbell(scene, harmonics=x),
                 lambda x: wt.orbit(scene, x), lambda x: wt.modes(scene, speed=x), lambda x: wt.routh([1, x, "y"]),
                 lambda x: wt.stability(scene, stages=x), lambda x: wt.fit(x), lambda x: wt.sweep(x),
                 lambda x: wt.read_log(x), lambda x: twin.step(x), lambda x: twin.state(x),
                 lambda x: twin.set_input("rotor", "force_x", x), lambda x: twin.set_parameter("rotor", "mass", x),
                 lambda x: twin.set_parameter(x, "mass", 1.0), lambda x: twin.restore(x)]
        for value in (object(), {"a": 1}, "nonsense", float("nan"), [object()], b"x", -10**30):
            for i, call in enumerate(calls):
                with self.subTest(call=i, value=repr(value)[:40]), \
                        self.assertRaises((TypeError, ValueError, KeyError, wt.WhirlTwinError)):
                    call(value)
        with self.assertRaises(TypeError):
            wt.simulate(scene, 0.01, progress=5)


class Reports(unittest.TestCase):
    def test_jeffcott_critical_speed_is_the_root_of_stiffness_over_mass(self):
        scene = wt.Scene.load(JEFFCOTT).with_(rotor={"damping": 0.0})
        report = wt.campbell(scene, to="3000 rpm")
        crossings = report["rotor"].crossings
        self.assertAlmostEqual(crossings[0].speed / math.sqrt(STIFFNESS / MASS), 1.0, 9)
        self.assertEqual(report.crossings[0].speed, crossings[0]["speed"])

    def test_values_are_those_that_the_command_prints(self):
        cases = [
            (lambda: wt.analyze("demo"), ("analyze", "demo")),
            (lambda: wt.analyze("double_pendulum", at=0.5), ("analyze", "double_pendulum", "--at", "0.5")),
            (lambda: wt.analyze("levitation"), ("analyze", "levitation")),
            (lambda: wt.campbell("demo", to=120.0, points=40), ("campbell", "demo", "--to", "120", "--points", "40")),
            (lambda: wt.response("demo", "rotor", to=120.0), ("response", "demo", "--system", "rotor", "--to", "120")),
            (lambda: wt.response("friswell_rotor", force="node_2", at=["node_2", "node_4"], speed=100),
             ("response", "friswell_rotor", "--force", "node_2", "--at", "node_2", "node_4", "--speed", "100")),
            (lambda: wt.orbit("demo", 55), ("orbit", "demo", "--speed", "55")),
            (lambda: wt.modes("balancing", speed=70), ("modes", "balancing", "--speed", "70")),
            (lambda: wt.stability("friswell_rotor", stages=[["500 W", "400 mm", 0.015, 1.6]]),
             ("stability", "friswell_rotor", "--stage", "500", "0.4", "0.015", "1.6")),
            (lambda: wt.critical_map("friswell_rotor", points=11), ("map", "friswell_rotor", "--points", "11")),
            (lambda: wt.loop("levitation"), ("loop", "levitation")),
            (lambda: wt.routh([1, 6, 11, "K"], "K"), ("routh", "1", "6", "11", "K", "--parameter", "K")),
            (lambda: wt.routh([1, 2, 3, 4]), ("routh", "1", "2", "3", "4")),
        ]
        for call, arguments in cases:
            with self.subTest(arguments=arguments):
                result = call()
                self.assertEqual(result.to_dict(), printed(*arguments))
                self.assertEqual(list(result.to_dict()), list(printed(*arguments)))
                text = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=True).stdout
                self.assertEqual(str(result), text)

    def test_tables_are_those_of_csv(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "campbell.csv")
            subprocess.run([PROGRAM, "campbell", "demo", "--to", "120", "--csv", path], check=True,
                           stdout=subprocess.DEVNULL)
            import pandas
            pandas.testing.assert_frame_equal(wt.campbell("demo", to=120).to_dataframe(), pandas.read_csv(path, float_precision="round_trip"),
                                              check_dtype=False, rtol=0, atol=0)

    def test_figures_are_those_of_plot(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "figure.json")
            subprocess.run([PROGRAM, "response", "friswell_rotor", "--to", "300", "--plot", path], check=True,
                           stdout=subprocess.DEVNULL)
            expected = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
            result = wt.response("friswell_rotor", to=300)
            self.assertEqual(result._document.figure(0), expected)
            figure = result.plot()
            curve = expected["charts"][0]["series"][0]
            peak = max(y for y in curve["y"] if y is not None)
            drawn = [line.get_xydata() for line in figure.axes[0].lines]
            self.assertTrue(any(len(xy) > 10 and abs(numpy.nanmax(xy[:, 1]) / peak - 1.0) < 1e-9 for xy in drawn))
            import matplotlib.figure
            axes = matplotlib.figure.Figure().subplots()
            self.assertIs(result.plot(ax=axes), axes.figure)
            self.assertTrue(axes.lines)
        with self.assertRaisesRegex(wt.InputError, "analyze has no figure"):
            wt.analyze("pendulum").plot()

    def test_attributes_name_what_is_there(self):
        result = wt.routh([1, 2, 3])
        self.assertEqual(result.verdict, "asymptotically_stable")
        self.assertIn("verdict", dir(result))
        with self.assertRaisesRegex(AttributeError, "did you mean 'verdict'"):
            result.verdikt
        with self.assertRaises(KeyError):
            result["none"]
        self.assertIn("stable", result._repr_html_())

    def test_measured_modes_are_read_from_a_log(self):
        with tempfile.TemporaryDirectory() as folder:
            log = os.path.join(folder, "run.lcmlog")
            subprocess.run([PROGRAM, "simulate", "balancing", "--duration", "20", "--sample", "0.01", "--measure",
                            "sensors", "--output", log], check=True)
            self.assertEqual(wt.modes("balancing", measured=log).to_dict(),
                             printed("modes", "balancing", "--measured", log))

    def test_balancing_from_a_log_is_that_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            log = os.path.join(folder, "run.lcmlog")
            subprocess.run([PROGRAM, "simulate", "balancing", "--measure", "sensors", "--output", log], check=True,
                           capture_output=True)
            result = wt.balance("balancing", measured=log, planes=["node_2", "node_4"], from_=30, to="700 rpm")
            options = ("--planes", "node_2", "node_4", "--from", "30", "--to", str(700 * math.pi / 30))
            self.assertEqual(result.to_dict(), printed("balance", "balancing", "--measured", log, *options))
            # 600 g mm at 0.9 rad, as the scene has it; the correction is opposite.
            found = result.unbalance["node_2"]
            self.assertLess(abs(found.mass_radius - 6.0e-4), 5.0 * found.mass_radius_deviation)
            turn = result.correction["node_2"].angle - found.angle
            self.assertAlmostEqual(math.cos(math.radians(turn)), -1.0, 9)
            self.assertEqual(result.to_dataframe()["plane"].tolist(), ["node_2", "node_4"])
            with self.assertRaisesRegex(wt.InputError, "expected samples with a known angle"):
                wt.balance("balancing", measured=log, from_=300)
        with self.assertRaisesRegex(wt.InputError, "--from must be < --to"):
            wt.balance("balancing", measured=log, from_=50, to=40)

    def test_balancing_job_of_a_mapping_and_of_a_file(self):
        # v = 2 u: an unbalance of 3 at 0 deg, and 1 more at 90 deg.
        job = {"probes": ["left"], "planes": ["disc"], "initial": [[6, 0]],
               "trials": [{"plane": "disc", "mass_radius": 1, "angle": 90,
                           "readings": [[math.hypot(6, 2), -math.degrees(math.atan2(2, 6))]]}]}
        result = wt.balance_job(job)
        self.assertAlmostEqual(result.correction["disc"]["mass_radius"], 3.0, places=9)
        self.assertAlmostEqual(abs(result.correction["disc"]["angle"]), 180.0, places=7)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "job.yaml")
            path.write_text(json.dumps(job))
            self.assertEqual(wt.balance_job(path).to_dict(), result.to_dict())
            self.assertEqual(printed("balance", str(path)), result.to_dict())
        with self.assertRaisesRegex(wt.InputError, "job: planes: must be"):
            wt.balance_job({**job, "planes": []})


class Package(unittest.TestCase):
    def test_nothing_is_loaded_before_it_is_used(self):
        code = "import whirl_twin, sys; assert not [m for m in sys.modules if 'numpy' in m or '_native' in m]"
        subprocess.run([sys.executable, "-c", code], check=True)

    def test_every_name_is_there_and_documented(self):
        for name in wt.__all__:
            self.assertTrue(getattr(wt, name).__doc__ or name == "stability_map", name)
        with self.assertRaises(AttributeError):
            wt.no_such_name
        self.assertRegex(wt.__version__, r"^\d+\.\d+\.\d+$")


if __name__ == "__main__":
    unittest.main()
