"""Colours, letter sizes and settings of all figures. Sizes are in px: 1/100 inch."""

from __future__ import annotations

import contextlib
import contextvars
import functools
import math
import textwrap
import warnings
from typing import Iterator, List, Optional, Tuple

import matplotlib
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, findfont, get_font

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
GRID = "#e0e2e5"
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

_SETTINGS = {
    "text.parse_math": False,  # "$" in a label is a dollar
    "text.color": BLACK,
    "svg.fonttype": "none",  # text stays text
    "svg.hashsalt": "whirl_twin",
    "pdf.fonttype": 42,
    "figure.dpi": DPI,
    "axes.edgecolor": GREY,
    "axes.labelcolor": BLACK,
    "axes.linewidth": 1.2 * PX,
    "axes.axisbelow": True,
    "axes.labelsize": LABEL * PX,
    "axes.labelpad": 4.5 * PX,
    "axes.titlecolor": BLACK,
    "grid.color": GRID,
    "grid.linewidth": 1.0 * PX,
    "lines.solid_capstyle": "round",
    "lines.solid_joinstyle": "round",
    "lines.dash_capstyle": "butt",
    "lines.scale_dashes": False,  # dashes are in points
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.labelcolor": BLACK,
    "ytick.labelcolor": BLACK,
    "xtick.labelsize": TICK * PX,
    "ytick.labelsize": TICK * PX,
    "xtick.major.size": 4.0 * PX,
    "ytick.major.size": 4.0 * PX,
    "xtick.major.pad": 4.0 * PX,
    "ytick.major.pad": 4.0 * PX,
}


_applied = contextvars.ContextVar("applied", default=False)


@contextlib.contextmanager
def context() -> Iterator[None]:
    """Settings of whirl_twin's figures; those of the user's matplotlibrc do not apply inside."""
    if _applied.get():
        yield
        return
    token = _applied.set(True)
    with matplotlib.rc_context(), warnings.catch_warnings():
        # Letters that the font does not have: an SVG shows them all the same.
        warnings.filterwarnings("ignore", message="Glyph")
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_SETTINGS)
        try:
            yield
        finally:
            _applied.reset(token)


def mixed(color: str, share: float, other: int) -> str:
    parts = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{round(part + share * (other - part)):02x}" for part in parts)


def paler(color: str, share: float) -> str:
    """Mixed with `share` of white."""
    return mixed(color, share, 255)


def darker(color: str, share: float) -> str:
    """Mixed with `share` of black."""
    return mixed(color, share, 0)


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


def sheet(width: float, height: float, title: str, description: str) -> Figure:
    """An empty figure [px]; title and description go into its files for screen readers."""
    figure = Figure(figsize=(width / DPI, height / DPI), dpi=DPI)
    figure.whirl_twin_title = title
    figure.whirl_twin_description = description
    return figure


def add_axes(figure: Figure, left: float, top: float, width: float, height: float):
    """Axes at a place of a figure [px from its upper left corner]."""
    all_width, all_height = figure.get_size_inches() * DPI
    return figure.add_axes((
        left / all_width, 1.0 - (top + height) / all_height, width / all_width, height / all_height,
    ))


def add_text(
    figure: Figure, x: float, y: float, text: str, size: float, ha: str = "left",
    va: str = "center", color: str = BLACK,
) -> None:
    """A text at a place of a figure [px from its upper left corner]."""
    width, height = figure.get_size_inches() * DPI
    figure.text(
        x / width, 1.0 - y / height, text, size=size * PX, ha=ha, va=va, color=color
    )


def title_space(title: str, width: float) -> float:
    """Height of the place of a figure's title [px]."""
    if not title:
        return 6.0
    text, size = fitted(title, TITLE, width - 20.0, True)
    return 16.0 + height_of(text, size)


def add_title(figure: Figure, title: str) -> None:
    """The title of a figure, at its top."""
    if title:
        width, height = figure.get_size_inches() * DPI
        text, size = fitted(title, TITLE, width - 20.0, True)
        figure.suptitle(
            text, x=0.5, y=1.0 - 8.0 / height, va="top", size=size * PX, weight="bold", color=BLACK
        )


SAMPLE = 24.0  # px, of a line in a legend
LEGEND_ROW = 20.0  # px
_LEGEND_GAP = 22.0  # px, between entries


def legend_places(names: List[str], width: float) -> List[Tuple[int, float]]:
    """Row and left edge [px] of each entry of a legend, in as many rows as a width [px] needs.

    Entries of several rows are in columns, unless one long name would make them many more.
    """
    sizes = [SAMPLE + 8.0 + text_width(name, TICK) + _LEGEND_GAP for name in names]
    places: List[Tuple[int, float]] = []
    row, x = 0, 0.0
    for size in sizes:
        if x > 0.0 and x + size - _LEGEND_GAP > width:
            row, x = row + 1, 0.0
        places.append((row, x))
        x += size
    if row == 0:
        return places
    column = max(sizes)
    columns = max(1, int((width + _LEGEND_GAP) / column))
    if (len(names) - 1) // columns > row + 1:
        return places
    return [(i // columns, column * (i % columns)) for i in range(len(names))]


def add_axes_title(ax, title: str, names: List[str], width: float) -> None:
    """A title over a legend, on axes of the caller."""
    ax.set_title(title, size=CHART_TITLE * PX, weight="bold", color=BLACK, y=1.0,
                 pad=(LEGEND_ROW * legend_rows(names, width) + 12.0) * PX)


def legend_rows(names: List[str], width: float) -> int:
    return max((row + 1 for row, _ in legend_places(names, width)), default=0)


def add_legend(
    ax, handles: list, names: List[str], width: float, above: float, space: float = math.inf
) -> None:
    """A legend in rows above the axes, `above` [px] over their upper edge; it covers no curve.

    It begins at their left edge, or so far left of it that it ends `space` [px] right of it.
    """
    from matplotlib.legend import Legend
    from matplotlib.transforms import ScaledTranslation

    rows = legend_rows(names, width)
    places = legend_places(names, width)
    needed = max(x + SAMPLE + 8.0 + text_width(name, TICK) for name, (_, x) in zip(names, places))
    left = min(0.0, space - min(needed, width))
    for handle, name, (row, x) in zip(handles, names, places):
        up = above + LEGEND_ROW * (rows - 1 - row)
        shift = ScaledTranslation((left + x) / DPI, up / DPI, ax.figure.dpi_scale_trans)
        text, size = fitted(name, TICK, max(width - SAMPLE - 8.0, 60.0))
        entry = Legend(
            ax, [handle], [text], loc="lower left", bbox_to_anchor=(0.0, 1.0),
            bbox_transform=ax.transAxes + shift, frameon=False, borderpad=0.0, borderaxespad=0.0,
            labelspacing=0.0, fontsize=size * PX, handlelength=SAMPLE / size,
            handletextpad=8.0 / size, handleheight=0.8,
        )
        ax.add_artist(entry)


def scale_of(ax) -> float:
    """Display units of matplotlib in a px."""
    return ax.figure.dpi / DPI


def size_of(ax) -> Tuple[float, float]:
    """Width and height of axes [px]."""
    box = ax.get_position().transformed(ax.figure.transSubfigure)
    return box.width / scale_of(ax), box.height / scale_of(ax)


def dash_of(dash: Optional[List[float]]):
    """Line style of dashes [px on, px off ...]; none or all zero: a full line."""
    if not dash or not any(length > 0.0 for length in dash):
        return "-"
    dash = list(dash) if len(dash) % 2 == 0 else 2 * list(dash)
    return (0.0, [max(length, 0.01) * PX for length in dash])
