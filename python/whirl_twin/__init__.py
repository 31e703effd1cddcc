"""Digital twin of rotors and pendulums: simulation, stability, critical speeds, identification.

    import whirl_twin as wt
    scene = wt.Scene.load("demo")
    run = wt.simulate(scene, duration="10 s", sample="1 ms")
    run["rotor.whirl_radius"].max()
    wt.campbell(scene, to="1200 rpm").plot()

Numbers are in SI units (m, kg, s, rad, N); text with a unit is converted ("800 rpm"). Exceptions derive from
:class:`WhirlTwinError` and have the text of the command line. Messages that the command line prints on standard error,
such as that a system has stopped, go to the logger ``whirl_twin``.

The messages of ROS are in ``whirl_twin.msg`` and ``whirl_twin.srv``. Nothing else is loaded before it is used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .errors import InputError, Problem, RunError, SceneError, WhirlTwinError
    from .logs import Log, Table, read_log
    from .reports import (analyze, balance, balance_job, campbell, critical_map, loop, modes, orbit, response, routh,
                          stability, stability_map)
    from .results import Result, Section
    from .scene import Scene, shipped_scenes
    from .simulation import Run, Twin, simulate
    from .studies import fit, sweep

_PLACES = {
    "errors": ("InputError", "Problem", "RunError", "SceneError", "WhirlTwinError"),
    "logs": ("Log", "Table", "read_log"),
    "reports": ("analyze", "balance", "balance_job", "campbell", "critical_map", "loop", "modes", "orbit", "response",
                "routh", "stability", "stability_map"),
    "results": ("Result", "Section"),
    "scene": ("Scene", "shipped_scenes"),
    "simulation": ("Run", "Twin", "simulate"),
    "studies": ("fit", "sweep"),
}
_PLACE_OF = {name: place for place, names in _PLACES.items() for name in names}

__all__ = sorted(_PLACE_OF)  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name: str):
    if name == "__version__":
        return importlib.import_module("._native", __name__).version
    if name not in _PLACE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module("." + _PLACE_OF[name], __name__), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted([*globals(), *__all__, "__version__"])
