"""A quantity over two others, known on a grid: a colour for each value, and contour lines."""

from __future__ import annotations

import math
from typing import Tuple

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from . import style
from .request import RequestError
from .style import PX
from .ticks import (LINEAR, Ticks, data_range, labels_of, linear_ticks, most_across, set_axis,
                    shown, ticks_of)

_WIDTH, _HEIGHT = 800.0, 560.0  # px
_CONTOUR_DASHES = ((), (7.0, 4.0), (2.5, 3.0), (9.0, 3.0, 2.0, 3.0))
HOLE_NAME = "failed or undefined"


def _levels(chart: dict, way: str) -> np.ndarray:
    levels = shown(chart[way + "_levels"], chart[way]["logarithmic"])
    if len(levels) < 2 or not (np.diff(levels) > 0.0).all():
        raise RequestError(
            f"figure.{way}_levels: two or more increasing numbers are required, found "
            f"{len(levels)} that are not")
    return levels


def edges(levels: np.ndarray, logarithmic: bool) -> np.ndarray:
    """Boundaries of the cells along an axis: half-way between the levels, and the outer levels."""
    at = np.log(levels) if logarithmic else levels
    middles = at[:-1] + 0.5 * np.diff(at)
    return np.concatenate(([levels[0]], np.exp(middles) if logarithmic else middles, [levels[-1]]))


def draw_map(chart: dict, ax=None):
    """A figure with the map and its scale of colours; with `ax` on these axes."""
    x, y = _levels(chart, "x"), _levels(chart, "y")
    if len(chart["values"]) != len(y) or any(len(row) != len(x) for row in chart["values"]):
        raise RequestError(
            f"figure.values: {len(y)} rows of {len(x)} numbers are required, found rows of "
            f"{sorted({len(row) for row in chart['values']})}: {len(chart['values'])}")
    values = np.ma.masked_invalid(shown(np.array(chart["values"]), False))
    low, high = data_range([np.asarray(values.filled(np.nan)).ravel()], False)
    ticks = linear_ticks(low, high, 9)
    limits = (ticks[0], ticks[-1])
    handles = [
        Line2D([], [], color="white", linewidth=2.2 * PX, path_effects=_under(),
               linestyle=style.dash_of(list(_CONTOUR_DASHES[i % len(_CONTOUR_DASHES)])))
        for i in range(len(chart["contours"]))
    ]
    names = [contour["label"] for contour in chart["contours"]]
    if np.ma.is_masked(values):
        handles.append(Patch(facecolor=style.HOLE, edgecolor=style.GREY, linewidth=0.6))
        names.append(HOLE_NAME)
    bar_ax = None
    if ax is not None:
        rows = style.legend_rows(names, style.size_of(ax)[0])
        style.add_axes_title(ax, chart["title"], style.LEGEND_ROW * rows + 12.0)
    else:
        sheet, ax, bar_ax = _sheet(chart, y, names)
    _set_axes(ax, chart, x, y)
    # As pixels in an SVG too: ten thousand cells as paths are a megabyte.
    mesh = ax.pcolormesh(
        edges(x, chart["x"]["logarithmic"]), edges(y, chart["y"]["logarithmic"]), values,
        cmap="viridis", vmin=limits[0], vmax=limits[1], rasterized=True, zorder=0.5)
    ax.set_facecolor(style.HOLE)
    _draw_contours(ax, chart, x, y, values)
    bar = ax.figure.colorbar(mesh, cax=bar_ax, ax=None if bar_ax is not None else ax)
    _set_bar(bar, chart, limits)
    if names:
        style.add_legend(ax, handles, names, style.size_of(ax)[0], 8.0)
    return ax.figure


def _under():
    """White lines have a black border: they are seen on every colour."""
    from matplotlib.patheffects import Normal, Stroke

    return [Stroke(linewidth=4.0 * PX, foreground=style.BLACK), Normal()]


def _sheet(chart: dict, y: np.ndarray, names: list) -> Tuple:
    labels, _ = labels_of(chart["y"], ticks_of(chart["y"], float(y[0]), float(y[-1]), 10, True))
    widest = max((style.text_width(label, style.TICK) for label in labels), default=0.0)
    label, size = style.fitted(chart["y"]["label"], style.LABEL, _HEIGHT - 60.0)
    left = 24.0 + style.height_of(label, size) + widest
    width = _WIDTH - 130.0 - left
    rows = style.legend_rows(names, width)
    top = style.title_space(chart["title"], _WIDTH) + style.LEGEND_ROW * rows + 16.0
    height = _HEIGHT - 44.0 - 58.0
    sheet = style.sheet(_WIDTH, top + height + 58.0, chart)
    ax = style.add_axes(sheet, left, top, width, height)
    return sheet, ax, style.add_axes(sheet, left + width + 22.0, top, 20.0, height)


def _set_axes(ax, chart: dict, x: np.ndarray, y: np.ndarray) -> None:
    width, height = style.size_of(ax)
    for way, at, axis, length in (("x", x, ax.xaxis, width), ("y", y, ax.yaxis, height)):
        fields = chart[way]
        ends = (at[-1], at[0]) if fields["inverted"] else (at[0], at[-1])
        ax.set(**{way + "scale": "log" if fields["logarithmic"] else "linear", way + "lim": ends})
        most = (lambda a, b, f=fields: most_across(f, width, a, b)) if way == "x" else lambda a, b: 10
        set_axis(axis, fields, fields["label"], Ticks(fields, most), length + 40.0)


def _draw_contours(ax, chart: dict, x: np.ndarray, y: np.ndarray, values) -> None:
    """Contour lines, linear between the grid points; none in a cell with a hole."""
    for i, contour in enumerate(chart["contours"]):
        at = contour["at"]
        # matplotlib warns where no line exists.
        if not (math.isfinite(at) and values.count() and values.min() <= at <= values.max()):
            continue
        lines = ax.contour(
            x, y, values, levels=[at], colors="white", linewidths=2.2 * PX, zorder=3,
            linestyles=[style.dash_of(list(_CONTOUR_DASHES[i % len(_CONTOUR_DASHES)]))])
        for collection in lines.collections:
            collection.set_path_effects(_under())


def _set_bar(bar, chart: dict, limits: Tuple[float, float]) -> None:
    bar.minorticks_off()
    ticks = Ticks(LINEAR, lambda a, b: 9)
    set_axis(bar.ax.yaxis, LINEAR, chart["label"], ticks, style.size_of(bar.ax)[1] + 40.0)
    bar.outline.set_edgecolor(style.GREY)
    for contour in chart["contours"]:
        if limits[0] <= contour["at"] <= limits[1]:
            bar.ax.axhline(contour["at"], color="white", linewidth=2.2 * PX, path_effects=_under())
