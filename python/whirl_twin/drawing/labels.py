"""Places of labels in a chart: beside their objects, where they cover neither curves nor labels."""

from __future__ import annotations

import math
from typing import List, Optional, Sequence, Tuple

import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.path import Path
from matplotlib.transforms import Affine2D

from . import style
from .thinning import by_columns, pieces_of

HEIGHT = 15.0  # px, of a line of text
MARK = 4.5  # px, radius

Rectangle = Tuple[float, float, float, float]  # left, top, width, height [px]


class LabelPlaces:
    """The area of axes [px from its upper left corner] with all that labels must not cover."""

    def __init__(self, width: float, height: float):
        self.width, self.height = width, height
        self._renderer = RendererAgg(max(1, math.ceil(width)), max(1, math.ceil(height)), 72.0)
        self._taken: List[Rectangle] = []
        self._sums: Optional[np.ndarray] = None

    def avoid_line(self, xy: np.ndarray, width: float) -> None:
        """A line [px]; a point that is not finite interrupts it."""
        gc = self._renderer.new_gc()
        gc.set_linewidth(width)
        xy = np.where(np.abs(xy) < 1.0e5, xy, np.nan)
        pieces = pieces_of(xy)
        if len(pieces) > 1000:
            pieces = [xy]
        pieces = [by_columns(piece) if (np.diff(piece[:, 0]) >= 0.0).all() else piece
                  for piece in pieces]
        stretches = [piece[i : i + 501] for piece in pieces for i in range(0, len(piece) - 1, 500)]
        # Of a tangle a part is enough to find the free places. Agg refuses very long paths.
        for stretch in stretches[:: 1 + len(stretches) // 100]:
            self._renderer.draw_path(gc, Path(stretch), self._upright())
        gc.restore()
        self._sums = None

    def avoid_marks(self, xy: np.ndarray) -> None:
        """Marks at points [px]."""
        gc = self._renderer.new_gc()
        good = np.all(np.abs(xy) < 1.0e5, axis=1)
        if good.any():
            self._renderer.draw_markers(
                gc, Path.unit_circle(), Affine2D().scale(MARK), Path(xy[good]), self._upright(),
                (0.0, 0.0, 0.0),
            )
        gc.restore()
        self._sums = None

    def _upright(self) -> Affine2D:
        # Agg counts y upwards.
        return Affine2D().scale(1.0, -1.0).translate(0.0, self._renderer.height)

    def covered(self, place: Rectangle) -> float:
        """Amount of overlap: px of curves, and much for labels and the edge of the area."""
        left, top, width, height = place
        if self._sums is None:
            mask = np.asarray(self._renderer.buffer_rgba())[:, :, 3] > 40
            self._sums = np.zeros((mask.shape[0] + 1, mask.shape[1] + 1), np.int64)
            self._sums[1:, 1:] = mask.cumsum(0).cumsum(1)
        rows, columns = self._sums.shape[0] - 1, self._sums.shape[1] - 1
        x0, x1 = (int(min(max(x, 0), columns)) for x in (left, math.ceil(left + width)))
        y0, y1 = (int(min(max(y, 0), rows)) for y in (top, math.ceil(top + height)))
        s = self._sums
        amount = float(s[y1, x1] - s[y0, x1] - s[y1, x0] + s[y0, x0])
        if left < 0 or top < 0 or left + width > self.width or top + height > self.height:
            amount += 1.0e5
        for other in self._taken:
            across = min(left + width, other[0] + other[2]) - max(left, other[0])
            down = min(top + height, other[1] + other[3]) - max(top, other[1])
            if across > 0.0 and down > 0.0:
                amount += 1.0e3 + 10.0 * across * down
        return amount

    def take(self, places: Sequence[Rectangle], most: float = math.inf) -> Optional[Rectangle]:
        """The first of these places that is free, else the one with the smallest overlap.

        None where each overlaps by more than `most`.
        """
        best, least = None, math.inf
        for place in places:
            now = self.covered(place)
            if now < least:
                best, least = place, now
            if least == 0.0:
                break
        if best is None or least > most:
            return None
        self._taken.append(best)
        return best


def label_chart(ax, chart: dict, curves: List[Tuple[np.ndarray, float, bool, bool]]) -> None:
    """Names of reference lines, and notes.

    `curves`: of each its points in data coordinates, line width [px], has it a line, has it marks.
    """
    if not (chart["vertical"] or chart["horizontal"] or chart["notes"]):
        return
    width, height = style.size_of(ax)
    box = ax.get_position().transformed(ax.figure.transSubfigure)
    places = LabelPlaces(width, height)
    scale = style.scale_of(ax)

    def on_sheet(xy) -> np.ndarray:
        """Data to px from the upper left corner of the axes."""
        with np.errstate(all="ignore"):
            at = ax.transData.transform(np.asarray(xy, dtype=float).reshape(-1, 2))
        return np.column_stack(((at[:, 0] - box.x0) / scale, (box.y1 - at[:, 1]) / scale))

    for xy, line_width, has_line, has_marks in curves:
        spots = on_sheet(xy)
        if has_line:
            places.avoid_line(spots, line_width + 1.0)
        if has_marks:
            places.avoid_marks(spots)
    middle = (np.mean(ax.get_xlim()), np.mean(ax.get_ylim()))
    upright = [(on_sheet((line["at"], middle[1]))[0][0], line) for line in chart["vertical"]]
    level = [(on_sheet((middle[0], line["at"]))[0][1], line) for line in chart["horizontal"]]
    upright = [(x, line) for x, line in upright if -0.5 <= x <= width + 0.5]
    level = [(y, line) for y, line in level if -0.5 <= y <= height + 0.5]
    for x, _ in upright:
        places.avoid_line(np.array([[x, 0.0], [x, height]]), 1.0)
    for y, _ in level:
        places.avoid_line(np.array([[0.0, y], [width, y]]), 1.0)
    for x, line in upright:
        _name_line(ax, places, line, (x, 0.0), True)
    for y, line in level:
        _name_line(ax, places, line, (width, y), False)
    for note in chart["notes"]:
        x, y = on_sheet((note["x"], note["y"]))[0]
        if -1.0 <= x <= width + 1.0 and -1.0 <= y <= height + 1.0:
            _note(ax, places, x, y, note)


def _annotate(
    ax, text: str, place: Rectangle, origin, at, coordinates="data", rotated=False, **more
) -> None:
    """A text in a place; it stays as far from `at`, which is at `origin` [px]."""
    shift = (place[0] + 0.5 * place[2] - origin[0], origin[1] - place[1] - 0.5 * place[3])
    ax.annotate(
        text, xy=at, xycoords=coordinates, xytext=(shift[0] * style.PX, shift[1] * style.PX),
        textcoords="offset points", ha="center", va="center" if rotated else "center_baseline",
        rotation=90 if rotated else 0, size=style.NOTE * style.PX, zorder=5,
        rotation_mode="anchor", annotation_clip=False, **more)


def _name_line(ax, places: LabelPlaces, line: dict, origin, upright: bool) -> None:
    """Beside a vertical line, rotated and preferably high, or horizontal where that does not fit;
    along a horizontal one, preferably to the right."""
    if not line["label"]:
        return
    x, y = origin
    length = style.text_width(line["label"], style.NOTE) + 2.0
    beside: List[Rectangle] = []
    if upright:
        for top in np.arange(5.0, max(places.height - length, 6.0), 10.0):
            beside += [(x - 3.0 - HEIGHT, top, HEIGHT, length), (x + 3.0, top, HEIGHT, length)]
        for away in (3.0, 12.0, 24.0):  # farther away it would be ambiguous
            for top in np.arange(5.0, max(places.height - HEIGHT, 6.0), 10.0):
                beside += [(x + away, top, length, HEIGHT), (x - away - length, top, length, HEIGHT)]
    else:
        end = places.width - 5.0 - length
        for left in np.arange(end, min(0.0, end - 1.0), -10.0):
            beside += [(left, y - 3.0 - HEIGHT, length, HEIGHT), (left, y + 3.0, length, HEIGHT)]
    place = places.take(beside)
    covers = places.covered(place) > 1.0e3 + 10.0 * place[2] * place[3]  # more than by itself
    white = {"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 0.5}
    at, coordinates = (((line["at"], 1.0), ("data", "axes fraction")) if upright
                       else ((1.0, line["at"]), ("axes fraction", "data")))
    _annotate(ax, line["label"], place, origin, at, coordinates, upright and place[2] == HEIGHT,
              color=style.darker(style.GREY, 0.25), bbox=white if covers else None)


def _note(ax, places: LabelPlaces, x: float, y: float, note: dict) -> None:
    """Beside its point or, with a thin line to it, a little farther away; else it is left out."""
    width = style.text_width(note["text"], style.NOTE) + 2.0
    height = HEIGHT * (note["text"].count("\n") + 1)
    around = [(x + across * (away + 0.5 * width) - 0.5 * width,
               y + down * (away + 0.5 * height) - 0.5 * height, width, height)
              for away in (7.0, 13.0, 26.0, 40.0, 60.0, 85.0)
              for across, down in ((1, 0), (-1, 0), (0, -1), (0, 1), (1, -1), (-1, -1), (1, 1), (-1, 1))]
    place = places.take(around, 0.0)
    if place is None:
        return
    arrow = {"arrowstyle": "-", "color": style.GREY, "linewidth": 0.8 * style.PX, "shrinkA": 0.0,
             "shrinkB": (MARK + 1.0) * style.PX}
    _annotate(ax, note["text"], place, (x, y), (note["x"], note["y"]), color=style.BLACK,
              arrowprops=arrow if around.index(place) >= 16 else None)
