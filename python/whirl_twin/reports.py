"""Reports on scenes: what the commands of the same names compute."""

from __future__ import annotations

import os
from typing import Any, Callable, Mapping, Sequence

from . import _native
from .quantities import Quantity, listed, quantity, seconds, text, whole
from .results import Result
from .scene import Scene, SceneLike


def analyze(scene: SceneLike, system: str | None = None, *, speed: Quantity | None = None,
            at: Quantity | None = None, parameters: bool = False, modes: int | str = 24,
            insist: bool = False) -> Result:
    """Energies, equilibria, natural frequencies and damping, stability and its margins, critical speeds.

    system: only this one; default: all. speed: of all shafts [rad/s]; default: that at the start. at: the motion after
    so many simulated seconds is analysed. parameters: instability points of the parameters also where their search
    takes minutes. modes: number of lowest modes, or "all", of a system with more than 100 coordinates.

    ``analyze(scene)["rotor"]`` has the values of a system: ``eigenvalues``, ``critical_speeds``, ``verdict`` ...
    Raises SceneError, InputError, and RunError for a system that stops before ``at``.
    """
    number = modes if isinstance(modes, str) else str(whole("modes", modes))
    return Result(_native.analyze(Scene.load(scene)._native, text("system", system),
                                  quantity("speed", speed, "rad/s"), seconds("at", at), bool(parameters), number,
                                  bool(insist)), "analyze")


def campbell(scene: SceneLike, system: str | None = None, *, from_: Quantity | None = None,
             to: Quantity | None = None, points: int = 200, harmonics: float | Sequence[float] = (1.0,),
             modes: int = 12, insist: bool = False,
             progress: Callable[[float], object] | None = None) -> Result:
    """Whirl frequencies [rad/s] of the rotors of a scene over the speed of the shaft, and critical speeds.

    from_, to: range of speeds [rad/s]; default: 0 to 1.2 times the drive's highest speed. harmonics: multiples of the
    speed that excite. modes: number of lowest modes. progress: called with the part that is done, 0 to 1.
    """
    return Result(_native.campbell(Scene.load(scene)._native, text("system", system), quantity("from_", from_, "rad/s"),
                                   quantity("to", to, "rad/s"), whole("points", points),
                                   [quantity("harmonics", one, "-") for one in listed(harmonics)],
                                   whole("modes", modes), bool(insist), progress), "campbell")


def response(scene: SceneLike, system: str | None = None, *, station: str | None = None,
             from_: Quantity | None = None, to: Quantity | None = None, points: int = 200,
             force: str | None = None, along: str = "x", at: str | Sequence[str] = (),
             speed: Quantity | None = None, insist: bool = False) -> Result:
    """Unbalance response over the speed of the shaft, or the response to a harmonic force.

    from_, to: range [rad/s] of speeds, or of frequencies of the force. station: only this one of the shaft.
    force: station of a harmonic force of 1 N in the fixed direction ``along`` ("x" or "y"), in place of the
    unbalance; at: stations of its response; speed: of the shaft [rad/s], default: the drive's highest.
    """
    return Result(_native.response(Scene.load(scene)._native, text("system", system), text("station", station),
                                   quantity("from_", from_, "rad/s"), quantity("to", to, "rad/s"),
                                   whole("points", points), text("force", force), text("along", along) or "x",
                                   [text("at", one) for one in listed(at)], quantity("speed", speed, "rad/s"),
                                   bool(insist)), "response")


def orbit(scene: SceneLike, speed: Quantity, system: str | None = None) -> Result:
    """Unbalance orbits at a speed of the shaft [rad/s], at every station of the rotors."""
    return Result(_native.orbit(Scene.load(scene)._native, text("system", system), quantity("speed", speed, "rad/s")),
                  "orbit")


def path(given: "str | os.PathLike[str] | None") -> str | None:
    """Of an optional file."""
    return None if given is None else os.fspath(given)


def modes(scene: SceneLike, system: str | None = None, *, speed: Quantity | None = None,
          measured: str | None = None, to: Quantity | None = None, drawn: int = 6,
          lcm_prefix: str = "TWIN_", import_settings: "str | os.PathLike[str] | None" = None) -> Result:
    """Modes of the rotors at a speed [rad/s]: frequency, damping, direction, shape; default: the drive's highest.

    measured: path of a log or a table of the running machine: modes identified from its ambient vibration, searched up
    to ``to`` [rad/s]. import_settings: path of the settings of a table. drawn: number of modes that :meth:`Result.plot`
    draws.
    """
    return Result(_native.modes(Scene.load(scene)._native, text("system", system), text("measured", measured),
                                quantity("speed", speed, "rad/s"), quantity("to", to, "rad/s"), whole("drawn", drawn),
                                text("lcm_prefix", lcm_prefix), path(import_settings)), "modes")


def stability(scene: SceneLike, system: str | None = None, *, speed: Quantity | None = None,
              at: str | None = None, stages: Sequence[Sequence[Any]] = (),
              axial_stages: Sequence[Sequence[Any]] = ()) -> Result:
    """Stability level I of API 617: the decrement over a cross-coupled stiffness [N/m] at mid-span.

    speed: of the shaft [rad/s], default: the drive's highest. at: station of the stiffness. stages: of each
    centrifugal stage power [W], diameter [m], width [m], density ratio; axial_stages: power, pitch diameter, height.
    """
    centrifugal = [_stage("stages", stage, ("W", "m", "m", "-")) for stage in stages]
    axial = [_stage("axial_stages", stage, ("W", "m", "m")) for stage in axial_stages]
    return Result(_native.stability(Scene.load(scene)._native, text("system", system),
                                    quantity("speed", speed, "rad/s"), text("at", at), centrifugal, axial),
                  "stability")


