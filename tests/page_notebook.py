"""The notebook of a page of the docs, run as it stands."""

import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

ROOT = Path(__file__).parents[1]


def run_notebook(page, blocks, folder, monkeypatch):
    """Run the code of a page in a folder; its cells, and what they print.

    The notebook has one cell for each of so many ``blocks`` of the page, each with the code of its block.
    """
    monkeypatch.syspath_prepend(ROOT / "docs/_extensions")
    text = (ROOT / "docs" / page).read_text("utf-8")
    cells = import_module("notebooks").notebook(ROOT / "docs" / page)["cells"]
    code = [cell["source"] for cell in cells if cell["cell_type"] == "code"]
    written = re.findall(r"```python\n(.*?)\n```", text, re.DOTALL)
    assert len(code) == blocks
    assert all(cell.startswith(block) for cell, block in zip(code, written, strict=True))
    (folder / "config").symlink_to(ROOT / "config")
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", "\n".join(code)], cwd=folder, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return cells, done.stdout
