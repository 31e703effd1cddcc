"""Line charts in rows and columns: time histories, phase portraits, orbits, response curves."""

from __future__ import annotations

from typing import Any, Dict, List, Tuple

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon
from matplotlib.ticker import MultipleLocator

from . import style
from .labels import MARK, label_chart
from .style import PX
from .ticks import (LINEAR, Ticks, data_range, exponent_of, labels_of, most_across, scaled_label,
                    set_axis, shown, ticks_of)

_SECOND_SCALE = 44.0  # px, above a chart
_RIGHT = 22.0  # px
_FOOT = 50.0  # px, of tick labels and label below a chart
_PER_TICK = 30.0  # px, at least, along a vertical axis
_MANY_MARKS = 2000
_DENSE = 0.5  # of the area of a chart
_FREE_LEGEND_ROWS = 2  # more make a chart higher instead of its curves lower


def pen_of(series: dict, index: int) -> dict:
    """Its own pen, or one of seven colours, then the same with other dashes."""
    if series["pen"] is not None:
        return series["pen"]
    dash = style.DASHES[index // len(style.PALETTE) % len(style.DASHES)]
    return {"color": style.PALETTE[index % len(style.PALETTE)], "width": style.LINE, "dash": dash}


def _legend(chart: dict) -> Dict[Tuple[str, str], Any]:
    """By name and look of each entry its handle; none of a single one, which the axes name."""
    looks = [(series["name"], series["fill"] or _look(series, pen_of(series, i)))
             for i, series in enumerate(chart["series"])]
    looks += [(band["name"], band["color"]) for band in chart["bands"]]
    entries = {
        (name, repr(look)): Line2D([], [], **look) if isinstance(look, dict)
        else Patch(facecolor=look, edgecolor=style.GREY, linewidth=0.6)
        for name, look in looks if name}
    return entries if len(entries) > 1 else {}


def _legends(charts: List[dict]) -> List[Dict[Tuple[str, str], Any]]:
    """Of each chart; what an earlier chart of the figure explains is not repeated."""
    known: set = set()
    legends = []
    for chart in charts:
        legend = _legend(chart)
        legends.append({entry: handle for entry, handle in legend.items() if entry not in known})
        known |= set(legend)
    return legends


def _range(chart: dict, way: str) -> Tuple[float, float]:
    return data_range((series[way] for series in chart["series"]), chart[way]["logarithmic"])


class _Layout:
    """The places of one chart's parts [px], from the upper left corner of its cell."""

    def __init__(self, chart: dict, width: float, height: float, legend: dict):
        self.chart = chart
        self.names, self.handles = [name for name, _ in legend], list(legend.values())
        self.rows = style.legend_rows(self.names, width - 70.0)
        self.extra = style.LEGEND_ROW * max(0, self.rows - _FREE_LEGEND_ROWS)
        self.title, self.title_size = style.fitted(
            chart["title"], style.CHART_TITLE, max(width - 140.0, 0.75 * width), True)
        self.x, self.y = _range(chart, "x"), _range(chart, "y")
        self.legend_height = style.LEGEND_ROW * self.rows + (6.0 if self.rows else 0.0)
        title = 11.0 + style.height_of(self.title, self.title_size) if self.title else 8.0
        self.top = title + self.legend_height + 4.0
        most = most_up(height - self.top - _FOOT)
        fixed = chart["y"]["tight"] or chart["equal_aspect"]
        ticks = ticks_of(chart["y"], *self.y, most, fixed) or list(self.y)
        if not fixed:
            self.y = (ticks[0], ticks[-1])
        labels, exponent = labels_of(chart["y"], ticks)
        self.above = _SECOND_SCALE if chart["x"]["second"] else 0.0
        self.top += self.above
        label, size = style.fitted(
            scaled_label(chart["y"]["label"], exponent), style.LABEL, height - self.top)
        self.left = 23.0 + style.height_of(label, size) + _widest(labels)
        self.right = _RIGHT
        second = chart["y"]["second"]
        if second is not None and second["factor"] != 0.0:
            ends = sorted(second["factor"] * end for end in self.y)
            self.right = 44.0 + _widest(labels_of(LINEAR, ticks_of(LINEAR, *ends, most, True))[0])

    def finish_x(self, width: float) -> None:
        """Ends of the x axis for a width of the plot [px]."""
        if not self.chart["x"]["tight"] and not self.chart["equal_aspect"]:
            most = most_across(self.chart["x"], width, *self.x, inside=False)
            ticks = ticks_of(self.chart["x"], *self.x, most)
            self.x = (ticks[0], ticks[-1])


def _widest(labels: List[str]) -> float:
    return max((style.text_width(label, style.TICK) for label in labels), default=0.0)


def most_up(height: float) -> int:
    """As many ticks as have space along a vertical axis of a length [px]."""
    return max(4, int(height / _PER_TICK))


def draw_charts(figure: dict, ax=None):
    """A figure with all its charts; with `ax` the first one on these axes."""
    charts = figure["charts"]
    if ax is not None:
        if charts:
            width, height = style.size_of(ax)
            layout = _Layout(charts[0], width + 70.0, height + 90.0, _legend(charts[0]))
            _finish_equal(layout, width, height)
            layout.finish_x(width)
            _draw_chart(ax, layout, width, width, True)
            if not layout.title and figure["title"]:
                style.add_axes_title(ax, figure["title"], layout.legend_height + layout.above + 6.0)
        return ax.figure
    columns = figure["columns"]
    cell = figure["width"] / columns
    layouts = [_Layout(chart, cell, figure["chart_height"], legend)
               for chart, legend in zip(charts, _legends(charts))]
    rows = [layouts[i : i + columns] for i in range(0, len(layouts), columns)]
    heights = [figure["chart_height"] + max(layout.extra for layout in row) for row in rows]
    top = style.title_space(figure["title"], figure["width"])
    sheet = style.sheet(figure["width"], max(top + sum(heights), 60.0), figure)
    for row, height in zip(rows, heights):
        for column, layout in enumerate(row):
            left = max(one.left for one in layouts[column::columns])
            right = max(one.right for one in layouts[column::columns])
            _place_chart(sheet, layout, column * cell, top, cell, height, left, right)
        top += height
    return sheet


def _place_chart(
    sheet, layout: _Layout, cell_left: float, cell_top: float, cell: float, cell_height: float,
    left: float, right: float,
) -> None:
    width = max(cell - left - right, 40.0)
    height = max(cell_height - layout.top - _FOOT, 40.0)
    if layout.chart["equal_aspect"]:
        # An orbit is drawn in a square, not in the middle of a wide chart.
        (x0, x1), (y0, y1) = layout.x, layout.y
        wanted = max(height, min(width, 1.1 * height * (x1 - x0) / (y1 - y0)))
        if wanted < 0.75 * width:
            left += 0.5 * (width - wanted)
            width = wanted
    _finish_equal(layout, width, height)
    layout.finish_x(width)
    ax = style.add_axes(sheet, cell_left + left, cell_top + layout.top, width, height)
    _draw_chart(ax, layout, cell - 70.0, cell - left - 10.0, False)


def _finish_equal(layout: _Layout, width: float, height: float) -> None:
    """Equal scales: the range with more units per px sets both."""
    if layout.chart["equal_aspect"]:
        margin = 1.04  # marks at the ends are whole
        unit = margin * max(
            (layout.x[1] - layout.x[0]) / width, (layout.y[1] - layout.y[0]) / height)
        layout.x, layout.y = (
            (0.5 * (a + b) - 0.5 * unit * pixels, 0.5 * (a + b) + 0.5 * unit * pixels)
            for (a, b), pixels in ((layout.x, width), (layout.y, height))
        )


def _draw_chart(
    ax, layout: _Layout, legend_width: float, legend_space: float, clip: bool
) -> None:
    """All of a chart; `clip`: marks end at the frame, as axes that can be zoomed need."""
    chart = layout.chart
    _set_axes(ax, layout)
    curves = []
    for band in chart["bands"]:
        low, high = max(band["low"], layout.x[0]), min(band["high"], layout.x[1])
        if high > low:
            ax.axvspan(low, high, facecolor=band["color"], edgecolor="none", zorder=0.2)
    reference = {"color": style.GREY, "linewidth": 1.2 * PX, "linestyle": style.dash_of([6.0, 4.0]),
                 "zorder": 1.5}
    for i, series in enumerate(chart["series"]):
        x = shown(series["x"], chart["x"]["logarithmic"])
        y = shown(series["y"], chart["y"]["logarithmic"])
        pen = pen_of(series, i)
        if series["fill"]:
            good = np.isfinite(x) & np.isfinite(y)
            if good.sum() > 2:
                area = Polygon(np.column_stack((x, y))[good], closed=True, facecolor=series["fill"],
                               edgecolor="none", zorder=1.0 + 1.0e-4 * i, label=series["name"])
                ax.add_patch(area)
        _add_series(ax, series, pen, x, y, i, clip)
        spots = np.column_stack((x, y))
        if series["fill"] and len(spots):
            spots = np.vstack((spots, spots[:1]))  # a label is not across its border
        curves.append((spots, pen["width"], series["line"] or series["fill"] is not None,
                       series["marks"] != "none"))
    # After the curves: ax.lines[i] is the series i.
    for line in chart["vertical"]:
        if layout.x[0] <= line["at"] <= layout.x[1]:
            ax.axvline(line["at"], **reference)
    for line in chart["horizontal"]:
        if layout.y[0] <= line["at"] <= layout.y[1]:
            ax.axhline(line["at"], **reference)
    if layout.names:
        style.add_legend(ax, layout.handles, layout.names, legend_width, layout.above + 7.0, legend_space)
    ax.set_xlim(layout.x[::-1] if chart["x"]["inverted"] else layout.x)
    ax.set_ylim(layout.y[::-1] if chart["y"]["inverted"] else layout.y)
    label_chart(ax, chart, curves)


def _look(series: dict, pen: dict) -> Dict[str, Any]:
    """Properties of its line and marks."""
    line = style.dash_of(pen["dash"]) if series["line"] and not series["fill"] else "None"
    look = {"color": pen["color"], "linewidth": pen["width"] * PX, "linestyle": line}
    if series["marks"] == "none":
        return {**look, "marker": "None"}
    dots = series["marks"] == "dots"
    if len(series["x"]) > _MANY_MARKS:  # a cloud: outlines would hide it
        return {**look, "marker": "o", "markersize": MARK * PX, "markeredgewidth": 0.0}
    return {
        **look, "marker": "o", "markersize": 2 * MARK * PX,
        "markerfacecolor": pen["color"] if dots else "white",
        "markeredgecolor": style.BLACK if dots else pen["color"],
        "markeredgewidth": (1.0 if dots else 2.0) * PX,
    }


def _add_series(
    ax, series: dict, pen: dict, x: np.ndarray, y: np.ndarray, index: int, clip: bool
) -> None:
    marked = series["marks"] != "none"
    (line,) = ax.plot(
        x, y, zorder=(3.0 if marked else 2.0) + 1.0e-4 * index, label=series["name"] or "_",
        clip_on=clip or not (marked or _fits(ax, x, y)), **_look(series, pen),
    )
    ink = 0.0 if marked else _ink(ax, x, y, pen["width"])
    if ink > _DENSE:  # a band: of a finer line the inside, and what is behind it, are seen
        line.set_linewidth(max(0.4, pen["width"] * _DENSE / ink) * PX)
        line.set_alpha(0.8 if ink < 4.0 * _DENSE else 0.55)
    if series["line"] and not series["fill"] and not marked:
        alone = _alone(x, y)
        if alone.any():  # a point between two gaps has no line: it is a dot
            line.set_marker("o")
            line.set_markersize(max(pen["width"] + 1.5, 4.0) * PX)
            line.set_markeredgewidth(0.0)
            line.set_markevery(np.flatnonzero(alone).tolist())
            line.set_clip_on(clip)


def _fits(ax, x: np.ndarray, y: np.ndarray) -> bool:
    """Is a line inside its frame? Then it is not clipped: at the frame it would be half as wide."""
    return all(np.nanmin(row, initial=ends[0]) >= min(ends) and np.nanmax(row, initial=ends[0]) <= max(ends)
               for row, ends in ((x, ax.get_xlim()), (y, ax.get_ylim())))


def _ink(ax, x: np.ndarray, y: np.ndarray, width: float) -> float:
    """Area of a line of a width [px] in areas of its axes, overlaps counted; linear scales only."""
    if ax.get_xscale() == "log" or ax.get_yscale() == "log":
        return 0.0
    sides = style.size_of(ax)
    steps = [np.diff(row) * side / np.ptp(ends) for row, side, ends in
             zip((x, y), sides, (ax.get_xlim(), ax.get_ylim()))]
    return width * float(np.nansum(np.hypot(*steps))) / (sides[0] * sides[1])


def _alone(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    good = np.isfinite(x) & np.isfinite(y)
    padded = np.concatenate(([False], good, [False]))
    return good & ~padded[:-2] & ~padded[2:]


def _set_axes(ax, layout: _Layout) -> None:
    chart = layout.chart
    width, height = style.size_of(ax)
    ax.set(xscale="log" if chart["x"]["logarithmic"] else "linear",
           yscale="log" if chart["y"]["logarithmic"] else "linear", xlim=layout.x, ylim=layout.y)
    locators = _ticks(chart["x"], "x", width), _ticks(chart["y"], "y", height)
    exponent = None
    if chart["equal_aspect"]:  # the same steps and one exponent
        ticks = [locator.tick_values(*ends) for locator, ends in zip(locators, (layout.x, layout.y))]
        step = max(row[1] - row[0] for row in ticks)
        exponent = exponent_of(ticks[0] + ticks[1])
        locators = MultipleLocator(step), MultipleLocator(step)
    for way, axis, locator, space in (("x", ax.xaxis, locators[0], width + 40.0),
                                      ("y", ax.yaxis, locators[1], height + _FOOT)):
        set_axis(axis, chart[way], chart[way]["label"], locator, space, exponent)
        if chart[way]["logarithmic"]:
            axis.grid(True, which="minor", color=style.FINE_GRID, linewidth=0.8 * PX)
        axis.grid(True, which="major")
        if chart[way]["second"] is not None and chart[way]["second"]["factor"] != 0.0:
            _add_second_scale(ax, chart[way], way, width if way == "x" else height)
    ax.tick_params(which="minor", length=0.0)
    if layout.title:
        ax.set_title(layout.title, size=layout.title_size * PX, weight="bold", y=1.0,
                     pad=(layout.legend_height + layout.above + 7.0) * PX)


def _ticks(fields: dict, way: str, length: float, ceiling: int = 9) -> Ticks:
    if way == "y":
        return Ticks(fields, lambda low, high: most_up(length))
    return Ticks(fields, lambda low, high: most_across(fields, length, low, high, ceiling))


def _add_second_scale(ax, fields: dict, way: str, length: float) -> None:
    factor = fields["second"]["factor"]
    functions = (lambda v: v * factor, lambda v: v / factor)
    fields = {**fields, "degrees": False}
    if way == "x":
        scale = ax.secondary_xaxis("top", functions=functions)
        scale.set_xlim(*(factor * end for end in ax.get_xlim()))  # its own are set when it is drawn
        axis = scale.xaxis
    else:
        scale = ax.secondary_yaxis("right", functions=functions)
        scale.set_ylim(*(factor * end for end in ax.get_ylim()))
        axis = scale.yaxis
    set_axis(axis, fields, fields["second"]["label"], _ticks(fields, way, length, 8), length)
    axis.label.set_size(style.TICK * PX)
    axis.set_tick_params(pad=3.0 * PX)
