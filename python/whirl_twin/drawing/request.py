"""Fields of figures and pages: their types, defaults and checks.

A check returns a copy with all defaults filled in, lists of numbers as NumPy arrays (null: NaN)
and texts without characters that XML forbids. An error names the field: "figure.charts[0].x: ...".
"""

from __future__ import annotations

import re
from typing import Any, Callable, Dict, Mapping, Optional

Check = Callable[[Any, str], Any]
REQUIRED = object()


class RequestError(ValueError):
    """A field of a request is missing or wrong."""


class MissingLibrary(RuntimeError):
    """matplotlib or Jinja2 is not installed."""

    @classmethod
    def of(cls, error: ImportError) -> "MissingLibrary":
        """With the command that installs it."""
        if (error.name or "").split(".")[0] in ("jinja2", "markupsafe"):
            return cls("pages need python3-jinja2: sudo apt-get install python3-jinja2")
        if (error.name or "").split(".")[0] in ("matplotlib", "numpy", "PIL"):
            return cls("figures need python3-matplotlib: sudo apt-get install python3-matplotlib")
        return cls(f"figures need a library that cannot be loaded: {error}")


# Control characters, lone surrogates and noncharacters are not allowed in XML.
_FORBIDDEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")


def found(value: Any) -> str:
    """A short text of what was found."""
    text = repr(value)
    return "nothing" if value is None else text if len(text) <= 60 else text[:57] + "..."


def text(value: Any, where: str) -> str:
    if not isinstance(value, str):
        raise RequestError(f"{where}: a text is required, found {found(value)}")
    return _FORBIDDEN.sub(" ", value.replace("\r\n", "\n").replace("\t", " "))


def boolean(value: Any, where: str) -> bool:
    if value is not True and value is not False:
        raise RequestError(f"{where}: true or false is required, found {found(value)}")
    return value


def number_or_gap(value: Any, where: str) -> float:
    """A number; null: NaN."""
    if value is None:
        return float("nan")
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise RequestError(f"{where}: a number is required, found {found(value)}")
    try:
        return float(value)
    except OverflowError:
        return float("inf") if value > 0 else float("-inf")


def number(value: Any, where: str) -> float:
    """A finite number."""
    result = number_or_gap(value, where)
    if not abs(result) < float("inf"):
        raise RequestError(f"{where}: a finite number is required, found {found(value)}")
    return result


def number_from(low: float, high: float) -> Check:
    def check(value: Any, where: str) -> float:
        result = number(value, where)
        if not low <= result <= high:
            raise RequestError(
                f"{where}: a number from {low:g} to {high:g} is required, found {found(value)}"
            )
        return result

    return check


def whole(low: int, high: int) -> Check:
    def check(value: Any, where: str) -> int:
        result = number_from(low, high)(value, where)
        if result != int(result):
            raise RequestError(f"{where}: a whole number is required, found {found(value)}")
        return int(result)

    return check


def color(value: Any, where: str) -> str:
    if not isinstance(value, str) or not re.fullmatch("#[0-9a-fA-F]{6}", value):
        raise RequestError(f"{where}: a colour as #rrggbb is required, found {found(value)}")
    return value.lower()


def one_of(*values: str) -> Check:
    def check(value: Any, where: str) -> str:
        if value not in values:
            raise RequestError(
                f"{where}: one of {', '.join(values)} is required, found {found(value)}"
            )
        return value

    return check


def optional(check: Check) -> Check:
    return lambda value, where: None if value is None else check(value, where)


def list_of(check: Check) -> Check:
    def checked(value: Any, where: str) -> list:
        if not isinstance(value, (list, tuple)):
            raise RequestError(f"{where}: a list is required, found {found(value)}")
        return [check(item, f"{where}[{i}]") for i, item in enumerate(value)]

    return checked


