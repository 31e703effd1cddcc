"""The parts of a sketch, drawn from the rearmost to the foremost."""

from __future__ import annotations

import functools
import math
from typing import Callable, List, Tuple

import numpy as np
from matplotlib.patches import Circle, Polygon

from . import style
from .style import PX, darker, paler

_STEEL = "#b3bac4"
_IRON = "#858f9c"
_SPRING_WIRE = "#735c1a"
_COLORS = {"body": _STEEL, "mass": style.BLUE, "support": _IRON, "spring": _SPRING_WIRE,
           "mark": style.GREY}
_THIN = 1.1  # px, of outlines
_WINDINGS = 9  # of a spring
_STRAIGHT = 0.08  # of its length, at either end
_ANGLES = np.linspace(0.0, 2.0 * math.pi, 60, endpoint=False)


class View:
    """A parallel projection, looking along y, raised and turned [rad] about the vertical."""

    def __init__(self, raised: float, turned: float):
        c, s = math.cos(turned), math.sin(turned)
        up, back = math.cos(raised), math.sin(raised)
        self._flat = np.array([[c, -s * back], [s, c * back], [0.0, up]])
        self._away = np.array([-s * up, c * up, -back])

    def at(self, points) -> np.ndarray:
        """Points of shape (..., 3) [m] on the sheet: right and up [m]."""
        return np.asarray(points) @ self._flat

    def depth(self, point) -> float:
        """Away from the eye [m]."""
        return float(np.asarray(point) @ self._away)

    def extent(self, sketch: dict) -> List[np.ndarray]:
        """Points on the sheet that surround all parts."""
        spots = []
        for kind in ("rods", "springs", "dampers", "arrows", "balls"):
            for part in sketch[kind]:
                ends = self.at([part["at"]] if kind == "balls" else [part["from"], part["to"]])
                spots += [ends - part.get("radius", 0.0), ends + part.get("radius", 0.0)]
        for disc in sketch["discs"]:
            spots += [self.at(rim(disc, along)) for along in (-0.5, 0.5)]
        for box in sketch["boxes"]:
            spots.append(self.at(_corners(box)))
        spots += [self.at(line["points"]) for line in sketch["lines"] if len(line["points"])]
        return spots


