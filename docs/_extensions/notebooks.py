"""Pages as notebooks: text and code in cells, pictures as outputs, written next to the page at each build.

A page that holds ``<!-- notebook -->`` is offered as one there.
"""

from __future__ import annotations

import base64
import json
import re
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

MARK = "<!-- notebook -->"
CODE = re.compile(r"```python\n(.*?)```\n", re.DOTALL)
PICTURE = re.compile(r"\s*!\[.*?\]\((\S+\.png)\)\n")
#: shows a picture that the cell has saved, with what matplotlib itself needs
SHOWN = "\nfrom PIL import Image\n\nImage.open({name!r})"


def notebook(page: Path) -> dict[str, Any]:
    """A page as a notebook (nbformat 4.5), to be run in the folder that the page names."""
    text = page.read_text("utf-8").replace(MARK, "")
    cells: list[dict[str, Any]] = []
    end = 0
    for code in CODE.finditer(text):
        cells += _text(text[end : code.start()])
        end = code.end()
        source, outputs = code[1].rstrip("\n"), []
        if picture := PICTURE.match(text, end):
            end = picture.end()
            source += SHOWN.format(name=Path(picture[1]).name)
            outputs = [_output(page.parent / picture[1])]
        cells.append({"cell_type": "code", "source": source, "outputs": outputs, "execution_count": None})
    cells += _text(text[end:])
    for number, cell in enumerate(cells):
        cell |= {"id": f"cell-{number}", "metadata": {}}
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return {"nbformat": 4, "nbformat_minor": 5, "metadata": {"kernelspec": kernel}, "cells": cells}


def _text(text: str) -> list[dict[str, Any]]:
    """A cell of text; none where there is nothing between two of code."""
    return [{"cell_type": "markdown", "source": text.strip()}] if text.strip() else []


def _output(picture: Path) -> dict[str, Any]:
    """A stored picture as a cell has it after a run."""
    data = base64.b64encode(picture.read_bytes()).decode("ascii")
    return {"output_type": "display_data", "data": {"image/png": data}, "metadata": {}}


def link(_app: Sphinx, page: str, source: list[str]) -> None:
    """Offer the notebook on its page."""
    name = f"{page}.ipynb"
    source[0] = source[0].replace(MARK, f'<p><a href="{name}" download>As a notebook ({name})</a></p>')


def write(app: Sphinx, error: Exception | None) -> None:
    """Put the notebooks next to the pages of a site."""
    if error or app.builder.format != "html":
        return
    for page in app.env.found_docs:
        path = Path(app.env.doc2path(page))
        if MARK in path.read_text("utf-8"):
            target = Path(app.outdir, f"{page}.ipynb")
            target.write_text(json.dumps(notebook(path), indent=1), encoding="utf-8")


def setup(app: Sphinx) -> dict[str, bool]:
    """Make notebooks of the pages that are marked."""
    app.connect("source-read", link)
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
