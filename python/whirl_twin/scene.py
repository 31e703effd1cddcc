"""Scenes: systems, drives, sensors and controllers, read, checked and changed."""

from __future__ import annotations

import os
from typing import Any, Mapping, Union

from . import _native

SceneLike = Union["Scene", str, "os.PathLike[str]", Mapping[str, Any]]


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
        paths: list[tuple[str, Any]] = []
        for name, change in changes.items():
            paths += ([(f"{name}.{path}", value) for path, value in change.items()]
                      if isinstance(change, Mapping) else [(name, change)])
        return Scene(_native.changed_scene(self._native, paths))

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
