"""A sketch of a system, to scale: plane ones from the front, spatial ones from slightly above."""

from __future__ import annotations

from typing import List, Tuple

import numpy as np

from . import style
from .request import RequestError
from .sketch_parts import PartDrawing, View
from .style import PX
from .ticks import linear_ticks

_WIDEST, _HIGHEST = 800.0, 620.0  # px
_MARGIN = 24.0  # px
_FOOT = 34.0  # px, of the scale bar and the note
_GHOST = 0.72  # share of white
_FARTHEST = 1.0e100  # m


def draw_sketch(picture: dict, ax=None):
    """A figure with the sketch; with `ax` on these axes, whose coordinates are then m."""
    sketch = picture["sketch"]
    view = View(0.35, 0.30) if sketch["spatial"] else View(0.0, 0.0)
    low, high = _bounds(picture, view)
    width, height = np.maximum(high - low, 1.0e-9)
    if ax is None:
        sheet, ax, scale = _sheet(picture, low, high, width, height)
    else:
        sheet = None
        ax.set_aspect("equal", adjustable="datalim")
        ax.set_axis_off()
        size = style.size_of(ax)
        scale = min(size[0] / width, size[1] / height) * 0.94
        middle = 0.5 * (low + high)
        half = 0.5 * np.array(size) / scale
        ax.set_xlim(middle[0] - half[0], middle[0] + half[0])
        ax.set_ylim(middle[1] - half[1], middle[1] + half[1])
        if picture["title"]:
            style.add_axes_title(ax, picture["title"], 6.0)
    drawing = PartDrawing(ax, view, scale)
    for ghost in reversed(picture["ghosts"]):
        drawing.draw(ghost, _GHOST)
    drawing.draw(sketch, 0.0)
    for path in [picture["trace"]] + picture["orbits"]:
        if len(path):
            ax.plot(*view.at(path).T, color=style.paler(style.VERMILION, 0.15),
                    linewidth=1.4 * PX, zorder=drawing.next_order(), solid_capstyle="round")
    return ax.figure if sheet is None else sheet


def _bounds(picture: dict, view: View) -> Tuple[np.ndarray, np.ndarray]:
    spots: List[np.ndarray] = []
    for sketch in [picture["sketch"]] + picture["ghosts"]:
        spots += view.extent(sketch)
    spots += [view.at(path) for path in [picture["trace"]] + picture["orbits"] if len(path)]
    if not spots:
        raise RequestError("figure.sketch: one part or more is required, found none")
    every = np.concatenate(spots)
    if not (np.abs(every) <= _FARTHEST).all():
        raise RequestError(
            f"figure.sketch: positions within {_FARTHEST:g} m are required, found others")
    return every.min(axis=0), every.max(axis=0)


def scale_bar(width: float) -> Tuple[float, str]:
    """Length [m] of the scale bar, a third of a picture at most, and its label."""
    ticks = linear_ticks(0.0, width / 3.0, 3)
    length = 0.5 * ticks[1] if ticks[1] > width / 3.0 else ticks[1]
    return length, f"{1000.0 * length:g} mm" if length < 0.01 else f"{length:g} m"


def _sheet(picture: dict, low: np.ndarray, high: np.ndarray, width: float, height: float) -> Tuple:
    top = max(style.title_space(picture["title"], _WIDEST), 18.0) + 0.25 * _MARGIN
    scale = min((_WIDEST - 2.0 * _MARGIN) / width,
                (_HIGHEST - top - 0.5 * _MARGIN - _FOOT) / height)
    note_width = style.text_width(picture["note"], style.TICK)
    needed = 2.0 * _MARGIN + max(
        style.text_width(picture["title"], style.TITLE, True), note_width + 180.0)
    sheet_width = min(max(scale * width + 2.0 * _MARGIN, 0.5 * _WIDEST, needed), _WIDEST)
    length, label = scale_bar(sheet_width / scale)
    bar_end = _MARGIN + scale * length
    # A long note goes below the scale bar.
    space = sheet_width - bar_end - style.text_width(label, style.TICK) - 2.0 * _MARGIN - 20.0
    below = note_width > space
    note, size = style.fitted(picture["note"], style.TICK,
                              sheet_width - 2.0 * _MARGIN if below else space)
    foot = _FOOT + (style.height_of(note, size) + 4.0 if below else 0.0)
    plot_height = scale * height
    sheet_height = top + plot_height + 0.5 * _MARGIN + foot
    sheet = style.sheet(round(sheet_width), round(sheet_height), picture)
    ax = style.add_axes(sheet, 0.0, 0.0, round(sheet_width), round(sheet_height))
    ax.set_zorder(-1)
    ax.set_axis_off()
    ax.set_aspect("equal", adjustable="datalim")
    # Data coordinates of the whole sheet [m].
    left = 0.5 * (low[0] + high[0]) - 0.5 * round(sheet_width) / scale
    upper = high[1] + top / scale
    ax.set_xlim(left, left + round(sheet_width) / scale)
    ax.set_ylim(upper - round(sheet_height) / scale, upper)
    y = top + plot_height + 0.5 * _MARGIN + 16.0
    _draw_bar(ax, left, upper, scale, y, length)
    style.add_text(sheet, bar_end + 9.0, y, label, style.TICK)
    if below:
        style.add_text(sheet, _MARGIN, y + 14.0, note, size, va="top")
    elif note:
        style.add_text(sheet, sheet_width - _MARGIN, y, note, size, ha="right")
    return sheet, ax, scale


def _draw_bar(ax, left: float, upper: float, scale: float, y: float, length: float) -> None:
    """A line with a stop at either end; its data are m."""
    start, level, stop = left + _MARGIN / scale, upper - y / scale, 4.0 / scale
    xs = [start, start, start, start + length, start + length, start + length]
    ys = [level - stop, level + stop, level, level, level + stop, level - stop]
    ax.plot(xs, ys, color=style.GREY, linewidth=1.5 * PX, gid="scale_bar")
