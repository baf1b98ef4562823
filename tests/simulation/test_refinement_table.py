"""The page on measured accuracy shows a refinement as it is."""

import re
from itertools import pairwise
from pathlib import Path

import pytest

from riserstudy import load_scene
from riserstudy.simulation.refine import run

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/measured_accuracy.md").read_text("utf-8")
ROW = re.compile(
    r"^\| (?P<run>\d+) \| (?P<halved>mesh|step|) ?\| (?P<elements>\d+) \| (?P<step>[\d.]+) "
    r"\| (?P<iterations>\d+) \|$",
    re.M,
)


def test_the_table_of_one_refinement_is_what_its_scene_does():
    table = PAGE.partition("## Example of a refinement")[2].partition("\n## ")[0]
    rows = [found.groupdict() for found in ROW.finditer(table)]
    facts = run(load_scene(ROOT / "config/scenes/bench/s2c.yaml").resolved()).facts["refinements"]
    assert [int(row["run"]) for row in rows] == [*range(1, len(facts) + 1)]
    for row, fact in zip(rows, facts, strict=True):
        assert (int(row["elements"]), float(row["step"])) == (fact["elements"], fact["step"])
        # which depend on rounding, and so on the processor
        assert int(row["iterations"]) == pytest.approx(fact["newton_iterations"], rel=0.02)
    for (before, now), row in zip(pairwise(facts), rows[1:], strict=True):
        mesh, step = now["elements"] / before["elements"], before["step"] / now["step"]
        assert (mesh, step) == ((2, 1) if row["halved"] == "mesh" else (1, 2))
