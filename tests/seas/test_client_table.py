"""The page from a CSV of seas to a client's table runs as it stands."""

import csv

import pytest
from page_notebook import run_notebook

pytestmark = pytest.mark.long


def test_the_notebook_of_its_page_runs_and_writes_the_table(tmp_path, monkeypatch):
    _, printed = run_notebook("client_table.md", 5, tmp_path, monkeypatch)
    assert "nothing from 2004-01-09T23" in printed
    assert (tmp_path / "client.png").stat().st_size > 5_000
    with (tmp_path / "client.csv").open(encoding="utf-8", newline="") as file:
        rows = {row["mode"]: row for row in csv.DictReader(file)}
    assert list(rows) == ["drilling", "connected"]
    for row in rows.values():
        low, high = map(int, row["range from the response error"].split(" to "))
        assert 0 < low <= int(row["hours a year"]) <= high <= 8766
    assert int(rows["drilling"]["hours a year"]) < int(rows["connected"]["hours a year"])
