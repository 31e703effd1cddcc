"""Fields of figures and pages: their types, defaults and checks.

checked() returns a copy with all defaults, lists of numbers as NumPy arrays (null: NaN) and texts
without characters that XML forbids. An error names the field: "figure.charts[0].x: ...".
"""

from __future__ import annotations

import re
from typing import Any, Callable, Dict, Mapping

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


def require(good: bool, where: str, what: str, value: Any) -> None:
    """Raises RequestError with what is required, and the value that was found."""
    if not good:
        found = "nothing" if value is None else repr(value)
        found = found if len(found) <= 60 else found[:57] + "..."
        raise RequestError(f"{where}: {what} is required, found {found}")


def checked(form: Any, value: Any, where: str) -> Any:
    """A value in a form: a check, a list of one form, or a dictionary of fields.

    Of a field that may be missing the form is a pair: form, default.
    """
    if isinstance(form, list):
        require(isinstance(value, (list, tuple)), where, "a list", value)
        return [checked(form[0], item, f"{where}[{i}]") for i, item in enumerate(value)]
    if not isinstance(form, dict):
        return form(value, where)
    require(isinstance(value, Mapping), where, "a set of fields", value)
    for name in value:
        require(name in form, where, f"one of the fields {', '.join(form)}", name)
    result = {}
    for name, field in form.items():
        of_field, default = field if isinstance(field, tuple) else (field, REQUIRED)
        given = value.get(name, default)
        require(given is not REQUIRED, f"{where}.{name}", "a value", None)
        # Defaults are checked too: they become what a given value becomes.
        result[name] = checked(of_field, given, f"{where}.{name}")
    return result


# Control characters, lone surrogates and noncharacters are not allowed in XML.
_FORBIDDEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")


def text(value: Any, where: str) -> str:
    require(isinstance(value, str), where, "a text", value)
    return _FORBIDDEN.sub(" ", value.replace("\r\n", "\n").replace("\t", " "))


def boolean(value: Any, where: str) -> bool:
    require(isinstance(value, bool), where, "true or false", value)
    return value


def number(value: Any, where: str) -> float:
    """A number; null: NaN."""
    if value is None:
        return float("nan")
    require(isinstance(value, (int, float)) and not isinstance(value, bool), where, "a number", value)
    try:
        return float(value)
    except OverflowError:
        return float("inf") if value > 0 else float("-inf")


def number_from(low: float, high: float) -> Check:
    def check(value: Any, where: str) -> float:
        result = number(value, where)
        require(low <= result <= high, where, f"a number from {low:g} to {high:g}", value)
        return result

    return check


def whole(low: int, high: int) -> Check:
    def check(value: Any, where: str) -> int:
        result = number_from(low, high)(value, where)
        require(result == int(result), where, "a whole number", value)
        return int(result)

    return check


def color(value: Any, where: str) -> str:
    good = isinstance(value, str) and re.fullmatch("#[0-9a-fA-F]{6}", value) is not None
    require(good, where, "a colour as #rrggbb", value)
    return value.lower()


def one_of(*values: str) -> Check:
    def check(value: Any, where: str) -> str:
        require(value in values, where, f"one of {', '.join(values)}", value)
        return value

    return check


def optional(form: Any) -> Check:
    return lambda value, where: None if value is None else checked(form, value, where)


def numbers(value: Any, where: str) -> Any:
    """A list or an array of numbers as a NumPy array; null: NaN."""
    try:
        import numpy
    except ImportError as error:
        raise MissingLibrary.of(error) from error
    if isinstance(value, numpy.ndarray):
        good = value.ndim == 1 and value.dtype.kind in "fiu"
        require(good, where, "a row of numbers", value)
        return value.astype(float)
    require(isinstance(value, (list, tuple)), where, "a list of numbers", value)
    if set(map(type, value)) <= {float, type(None)}:
        return numpy.array(value, dtype=float)
    return numpy.array(checked([number], value, where))


def point(value: Any, where: str) -> Any:
    """x, y, z as an array."""
    result = numbers(value, where)
    require(len(result) == 3, where, "a point of three numbers (m)", value)
    return result


def points(value: Any, where: str) -> Any:
    """An array of shape (n, 3)."""
    import numpy

    return numpy.array(checked([point], value, where)).reshape(-1, 3)


def _series(value: Any, where: str) -> Dict[str, Any]:
    result = checked(_SERIES, value, where)
    sizes = len(result["x"]), len(result["y"])
    if sizes[0] != sizes[1]:
        raise RequestError(
            f"{where}: x and y of equal length are required, found {sizes[0]} and {sizes[1]}")
    return result


_TEXT = (text, "")
_NO = (boolean, False)
_SECOND = {"label": _TEXT, "factor": number_from(-1.0e300, 1.0e300)}
_AXIS = ({"label": _TEXT, "logarithmic": _NO, "tight": _NO, "degrees": _NO, "inverted": _NO,
          "second": (optional(_SECOND), None)}, {})
