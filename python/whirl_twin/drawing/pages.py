"""Pages: texts, tables and figures in one HTML file that needs no network and no script."""

from __future__ import annotations

import re

from jinja2 import Environment, PackageLoader

# Of a cell that begins like a number: it is aligned to the right.
_NUMBER = re.compile("[-+−±]? ?[0-9]")


def html(page: dict) -> str:
    """The contents of the file of a checked page."""
    figures = 0
    parts = []
    for part in page["parts"]:
        content = part["content"]
        if part["kind"] == "figure":
            figures += 1
            content = _inlined(content, figures)
        parts.append({"kind": part["kind"], "content": content})
    environment = Environment(
        loader=PackageLoader("whirl_twin.drawing"), autoescape=True, trim_blocks=True,
        lstrip_blocks=True, auto_reload=False)
    environment.tests["numeric"] = lambda text: _NUMBER.match(text) is not None
    return environment.get_template("page.html").render({**page, "parts": parts}) + "\n"


def _inlined(figure: dict, number: int):
    """The SVG of a figure; its identifiers are its own in the page."""
    from markupsafe import Markup

    from . import _drawn
    from .output import svg

    return Markup(svg(_drawn(figure), f"f{number}-"))
