"""Colours, letter sizes and places in all figures. Sizes are in px: 1/100 inch."""

from __future__ import annotations

import contextlib
import functools
import math
import pathlib
import textwrap
import warnings
from typing import Iterator, List, Optional, Sequence, Tuple

import matplotlib.style
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.legend import Legend
from matplotlib.transforms import ScaledTranslation

PX = 0.72  # points in a px
DPI = 100  # px in an inch

# Colours distinguishable with every kind of colour vision (M. Okabe, K. Ito: Color Universal
# Design, 2008).
BLUE = "#0072b2"
VERMILION = "#d55e00"
GREEN = "#009e73"
PURPLE = "#cc79a7"
ORANGE = "#e69f00"
SKY_BLUE = "#56b4e9"
BLACK = "#212126"
GREY = "#6b7078"
FINE_GRID = "#eff0f2"
HOLE = "#cccccc"
PALETTE = (BLUE, VERMILION, GREEN, PURPLE, SKY_BLUE, ORANGE, BLACK)
# The palette is used full, then dashed, and so on: 42 lines that differ.
DASHES: Tuple[Tuple[float, ...], ...] = (
    (), (7.0, 4.0), (2.0, 3.0), (9.0, 3.0, 2.0, 3.0), (14.0, 4.0), (6.0, 2.0, 2.0, 2.0, 2.0, 2.0),
)

TITLE = 17.0
CHART_TITLE = 14.0
LABEL = 14.0
TICK = 13.0
NOTE = 12.0
LINE = 1.8  # width of a curve
LEGEND_ROW = 20.0
_SAMPLE = 32.0  # of a line in a legend, with the space behind it
_LEGEND_GAP = 22.0  # between columns of a legend

_SETTINGS = pathlib.Path(__file__).with_name("templates") / "figure.mplstyle"


@contextlib.contextmanager
def context() -> Iterator[None]:
    """Settings of whirl_twin's figures; those of the user's matplotlibrc do not apply inside."""
    with matplotlib.style.context(_SETTINGS, after_reset=True), warnings.catch_warnings():
        # Letters that the font does not have: an SVG shows them all the same.
        warnings.filterwarnings("ignore", message="Glyph")
        yield


def paler(color: str, share: float) -> str:
    """Mixed with `share` of white."""
    return to_hex([part + share * (1.0 - part) for part in to_rgb(color)])


def darker(color: str, share: float) -> str:
    """Mixed with `share` of black."""
    return to_hex([part - share * part for part in to_rgb(color)])


@functools.lru_cache(maxsize=4)
def _font(bold: bool):
    return get_font(findfont(FontProperties(weight="bold" if bold else "normal")))


@functools.lru_cache(maxsize=4096)
def text_width(text: str, size: float, bold: bool = False) -> float:
    """Width of a text [px] in letters of a size [px]; of several lines the widest."""
    font = _font(bold)
    font.set_size(size, 72.0)
    widest = 0.0
    for line in text.split("\n"):
        font.set_text(line, 0.0, flags=2)  # 2: without hinting, as in a file
        widest = max(widest, font.get_width_height()[0] / 64.0)
    return widest


def fitted(text: str, size: float, width: float, bold: bool = False) -> Tuple[str, float]:
    """The text and the size of its letters [px] for a width [px].

    A long text is set in smaller letters, down to 0.7 of the size; a longer one in several lines.
    """
    needed = text_width(text, size, bold)
    if needed <= width or width <= 0.0:
        return text, size
    smaller = max(0.7 * size, size * width / needed)
    if text_width(text, smaller, bold) <= 1.01 * width:
        return text, smaller
    letters = max(8, int(len(text) * width / text_width(text, smaller, bold)))
    lines: List[str] = []
    for line in text.split("\n"):
        lines += textwrap.wrap(line, letters) or [""]
    return "\n".join(lines), smaller


def height_of(text: str, size: float) -> float:
    """Height of a text [px]: 1.2 sizes a line."""
    return 1.2 * size * (text.count("\n") + 1)


