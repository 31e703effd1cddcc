"""Figures and pages of whirl_twin: from plain dictionaries to SVG, PNG, PDF and HTML.

A figure is a dictionary with the key ``kind``: ``charts``, ``bars``, ``map`` or ``sketch``; a page
holds texts, tables and figures. Their fields are in ``request.py``. matplotlib and Jinja2 are
imported by the first call that needs them, so that importing this package costs nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Mapping, Optional

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

from . import request
from .request import MissingLibrary, RequestError

__all__ = ["MissingLibrary", "RequestError", "draw", "overlaid", "page_html", "save"]

FORMATS = ("svg", "png", "pdf")


def draw(figure: Mapping[str, Any], ax: Optional["Axes"] = None) -> "Figure":
    """Draw a figure.

    With ``ax``, axes of the caller, the first chart is drawn on them and their figure is returned;
    titles, sizes and columns of the figure do not apply. Without, a new figure, 100 px per inch,
    not registered with pyplot.

    Raises RequestError if a field is missing or wrong, MissingLibrary without matplotlib.
    """
    return _drawn(request.figure(figure, "figure"), ax)


def _drawn(checked: Mapping[str, Any], ax: Optional["Axes"] = None) -> "Figure":
    """The figure of fields that are checked."""
    try:
        from . import style
    except ImportError as error:
        raise MissingLibrary.of(error) from error
    with style.context():
        if checked["kind"] == "charts":
            from .charts import draw_charts as drawn
        elif checked["kind"] == "bars":
            from .bars import draw_bars as drawn
        elif checked["kind"] == "map":
            from .maps import draw_map as drawn
        else:
            from .sketches import draw_sketch as drawn
        return drawn(checked, ax)


def overlaid(figures: Mapping[str, Mapping[str, Any]]) -> Mapping[str, Any]:
    """One figure with the curves of several, by name, over each other: all are of kind ``charts``.

    Curves of the first are drawn as they are, those of the others in dashes. Reference lines, bands
    and notes are those of the first. Raises RequestError unless all have the same axes.
    """
    from .overlay import overlaid as made

    return made(figures)


def save(figure: Mapping[str, Any], path: str, format: str) -> None:
    """Draw a figure and write it: ``format`` is ``svg``, ``png`` (144 px per inch) or ``pdf``.

    The same figure gives the same bytes. Raises as draw(), and OSError if the file cannot be
    written.
    """
    if format not in FORMATS:
        raise RequestError(f"format: one of {', '.join(FORMATS)} is required, found {format!r}")
    checked = request.figure(figure, "figure")
    try:
        from . import output, style
    except ImportError as error:
        raise MissingLibrary.of(error) from error
    with style.context():
        contents = output.image(_drawn(checked), format)
    with open(path, "wb") as file:
        file.write(contents)


def page_html(page: Mapping[str, Any]) -> str:
    """An HTML page with its figures inside, as SVG: it needs no network and no script.

    Raises RequestError, MissingLibrary without Jinja2 or (with figures) without matplotlib.
    """
    checked = request.checked(request.PAGE, page, "page")
    try:
        from .pages import html
    except ImportError as error:
        raise MissingLibrary.of(error) from error
    return html(checked)