_PEN = {"color": color, "width": (number_from(0.1, 100.0), 1.0),
        "dash": ([number_from(0.0, 1000.0)], [])}
_REFERENCES = ([{"at": number, "label": _TEXT}], [])
_SERIES = {
    "name": _TEXT, "x": numbers, "y": numbers, "pen": (optional(_PEN), None),
    "line": (boolean, True), "marks": (one_of("none", "dots", "rings"), "none"),
    "fill": (optional(color), None),
}
_CHART = {
    "title": _TEXT, "x": _AXIS, "y": _AXIS, "series": ([_series], []),
    "vertical": _REFERENCES, "horizontal": _REFERENCES,
    "bands": ([{"name": _TEXT, "low": number, "high": number, "color": color}], []),
    "notes": ([{"x": number, "y": number, "text": _TEXT}], []), "equal_aspect": _NO,
}
_SIZE = (number, 0.0)
_ROLE = (one_of("body", "mass", "support", "spring", "mark"), "body")
_BAR = {"from": point, "to": point, "radius": _SIZE}
_SKETCH = {
    "rods": ([{**_BAR, "role": _ROLE}], []),
    "balls": ([{"at": point, "radius": _SIZE, "role": _ROLE}], []),
    "discs": ([{"at": point, "axis": point, "radius": _SIZE, "thickness": _SIZE, "angle": _SIZE,
                "role": _ROLE}], []),
    "boxes": ([{"at": point, "size": point, "pitch": _SIZE, "role": _ROLE}], []),
    "springs": ([_BAR], []), "dampers": ([_BAR], []), "arrows": ([{"from": point, "to": point}], []),
    "lines": ([{"points": points, "role": _ROLE}], []),
    "size": (number, 1.0), "height": _SIZE, "centre": (point, (0.0, 0.0, 0.0)), "spatial": _NO,
}
_SHEET = {"kind": text, "title": _TEXT, "description": _TEXT}
_FIGURES = {
    "charts": {**_SHEET, "columns": (whole(1, 12), 1), "width": (whole(200, 5000), 800),
               "chart_height": (whole(120, 5000), 460), "charts": [_CHART]},
    "bars": {**_SHEET, "subtitle": _TEXT, "x": _AXIS, "names": ([text], []),
             "groups": [{"name": _TEXT, "bars": [
                 {"value": number, "low": (number, None), "high": (number, None)}]}],
             "base": (number_from(-1.0e300, 1.0e300), 0.0)},
    "map": {**_SHEET, "x": _AXIS, "y": _AXIS, "label": _TEXT, "x_levels": numbers,
            "y_levels": numbers, "values": [numbers], "contours": _REFERENCES},
    "sketch": {**_SHEET, "sketch": _SKETCH, "ghosts": ([_SKETCH], []), "trace": (points, []),
               "orbits": ([points], []), "note": _TEXT},
}


def figure(value: Any, where: str) -> Dict[str, Any]:
    """A figure with all its fields."""
    kind = value.get("kind") if isinstance(value, Mapping) else None
    one_of(*_FIGURES)(kind, f"{where}.kind")
    return checked(_FIGURES[kind], value, where)


def _cell(value: Any, where: str) -> Dict[str, str]:
    return checked({"text": text, "class": (one_of("", "danger", "warning", "info"), "")},
                   {"text": value} if isinstance(value, str) else value, where)


_TABLE = {"head": ([text], []), "rows": [[_cell]]}
_PARTS: Dict[str, Any] = {
    "section": text, "part": text, "text": text, "list": [text], "table": _TABLE, "figure": figure,
}


def _part(value: Any, where: str) -> Dict[str, Any]:
    good = isinstance(value, Mapping) and len(value) == 1 and next(iter(value)) in _PARTS
    require(good, where, f"one of the fields {', '.join(_PARTS)}", value)
    kind, content = next(iter(value.items()))
    return {"kind": kind, "content": checked(_PARTS[kind], content, f"{where}.{kind}")}


def _fact(value: Any, where: str) -> list:
    result = checked([text], value, where)
    require(len(result) == 2, where, "a name and a value", value)
    return result


#: A page with all its fields; its parts as {"kind", "content"}.
PAGE = {"title": text, "summary": ([text], []), "facts": ([_fact], []), "parts": ([_part], [])}


def drawing(value: Any, where: str) -> Dict[str, Any]:
    """One entry of a request: where its file goes, its format, and its figure, figures or page.

    What it holds is unchecked: draw(), overlaid() and page_html() check it.
    """
    kind = value.get("format") if isinstance(value, Mapping) else None
    one_of("svg", "png", "pdf", "html")(kind, f"{where}.format")
    content = "page" if kind == "html" else "figures" if "figures" in value else "figure"
    return checked({"path": text, "format": text, content: lambda held, _: held}, value, where)
