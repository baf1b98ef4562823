"""A verdict without some points is the verdict of what is left, by the same grader."""

import csv
import io
import json
import sqlite3

import numpy as np
import pytest
import xarray as xr
from some_seeds import seeds

from riserstudy.chapters import derive as chapter
from riserstudy.database.write_papers import _margin
from riserstudy.grading.cases import Sources, regrade
from riserstudy.grading.grade import Found, graded, judged
from riserstudy.grading.margin import above
from riserstudy.grading.models import Item
from riserstudy.grading.rows import table
from riserstudy.records.graded import Case
from riserstudy.report.without_points import cases_of

LINES = ["a chord", "a; b=2", "tangent, line=a chord", "1"]
PUBLISHED = 2.0


def check(name):
    """Checks of an invented paper, over all cells or over the worst of the lines."""

    def looked(runs):
        found = runs["quantity"]
        if name == "least" and "line" in found.dims:
            found = found.min("line")
        return Found(found) if name == "number" else judged(found, above(found, 1.0))

    return looked


def simulated(values, calibrated, **coords):
    """A simulated dataset."""
    return xr.Dataset(
        {"quantity": (tuple(coords), values), "point_key": (tuple(coords), np.full(np.shape(values), "k"))},
        coords,
        {"origins": json.dumps({"riser": "calibrated" if calibrated else "assumed"})},
    )


