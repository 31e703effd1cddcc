"""The exceptions of the package. Their text is that of the command line."""

from __future__ import annotations

import re
from typing import NamedTuple


class WhirlTwinError(Exception):
    """Base of all exceptions of this package."""


class InputError(WhirlTwinError, ValueError):
    """An input is invalid: the text names the place, what is required, with its unit, and what was found."""


class RunError(WhirlTwinError, RuntimeError):
    """The input is valid, but the operation failed."""


class Problem(NamedTuple):
    """One error of a scene."""

    path: str
    """Key of the scene, such as ``systems.rotor.parameters.mass``; empty: the whole file."""
    expected: str
    """What is required there, with its unit."""
    found: str
    """What was found; empty: it is missing."""
    text: str
    """The whole message."""


_KEY = re.compile(r"^[\w.\[\]-]+$")


def _problem(text: str) -> Problem:
    """The parts of a message "source: key: what is required, found what"."""
    parts = text.split(": ")
    at = next((i for i, part in enumerate(parts[1:], 1) if _KEY.match(part)), 0)
    path = parts[at] if at else ""
    message = ": ".join(parts[at + 1:])
    expected, _, found = message.partition(", found ")
    found = re.sub(r"^'(.*)'$", r"\1", found)
    return Problem(path, re.sub(r"^(missing; )?(must be|must have|expected) ", "", expected), found, text)


class SceneError(InputError):
    """A scene is invalid.

    ``problems`` has all its errors, each a :class:`Problem`; ``str()`` has one line for each.
    """

    def __init__(self, errors: list[str] | str):
        self.errors = [errors] if isinstance(errors, str) else list(errors)
        super().__init__("\n".join(self.errors))

    @property
    def problems(self) -> list[Problem]:
        """The errors of the scene, in the order of its keys."""
        return [_problem(error) for error in self.errors]

    def __reduce__(self):
        return (type(self), (self.errors,))
