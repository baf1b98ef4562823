"""The page from a CSV of seas to a client's table runs as it stands."""

import csv
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_the_notebook_of_its_page_runs_and_writes_the_table(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "docs/_extensions")
    page = ROOT / "docs/client_table.md"
    cells = import_module("notebooks").notebook(page)["cells"]
    code = [cell["source"] for cell in cells if cell["cell_type"] == "code"]
    blocks = re.findall(r"```python\n(.*?)\n```", page.read_text("utf-8"), re.DOTALL)
    assert [cell.startswith(block) for cell, block in zip(code, blocks, strict=True)] == [True] * 5
    (tmp_path / "config").symlink_to(ROOT / "config")
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", "\n".join(code)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert "nothing from 2004-01-09T23" in done.stdout
    assert (tmp_path / "client.png").stat().st_size > 5_000
    with (tmp_path / "client.csv").open(encoding="utf-8", newline="") as file:
        rows = {row["mode"]: row for row in csv.DictReader(file)}
    assert list(rows) == ["drilling", "connected"]
    for row in rows.values():
        low, high = map(int, row["for what is not known of the response"].split(" to "))
        assert 0 < low <= int(row["hours a year"]) <= high <= 8766
    assert int(rows["drilling"]["hours a year"]) < int(rows["connected"]["hours a year"])