def _stage(name: str, stage: Sequence[Any], units: tuple[str, ...]) -> list[float | None]:
    if isinstance(stage, str) or len(stage) != len(units):
        raise TypeError(f"{name}: each must have {len(units)} values ({', '.join(units)})")
    return [quantity(name, value, unit) for value, unit in zip(stage, units)]


def critical_map(scene: SceneLike, system: str | None = None, *, from_: Quantity | None = None,
                 to: Quantity | None = None, points: int = 61, modes: int = 4,
                 bearings: Sequence[int] = ()) -> Result:
    """Undamped critical speeds [rad/s] of a flexible_rotor over the stiffness of its bearings.

    from_, to: range of stiffnesses [N/m]; default: about the bearings' own. bearings: nodes whose bearings are varied.
    """
    return Result(_native.critical_map(Scene.load(scene)._native, text("system", system),
                                       quantity("from_", from_, "N/m"), quantity("to", to, "N/m"),
                                       whole("points", points), whole("modes", modes),
                                       [whole("bearings", node) for node in listed(bearings)]), "map")


#: The map that there is: critical speeds over the stiffness of the bearings.
stability_map = critical_map


def balance(scene: SceneLike, system: str | None = None, *, measured: "str | os.PathLike[str]",
            planes: str | Sequence[str] = (), from_: Quantity | None = None, to: Quantity | None = None,
            known_run_out: bool = False, lcm_prefix: str = "TWIN_",
            import_settings: "str | os.PathLike[str] | None" = None) -> Result:
    """Unbalance of a running rotor from a log of its probes and keyphasor, and the masses that cancel it.

    measured: path of the log, as ``twin simulate --measure`` writes it, or of a table, with import_settings. planes: stations where masses can be added;
    default: those of the scene's unbalances. from_, to: range of speeds [rad/s] that is used. known_run_out: the
    run-out of the scene's sensors is used, else it is estimated.

    ``correction[PLANE]`` and ``unbalance[PLANE]`` have ``mass_radius`` [kg m] and ``angle`` [deg] from the shaft's
    phase mark, each with its ``_deviation``; None where the log does not identify them. Raises InputError for a log
    without samples in the range, and as :func:`whirl_twin.read_log` does.
    """
    return Result(_native.balance(Scene.load(scene)._native, text("system", system), os.fspath(measured),
                                  [text("planes", one) for one in listed(planes)],
                                  quantity("from_", from_, "rad/s"), quantity("to", to, "rad/s"), bool(known_run_out),
                                  text("lcm_prefix", lcm_prefix), path(import_settings)), "balance")


def balance_job(job: "str | os.PathLike[str] | Mapping[str, Any]") -> Result:
    """Correction masses from trial runs, or from the influence coefficients of an earlier job.

    job: path of a file of ``twin balance``, or a mapping with its keys: ``probes``, ``planes``, ``initial``, ``trials``
    or ``influence`` ... Numbers are in the SI and degrees, or text with a unit.

    ``correction[PLANE]`` has ``mass_radius`` [kg m] and ``angle`` [deg], with their 95 % intervals where the errors are
    known; ``residual[PROBE]`` the vibration that remains; ``influence`` the coefficients [amplitude/(kg m), deg].
    Raises InputError with all errors of the job.
    """
    return Result(_native.balance_job(job if isinstance(job, Mapping) else os.fspath(job)), "balance")


def loop(scene: SceneLike, *, speed: Quantity | None = None) -> Result:
    """Stability and margins of the sampled control loops of a scene, at a speed of all shafts [rad/s]."""
    return Result(_native.loop(Scene.load(scene)._native, quantity("speed", speed, "rad/s")), "loop")


def routh(coefficients: Sequence[Any], parameter: str | None = None, *, insist: bool = False) -> Result:
    """Counts the roots of a polynomial right of, on and left of the imaginary axis, exactly.

    coefficients: highest power first: numbers, complex numbers, fractions, or text as on the command line ("1/3",
    "3+2i", with a parameter "2K"). parameter: its name; the values are found for which all roots are left of the axis.

    >>> routh([1, 2, 3, 4]).verdict
    'asymptotically_stable'
    """
    return Result(_native.routh([_coefficient(one) for one in listed(coefficients)], text("parameter", parameter),
                                bool(insist)), "routh")


def _coefficient(value: Any) -> str:
    """As typed: the number itself, not a rounded one."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        raise TypeError("coefficients: must be numbers or text, found bool")
    if hasattr(value, "item"):
        value = value.item()
    if isinstance(value, complex):
        return f"{value.real!r}{value.imag:+.17g}i"
    if isinstance(value, (int, float)):
        return repr(value)
    if hasattr(value, "numerator") and hasattr(value, "denominator"):
        return f"{value.numerator}/{value.denominator}"
    raise TypeError(f"coefficients: must be numbers or text, found {type(value).__name__}")
