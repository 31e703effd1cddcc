"""Several figures of the same axes in one: two runs, two systems, a measurement over its model."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, Tuple

from .request import RequestError, figure as checked_figure


def overlaid(figures: Mapping[str, Mapping[str, Any]]) -> Dict[str, Any]:
    """As whirl_twin.drawing.overlaid()."""
    named = [(name, checked_figure(one, name)) for name, one in figures.items()]
    if not named:
        raise RequestError("figures: one figure or more is required, found none")
    first_name, first = named[0]
    for name, one in named:
        if one["kind"] != "charts":
            raise RequestError(f"{name}: charts are required, found a figure of kind {one['kind']}")
        for what, of in (("charts", len), ("axes", _axes)):
            if of(one["charts"]) != of(first["charts"]):
                raise RequestError(f"{name}: {what} as in {first_name} are required, found others: "
                                   f"{of(one['charts'])} and {of(first['charts'])}")
    charts = [_together([(name, one["charts"][i]) for name, one in named])
              for i in range(len(first["charts"]))]
    return {**first, "charts": charts, "title": " and ".join(dict.fromkeys(
        one["title"] for _, one in named if one["title"]))}


def _axes(charts: List[Dict[str, Any]]) -> List[Tuple[str, str]]:
    return [(chart["x"]["label"], chart["y"]["label"]) for chart in charts]


def _together(charts: List[Tuple[str, Dict[str, Any]]]) -> Dict[str, Any]:
    from . import style
    from .charts import pen_of

    series = []
    for k, (name, chart) in enumerate(charts):
        alone = sum(bool(len(one["x"])) for one in chart["series"]) == 1
        for i, one in enumerate(chart["series"]):
            pen = dict(pen_of(one, i))
            if k > 0:
                color = style.PALETTE[k % len(style.PALETTE)] if alone else pen["color"]
                pen.update(color=color, dash=style.DASHES[k % len(style.DASHES)])
            text = ", ".join(part for part in (name, "" if alone else one["name"]) if part)
            series.append({**one, "pen": pen, "name": text if alone or one["name"] else ""})
    return {**charts[0][1], "series": series}
