"""Runs of a scene as arrays, and twins stepped by a loop."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Iterator, Sequence

from . import _native
from .quantities import Quantity, listed, quantity, seconds, text
from .results import data_frame, drawn, near, preformatted
from .scene import Scene, SceneLike

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure
    import numpy
    import pandas


class Run:
    """Samples of a run: ``run["rotor.x"]`` is a NumPy array of float64, one value for each sample.

    Of each system: its coordinates, their rates (``x_rate``); of a rotor ``whirl_radius`` [m], ``whirl_phase`` [rad]
    (lag behind the shaft's phase mark, unwrapped) and ``STATION.x``, ``STATION.y`` [m] along its shaft; of a shaft
    ``shaft_speed`` [rad/s] and ``shaft_angle`` [rad]; ``kinetic_energy``, ``potential_energy`` and ``jacobi_energy``
    [J]. Of controllers ``CONTROLLER.SYSTEM.INPUT``. NaN where a value is undefined or a system has stopped.
    """

    def __init__(self, names: list[str], units: list[str], data: "numpy.ndarray", final: dict[str, Any], ok: bool):
        self._rows = {name: row for row, name in enumerate(names)}
        self._final = final
        self.units: dict[str, str] = dict(zip(names, units))
        """Unit of each signal."""
        self.data = data
        """All samples [signals, samples], in the order of :attr:`names`; the signals are its rows, not copies."""
        self.ok = ok
        """False if a system has stopped before the end: ``to_dict()["systems"][NAME]["status"]``."""

    @property
    def names(self) -> list[str]:
        """Names of the signals; the first is "time"."""
        return list(self._rows)

    @property
    def time(self) -> "numpy.ndarray":
        """Simulated time [s] of the samples."""
        return self.data[0]

    def __getitem__(self, name: str) -> "numpy.ndarray":
        row = self._rows.get(name)
        if row is None:
            raise KeyError(f"no signal '{name}'" + near(str(name), self.names))
        return self.data[row]

    def __contains__(self, name: object) -> bool:
        return name in self._rows

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)

    def to_dict(self) -> dict[str, Any]:
        """The final state, as ``twin simulate --json`` prints it."""
        return self._final

    def to_dataframe(self) -> "pandas.DataFrame":
        """The signals as columns, the time [s] as index."""
        columns = {name: self[name] for name in self.names[1:]}
        import pandas
        return data_frame(columns, index=pandas.Index(self.time, name="time"))

    def plot(self, *names: str, ax: "matplotlib.axes.Axes | None" = None) -> "matplotlib.figure.Figure":
        """Draws signals over time, those of one unit in one chart; by default the coordinates of all systems.

        ax: axes of matplotlib for the first chart. Returns the figure. Raises KeyError for an unknown name.
        """
        if not names:
            names = tuple(self._coordinates())
        charts: dict[str, dict[str, Any]] = {}
        for name in names:
            values = self[name]
            unit = self.units[name]
            chart = charts.setdefault(unit, {
                "x": {"label": "time (s)", "tight": True}, "y": {"label": f"{name} ({unit})"}, "series": []})
            if chart["series"]:
                chart["y"]["label"] = f"({unit})"
            chart["series"].append({"name": name, "x": self.time.tolist(), "y": values.tolist()})
        return drawn({"kind": "charts", "title": self._final["scene"], "columns": 1, "charts": list(charts.values())},
                     ax)

    def _coordinates(self) -> list[str]:
        names = []
        for system, values in self._final["systems"].items():
            names += [f"{system}.{name}" for name in values["state"] if not name.endswith("_rate")][:8]
        return names

    def __repr__(self) -> str:
        return (f"<Run {self._final['scene']}: {len(self.names) - 1} signals, {self.data.shape[1]} samples, "
                f"{self._final['duration']:g} s>")

    def _repr_html_(self) -> str:
        lines = [repr(self)[1:-1]]
        lines += [f"  {name:40} {self.units[name]}" for name in self.names]
        return preformatted("\n".join(lines))


def simulate(scene: SceneLike, duration: Quantity | None = None, sample: Quantity | None = None,
             systems: str | Sequence[str] | None = None, *, step: Quantity | None = None,
             integrator: str | None = None, progress: Callable[[float], object] | None = None,
             insist: bool = False) -> Run:
    """Runs a scene from its start, as fast as possible.

    duration: simulated time [s], to the nearest step; default: the longest drive profile, else 10 s.
    sample: time between samples [s], to the nearest step; default: a step. The first sample is the start.
    systems: names of the systems that are sampled; default: all. All of them run.
    step, integrator: instead of the scene's.
    progress: called about 20 times a second with the part that is done, 0 to 1; its exception ends the run.
    insist: no limit on memory and preparation.

    Ctrl-C ends the run with KeyboardInterrupt. Raises SceneError, InputError, RunError. A system that stops, because
    it diverges or its equations become invalid, is NaN from then on and logged; ``run.ok`` is then False.
    """
    chosen = None if systems is None else [text("systems", name) for name in listed(systems)]
    return Run(*_native.simulate(
        Scene.load(scene)._native, chosen, seconds("duration", duration), seconds("sample", sample),
        seconds("step", step), text("integrator", integrator), bool(insist), progress))


class Twin:
    """A twin stepped by a loop of yours; the same bits as :func:`simulate`.

    >>> twin = Twin("pendulum")
    >>> twin.step(100)
    >>> twin.state("pendulum")["q"].shape
    (1,)
    """

    def __init__(self, scene: SceneLike):
        self.scene = Scene.load(scene)
        """The scene, which the twin starts from."""
        self._native = _native.Twin(self.scene._native)

    def step(self, count: int = 1) -> None:
        """Advances by so many fixed steps of the scene. Ctrl-C ends it after a whole step."""
        self._native.step(count)

    def reset(self) -> None:
        """Back to the start of the scene, with its parameters."""
        self._native.reset()

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._native.time

    @property
    def steps(self) -> int:
        """Steps since the start."""
        return self._native.steps

    def names(self, system: str) -> dict[str, list[str]]:
        """Names of the ``coordinates``, ``inputs`` and ``stations`` of a system, in the order of :meth:`state`."""
        return self._native.names(system)

    def state(self, system: str) -> dict[str, Any]:
        """The present state of a system.

        ``q``, ``v``: coordinates [rad or m] and rates, arrays [n]; of a rotor ``x``, ``y`` [m] at its stations,
        ``whirl_radius`` [m] and ``whirl_phase`` [rad]; of a shaft ``shaft_speed`` [rad/s] and ``shaft_angle`` [rad];
        ``kinetic_energy`` and ``potential_energy`` [J]. Arrays are copies. Raises InputError for an unknown system.
        """
        return self._native.state(system)

    def status(self, system: str) -> str:
        """"ok", or why the system has stopped."""
        return self._native.status(system)

    def set_input(self, system: str, input: str, value: Quantity, duration: Quantity | None = None) -> None:
        """Sets an input from the next step on.

        value: in the unit of the input (N, N m ...), or text with a unit. duration: simulated time [s], after which the
        scene's own value applies again; default: until the next value. Raises InputError for an input that is not there
        or that the scene does not give as a number: ``scene.with_(rotor={"inputs.force_x": 0})``.
        """
        self._native.set_input(system, input, value, quantity("duration", duration, "s"))

    def set_parameter(self, system: str, path: str, value: Quantity) -> None:
        """Changes a parameter, such as ``discs[0].mass``, from the next step on; coordinates and rates stay."""
        self._native.set_parameter(system, path, value)

    def parameter(self, system: str, path: str) -> float | None:
        """The present value of a parameter, in the unit of its model; None for an unknown path."""
        return self._native.parameter(system, path)

    def save(self) -> bytes:
        """The state, for :meth:`restore`. Parameters are not part of it."""
        return self._native.save()

    def restore(self, state: bytes) -> None:
        """Back to a saved state of a twin of the same scene. Raises InputError."""
        self._native.restore(state)

    def __repr__(self) -> str:
        return f"<Twin {self.scene.name} at {self.time:g} s>"
