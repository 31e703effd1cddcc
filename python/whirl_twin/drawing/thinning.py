"""Thinning of lines for SVG and PDF: removes what is below the resolution of a screen."""

from __future__ import annotations

from typing import List

import numpy as np
from matplotlib.path import Path

_FILE_SPOTS = 9000  # of a whole file: an SVG stays below about 200 kB
_PIXEL_SPOTS = 40000  # of a PNG: its drawing stays below a few seconds
_MOST_MARKS = 1200  # of a whole file; more are drawn as pixels
_UNSEEN = 0.12  # px, maximum deviation of a line
_COARSEST = 0.9  # px, the same if there would be too many points
_COLUMN = 0.5  # px
_CELL = 0.75  # px, less than the width of a line
_MOST_SAMPLES = 4.0e6  # of a line on the raster of cells
_MARK_CELL = 1.5  # px, marks as near as that cover each other


def thin(figure, dpi: float, pixels: bool) -> None:
    """Thin all lines of a figure for a file of `dpi` px per inch, of pixels or of lines."""
    spots = _PIXEL_SPOTS if pixels else _FILE_SPOTS
    lines = [(ax, line) for ax in figure.axes for line in ax.lines
             if line.get_transform() == ax.transData]
    if sum(len(line.get_xdata(orig=False)) for _, line in lines) > spots:
        curves = [line for _, line in lines if line.get_linestyle() not in ("None", "")]
        for ax, line in lines:
            if line in curves and line.get_marker() in ("None", None):
                _thin_line(ax, line, max(50, spots // len(curves)), dpi)
    marked = [(ax, line) for ax, line in lines if line.get_marker() not in ("None", None)]
    if not pixels and sum(_marks(line) for _, line in marked) > _MOST_MARKS:
        for ax, line in marked:
            if line.get_linestyle() in ("None", ""):
                _thin_marks(ax, line)
    if not pixels and sum(_marks(line) for _, line in marked) > _MOST_MARKS:
        for _, line in marked:
            if _marks(line) > 20:
                line.set_rasterized(True)
    for ax in figure.axes:
        for patch in ax.patches:
            xy = patch.get_xy() if hasattr(patch, "set_xy") and hasattr(patch, "get_closed") else []
            if len(xy) > 2000:
                _thin_area(ax, patch)


def _to_px(ax, xy: np.ndarray, dpi: float = 100.0) -> np.ndarray:
    with np.errstate(all="ignore"):
        spots = ax.transData.transform(xy) * (dpi / ax.figure.dpi)
    return np.where(np.abs(spots) < 1.0e6, spots, np.nan)


def _to_data(ax, spots: np.ndarray, dpi: float = 100.0) -> np.ndarray:
    return ax.transData.inverted().transform(spots * (ax.figure.dpi / dpi))


def _thin_line(ax, line, most: int, dpi: float) -> None:
    spots = _to_px(ax, np.column_stack(line.get_data(orig=False)), dpi)
    pieces = [thinned(piece) for piece in pieces_of(spots)]
    if sum(map(len, pieces)) > most:
        share = most / sum(map(len, pieces))
        pieces = [part for piece in pieces
                  for part in without_repeats(piece, max(2, int(share * len(piece))))]
    if pieces:
        gap = np.full((1, 2), np.nan)
        joined = np.concatenate([row for piece in pieces for row in (gap, piece)][1:])
        line.set_data(*_to_data(ax, joined, dpi).T)


def _marks(line) -> int:
    """How many marks it has."""
    every = line.get_markevery()
    return len(line.get_xdata(orig=False)) if every is None else len(every)


def _thin_marks(ax, line) -> None:
    """One mark of those that cover each other."""
    xy = np.column_stack(line.get_data(orig=False))
    spots = _to_px(ax, xy)
    xy, spots = (rows[np.isfinite(spots).all(axis=1)] for rows in (xy, spots))
    cells = np.floor(spots / _MARK_CELL).astype(np.int64)
    _, first = np.unique(cells[:, 0] * 2**32 + cells[:, 1], return_index=True)
    line.set_data(*xy[np.sort(first)].T)


def _thin_area(ax, patch) -> None:
    spots = _to_px(ax, patch.get_xy())
    patch.set_xy(_to_data(ax, simplified(spots[np.isfinite(spots).all(axis=1)], _UNSEEN)))


def pieces_of(spots: np.ndarray) -> List[np.ndarray]:
    """The stretches between the gaps."""
    good = np.isfinite(spots).all(axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate(([0], good.astype(np.int8), [0]))))
    return [spots[start:end] for start, end in zip(edges[::2], edges[1::2])]


def thinned(spots: np.ndarray) -> np.ndarray:
    """The line with only the points needed to stay within a fraction of a pixel; ends are kept."""
    if len(spots) < 3:
        return spots
    steps = np.diff(spots[:, 0])
    if (steps >= 0.0).all():
        spots = by_columns(spots)
    elif (steps <= 0.0).all():
        spots = by_columns(spots[::-1])[::-1]
    return simplified(spots, _UNSEEN)


def by_columns(spots: np.ndarray) -> np.ndarray:
    """Of a line from left to right: first, lowest, highest and last point of every pixel column."""
    columns = np.floor(spots[:, 0] / _COLUMN)
    starts = np.flatnonzero(np.concatenate(([True], np.diff(columns) != 0)))
    ends = np.concatenate((starts[1:], [len(spots)])) - 1
    order = np.lexsort((spots[:, 1], columns))  # columns in place, rising inside each
    kept = np.unique(np.concatenate((starts, ends, order[starts], order[ends])))
    return spots[kept]


def simplified(spots: np.ndarray, tolerance: float) -> np.ndarray:
    """Points within a tolerance [px] of a straight stretch are left out."""
    if len(spots) < 3:
        return spots
    path = Path(spots)
    path.simplify_threshold = tolerance
    path.should_simplify = True
    cleaned = path.cleaned(simplify=True)
    kept = cleaned.vertices[(cleaned.codes == Path.MOVETO) | (cleaned.codes == Path.LINETO)]
    return kept if len(kept) > 1 else spots[[0, -1]]


def without_repeats(spots: np.ndarray, most: int) -> List[np.ndarray]:
    """Removes the stretches of a line that repeat what it has drawn before.

    A periodic motion draws the same loop again and again. The line is coarsened, by a pixel at
    most, and the tolerance of equality grows, until at most `most` points remain.
    """
    length = np.hypot(*np.diff(spots, axis=0).T).sum()
    tolerance, cell = _UNSEEN, max(_CELL, 2.0 * length / _MOST_SAMPLES)
    while True:
        pieces = _fresh(simplified(spots, tolerance), cell)
        if sum(map(len, pieces)) <= max(most, 2) or cell > 1000.0:
            return pieces
        if tolerance < _COARSEST:
            tolerance *= 2.0
        else:
            cell *= 1.5


def _fresh(spots: np.ndarray, cell: float) -> List[np.ndarray]:
    """The stretches that pass through cells [px] of a raster no earlier one has passed."""
    steps = np.diff(spots, axis=0)
    samples = 2 + (2.0 * np.hypot(steps[:, 0], steps[:, 1]) / cell).astype(int)
    section = np.repeat(np.arange(len(steps)), samples)
    within = np.arange(len(section)) - np.repeat(np.cumsum(samples) - samples, samples)
    along = (within / (np.repeat(samples, samples) - 1))[:, None]
    cells = np.floor((spots[section] + along * steps[section]) / cell).astype(np.int64)
    _, first = np.unique(cells[:, 0] * 2**32 + cells[:, 1], return_index=True)
    fresh = np.bincount(section[first], minlength=len(steps))
    drawn = 10 * fresh > samples
    edges = np.flatnonzero(np.diff(np.concatenate(([0], drawn.astype(np.int8), [0]))))
    return [spots[start : end + 1] for start, end in zip(edges[::2], edges[1::2])]