def numbers(value: Any, where: str) -> Any:
    """A list or an array of numbers as a NumPy array; null: NaN."""
    try:
        import numpy
    except ImportError as error:
        raise MissingLibrary.of(error) from error
    if isinstance(value, numpy.ndarray):
        if value.ndim != 1 or value.dtype.kind not in "fiu":
            raise RequestError(f"{where}: a row of numbers is required, found {found(value)}")
        return value.astype(float)
    if not isinstance(value, (list, tuple)):
        raise RequestError(f"{where}: a list of numbers is required, found {found(value)}")
    if set(map(type, value)) <= {float, type(None)}:
        return numpy.array(value, dtype=float)
    return numpy.array([number_or_gap(x, f"{where}[{i}]") for i, x in enumerate(value)])


def point(value: Any, where: str) -> Any:
    """x, y, z as an array."""
    result = numbers(value, where)
    if len(result) != 3:
        raise RequestError(f"{where}: three numbers (m) are required, found {found(value)}")
    return result


def points(value: Any, where: str) -> Any:
    """An array of shape (n, 3)."""
    import numpy

    return numpy.array(list_of(point)(value, where)).reshape(-1, 3)


def record(fields: Mapping[str, Any]) -> Check:
    """A dictionary; of each field its check, or the check and a default."""

    def check(value: Any, where: str) -> Dict[str, Any]:
        if not isinstance(value, Mapping):
            raise RequestError(f"{where}: a set of fields is required, found {found(value)}")
        for name in value:
            if name not in fields:
                raise RequestError(
                    f"{where}: one of the fields {', '.join(fields)} is required, "
                    f"found {found(name)}"
                )
        result = {}
        for name, field in fields.items():
            of_field, default = field if isinstance(field, tuple) else (field, REQUIRED)
            if name not in value and default is REQUIRED:
                raise RequestError(f"{where}.{name}: a value is required, found nothing")
            # Defaults are checked too: they become what a given value becomes.
            result[name] = of_field(value.get(name, default), f"{where}.{name}")
        return result

    return check


_TEXT = (text, "")
_NO = (boolean, False)

AXIS = record({
    "label": _TEXT, "logarithmic": _NO, "tight": _NO, "degrees": _NO, "inverted": _NO,
    "second": (optional(record({"label": _TEXT, "factor": number})), None),
})
_AXIS = (AXIS, {})
_PEN = record({
    "color": color, "width": (number_from(0.1, 100.0), 1.0),
    "dash": (list_of(number_from(0.0, 1000.0)), []),
})
_REFERENCES = (list_of(record({"at": number_or_gap, "label": _TEXT})), [])


def _series(value: Any, where: str) -> Dict[str, Any]:
    result = _SERIES(value, where)
    if len(result["x"]) != len(result["y"]):
        raise RequestError(
            f"{where}: x and y of equal length are required, found {len(result['x'])} and "
            f"{len(result['y'])}"
        )
    return result


