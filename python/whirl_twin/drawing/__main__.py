"""Reads one request (JSON) on standard input and writes its files.

{"drawings": [{"path": ..., "format": "svg" | "png" | "pdf", "figure": {...}},
              {"path": ..., "format": "svg" | "png" | "pdf", "figures": {"first": {...}, ...}},
              {"path": ..., "format": "html", "page": {...}}, ...]}

On failure: one line on standard error, exit status 1.
"""

from __future__ import annotations

import gc
import json
import logging
import sys
import warnings
from typing import Any


def run(request: Any) -> None:
    """Write all files of a request."""
    from . import overlaid, page_html, save
    from .request import RequestError, checked, drawing as one_drawing

    drawings = checked({"drawings": [one_drawing]}, request, "request")["drawings"]
    for i, drawing in enumerate(drawings):
        try:
            if drawing["format"] == "html":
                contents = page_html(drawing["page"])
                with open(drawing["path"], "w", encoding="utf-8", newline="\n") as file:
                    file.write(contents)
            else:
                figure = overlaid(drawing["figures"]) if "figures" in drawing else drawing["figure"]
                save(figure, drawing["path"], drawing["format"])
        except RequestError as error:
            raise RequestError(f"drawings[{i}].{error}") from error


def main() -> int:
    """The exit status."""
    gc.disable()  # a short process: collecting costs a tenth of its time
    # Standard error is for the one line of a failure.
    logging.disable(logging.WARNING)
    warnings.simplefilter("ignore")
    try:
        try:
            request = json.loads(sys.stdin.buffer.read())
        except ValueError as error:
            raise ValueError(f"request: JSON is required, found {error}") from None
        run(request)
    except OSError as error:
        where = error.filename if error.filename is not None else "a file"
        print(f"{where}: cannot be written: {error.strerror or error}", file=sys.stderr)
        return 1
    except Exception as error:  # whatever it is, the caller shows one line
        text = str(error) or type(error).__name__
        if not isinstance(error, (ValueError, RuntimeError)):
            text = f"a figure cannot be drawn: {type(error).__name__}: {text}"
        print(" ".join(text.split()), file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
