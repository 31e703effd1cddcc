"""Horizontal bars from a base line, one group per name; sorted by weight a tornado chart."""

from __future__ import annotations

import math

from matplotlib.patches import Patch

from . import style
from .style import PX
from .ticks import Ticks, data_range, most_across, set_axis, ticks_of

_WIDTH = 800.0  # px
_BAR = 15.0  # px, with the space between bars
_GAP = 12.0  # px, between groups
_FOOT = 56.0  # px
_COLORS = (style.BLUE, style.SKY_BLUE, style.ORANGE, style.GREEN, style.PURPLE, style.VERMILION)


def _has_interval(bar: dict) -> bool:
    return all(math.isfinite(bar[key]) for key in ("value", "low", "high"))


def draw_bars(chart: dict, ax=None):
    """A figure with the bars; with `ax` on these axes."""
    import numpy as np

    count = max([len(chart["names"])] + [len(group["bars"]) for group in chart["groups"]] + [1])
    step = _BAR * count + _GAP
    height = step * max(len(chart["groups"]), 1)
    names = chart["names"] if len(chart["names"]) > 1 else []
    sheet = None
    if ax is None:
        sheet, ax = _sheet(chart, names, height)
    width = style.size_of(ax)[0]
    reached = [chart["base"]]
    for group in chart["groups"]:
        for bar in group["bars"]:
            reached.append(bar["value"])
            if _has_interval(bar):
                reached += [bar["low"], bar["high"]]
    fields = {**chart["x"], "logarithmic": False}
    low, high = data_range([np.array(reached)], False)
    if not fields["tight"]:
        ticks = ticks_of(fields, low, high, most_across(fields, width, low, high, inside=False))
        low, high = ticks[0], ticks[-1]
    _set_axes(ax, chart, fields, low, high, width)
    ax.set_ylim(height, 0.0)
    centres = []
    for i, group in enumerate(chart["groups"]):
        top = 0.5 * _GAP + step * i
        centres.append(top + 0.5 * _BAR * count)
        for k, bar in enumerate(group["bars"]):
            _draw_bar(ax, chart["base"], bar, top + _BAR * (k + 0.5), _COLORS[k % len(_COLORS)])
    ax.set_yticks(centres, [_name(group, sheet is not None) for group in chart["groups"]])
    ax.tick_params(axis="y", length=0.0, pad=7.0 * PX, labelsize=style.TICK * PX)
    ax.axvline(chart["base"], color=style.BLACK, linewidth=1.4 * PX, zorder=4)
    if names:
        handles = [Patch(facecolor=color, edgecolor=style.darker(color, 0.3), linewidth=0.8 * PX)
                   for color in (_COLORS[k % len(_COLORS)] for k in range(len(names)))]
        style.add_legend(ax, handles, names, width, 7.0)
    if sheet is None:
        style.add_axes_title(
            ax, chart["title"], style.LEGEND_ROW * style.legend_rows(names, width) + 12.0)
    return ax.figure if sheet is None else sheet


def _name(group: dict, own: bool) -> str:
    return style.fitted(group["name"], style.TICK, 0.45 * _WIDTH)[0] if own else group["name"]


def _sheet(chart: dict, names: list, height: float):
    """A figure whose height follows from the number of bars, and its axes."""
    widest = max((style.text_width(_name(group, True), style.TICK) for group in chart["groups"]),
                 default=0.0)
    left = 22.0 + widest
    width = _WIDTH - 30.0 - left
    top = style.title_space(chart["title"], _WIDTH)
    subtitle, size = style.fitted(chart["subtitle"], style.TICK, _WIDTH - 20.0)
    subtitle_height = 4.0 + style.height_of(subtitle, size) if subtitle else 0.0
    rows = style.legend_rows(names, width)
    plot_top = top + subtitle_height + style.LEGEND_ROW * rows + 8.0
    sheet = style.sheet(_WIDTH, plot_top + height + _FOOT, chart)
    if subtitle:
        style.add_text(sheet, 0.5 * _WIDTH, top - 4.0, subtitle, size, ha="center", va="top")
    return sheet, style.add_axes(sheet, left, plot_top, width, height)


def _set_axes(ax, chart: dict, fields: dict, low: float, high: float, width: float) -> None:
    ax.set_xlim((high, low) if fields["inverted"] else (low, high))
    ticks = Ticks(fields, lambda a, b: most_across(fields, width, a, b))
    set_axis(ax.xaxis, fields, chart["x"]["label"], ticks, width + 40.0)
    ax.grid(True, axis="x")
    for side in ("top", "right", "left"):
        ax.spines[side].set_visible(False)


def _draw_bar(ax, base: float, bar: dict, y: float, color: str) -> None:
    if not math.isfinite(bar["value"]):
        return
    ax.barh(y, bar["value"] - base, height=12.0, left=base, color=color,
            edgecolor=style.darker(color, 0.3), linewidth=0.8 * PX, zorder=2)
    if _has_interval(bar):
        ax.plot([bar["low"], bar["high"]], [y, y], color=style.BLACK, linewidth=1.4 * PX,
                marker="|", markersize=8.0 * PX, markeredgewidth=1.4 * PX, zorder=3,
                solid_capstyle="butt")