_SERIES = record({
    "name": _TEXT, "x": numbers, "y": numbers, "pen": (optional(_PEN), None),
    "line": (boolean, True), "marks": (one_of("none", "dots", "rings"), "none"),
    "fill": (optional(color), None),
})
CHART = record({
    "title": _TEXT, "x": _AXIS, "y": _AXIS, "series": (list_of(_series), []),
    "vertical": _REFERENCES, "horizontal": _REFERENCES,
    "bands": (list_of(record(
        {"name": _TEXT, "low": number_or_gap, "high": number_or_gap, "color": color})), []),
    "notes": (list_of(record({"x": number_or_gap, "y": number_or_gap, "text": _TEXT})), []),
    "equal_aspect": _NO,
})
_POSITIVE = (number_or_gap, 0.0)
_ROLE = (one_of("body", "mass", "support", "spring", "mark"), "body")
SKETCH = record({
    "rods": (list_of(record({"from": point, "to": point, "radius": _POSITIVE, "role": _ROLE})), []),
    "balls": (list_of(record({"at": point, "radius": _POSITIVE, "role": _ROLE})), []),
    "discs": (list_of(record({
        "at": point, "axis": point, "radius": _POSITIVE, "thickness": _POSITIVE,
        "angle": _POSITIVE, "role": _ROLE})), []),
    "boxes": (list_of(record({"at": point, "size": point, "pitch": _POSITIVE, "role": _ROLE})), []),
    "springs": (list_of(record({"from": point, "to": point, "radius": _POSITIVE})), []),
    "dampers": (list_of(record({"from": point, "to": point, "radius": _POSITIVE})), []),
    "arrows": (list_of(record({"from": point, "to": point})), []),
    "lines": (list_of(record({"points": points, "role": _ROLE})), []),
    "size": (number_or_gap, 1.0), "height": _POSITIVE, "centre": (point, (0.0, 0.0, 0.0)),
    "spatial": _NO,
})
_BAR = record({
    "value": number_or_gap, "low": (number_or_gap, None), "high": (number_or_gap, None),
})
_SHEET = {"kind": text, "title": _TEXT, "description": _TEXT}
FIGURES = {
    "charts": record({
        **_SHEET, "columns": (whole(1, 12), 1), "width": (whole(200, 5000), 800),
        "chart_height": (whole(120, 5000), 460), "charts": list_of(CHART)}),
    "bars": record({
        **_SHEET, "subtitle": _TEXT, "x": _AXIS, "names": (list_of(text), []),
        "groups": list_of(record({"name": _TEXT, "bars": list_of(_BAR)})),
        "base": (number, 0.0)}),
    "map": record({
        **_SHEET, "x": _AXIS, "y": _AXIS, "label": _TEXT, "x_levels": numbers, "y_levels": numbers,
        "values": list_of(numbers), "contours": _REFERENCES}),
    "sketch": record({
        **_SHEET, "sketch": SKETCH, "ghosts": (list_of(SKETCH), []), "trace": (points, []),
        "orbits": (list_of(points), []), "note": _TEXT}),
}


def checked_figure(value: Any, where: str) -> Dict[str, Any]:
    """A figure with all its fields."""
    kind = value.get("kind") if isinstance(value, Mapping) else None
    if not isinstance(kind, str) or kind not in FIGURES:
        raise RequestError(
            f"{where}.kind: one of {', '.join(FIGURES)} is required, found {found(kind)}"
        )
    return FIGURES[kind](value, where)


def _cell(value: Any, where: str) -> Dict[str, str]:
    if isinstance(value, str):
        return {"text": text(value, where), "class": ""}
    return _MARKED_CELL(value, where)


_MARKED_CELL = record({"text": text, "class": (one_of("", "danger", "warning", "info"), "")})
_TABLE = record({"head": (list_of(text), []), "rows": list_of(list_of(_cell))})
_PARTS: Dict[str, Check] = {
    "section": text, "part": text, "text": text, "list": list_of(text), "table": _TABLE,
    "figure": checked_figure,
}


def _part(value: Any, where: str) -> Dict[str, Any]:
    if not isinstance(value, Mapping) or len(value) != 1 or next(iter(value)) not in _PARTS:
        raise RequestError(
            f"{where}: one of the fields {', '.join(_PARTS)} is required, found {found(value)}"
        )
    kind, content = next(iter(value.items()))
    return {"kind": kind, "content": _PARTS[kind](content, f"{where}.{kind}")}


def _fact(value: Any, where: str) -> list:
    result = list_of(text)(value, where)
    if len(result) != 2:
        raise RequestError(f"{where}: a name and a value are required, found {found(value)}")
    return result


_PAGE = record({
    "title": text, "summary": (list_of(text), []), "facts": (list_of(_fact), []),
    "parts": (list_of(_part), []),
})


def checked_page(value: Any, where: str) -> Dict[str, Any]:
    """A page with all its fields; its parts as {"kind", "content"}."""
    return _PAGE(value, where)


def checked_drawing(value: Any, where: str) -> Dict[str, Any]:
    """One entry of a request: where its file goes, its format, and its figure or page.

    What it holds stays as it is: draw() and page_html() check it.
    """
    kind: Optional[str] = value.get("format") if isinstance(value, Mapping) else None
    one_of("svg", "png", "pdf", "html")(kind, f"{where}.format")
    held = "page" if kind == "html" else "figure"
    return record({"path": text, "format": text, held: lambda content, _: content})(value, where)
