"""Verdicts, their cases and the datasets of their checks are in the columns that are named after them."""

import json
from pathlib import Path

import numpy as np
import pytest
import workspace
from ruamel.yaml import YAML

from riserstudy import query
from riserstudy.files.csv_files import read_csv
from riserstudy.records.graded import Grounds, Share

NUMBERS = ("published", "simulated", "error", "margin", "margin_low", "margin_high")
TEXTS = ("paper", "id", "figure", "kind", "statement", "unit", "verdict", "note")
FLAGS = ("base", "judged", "met", "same", "calibrated")
CLAIMS = (
    "def claim(**runs):\n    return runs\n\n\ndef one(a):\n    return a\n\n\ndef two(a, b):\n    return a\n"
)


def number(text):
    """A cell of a table; None where it is blank."""
    return float(text) if text else None


def drawn(draw, row):
    """A row of the table of verdicts with other numbers."""
    samples = int(draw.integers(2, 300))
    low, high = np.sort(draw.random(2)).tolist()
    share = Share(int(draw.integers(0, samples + 1)), samples, samples, low, high)
    grounds = Grounds(share=share if draw.random() < 0.8 else None, because="inputs")
    cells = {name: repr(float(draw.normal())) if draw.random() < 0.8 else "" for name in NUMBERS}
    return share if grounds.share else None, row | cells | {"grounds": grounds.to_json()}


def null(values):
    """A row of an answer with None for what is missing."""
    return [None if value != value else value for value in values]


@pytest.mark.parametrize("seed", range(4))
def test_every_number_of_a_verdict_and_of_its_cases_has_its_own_column(mine, seed):
    draw = np.random.default_rng(seed)
    first, *_ = read_csv(workspace.RESULTS / "reproduction.csv")
    rows = [drawn(draw, first | {"id": f"A{k}", "note": f"note {k}"}) for k in range(6)]
    workspace._write("reproduction", [row for _, row in rows])
    blank = {"paper": "plain", "id": "A1", "rests_on": "{}"}
    cases = [
        blank
        | {name: str(int(draw.integers(2))) for name in FLAGS}
        | {"place": json.dumps({"sample": k}), "margin": repr(float(draw.normal()))}
        for k in range(12)
    ]
    cases[3]["met"] = cases[3]["margin"] = ""
    workspace._write("margins", cases)
    workspace.built()
    for share, row in rows:
        (found,) = query("select * from numbers_and_claims where id = ?", [row["id"]]).to_dict("records")
        found = dict(zip(found, null(found.values()), strict=True))
        assert {name: found[name] for name in TEXTS} == {name: row[name] for name in TEXTS}
        assert {name: found[name] for name in NUMBERS} == {name: number(row[name]) for name in NUMBERS}
        own = [found[name] for name in ("share_low", "share_high", "met", "samples")]
        assert own == ([share.low, share.high, share.met, share.samples] if share else [None] * 4)
        assert found["share"] == (share and share.met / share.samples)
    for case in cases:
        (found,) = query("select * from margins where place = ?", [case["place"]]).to_dict("records")
        found = dict(zip(found, null(found.values()), strict=True))
        wanted = {name: number(case[name]) for name in (*FLAGS, "margin")}
        assert {name: found[name] for name in wanted} == wanted


@pytest.mark.parametrize("seed", range(4))
def test_numbers_claims_and_errata_rest_on_the_datasets_of_their_checks(mine, seed):
    """On those of the base case, and on those over the unspecified inputs; each once."""
    draw = np.random.default_rng(seed)
    names = ["surge", "meshes", "sampled", "one", "static", "swing"]
    Path("chapters/plain/claims.py").write_text(CLAIMS)
    items, errata, expected = [], [], set()
    for k in range(8):
        count = int(draw.integers(1, 3))
        reads = dict(zip("ab", draw.choice(names, count).tolist(), strict=False))
        entry = {"id": f"{'E' if k % 2 else 'A'}{k}", "check": ("one", "two")[count - 1], "reads": reads}
        used = {*reads.values()}
        if k % 2:
            errata.append(entry | {"where": "p. 1", "printed": "a", "reading": "b"})
        else:
            if draw.random() < 0.5:
                entry["over"] = dict(zip(reads, draw.choice(names, count).tolist(), strict=True))
                used |= {*entry["over"].values()}
            items.append(entry | {"figure": "3", "kind": "claim", "statement": "it moves"})
        expected |= {("plain", entry["id"], f"plain/{name}") for name in used}
    Path("config/published").mkdir()
    YAML().dump({"paper": "plain", "items": items, "errata": errata}, Path("config/published/plain.yaml"))
    workspace.built()
    found = query("select paper, id, study from rests_on")
    assert {*found.itertuples(index=False, name=None)} == expected
    assert len(found) == len(expected)