def disc_axes(disc: dict) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Its axis, the direction of the zero of its angle, and the third."""
    length = np.linalg.norm(disc["axis"])
    axis = disc["axis"] / length if length > 0.0 else np.array([0.0, 1.0, 0.0])
    up = np.array([1.0, 0.0, 0.0] if abs(axis[2]) > 0.99 else [0.0, 0.0, 1.0])
    zero = up - (up @ axis) * axis
    zero /= np.linalg.norm(zero)
    return axis, zero, np.cross(axis, zero)


def rim(disc: dict, along: float, angles=_ANGLES) -> np.ndarray:
    """Points of its rim, `along` [thicknesses] its axis from the centre."""
    axis, zero, side = disc_axes(disc)
    angles = np.asarray(angles)[..., None]
    return (disc["at"] + along * disc["thickness"] * axis
            + disc["radius"] * (np.cos(angles) * zero + np.sin(angles) * side))


def _key(point: np.ndarray) -> Tuple[float, ...]:
    return tuple(float(f"{x:.6g}") + 0.0 for x in point)


def _radii_at_ends(rods: List[dict]) -> dict:
    """Of each end of a rod the radii of all rods that meet there."""
    ends: dict = {}
    for rod in rods:
        for at in (rod["from"], rod["to"]):
            ends.setdefault(_key(at), []).append(rod["radius"])
    return ends


def _box_axes(box: dict) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    c, s = math.cos(box["pitch"]), math.sin(box["pitch"])
    return np.array([c, 0.0, s]), np.array([0.0, 1.0, 0.0]), np.array([-s, 0.0, c])


def _corners(box: dict) -> np.ndarray:
    along, inwards, across = _box_axes(box)
    x, y, z = 0.5 * box["size"]
    return np.array([box["at"] + a * x * along + b * y * inwards + c * z * across
                     for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)])


def _hull(spots: np.ndarray) -> np.ndarray:
    """The convex hull of points (A. M. Andrew, 1979)."""
    spots = spots[np.lexsort((spots[:, 1], spots[:, 0]))]
    outline: List[np.ndarray] = []
    for half in (spots, spots[::-1]):
        start = len(outline)
        for spot in half:
            while len(outline) >= start + 2:
                a, b = outline[-2], outline[-1]
                if (b[0] - a[0]) * (spot[1] - a[1]) - (b[1] - a[1]) * (spot[0] - a[0]) > 0.0:
                    break
                outline.pop()
            outline.append(spot)
        outline.pop()
    return np.array(outline) if outline else spots[:1]


class PartDrawing:
    """Draws parts on axes whose coordinates are m, with `scale` px/m."""

    def __init__(self, ax, view: View, scale: float):
        self._ax, self._view, self._scale = ax, view, scale
        self._pale = 0.0
        self._ends: dict = {}
        self._order = 2.0

    def next_order(self) -> float:
        """Painter's order: what comes later covers what came before."""
        self._order += 1.0e-3
        return self._order

    def draw(self, sketch: dict, pale: float) -> None:
        """All parts; `pale`: share of white in every colour."""
        self._pale = pale
        self._ends = _radii_at_ends(sketch["rods"]) if sketch["spatial"] else {}
        for line in sketch["lines"]:
            self._line(line)
        parts: List[Tuple[float, Callable[[], None]]] = []

        def add(kind: str, draw: Callable[[dict], None]) -> None:
            for part in sketch[kind]:
                at = part["at"] if "at" in part else 0.5 * (part["from"] + part["to"])
                parts.append((self._view.depth(at), functools.partial(draw, part)))

        add("boxes", self._box)
        if sketch["spatial"]:
            add("rods", self._cylinder)
        else:
            # Rods at one depth share an outline: a beam of many rods appears as one piece.
            add("rods", self._bar_outline)
            add("rods", self._bar)
        add("discs", self._disc)
        add("dampers", self._damper)
        add("springs", self._spring)
        add("balls", self._ball)
        for _, draw in sorted(parts, key=lambda part: -part[0]):
            draw()
        for arrow in sketch["arrows"]:
            self._arrow(arrow)

    def _color(self, role: str) -> str:
        return paler(_COLORS[role], self._pale)

    def _outline(self, color: str) -> str:
        return darker(color, 0.45 * (1.0 - self._pale))

    def _polygon(self, spots: np.ndarray, color: str, edge: str, width: float = _THIN) -> None:
        self._ax.add_patch(Polygon(
            spots, closed=True, facecolor=color, edgecolor=edge, linewidth=width * PX,
            joinstyle="round", zorder=self.next_order()))

    def _stroke(self, spots: np.ndarray, color: str, width: float, dash=None) -> None:
        self._ax.plot(
            *np.asarray(spots).T, color=color, linewidth=width * PX, linestyle=style.dash_of(dash),
            zorder=self.next_order(), solid_capstyle="round", solid_joinstyle="round")

    def _capsule(self, start: np.ndarray, end: np.ndarray, radius: float) -> np.ndarray:
        """The outline of a round bar from the side, with round ends."""
        radius = max(radius, 1.1 / self._scale)
        direction = math.atan2(end[1] - start[1], end[0] - start[0])
        turns = direction + np.linspace(-0.5 * math.pi, 0.5 * math.pi, 16)
        half = radius * np.column_stack((np.cos(turns), np.sin(turns)))
        return np.concatenate((end + half, start - half))

    def _bar_outline(self, bar: dict) -> None:
        color = self._color(bar["role"])
        ends = self._view.at([bar["from"], bar["to"]])
        self._polygon(self._capsule(*ends, bar["radius"]), color, self._outline(color), 2.0 * _THIN)

    def _bar(self, bar: dict) -> None:
        color, radius = self._color(bar["role"]), bar["radius"]
        start, end = self._view.at([bar["from"], bar["to"]])
        self._polygon(self._capsule(start, end, radius), color, color, 0.0)
        if radius * self._scale > 2.5:  # light along a cylinder
            way = (end - start) / max(math.hypot(*(end - start)), 1.0e-300)
            up = 0.35 * radius * np.array([-way[1], way[0]])
            up = up if up[1] > 0.0 or up[1] == 0.0 and up[0] <= 0.0 else -up
            self._polygon(self._capsule(start + up, end + up, 0.22 * radius),
                          paler(color, 0.45), color, 0.0)

    def _cylinder(self, rod: dict) -> None:
        """A round bar with flat ends; between two equally thick ones there is no line."""
        radius = max(rod["radius"], 1.1 / self._scale)
        plate = {"at": rod["from"], "axis": rod["to"] - rod["from"], "radius": radius,
                 "thickness": 0.0}
        count = int(min(max(8.0 * math.sqrt(radius * self._scale), 12.0), 60.0))
        angles = np.linspace(0.0, 2.0 * math.pi, count, endpoint=False)
        along = self._view.at(plate["axis"])
        start = self._view.at(rim(plate, 0.0, angles))
        color = self._color(rod["role"])
        edge = self._outline(color)
        far, near = (rod["from"], start), (rod["to"], start + along)
        if self._view.depth(plate["axis"]) > 0.0:
            far, near = near, far
        if self._is_end(far[0], radius):
            self._polygon(far[1], color, edge, 2.0 * _THIN)
        self._polygon(_hull(np.concatenate((start, start + along))), color, color, 0.4)
        if math.hypot(*along) * self._scale > 0.5:
            sides = self._lines_along(plate, along, (1.0, 0.5, 0.2, -1.0))
            if radius * self._scale > 2.5:
                light = np.array([sides[1], sides[1] + along, sides[2] + along, sides[2]])
                self._polygon(light, paler(color, 0.4), color, 0.0)
            for side in (sides[0], sides[3]):
                self._stroke(np.array([side, side + along]), edge, _THIN)
        if self._is_end(near[0], radius):
            self._polygon(near[1], paler(color, 0.25), edge)

    def _is_end(self, at: np.ndarray, radius: float) -> bool:
        """Has a bar a visible face there: no neighbour, or a thinner one?"""
        radii = self._ends[_key(at)]
        return len(radii) == 1 or max(radii) > 1.001 * min(radii) and radius >= max(radii)

    def _lines_along(self, plate: dict, along: np.ndarray, heights) -> np.ndarray:
        """Where lines along the visible side of a cylinder begin, at heights [radii] on the sheet."""
        normal = np.array([-along[1], along[0]]) / math.hypot(*along)
        normal = normal if normal[1] >= 0.0 else -normal
        _, zero, side = disc_axes(plate)
        highest = math.atan2(self._view.at(side) @ normal, self._view.at(zero) @ normal)
        starts = []
        for height in heights:
            angles = (highest + math.acos(height), highest - math.acos(height))
            points = [rim(plate, 0.0, angle) for angle in angles]
            starts.append(self._view.at(min(points, key=self._view.depth)))
        return np.array(starts)

    def _ball(self, ball: dict) -> None:
        color = self._color(ball["role"])
        centre = self._view.at(ball["at"])
        radius = max(ball["radius"], 1.1 / self._scale)
        for at, size, fill, width in ((centre, radius, color, _THIN),
                                      (centre + (-0.3 * radius, 0.3 * radius), 0.22 * radius,
                                       paler(color, 0.55), 0.0)):
            self._ax.add_patch(Circle(at, size, facecolor=fill, edgecolor=self._outline(color),
                                      linewidth=width * PX, zorder=self.next_order()))

    def _disc(self, disc: dict) -> None:
        """A round plate with its mark, a spoke, on the near side."""
        axis = disc_axes(disc)[0]
        near = 0.5 if self._view.depth(axis) < 0.0 else -0.5
        face, back = self._view.at(rim(disc, near)), self._view.at(rim(disc, -near))
        color = self._color(disc["role"])
        self._polygon(_hull(np.concatenate((face, back))), darker(color, 0.2), self._outline(color))
        self._polygon(face, color, self._outline(color))
        centre = disc["at"] + near * disc["thickness"] * axis
        spoke = self._view.at([centre, rim(disc, near, disc["angle"])])
        self._stroke(spoke, paler(style.VERMILION, self._pale), 2.5)

    def _box(self, box: dict) -> None:
        along, inwards, across = _box_axes(box)
        x, y, z = 0.5 * box["size"]
        color = self._color(box["role"])
        for normal, half, u, half_u, v, half_v, fill in (
            (across, z, along, x, inwards, y, paler(color, 0.25)),
            (along, x, across, z, inwards, y, darker(color, 0.15)),
            (inwards, y, along, x, across, z, color),
        ):
            seen = self._view.depth(normal) < 0.0
            centre = box["at"] + (half if seen else -half) * normal
            spots = [self._view.at(centre + a * half_u * u + b * half_v * v)
                     for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            self._polygon(np.array(spots), fill, self._outline(color))

    def _frame(self, part: dict) -> Tuple[np.ndarray, np.ndarray, float, np.ndarray]:
        """On the sheet: both ends, the distance, and the direction."""
        start, end = self._view.at([part["from"], part["to"]])
        length = max(math.hypot(*(end - start)), 1.0e-3 / self._scale)
        return start, end, length, (end - start) / length

    def _spring(self, spring: dict) -> None:
        start, end, length, along = self._frame(spring)
        s = np.linspace(0.0, 1.0, 12 * _WINDINGS + 1)
        way = (_STRAIGHT + (1.0 - 2.0 * _STRAIGHT) * s) * length
        out = spring["radius"] * np.sin(2.0 * math.pi * _WINDINGS * s)
        wire = start + np.outer(way, along) + np.outer(out, [-along[1], along[0]])
        width = min(max(0.2 * spring["radius"] * self._scale, 1.3), 3.5)
        self._stroke(np.vstack((start, wire, end)), paler(_SPRING_WIRE, self._pale), width)

    def _damper(self, damper: dict) -> None:
        pot = min(0.5, 10.0 * damper["radius"] / self._frame(damper)[2])
        middle = damper["from"] + pot * (damper["to"] - damper["from"])
        for part in ({**damper, "radius": 0.3 * damper["radius"], "role": "body"},
                     {**damper, "to": middle, "role": "support"}):
            self._bar_outline(part)
            self._bar(part)

    def _arrow(self, arrow: dict) -> None:
        start, end, length, along = self._frame(arrow)
        if length * self._scale < 1.0:
            return
        color = paler(style.BLUE, self._pale)
        head = min(12.0 / self._scale, 0.6 * length)
        neck = end - head * along
        side = 0.45 * head * np.array([-along[1], along[0]])
        self._stroke(np.array([start, neck]), color, 3.0)
        self._polygon(np.array([end, neck + side, neck - side]), color, color, 1.0)

    def _line(self, line: dict) -> None:
        spots = self._view.at(line["points"])
        if len(spots) == 0:
            return
        if line["role"] == "mark":
            self._stroke(spots, paler(style.GREY, max(self._pale, 0.3)), 1.2, [6.0, 4.0])
        else:
            self._stroke(spots, darker(self._color(line["role"]), 0.2), 2.5)
