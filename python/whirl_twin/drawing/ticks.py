"""Ticks at multiples of 1, 2 or 5 times a power of ten, one exponent per axis, and axis limits."""

from __future__ import annotations

import math
import re
from typing import Iterable, List, Sequence, Tuple

import numpy as np
from matplotlib.ticker import Formatter, Locator, LogLocator, NullFormatter, NullLocator

from . import style

MOST = 1.0e300  # beyond it lengths of axes leave the range of double
LEAST = 1.0e-280  # a shorter linear axis cannot be mapped by matplotlib
_SLACK = 1.0e-9  # fraction of a step by which a tick may miss the end of a range: rounding
_SMALLEST_SPREAD = 1.0e-6  # relative to the values; labels have seven digits
_MARGIN = 0.1  # relative to a constant value, to either side

Range = Tuple[float, float]


def decimal(factor: float, exponent: int) -> float:
    """factor x 10^exponent, rounded as the number is written."""
    if exponent < -300:
        return factor / 10.0**300 / 10.0 ** (-exponent - 300)
    return factor / 10.0**-exponent if exponent < 0 else factor * 10.0**exponent


def shown(values: np.ndarray, logarithmic: bool) -> np.ndarray:
    """The values with NaN for those that an axis cannot show: they interrupt a line."""
    with np.errstate(invalid="ignore"):
        good = np.abs(values) <= MOST
        if logarithmic:
            good &= values >= 1.0 / MOST
    return np.where(good, values, np.nan)


def data_range(rows: Iterable[np.ndarray], logarithmic: bool) -> Range:
    """From the smallest to the largest value that can be shown, with nonzero length."""
    low, high = math.inf, -math.inf
    for row in rows:
        row = shown(row, logarithmic)
        row = row[np.isfinite(row)]
        if len(row):
            low, high = min(low, float(row.min())), max(high, float(row.max()))
    if low > high:
        return (1.0, 10.0) if logarithmic else (0.0, 1.0)
    if logarithmic:
        return (low, high) if high >= 1.02 * low else (low / 1.1, min(1.1 * high, MOST))
    return widened(low, high)


def widened(low: float, high: float) -> Range:
    """Widens a single value by a tenth of it to either side: an axis has a length."""
    largest = max(abs(low), abs(high))
    if largest < LEAST:
        return -1.0, 1.0
    if high - low >= max(_SMALLEST_SPREAD * largest, LEAST):
        return low, high
    margin = max(_MARGIN * largest, LEAST)
    return max(low - margin, -MOST), min(high + margin, MOST)


def _multiples(
    low: float, high: float, factor: float, exponent: int, most: int, inside: bool
) -> List[float]:
    step = decimal(factor, exponent)
    if inside:
        first, last = math.ceil(low / step - _SLACK), math.floor(high / step + _SLACK)
    else:
        first, last = math.floor(low / step + _SLACK), math.ceil(high / step - _SLACK)
    if last - first + 1 > most:
        return []
    return [decimal(i * factor, exponent) for i in range(first, last + 1)]


def linear_ticks(low: float, high: float, most: int, inside: bool = False) -> List[float]:
    """Ticks of a range, at most as many as given (3 or more).

    They are inside the range or cover it: then the first is not above its low end, the last not
    below its high end.
    """
    most = max(most, 3)
    exponent = math.floor(math.log10((high - low) / (most + 1)))
    while True:
        for factor in (1.0, 2.0, 5.0):
            ticks = _multiples(low, high, factor, exponent, most, inside)
            if ticks:
                return ticks
        exponent += 1


def degree_ticks(low: float, high: float, most: int, inside: bool = False) -> List[float]:
    """Of a wide range an eighth, a quarter, a half of a turn apart; of a narrower one 15 or 30."""
    steps = (45.0, 90.0, 180.0, 360.0) if high - low >= 170.0 else (15.0, 30.0, 45.0, 90.0)
    for step in steps:
        ticks = _multiples(low, high, step, 0, most, inside)
        if ticks:
            return ticks if len(ticks) > 2 else linear_ticks(low, high, most, inside)
    return linear_ticks(low, high, most, inside)


