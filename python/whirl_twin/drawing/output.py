"""Files of a figure: SVG, PNG and PDF. The same figure gives the same bytes."""

from __future__ import annotations

import io
import re
from html import escape

from . import style
from .thinning import thin

_PNG_DPI = 144


def image(figure, format: str) -> bytes:
    """The contents of a file."""
    if format == "svg":
        return svg(figure).encode("utf-8")
    file = io.BytesIO()
    title = figure.whirl_twin_title
    with style.context():
        if format == "pdf":
            thin(figure, style.DPI, False)
            figure.savefig(file, format="pdf", dpi=_PNG_DPI, metadata={
                "Title": title, "Creator": "whirl_twin", "CreationDate": None})
        else:
            thin(figure, _PNG_DPI, True)
            figure.savefig(file, format="png", dpi=_PNG_DPI, metadata={
                "Title": title, "Software": None})
    return file.getvalue()


def svg(figure, prefix: str = "") -> str:
    """An SVG document; its identifiers begin with `prefix`, so that a page can hold several."""
    file = io.StringIO()
    with style.context():
        thin(figure, style.DPI, False)
        figure.savefig(file, format="svg", dpi=_PNG_DPI, metadata={"Date": None, "Creator": None})
    text = file.getvalue()
    text = text[text.index("<svg") :]
    # matplotlib writes six decimals (of 1/72 inch) and a style rule for all elements of a page.
    text = re.sub(r' d="[^"]*"', lambda d: re.sub(r"(\.\d\d)\d+", r"\1", d.group()), text)
    text = re.sub(r"\s*<defs>\s*<style[^>]*>[^<]*</style>\s*</defs>", "", text)
    text = re.sub(r"\s*<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->\n?", "", text, flags=re.DOTALL)
    used = set(re.findall(r'(?:href="#|url\(#)([^")]+)', text))
    text = re.sub(
        r' id="([^"]*)"',
        lambda name: f' id="{prefix}{name.group(1)}"' if name.group(1) in used else "", text)
    text = re.sub(r'(href="#|url\(#)', lambda start: start.group() + prefix, text)
    head, body = text.split(">", 1)
    title, description = figure.whirl_twin_title, figure.whirl_twin_description
    return (
        f'{head} role="img" style="stroke-linejoin:round;stroke-linecap:butt">'
        + (f"\n<title>{escape(title, quote=False)}</title>" if title else "")
        + f"\n<desc>{escape(description, quote=False)}</desc>{body}"
    )

