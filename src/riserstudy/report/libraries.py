"""JavaScript that the page carries along so that it needs no network: plotly and DataTables.

Compressed they are 2.3 of 5.5 MB. itables has DataTables as one file for pages without a network; the page's
tables are plain HTML that it makes sortable, so that they can be read and printed without it.
"""

from __future__ import annotations

import base64
import gzip
from pathlib import Path

import itables
from plotly.offline import get_plotlyjs

DATATABLES = Path(itables.__file__).parent / "html"


def packed(text: str) -> str:
    """Text as page.js unpacks it; the same text gives the same."""
    return base64.b64encode(gzip.compress(text.encode(), mtime=0)).decode()


def libraries(moving: bool) -> dict[str, str]:
    """Packed files by the name under which the page holds them; plotly where something moves."""
    tables = {
        "datatables": packed((DATATABLES / "dt_bundle.js").read_text("utf-8")),
        "datatables-style": packed((DATATABLES / "dt_bundle.css").read_text("utf-8")),
    }
    return tables | ({"plotly": packed(get_plotlyjs())} if moving else {})