def sheet(width: float, height: float, fields: dict) -> Figure:
    """A figure [px] with its title, which goes into its files, as its description does."""
    figure = Figure(figsize=(width / DPI, height / DPI), dpi=DPI)
    figure.whirl_twin_title = fields["title"]
    figure.whirl_twin_description = fields["description"]
    if fields["title"]:
        text, size = fitted(fields["title"], TITLE, width - 20.0, True)
        figure.suptitle(text, x=0.5, y=1.0 - 8.0 / height, va="top", size=size * PX)
    return figure


def title_space(title: str, width: float) -> float:
    """Height of the place of a figure's title [px]."""
    return 16.0 + height_of(*fitted(title, TITLE, width - 20.0, True)) if title else 6.0


def add_axes(figure: Figure, left: float, top: float, width: float, height: float):
    """Axes at a place of a figure [px from its upper left corner]."""
    all_width, all_height = figure.get_size_inches() * DPI
    return figure.add_axes((
        left / all_width, 1.0 - (top + height) / all_height, width / all_width, height / all_height,
    ))


def add_text(figure: Figure, x: float, y: float, text: str, size: float, **more) -> None:
    """A grey text at a place of a figure [px from its upper left corner]."""
    width, height = figure.get_size_inches() * DPI
    figure.text(x / width, 1.0 - y / height, text,
                **{"size": size * PX, "va": "center", "color": GREY, **more})


def add_axes_title(ax, title: str, above: float) -> None:
    """A title `above` axes [px]."""
    ax.set_title(title, size=fitted(title, CHART_TITLE, 1.2 * size_of(ax)[0])[1] * PX, pad=above * PX)


def _legend_columns(names: Sequence[str], width: float) -> Tuple[List[str], float, List[float]]:
    """Names, long ones in several lines; size of letters; width of each column: as many as fit."""
    fits = [fitted(name, TICK, max(width - _SAMPLE, 60.0)) for name in names]
    size = min((size for _, size in fits), default=TICK)
    sizes = [_SAMPLE + text_width(name, size) + _LEGEND_GAP for name, _ in fits]
    columns: List[float] = []
    for count in range(len(names), 0, -1):
        columns = [max(sizes[i::count]) for i in range(count)]
        if sum(columns) - _LEGEND_GAP <= width:
            break
    return [name for name, _ in fits], size, columns


def legend_rows(names: Sequence[str], width: float) -> int:
    """Of a legend that is as wide [px]; in lines of text."""
    names, _, columns = _legend_columns(names, width)
    count = max(len(columns), 1)
    return max(sum(name.count("\n") + 1 for name in names[i::count]) for i in range(count))


def add_legend(
    ax, handles: Sequence, names: Sequence[str], width: float, above: float, space: float = math.inf
) -> None:
    """A legend in rows above the axes, `above` [px] over their upper edge; it covers no curve.

    It begins at their left edge, or so far left of it that it ends `space` [px] right of it.
    """
    names, size, columns = _legend_columns(names, width)
    count = len(columns)
    order = [k for i in range(count) for k in range(i, len(names), count)]  # rows, not columns
    left = min(0.0, space - min(sum(columns) - _LEGEND_GAP, width))
    shift = ScaledTranslation(left / DPI, above / DPI, ax.figure.dpi_scale_trans)
    ax.add_artist(Legend(
        ax, [handles[k] for k in order], [names[k] for k in order], ncol=count, loc="lower left",
        bbox_to_anchor=(0.0, 1.0), bbox_transform=ax.transAxes + shift, fontsize=size * PX,
        frameon=False, borderpad=0.0, borderaxespad=0.0, labelspacing=0.35, handleheight=0.8,
        handlelength=(_SAMPLE - 8.0) / size, handletextpad=8.0 / size,
        columnspacing=_LEGEND_GAP / size))


def scale_of(ax) -> float:
    """Display units of matplotlib in a px."""
    return ax.figure.dpi / DPI


def size_of(ax) -> Tuple[float, float]:
    """Width and height of axes [px]."""
    return ax.bbox.width / scale_of(ax), ax.bbox.height / scale_of(ax)


def dash_of(dash: Optional[Sequence[float]]):
    """Line style of dashes [px on, px off ...]; none or all zero: a full line."""
    if not dash or not any(length > 0.0 for length in dash):
        return "-"
    dash = list(dash) if len(dash) % 2 == 0 else 2 * list(dash)
    return (0.0, [max(length, 0.01) * PX for length in dash])
