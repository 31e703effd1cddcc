"""Scenes: systems, drives, sensors and controllers, read, checked and changed."""

from __future__ import annotations

import os
import re
from typing import Any, Mapping, Union

from . import _native
from .errors import InputError

SceneLike = Union["Scene", str, "os.PathLike[str]", Mapping[str, Any]]

_SYSTEM_KEYS = ("model", "drive", "integrator", "tolerance", "horizon", "substeps", "parameters", "initial", "inputs",
                "count", "seed", "spread")
_STEP = re.compile(r"\.?([A-Za-z_]\w*)|\[(\d+)\]")


def shipped_scenes() -> list[str]:
    """Names of the scenes of the package, which :meth:`Scene.load` takes."""
    return _native.shipped_scenes()


class Scene:
    """A valid scene. It does not change; :meth:`with_` makes a changed one."""

    def __init__(self, native: _native.Scene):
        self._native = native

    @classmethod
    def load(cls, scene: SceneLike) -> "Scene":
        """Reads a scene.

        scene: name of a scene of the package, path of a YAML file, YAML text of several lines, or a mapping with the
            keys of such a file. Paths in a text or a mapping count from the current folder.

        Raises :class:`SceneError`, with all errors of the scene, and TypeError.
        """
        if isinstance(scene, Scene):
            return scene
        if isinstance(scene, Mapping):
            return cls(_native.scene_of_tree(scene, "scene"))
        if isinstance(scene, str) and "\n" in scene:
            return cls(_native.scene_of_text(scene, "scene"))
        if isinstance(scene, (str, os.PathLike)):
            path = os.fspath(scene)
            if isinstance(path, str):
                return cls(_native.scene_of_file(_native.scene_path(path)))
        raise TypeError(f"scene: must be a name, a path, YAML text or a mapping, found {type(scene).__name__}")

    @property
    def name(self) -> str:
        return self._native.name

    @property
    def source(self) -> str:
        """Path of its file, or "scene"; messages begin with it."""
        return self._native.source

    @property
    def step(self) -> float:
        """The fixed step [s]."""
        return self._native.step

    @property
    def systems(self) -> dict[str, str]:
        """The model of each system, by its name."""
        return self._native.systems

    def to_dict(self) -> dict[str, Any]:
        """The scene as read: numbers, text with units, lists and dicts; for :meth:`load`."""
        return self._native.to_dict()

    def to_yaml(self) -> str:
        """The scene as a YAML text; for :meth:`load`, or a file."""
        return self._native.to_yaml()

    def with_(self, **changes: Any) -> "Scene":
        """A changed copy.

        changes: for the name of a system, drive, sensor or controller a mapping of paths to values; for a key of the
            scene (step, time, gravity, name) its value. A path begins with a key of that part, such as ``integrator``,
            ``initial.x`` or ``inputs.force_x``; of a system or a controller it may begin with a parameter:
            ``discs[0].mass``. Values are numbers in SI units, text with a unit, lists, mappings; None removes a key.

        >>> Scene.load("demo").with_(rotor={"mass": "900 g"}, step="0.5 ms").step
        0.0005

        Raises :class:`SceneError` for an invalid scene, InputError for a path that is not there.
        """
        tree = self.to_dict()
        for name, change in changes.items():
            part, where = self._part(tree, name, change)
            if part is None:
                _put(tree, name, change, self.source)
                continue
            if not isinstance(change, Mapping):
                raise TypeError(f"{name}: must be a mapping of paths to values, found {type(change).__name__}")
            for path, value in change.items():
                if not isinstance(path, str):
                    raise TypeError(f"{name}: paths must be text, found {type(path).__name__}")
                first = re.split(r"[.\[]", path, 1)[0]
                known = _SYSTEM_KEYS if where == "systems" else (*part, "type", "sample", "delay")
                if where == "systems" and first not in known:
                    part.setdefault("parameters", {})
                    _put(part["parameters"], path, value, f"{self.source}: {where}.{name}.parameters")
                elif where == "controllers" and first not in known and isinstance(part.get("parameters"), dict):
                    _put(part["parameters"], path, value, f"{self.source}: {where}.{name}.parameters")
                else:
                    _put(part, path, value, f"{self.source}: {where}.{name}")
        return Scene(_native.scene_of_tree(tree, self.source))

    @staticmethod
    def _part(tree: dict[str, Any], name: str, change: Any):
        """The part of the scene of this name, and the key that it is in; None: a key of the scene itself."""
        if isinstance(change, Mapping) or name not in ("name", "step", "time", "gravity"):
            for where in ("systems", "drives", "controllers", "sensors"):
                if isinstance(tree.get(where), dict) and name in tree[where]:
                    return tree[where][name], where
        if name in ("name", "step", "time", "gravity"):
            return None, ""
        names = [each for where in ("systems", "drives", "controllers", "sensors") for each in tree.get(where) or {}]
        raise InputError(f"{name}: must be the name of a system, drive, sensor or controller "
                         f"({', '.join(names)}), or step, time, gravity or name")

    def __repr__(self) -> str:
        systems = ", ".join(f"{name}: {model}" for name, model in self.systems.items())
        return f"<Scene {self.name} ({systems})>"

    def _repr_html_(self) -> str:
        from .results import preformatted
        return preformatted(self.to_yaml())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self.to_dict() == other.to_dict()

    def __hash__(self) -> int:
        return hash(self.to_yaml())

    def __reduce__(self):
        return (_scene_of, (self.to_dict(), self.source))


def _scene_of(tree: dict[str, Any], source: str) -> Scene:
    return Scene(_native.scene_of_tree(tree, source))


def _put(tree: Any, path: str, value: Any, where: str) -> None:
    """Sets the value at a path, "discs[0].mass"; None removes a key."""
    steps: list[str | int] = []
    at = 0
    while at < len(path):
        step = _STEP.match(path, at)
        if not step:
            raise InputError(f"{where}: must be a path such as discs[0].mass, found '{path}'")
        steps.append(step[1] if step[1] is not None else int(step[2]))
        at = step.end()
    if not steps:
        raise InputError(f"{where}: must be a path such as discs[0].mass, found ''")
    for step, following in zip(steps, steps[1:]):
        tree = _inner(tree, step, following, path, where)
    last = steps[-1]
    if isinstance(last, int):
        _require_place(tree, last, path, where)
        tree[last] = value
    elif not isinstance(tree, dict):
        raise InputError(f"{where}.{path}: must be a key of a map, found none")
    elif value is None:
        tree.pop(last, None)
    else:
        tree[last] = value


def _inner(tree: Any, step: str | int, following: str | int, path: str, where: str) -> Any:
    if isinstance(step, int):
        _require_place(tree, step, path, where)
        return tree[step]
    if not isinstance(tree, dict):
        raise InputError(f"{where}.{path}: must be a key of a map, found none")
    if step not in tree and not isinstance(following, int):
        tree[step] = {}
    if step not in tree:
        raise InputError(f"{where}.{step}: must be a list to change '{path}' in, found none")
    return tree[step]


def _require_place(tree: Any, index: int, path: str, where: str) -> None:
    if not isinstance(tree, list) or index >= len(tree):
        entries = len(tree) if isinstance(tree, list) else 0
        raise InputError(f"{where}.{path}: must be an entry of a list, found {entries} entries")
