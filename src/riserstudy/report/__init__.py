"""One page about all results that opens without a network: figures, styles and tables are in it."""

from __future__ import annotations

import base64
import os
from pathlib import Path

import jinja2

from riserstudy.report.contents import Sources, contents
from riserstudy.report.libraries import libraries, packed
from riserstudy.report.wording import WORDING


def write_report(sources: Sources, target: Path) -> None:
    """Write the page, whole or not at all. The same files give the same page."""
    target.parent.mkdir(parents=True, exist_ok=True)
    partial = target.with_name(f".{target.name}.{os.getpid()}")
    partial.write_text(render(sources), "utf-8")
    partial.replace(target)


def render(sources: Sources) -> str:
    """The page as HTML."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters |= WORDING | {"embedded": embedded, "packed": packed}
    moves = (Path(__file__).parent / "page.js").read_text("utf-8")
    page = contents(sources)
    page |= {"libraries": libraries(moving=bool(page["motions"])), "moves": moves}
    return environment.get_template("page.html").render(page)


def embedded(image: Path) -> str:
    """A PNG as the address of an image."""
    return "data:image/png;base64," + base64.b64encode(image.read_bytes()).decode()
