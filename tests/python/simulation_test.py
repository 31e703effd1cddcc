"""Runs and stepped twins of the Python package, studies and logs: physics, bits, memory, interruption."""

import gc
import json
import logging
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy
import whirl_twin as wt

PROGRAM = os.environ["WHIRL_TWIN_PROGRAM"]
PROJECT = pathlib.Path(__file__).resolve().parents[2]


def memory():
    """Resident memory [bytes], now."""
    gc.collect()
    pages = int(pathlib.Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * resource.getpagesize()


class Runs(unittest.TestCase):
    def test_pendulum_without_damping_keeps_its_energy(self):
        scene = wt.Scene.load("pendulum").with_(free={"initial.theta": "100 deg"})
        run = wt.simulate(scene, "5 s", "10 ms")
        energy = run["free.kinetic_energy"] + run["free.potential_energy"]
        self.assertGreater(numpy.ptp(run["free.kinetic_energy"]), 0.1 * abs(energy[0]))
        self.assertLess(numpy.ptp(energy), 1e-5 * numpy.ptp(run["free.kinetic_energy"]))
        self.assertEqual(len(run.time), 501)
        self.assertEqual(run.time[-1], 5.0)

    def test_samples_are_those_of_the_table(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "demo.csv")
            done = subprocess.run([PROGRAM, "simulate", "demo", "--duration", "1", "--sample", "0.01", "--output",
                                   path, "--json"], capture_output=True, check=True)
            table = numpy.genfromtxt(path, delimiter=",", names=None, skip_header=1)
            names = pathlib.Path(path).read_text(encoding="utf-8").split("\n")[0].split(",")
            run = wt.simulate("demo", 1, 0.01)
            for column, name in enumerate(names):
                numpy.testing.assert_array_equal(run[name], table[:, column], name)
        self.assertEqual(run.to_dict(), json.loads(done.stdout))

    def test_arrays_share_the_memory_that_was_sampled_into(self):
        run = wt.simulate("demo", 0.1)
        self.assertFalse(run.data.flags.owndata)
        for name in run.names:
            self.assertTrue(numpy.shares_memory(run[name], run.data))
            self.assertTrue(run[name].flags.c_contiguous)
        signal_of_it = run[run.names[3]]
        expected = signal_of_it.copy()
        del run
        gc.collect()
        numpy.testing.assert_array_equal(signal_of_it, expected)

    def test_whirl_radius_is_that_of_the_station(self):
        run = wt.simulate("friswell_rotor", 0.05)
        system = next(iter(wt.Scene.load("friswell_rotor").systems))
        stations = [name[:-2] for name in run.names if name.endswith(".x")]
        self.assertGreater(len(stations), 3)
        radius = run[f"{system}.whirl_radius"]
        self.assertTrue(any(numpy.allclose(numpy.hypot(run[s + ".x"], run[s + ".y"]), radius, rtol=1e-12)
                            for s in stations))

    def test_chosen_systems_alone_are_sampled(self):
        systems = list(wt.Scene.load("demo").systems)
        run = wt.simulate("demo", 0.1, systems=systems[1])
        self.assertEqual({name.split(".")[0] for name in run.names[1:]}, {systems[1]})
        numpy.testing.assert_array_equal(run.data[1], wt.simulate("demo", 0.1)[run.names[1]])
        frame = run.to_dataframe()
        self.assertEqual(frame.shape, (len(run.time), len(run.names) - 1))
        figure = run.plot()
        self.assertTrue(figure.axes[0].lines)
        with self.assertRaisesRegex(KeyError, "did you mean"):
            run[run.names[1] + "x"]

    def test_every_shipped_scene_runs(self):
        for name in wt.shipped_scenes():
            with self.subTest(scene=name):
                run = wt.simulate(name, 0.05, 0.01)
                self.assertEqual(run.data.shape, (len(run.names), len(run.time)))
                self.assertTrue(numpy.isfinite(run.time).all())

    def test_what_stops_is_logged_and_undefined_from_then_on(self):
        scene = wt.Scene.load({
            "step": 0.01, "systems": {"block": {  # a step of 100 radians of its motion
                "model": "mass_spring_damper", "parameters": {"mass": 1.0, "stiffness": 1e8, "damping": 0.0},
                "integrator": "runge_kutta_4", "initial": {"x": 1.0}}}})
        with self.assertLogs("whirl_twin", logging.WARNING) as logged:
            run = wt.simulate(scene, 2)
        self.assertFalse(run.ok)
        self.assertTrue(numpy.isfinite(run["block.x"][:3]).all())
        self.assertTrue(numpy.isnan(run["block.x"][-1]))
        self.assertIn("block", logged.output[0])
        self.assertNotEqual(run.to_dict()["systems"]["block"]["status"], "ok")

    def test_progress_rises_to_one_and_its_exception_ends_the_run(self):
        parts = []
        wt.simulate("demo", 20, 1, progress=parts.append)
        self.assertEqual(parts, sorted(parts))
        self.assertEqual(parts[-1], 1.0)

        def fail(part):
            raise LookupError(str(part))

        with self.assertRaisesRegex(wt.InputError, "sample"):  # more memory than there is
            wt.simulate("demo", "1e8")
        with self.assertRaises(LookupError):
            wt.simulate("demo", "1e6", 100, progress=fail)

    def test_interrupt_ends_a_run_with_keyboard_interrupt(self):
        code = ("import whirl_twin as wt\n"
                "def begun(part):\n"
                "    print('begun', flush=True)\n"
                "try:\n"
                "    wt.simulate('demo', '1e7', 1e4, progress=begun)\n"
                "except KeyboardInterrupt:\n"
                "    print('interrupted', wt.simulate('pendulum', 0.01).ok)\n")
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
            self.assertEqual(process.stdout.readline(), "begun\n")
            process.send_signal(signal.SIGINT)
            self.assertIn("interrupted True", process.communicate(timeout=60)[0])
            self.assertEqual(process.returncode, 0)

    def test_loads_and_runs_keep_no_memory(self):
        count = int(os.environ.get("WHIRL_TWIN_RUNS", "300"))

        tree = wt.Scene.load("demo").with_(rotor={"integrator": "exponential"},
                                           pendulum={"integrator": "runge_kutta_4"}).to_dict()

        def work(times):
            for _ in range(times):
                scene = wt.Scene.load(tree).with_(rotor={"mass": 2.1})
                wt.simulate(scene, 0.01)["rotor.whirl_radius"].max()
                wt.routh([1, 2, 3])

        work(100)
        before = memory()
        work(count)
        self.assertLess(memory() - before, 2e6)


class SteppedTwins(unittest.TestCase):
    def test_steps_are_those_of_a_run_bit_for_bit(self):
        for name in ("demo", "double_pendulum", "friswell_rotor", "levitation", "rub"):
            with self.subTest(scene=name):
                scene = wt.Scene.load(name)
                run = wt.simulate(scene, 0.2)
                twin = wt.Twin(scene)
                done = 0
                for count in (1, 2, 16, 100, len(run.time) - 1 - 119):
                    twin.step(max(0, count))
                    done += max(0, count)
                    if done >= len(run.time):
                        break
                    self.assertEqual(twin.time, run.time[done])
                    for system in scene.systems:
                        state = twin.state(system)
                        names = twin.names(system)["coordinates"]
                        for k, coordinate in enumerate(names):
                            self.assertEqual(state["q"][k], run[f"{system}.{coordinate}"][done])
                            self.assertEqual(state["v"][k], run[f"{system}.{coordinate}_rate"][done])
                        if "whirl_phase" in state:
                            numpy.testing.assert_equal(state["whirl_phase"], run[f"{system}.whirl_phase"][done])

    def test_saved_states_and_resets_return(self):
        twin = wt.Twin("demo")
        twin.step(100)
        saved = twin.save()
        twin.step(500)
        expected = twin.state("rotor")["q"]
        twin.restore(saved)
        self.assertEqual(twin.steps, 100)
        twin.step(500)
        numpy.testing.assert_array_equal(twin.state("rotor")["q"], expected)
        twin.reset()
        self.assertEqual(twin.steps, 0)
        twin.step(600)
        numpy.testing.assert_array_equal(twin.state("rotor")["q"], expected)
        with self.assertRaises(wt.InputError):
            twin.restore(b"nonsense")
        with self.assertRaises(wt.InputError):
            wt.Twin("pendulum").restore(saved)

    def test_a_twin_that_another_thread_steps_is_not_read(self):
        twin = wt.Twin("demo")
        thread = threading.Thread(target=twin.step, args=(3_000_000,))
        thread.start()
        refused = 0
        while thread.is_alive():
            try:
                twin.state("rotor")
            except wt.RunError:
                refused += 1
        thread.join()
        self.assertGreater(refused, 0)
        self.assertEqual(twin.steps, 3_000_000)
        self.assertTrue(numpy.isfinite(twin.state("rotor")["q"]).all())

    def test_a_constant_force_moves_a_spring_by_force_over_stiffness(self):
        scene = wt.Scene.load({
            "step": 0.001, "systems": {"block": {
                "model": "mass_spring_damper", "parameters": {"mass": 1.0, "stiffness": 100.0, "damping": 20.0},
                "inputs": {"force": 0.0}}}})
        twin = wt.Twin(scene)
        twin.set_input("block", "force", "5 N")
        twin.step(5000)
        self.assertAlmostEqual(twin.state("block")["q"][0], 0.05, 9)
        twin.set_parameter("block", "stiffness", "200 N/m")
        self.assertEqual(twin.parameter("block", "stiffness"), 200.0)
        twin.step(10000)
        self.assertAlmostEqual(twin.state("block")["q"][0], 0.025, 9)
        twin.set_input("block", "force", 8.0, duration="1 s")  # then that of the scene again, 0
        twin.step(1000)
        self.assertGreater(twin.state("block")["q"][0], 0.03)
        twin.step(10000)
        self.assertLess(abs(twin.state("block")["q"][0]), 1e-9)
        self.assertEqual(twin.status("block"), "ok")
        with self.assertRaisesRegex(wt.InputError, "'N' cannot|'m' cannot"):
            twin.set_input("block", "force", "5 m")
        with self.assertRaisesRegex(wt.InputError, "no input 'forc'; did you mean 'force'"):
            twin.set_input("block", "forc", 1.0)
        with self.assertRaisesRegex(wt.InputError, "must be given as a number in the scene"):
            wt.Twin(scene.with_(block={"inputs": None})).set_input("block", "force", 1.0)
        with self.assertRaises(wt.InputError):
            twin.set_parameter("block", "mass", -1.0)


class StudiesAndLogs(unittest.TestCase):
    def test_sweep_has_the_points_and_the_statistics_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            study = os.path.join(folder, "study.yaml")
            pathlib.Path(study).write_text(
                "study: {scene: scene.yaml, seed: 3}\nvary: {block.mass: {uniform: [1, 4]}}\n"
                "design: {latin_hypercube: 20}\nrun: analyze\nmeasure: {f: \"natural_frequencies[0]\"}\n",
                encoding="utf-8")
            pathlib.Path(folder, "scene.yaml").write_text(
                "step: 0.001\nsystems: {block: {model: mass_spring_damper, parameters: "
                "{mass: 1, stiffness: 100, damping: 0}}}\n", encoding="utf-8")
            result = wt.sweep(study)
            frame = result.to_dataframe()
            self.assertEqual(len(frame), 20)
            numpy.testing.assert_allclose(frame["f"], numpy.sqrt(100.0 / frame["block.mass"]), rtol=1e-9)
            done = subprocess.run([PROGRAM, "sweep", study, "--output", os.path.join(folder, "out"), "--json"],
                                  capture_output=True, check=True)
            self.assertEqual(result.to_dict(), json.loads(done.stdout))

    @unittest.skipIf(os.environ.get("WHIRL_TWIN_FITS") == "OFF", "built without Ceres")
    def test_fit_finds_the_length_of_a_pendulum(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = wt.Scene.load("pendulum").with_(free={"initial.theta": 0.5})
            run = wt.simulate(scene, 4, 0.01)
            numpy.savetxt(os.path.join(folder, "swing.csv"), numpy.column_stack([run.time, run["free.theta"]]),
                          delimiter=",", header="time,theta", comments="")
            length = wt.Twin(scene).parameter("free", "length")
            pathlib.Path(folder, "scene.yaml").write_text(
                scene.with_(free={"length": 1.1 * length}).to_yaml(), encoding="utf-8")
            study = os.path.join(folder, "study.yaml")
            pathlib.Path(study).write_text(
                "scene: scene.yaml\nsystem: free\nruns:\n"
                "  - {file: swing.csv, use: train, time: time, measured: {theta: theta}}\n"
                "windows: {length: 1.0, start: estimated}\nfit: {length: {}}\n", encoding="utf-8")
            result = wt.fit(study)
            self.assertTrue(result.ok)
            frame = result.to_dataframe()
            self.assertAlmostEqual(float(frame["value"][0]) / length, 1.0, 4)
            self.assertTrue(result.plot().axes)

    def test_logs_have_the_samples_of_the_run(self):
        run = wt.simulate("demo", 1, 0.01)
        with tempfile.TemporaryDirectory() as folder:
            for file in ("run.lcmlog", "run.mcap"):
                with self.subTest(file=file):
                    path = os.path.join(folder, file)
                    subprocess.run([PROGRAM, "simulate", "demo", "--duration", "1", "--sample", "0.01", "--output",
                                    path], check=True)
                    log = wt.read_log(path)
                    whirl = log["rotor/whirl"]
                    self.assertIs(log["/twin/rotor/whirl"], whirl)
                    numpy.testing.assert_array_equal(whirl["radius"], run["rotor.whirl_radius"])
                    self.assertEqual(len(log.to_dataframe("rotor/whirl")), len(run.time))
                    self.assertEqual((log.left_out, log.defects), (0, []))
                    with self.assertRaises(KeyError):
                        log["no/topic"]
            cut = pathlib.Path(folder, "cut.mcap")
            cut.write_bytes(pathlib.Path(folder, "run.mcap").read_bytes()[:-40_000])
            wt.read_log(cut)
            for name, contents in (("a.mcap", b"nonsense"), ("b.lcmlog", b"nonsense"), ("c.bag", b"nonsense")):
                pathlib.Path(folder, name).write_bytes(contents)
                with self.assertRaises(wt.InputError):
                    wt.read_log(pathlib.Path(folder, name))
            with self.assertRaises(wt.InputError):
                wt.read_log(os.path.join(folder, "missing.lcmlog"))


if __name__ == "__main__":
    unittest.main()
