"""Studies: a scene at many points, its optimum, and the fit of its parameters to measured runs."""

from __future__ import annotations

import os
import tempfile
from typing import Callable

from . import _native
from .quantities import text, whole
from .results import Result

Path = "str | os.PathLike[str]"


def _path(name: str, value: Path) -> str:
    path = os.fspath(value) if isinstance(value, (str, os.PathLike)) else value
    if not isinstance(path, str):
        raise TypeError(f"{name}: must be a path, found {type(value).__name__}")
    return path


def sweep(study: Path, output: Path | None = None, *, point: int | None = None, workers: int = 0,
          insist: bool = False, progress: Callable[[float], object] | None = None) -> Result:
    """Runs a scene at every point of a study (YAML), or finds its optimum.

    output: folder of the results, from which an interrupted study resumes; default: none is kept. point: only this
    one. workers: threads, 0: one for each core.

    ``to_dataframe()`` has the varied numbers and the measures of every point, ``to_dict()`` their statistics. Raises
    InputError for an invalid study, RunError if its results cannot be written.
    """
    path = _path("study", study)

    def run(folder: str | None) -> Result:
        return Result(_native.sweep(path, folder, None if point is None else whole("point", point),
                                    whole("workers", workers), bool(insist), progress), "sweep")

    if output is not None:
        return run(_path("output", output))
    if point is not None or _native.is_optimization(path):
        return run(None)
    with tempfile.TemporaryDirectory(prefix="whirl_twin_") as folder:
        return run(os.path.join(folder, "results"))


def fit(study: Path, *, output: Path | None = None, validate_only: bool = False, check: bool = False,
        lcm_prefix: str = "TWIN_", progress: Callable[[float], object] | None = None) -> Result:
    """Identifies parameters of a system from measured runs, as the study (YAML) says.

    output: path for the scene with the values found. validate_only: only the starts of the windows are fitted.
    check: nothing is fitted, anomalies of the runs are reported.

    ``to_dataframe()`` has the parameters with their intervals, ``plot(RUN)`` draws a run and its prediction. Raises
    InputError for an invalid study, scene or run, RunError where no fit can be computed; ``ok`` is False where the
    fit has not converged.
    """
    return Result(_native.fit(_path("study", study), None if output is None else _path("output", output),
                              bool(validate_only), bool(check), text("lcm_prefix", lcm_prefix), progress), "fit")
