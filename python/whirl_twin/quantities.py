"""Arguments: numbers in SI units, or text with a unit."""

from __future__ import annotations

import numbers
from typing import Any, Union

from . import _native

Quantity = Union[float, str]


def quantity(name: str, value: Any, unit: str) -> float | None:
    """The value in this unit; None stays. Raises InputError and TypeError that name the argument."""
    return None if value is None else _native.quantity(name, value, unit)


def seconds(name: str, value: Any) -> str | None:
    """Seconds as the command reads them, exact to the last digit: "0.001"."""
    if value is None:
        return None
    if isinstance(value, str):
        try:
            float(value)
            return value
        except ValueError:
            return repr(_native.quantity(name, value, "s"))
    if isinstance(value, numbers.Integral) and not isinstance(value, bool):
        return str(int(value))
    return repr(_native.quantity(name, value, "s"))


def whole(name: str, value: Any) -> int:
    """A whole number of at most nine digits."""
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise TypeError(f"{name}: must be a whole number, found {type(value).__name__}")
    if not -10**9 < value < 10**9:
        from .errors import InputError
        raise InputError(f"{name}: must be a whole number below 1e9, found {value}")
    return int(value)


def text(name: str, value: Any) -> str | None:
    """Text; None stays."""
    if value is not None and not isinstance(value, str):
        raise TypeError(f"{name}: must be text, found {type(value).__name__}")
    return value


def listed(value: Any) -> list:
    """A list of one, or of all."""
    return [value] if isinstance(value, (str, bytes, numbers.Number)) else list(value)