def logarithmic_ticks(low: float, high: float, most: int, inside: bool = False) -> List[float]:
    """Powers of ten, with 2 and 5 times them where the range is short."""
    most = max(most, 3)
    if high / low < 5.0:
        return [tick for tick in linear_ticks(low, high, min(most, 6), inside) if tick > 0.0]
    first = math.floor(math.log10(low) + _SLACK)
    last = max(first + 1, math.ceil(math.log10(high) - _SLACK))
    factors = (1.0, 2.0, 5.0) if 3 * (last - first) + 1 <= most else (1.0,)
    stride = next(s for s in (1, 2, 3, 5, 10, 20, 30, 50, 100, 200, 300, 600)
                  if len(factors) == 3 or math.ceil(last / s) - first // s < most)
    ticks = [
        decimal(factor, decade)
        for decade in range(stride * (first // stride), last + stride, stride)
        for factor in factors
    ]
    below = [tick for tick in ticks if tick <= low * (1.0 + _SLACK)]
    above = [tick for tick in ticks if tick >= high * (1.0 - _SLACK)]
    kept = [tick for tick in ticks if below[-1] <= tick <= above[0]]
    if not inside:
        return kept
    return [t for t in kept if low <= t * (1.0 + _SLACK) and t <= high * (1.0 + _SLACK)]


def ticks_of(axis: dict, low: float, high: float, most: int, inside: bool = False) -> List[float]:
    """Ticks of an axis of a request."""
    if axis["logarithmic"]:
        return logarithmic_ticks(low, high, most, inside)
    return (degree_ticks if axis["degrees"] else linear_ticks)(low, high, most, inside)


def superscript(exponent: int) -> str:
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def exponent_of(ticks: Sequence[float]) -> int:
    """The power of ten of an axis: a multiple of 3; 0 where plain numbers are short."""
    largest = max(abs(tick) for tick in ticks)
    if 0.5e-1 <= largest < 1.0e5 or largest == 0.0:
        return 0
    return 3 * math.floor(math.log10(largest) / 3.0 + _SLACK)


def linear_labels(ticks: Sequence[float], exponent: int) -> List[str]:
    """Their labels, to be multiplied by 10^exponent."""
    step = min(b - a for a, b in zip(ticks, ticks[1:])) if len(ticks) > 1 else abs(ticks[0])
    scaled = decimal(step, -exponent)
    decimals = 0 if scaled <= 0.0 else max(0, -math.floor(math.log10(scaled) + 1.0e-6))
    labels = (f"{decimal(tick, -exponent) + 0.0:.{min(decimals, 12)}f}" for tick in ticks)
    return [label.replace("-", "−") for label in labels]


def logarithmic_labels(ticks: Sequence[float]) -> List[str]:
    if min(ticks) >= 0.9e-3 and max(ticks) <= 1.1e4:
        return [f"{tick:g}" for tick in ticks]
    labels = []
    for tick in ticks:
        exponent = math.floor(math.log10(tick) + _SLACK)
        factor = f"{decimal(tick, -exponent):.4g}"
        power = "10" + superscript(exponent)
        labels.append(power if factor == "1" else f"{factor}·{power}")
    return labels


class TickLabels(Formatter):
    """Labels of ticks, divided by the power of ten that the label of the axis names."""

    def __init__(self, logarithmic: bool, exponent: int):
        self.logarithmic, self.exponent = logarithmic, exponent
        self._labels: dict = {}

    def set_locs(self, locs) -> None:
        self.locs = list(locs)
        labels = []
        if self.locs:
            labels = (logarithmic_labels(self.locs) if self.logarithmic
                      else linear_labels(self.locs, self.exponent))
        self._labels = dict(zip(self.locs, labels))

    def __call__(self, value, position=None) -> str:
        return self._labels.get(value, f"{value:g}")

    def format_data_short(self, value) -> str:
        return f"{value:.6g}"


# Units that take a prefix, also as the first of several: N m, m/s, but not m^2.
_PREFIXED = re.compile(r"(?<![^ (])(m|s|N|J|W|Hz|V|A|Pa|rad)(?![\w^²³])")
_PREFIXES = {-9: "n", -6: "µ", -3: "m", 3: "k", 6: "M", 9: "G"}


def scaled_label(label: str, exponent: int) -> str:
    """The label of an axis whose ticks are divided by a power of ten: x (µm), x (10⁻³ kg m)."""
    if exponent == 0:
        return label
    power = "10" + superscript(exponent)
    name, bracket, unit = label.rpartition(" (")
    if not bracket or not unit.endswith(")"):
        return f"{label} ({power})" if " " in label else f"{power} {label}".rstrip()
    first = _PREFIXED.match(unit)
    if first and exponent in _PREFIXES and not (exponent > 0 and first[1] in ("s", "rad")):
        return f"{name} ({_PREFIXES[exponent]}{unit}"
    return f"{name} ({power} {unit}"


def set_axis(axis, fields: dict, label: str, most, length: float, exponent=None) -> None:
    """Ticks, their labels and the label of an axis of a length [px], whose limits are set.

    `most`: number of ticks as a function of the limits; `exponent`: by default that of the ticks.
    """
    axis.set_major_locator(Ticks(fields, most))
    if exponent is None:
        ticks = axis.get_major_locator().tick_values(*axis.get_view_interval())
        exponent = 0 if fields["logarithmic"] or not ticks else exponent_of(ticks)
    axis.set_major_formatter(TickLabels(fields["logarithmic"], exponent))
    if fields["logarithmic"]:
        low, high = sorted(axis.get_view_interval())
        fine = 5.0 <= high / low <= 1.1e6  # the 2nd to 9th parts of its decades
        axis.set_minor_locator(LogLocator(subs=range(2, 10), numticks=99) if fine else NullLocator())
        axis.set_minor_formatter(NullFormatter())
    axis.set_tick_params(which="minor", length=0.0)
    text, size = style.fitted(scaled_label(label, exponent), style.LABEL, length)
    axis.set_label_text(text, size=size * style.PX)


class Ticks(Locator):
    """Ticks of an axis of a request, at most as many as its length allows."""

    def __init__(self, fields: dict, most):
        self.fields = fields
        self.most = most  # a function of the axis' limits
        self.step = None  # of equal scales; None: by the number of ticks

    def __call__(self) -> List[float]:
        return self.tick_values(*self.axis.get_view_interval())

    def tick_values(self, low: float, high: float) -> List[float]:
        low, high = sorted((float(low), float(high)))
        if not (low < high and math.isfinite(high - low)):
            return []
        if self.fields["logarithmic"] and low <= 0.0:
            return []
        most = self.most(low, high)
        if self.step is not None and (high - low) / self.step <= 4 * most:
            first = math.ceil(low / self.step - _SLACK)
            last = math.floor(high / self.step + _SLACK)
            ticks = [i * self.step for i in range(first, last + 1)]
        else:
            ticks = ticks_of(self.fields, low, high, most)
            if not (_same(ticks[0], low, high) and _same(ticks[-1], high, low)):
                ticks = ticks_of(self.fields, low, high, most, True)
        return ticks


def _same(tick: float, end: float, other_end: float) -> bool:
    """Is a tick at an end of the axis?"""
    return abs(tick - end) <= 1.0e-9 * min(abs(end - other_end), max(abs(tick), abs(end)))


def most_across(
    fields: dict, length: float, low: float, high: float, ceiling: int = 9, inside: bool = True
) -> int:
    """As many ticks as their labels have space for along an axis of a length [px]."""
    most = max(3, min(ceiling, int(length / 60.0)))
    while most > 3:
        ticks = ticks_of(fields, low, high, most, inside)
        if not ticks:
            break
        if fields["logarithmic"]:
            labels = logarithmic_labels(ticks)
        else:
            labels = linear_labels(ticks, exponent_of(ticks))
        if (8.3 * max(map(len, labels)) + 14.0) * len(ticks) <= length * 1.15:
            break
        most -= 1
    return most
