"""Pages: texts, tables and figures in one HTML file that needs no network and no script."""

from __future__ import annotations

import re
from typing import List

from jinja2 import Environment, PackageLoader

from .request import RequestError

# Of a cell that begins like a number: it is aligned to the right.
_NUMBER = re.compile("[-+−±]? ?[0-9]")


def html(page: dict) -> str:
    """The contents of the file of a checked page."""
    figures = 0
    parts = []
    for i, part in enumerate(page["parts"]):
        content = part["content"]
        if part["kind"] == "figure":
            figures += 1
            try:
                content = _inlined(content, figures)
            except RequestError as error:
                raise RequestError(f"page.parts[{i}].{error}") from error
        elif part["kind"] == "table":
            content = {**content, "numeric": _numeric_columns(content)}
        parts.append({"kind": part["kind"], "content": content})
    environment = Environment(
        loader=PackageLoader("whirl_twin.drawing"), autoescape=True, trim_blocks=True,
        lstrip_blocks=True, auto_reload=False)
    environment.tests["numeric"] = _is_numeric
    return environment.get_template("page.html").render({**page, "parts": parts}) + "\n"


def _is_numeric(text: str) -> bool:
    return _NUMBER.match(text) is not None


def _numeric_columns(table: dict) -> List[bool]:
    """Has a column numbers only? Its head is above them."""
    columns = []
    for i in range(len(table["head"])):
        cells = [row[i]["text"] for row in table["rows"] if i < len(row) and row[i]["text"]]
        columns.append(bool(cells) and all(_is_numeric(c) or c in ("–", "—", "-") for c in cells))
    return columns


def _inlined(figure: dict, number: int):
    """The SVG of a figure; its identifiers are its own in the page."""
    from markupsafe import Markup

    from . import _drawn
    from .output import svg

    return Markup(svg(_drawn(figure), f"f{number}-"))
