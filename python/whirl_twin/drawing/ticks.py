"""Ticks at multiples of 1, 2 or 5 times a power of ten, one exponent per axis, and axis limits."""

from __future__ import annotations

import math
import re
from typing import Iterable, List, Sequence, Tuple

import numpy as np
from matplotlib.ticker import (Formatter, Locator, LogLocator, MaxNLocator, NullFormatter,
                               NullLocator)

from . import style

MOST = 1.0e300  # beyond it lengths of axes leave the range of double
LEAST = 1.0e-280  # a shorter linear axis cannot be mapped by matplotlib
_SLACK = 1.0e-9  # relative, by which a tick may miss the end of a range: rounding
_SMALLEST_SPREAD = 1.0e-6  # relative to the values; labels have seven digits
_MARGIN = 0.1  # relative to a constant value, to either side
LINEAR = {"logarithmic": False, "degrees": False}

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
    values = np.concatenate([shown(row, logarithmic) for row in rows] or [np.empty(0)])
    values = values[np.isfinite(values)]
    if not len(values):
        return (1.0, 10.0) if logarithmic else (0.0, 1.0)
    low, high = float(values.min()), float(values.max())
    if logarithmic:
        return (low, high) if high >= 1.02 * low else (low / 1.1, min(1.1 * high, MOST))
    largest = max(abs(low), abs(high))
    if largest < LEAST:
        return -1.0, 1.0
    if high - low >= max(_SMALLEST_SPREAD * largest, LEAST):
        return low, high
    margin = max(_MARGIN * largest, LEAST)  # a constant: an axis has a length
    return max(low - margin, -MOST), min(high + margin, MOST)


def linear_ticks(low: float, high: float, most: int) -> List[float]:
    """Ticks that cover a range: the first is not above its low end, the last not below its high one.

    About as many as given, and three or more inside the range.
    """
    locator = MaxNLocator(max(most, 3) - 1, steps=[1, 2, 5, 10], min_n_ticks=3)
    ticks = locator.tick_values(low, high)
    digits = 3 - math.floor(math.log10(ticks[1] - ticks[0]))
    return [round(float(tick), digits) + 0.0 for tick in ticks]  # 0.3, not 0.30000000000000004


def degree_ticks(low: float, high: float, most: int) -> List[float]:
    """Of a wide range an eighth, a quarter, a half of a turn apart; of a narrower one 15 or 30."""
    for step in (45.0, 90.0, 180.0, 360.0) if high - low >= 170.0 else (15.0, 30.0, 45.0, 90.0):
        first, last = math.floor(low / step + _SLACK), math.ceil(high / step - _SLACK)
        if 2 < last - first + 1 <= most:
            return [i * step for i in range(first, last + 1)]
    return linear_ticks(low, high, most)