def drawn(seed):
    """An item and its datasets: of quantities on and about the bounds, with or without fitted values."""
    draw = np.random.default_rng(seed)
    count = int(draw.choice([2, 58, 59, 64, 120]))
    lines = LINES[: draw.integers(1, 5)]
    # 2.02 is met on its bound, 0.999 is a claim missed by little; most are hits
    low, high = ([1.97, 2.03], [2.0, 2.02]) if seed % 2 else ([0.5, 0.999], [1.5, 3.0])
    hit = draw.random((count, len(lines))) < draw.choice([0.02, 0.5, 0.9, 0.97, 1.0])
    values = np.where(hit, draw.choice(high, hit.shape), draw.choice(low, hit.shape))
    fitted = bool(draw.integers(2))
    space = simulated(values, fitted, sample=np.arange(count), line=lines)
    base = simulated(draw.choice([*low, *high, *high]), fitted)
    kind = ["claim", "number"][seed % 2]
    about = {"id": "X1", "figure": "1", "statement": "s", "kind": kind, "reads": {"runs": "base"}}
    about |= {"check": "number", "published": PUBLISHED, "rounding": 0.04} if seed % 2 else {}
    about |= {} if seed % 2 else {"check": ["claim", "least"][seed // 2 % 2]}
    return Item(**about, over={"runs": "space"}), {"base": base, "space": space}, draw


def places(axes, at):
    return [dict(zip(axes, place, strict=True)) for place in at]


@pytest.mark.parametrize("seed", seeds(60, few=20))
def test_without_some_samples_a_verdict_is_that_of_the_others(seed):
    item, datasets, draw = drawn(seed)
    found = graded("paper", item, check, datasets)
    assert regrade(item.kind, found.cases) == found.verdict
    samples = datasets["space"]["sample"].values
    off = draw.choice(samples, draw.integers(1, len(samples)), replace=False).tolist()
    lines = draw.choice(datasets["space"]["line"].values, len(off)).tolist()
    left = datasets | {"space": datasets["space"].drop_sel(sample=off)}
    expected = graded("paper", item, check, left).verdict
    at = [(s, line) for s in off for line in datasets["space"]["line"].values.tolist()]
    if item.check == "least":  # of the worst line: with any of its points the sample is off
        at = [*zip(off, lines, strict=True)]
    drop = {"paper/space": places(("sample", "line"), at)}
    assert regrade(item.kind, found.cases, drop) == expected
    assert regrade(item.kind, found.cases, {"paper/other": places(("sample",), [(0,)])}) == (found.verdict)


@pytest.mark.parametrize("seed", seeds(60, few=20))
def test_a_base_case_that_is_left_out_counts_for_nothing(seed):
    """Its verdict is told where it is the same whether the base is a hit or not."""
    item, datasets, _ = drawn(seed)
    cases = graded("paper", item, check, datasets).cases
    both = {
        graded("paper", item, check, datasets | {"base": simulated(value, fitted)}).verdict
        for value in (2.0, 0.5)
        for fitted in ["calibrated" in datasets["base"].attrs["origins"]]
    }
    anew = regrade(item.kind, cases, {"paper/base": [{}]})
    assert anew == (both.pop() if len(both) == 1 else None)


def test_one_cell_off_leaves_the_other_cells_of_its_sample():
    values = [[2.0, 0.0], [2.0, 2.0]] * 80
    space = simulated(values, False, sample=range(160), line=LINES[1:3])
    about = {"id": "X1", "figure": "1", "statement": "s", "kind": "claim", "check": "claim"}
    item = Item(**about, reads={"runs": "base"}, over={"runs": "space"})
    datasets = {"base": simulated(2.0, False), "space": space}
    cases = graded("paper", item, check, datasets).cases
    assert regrade("claim", cases) == "depends"
    bad = [{"sample": k, "line": LINES[2]} for k in range(0, 160, 2)]
    assert regrade("claim", cases, {"paper/space": bad}) == "holds"
    mistaken = [{"sample": k, "line": LINES[1]} for k in range(0, 160, 2)]
    assert regrade("claim", cases, {"paper/space": mistaken}) == "depends"


def test_what_is_derived_rests_on_the_points_of_its_sources(monkeypatch):
    """Over what is left of the axes: an axis that was reduced picks no points."""
    values = [[2.0, 9.0], [0.0, 9.0]] * 80
    space = simulated(values, False, sample=range(160), line=LINES[:2])
    monkeypatch.setattr(chapter, "function_of", lambda *_: lambda **d: next(iter(d.values())).min("line"))
    once = chapter.derive("paper", "once", {"space": space})
    monkeypatch.setattr(chapter, "function_of", lambda *_: lambda **d: next(iter(d.values())).copy())
    twice = chapter.derive("paper", "twice", {"once": once})
    about = {"id": "X1", "figure": "1", "statement": "s", "kind": "claim", "check": "claim"}
    item = Item(**about, reads={"runs": "base"}, over={"runs": "twice"})
    cases = graded("paper", item, check, {"base": simulated(2.0, False), "twice": twice}).cases
    assert [case.rests_on for case in cases[1:]] == [{"paper/space": ["sample"]}] * 160
    odd = [{"sample": k, "line": LINES[1]} for k in range(1, 160, 2)]
    assert regrade("claim", cases, {"paper/space": odd[1:]}) == "holds"  # one of 81 is false
    assert regrade("claim", cases, {"paper/space": odd[10:]}) == "depends"
    assert regrade("claim", cases, {"paper/space": [{"sample": k} for k in range(160)]}) is None


def test_where_every_case_rests_on_such_a_point_nothing_is_said():
    item = Item(
        **{"id": "X1", "figure": "1", "statement": "s", "kind": "claim", "check": "claim"},
        reads={"runs": "base"},
    )
    cases = graded("paper", item, check, {"base": simulated(2.0, False)}).cases
    assert regrade("claim", cases) == "holds"
    assert regrade("claim", cases, {"paper/base": [{}]}) is None


def test_cases_come_back_from_their_table_as_they_were(tmp_path):
    item, datasets, _ = drawn(4)
    cases = graded("paper", item, check, datasets).cases
    rows = csv.DictReader(io.StringIO(table(cases, Case)))
    db = sqlite3.connect(":memory:")
    db.execute(
        "create table margins (paper, id, place, base, judged, met, same, margin, calibrated, rests_on)"
    )
    db.executemany("insert into margins values (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", map(_margin, rows))
    read = [*cases_of(db, ("paper", "X1"))]
    assert [c.place for c in read] == [c.place for c in cases]
    assert regrade(item.kind, read) == regrade(item.kind, cases)
    assert [(c.base, c.judged, c.met, c.calibrated, c.rests_on) for c in read] == [
        (c.base, c.judged, c.met, c.calibrated, c.rests_on) for c in cases
    ]


def test_an_axis_picks_points_of_a_study_only_where_the_study_has_it_and_the_value():
    """A value that was interpolated or averaged over, or an axis of another study, stands for all points."""
    axes = ({"period": [5.0, 10.0], "amplitude": [1.0, 2.0]}, {"period": [10.0, 20.0]})
    heave, roll = (xr.Dataset({"point_key": (tuple(of), np.full((2,) * len(of), "key"))}, of) for of in axes)
    sources = Sources("mine", {"heave": heave, "roll": roll})
    assert sources.rests_on({"period": 10.0, "amplitude": 2.0}) == {
        "mine/heave": ["period", "amplitude"],
        "mine/roll": ["period"],
    }
    assert sources.rests_on({"period": 20.0, "amplitude": 1.5, "sample": 3}) == {
        "mine/heave": [],
        "mine/roll": ["period"],
    }
