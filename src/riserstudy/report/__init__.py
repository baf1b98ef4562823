"""One page about all results. It contains figures, styles and tables, and needs no network."""

from __future__ import annotations

from pathlib import Path

import jinja2

from riserstudy.files.whole import whole_file
from riserstudy.report.contents import Sources, contents
from riserstudy.report.formats import WORDING
from riserstudy.report.libraries import libraries, packed

FOLDER = Path(__file__).parent
PAGE, STYLE, MOVES = "page.html", "page.css", "page.js"
#: files, besides modules, that the digest of the report includes
DATA_FILES = (
    "page.html",
    "page.css",
    "page.js",
    "macros.html",
    "overview.html",
    "verdicts.html",
    "chapter.html",
    "section.html",
    "audit.html",
)


def write_report(sources: Sources, target: Path) -> None:
    """Write the page, whole or not at all; equal sources give an equal page."""
    target.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(target) as partial:
        partial.write_text(render(sources), "utf-8")


def render(sources: Sources) -> str:
    """Return the page as HTML."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(FOLDER),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters |= WORDING | {"packed": packed}
    page = contents(sources)
    moving = any(chapter.motion for chapter in page["chapters"])
    style, moves = ((FOLDER / name).read_text("utf-8") for name in (STYLE, MOVES))
    page |= {"libraries": libraries(moving=moving), "style": style, "moves": moves}
    return environment.get_template(PAGE).render(page)