def logarithmic_ticks(low: float, high: float, most: int) -> List[float]:
    """Powers of ten, with 2 and 5 times them where the range is short."""
    most = max(most, 3)
    if high / low < 5.0 and low > LEAST:
        return [tick for tick in linear_ticks(low, high, min(most, 6)) if tick > 0.0]
    first = math.floor(math.log10(low) + _SLACK)
    last = max(first + 1, math.ceil(math.log10(high) - _SLACK))
    factors = (1.0, 2.0, 5.0) if 3 * (last - first) + 1 <= most else (1.0,)
    stride = next(s for s in (1, 2, 3, 5, 10, 20, 30, 50, 100, 200, 300, 600)
                  if len(factors) == 3 or math.ceil(last / s) - first // s < most)
    ticks = [decimal(factor, decade)
             for decade in range(stride * (first // stride), last + stride, stride)
             for factor in factors]
    start = max(tick for tick in ticks if tick <= low * (1.0 + _SLACK))
    end = min(tick for tick in ticks if tick >= high * (1.0 - _SLACK))
    return [tick for tick in ticks if start <= tick <= end]


def ticks_of(axis: dict, low: float, high: float, most: int, inside: bool = False) -> List[float]:
    """Ticks of an axis of a request: they cover the range, or are those of them inside it."""
    if axis["logarithmic"]:
        ticks = logarithmic_ticks(low, high, most)
    else:
        ticks = (degree_ticks if axis["degrees"] else linear_ticks)(low, high, most)
    slack = 0.0 if axis["logarithmic"] else _SLACK * (high - low)
    return [tick for tick in ticks if not inside or
            low - slack <= tick * (1.0 + _SLACK) and tick * (1.0 - _SLACK) <= high + slack]


def superscript(exponent: int) -> str:
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def exponent_of(ticks: Sequence[float]) -> int:
    """The power of ten of an axis: a multiple of 3; 0 where plain numbers are short."""
    largest = max((abs(tick) for tick in ticks), default=0.0)
    if 0.5e-1 <= largest < 1.0e5 or largest == 0.0:
        return 0
    return 3 * math.floor(math.log10(largest) / 3.0 + _SLACK)


def linear_labels(ticks: Sequence[float], exponent: int) -> List[str]:
    """Their labels, to be multiplied by 10^exponent."""
    step = min((b - a for a, b in zip(ticks, ticks[1:])), default=abs(ticks[0]) if ticks else 0.0)
    scaled = decimal(step, -exponent)
    decimals = 0 if scaled <= 0.0 else max(0, -math.floor(math.log10(scaled) + 1.0e-6))
    labels = (f"{decimal(tick, -exponent) + 0.0:.{min(decimals, 12)}f}" for tick in ticks)
    return [label.replace("-", "−") for label in labels]


def logarithmic_labels(ticks: Sequence[float]) -> List[str]:
    if all(0.9e-3 <= tick <= 1.1e4 for tick in ticks):
        return [f"{tick:g}" for tick in ticks]
    labels = []
    for tick in ticks:
        exponent = math.floor(math.log10(tick) + _SLACK)
        factor = f"{decimal(tick, -exponent):.4g}"
        power = "10" + superscript(exponent)
        labels.append(power if factor == "1" else f"{factor}·{power}")
    return labels


def labels_of(axis: dict, ticks: Sequence[float]) -> Tuple[List[str], int]:
    """Labels of ticks, and the exponent that they are divided by."""
    if axis["logarithmic"]:
        return logarithmic_labels(ticks), 0
    exponent = exponent_of(ticks)
    return linear_labels(ticks, exponent), exponent


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


class Ticks(Locator):
    """Ticks of an axis of a request, at most as many as its length allows."""

    def __init__(self, fields: dict, most):
        self.fields = fields
        self.most = most  # a function of the axis' limits

    def __call__(self) -> List[float]:
        return self.tick_values(*self.axis.get_view_interval())

    def tick_values(self, vmin: float, vmax: float) -> List[float]:
        low, high = sorted((float(vmin), float(vmax)))
        if not 0.0 < high - low < math.inf or self.fields["logarithmic"] and low <= 0.0:
            return []
        return ticks_of(self.fields, low, high, self.most(low, high), True)


class TickLabels(Formatter):
    """Labels of ticks, divided by the power of ten that the label of the axis names."""

    def __init__(self, logarithmic: bool, exponent: int):
        self.logarithmic, self.exponent = logarithmic, exponent

    def format_ticks(self, values) -> List[str]:
        if self.logarithmic:
            return logarithmic_labels(values)
        return linear_labels(list(values), self.exponent)

    def __call__(self, x, pos=None) -> str:
        return f"{x:.6g}"  # of the cursor


def set_axis(axis, fields: dict, label: str, locator: Locator, length: float, exponent=None) -> None:
    """Ticks, their labels and the label of an axis of a length [px], whose limits are set.

    `exponent`: by default that of the ticks.
    """
    axis.set_major_locator(locator)
    if exponent is None:
        exponent = labels_of(fields, locator())[1]
    axis.set_major_formatter(TickLabels(fields["logarithmic"], exponent))
    if fields["logarithmic"]:
        low, high = sorted(axis.get_view_interval())
        fine = 5.0 <= high / low <= 1.1e6  # the 2nd to 9th parts of its decades
        axis.set_minor_locator(LogLocator(subs=range(2, 10), numticks=99) if fine else NullLocator())
        axis.set_minor_formatter(NullFormatter())
    text, size = style.fitted(scaled_label(label, exponent), style.LABEL, length)
    axis.set_label_text(text, size=size * style.PX)


def most_across(
    fields: dict, length: float, low: float, high: float, ceiling: int = 9, inside: bool = True
) -> int:
    """As many ticks as their labels have space for along an axis of a length [px]."""
    for most in range(max(3, min(ceiling, int(length / 60.0))), 3, -1):
        ticks = ticks_of(fields, low, high, most, inside)
        widest = max(map(len, labels_of(fields, ticks)[0]), default=0)
        if (8.3 * widest + 14.0) * len(ticks) <= length * 1.15:
            return most
    return 3
