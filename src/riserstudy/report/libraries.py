"""JavaScript libraries that the page contains, as it must need no network: plotly and DataTables.

Compressed they need 2.3 of 5.5 MB. The package itables has DataTables as one file for pages without a
network. The tables of the page are plain HTML, which can be read and printed without DataTables; it only
makes them sortable.
"""

from __future__ import annotations

import base64
import gzip
from pathlib import Path

import itables
from plotly.offline import get_plotlyjs

DATATABLES = Path(itables.__file__).parent / "html"


def packed(text: str) -> str:
    """Return a text compressed as page.js needs it; equal texts give equal results."""
    return base64.b64encode(gzip.compress(text.encode(), mtime=0)).decode()


def libraries(moving: bool) -> dict[str, str]:
    """Return the packed files by their names on the page; plotly only if the page has an animation."""
    tables = {
        "datatables": packed((DATATABLES / "dt_bundle.js").read_text("utf-8")),
        "datatables-style": packed((DATATABLES / "dt_bundle.css").read_text("utf-8")),
    }
    return tables | ({"plotly": packed(get_plotlyjs())} if moving else {})
