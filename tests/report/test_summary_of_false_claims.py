"""What the report says of deliberately false claims, and the cases behind a specification curve."""

import csv
import json
import re
import sqlite3

import numpy as np
import pytest
import xarray as xr

from riserstudy.report.curves import FEWEST, _cases, _samples
from riserstudy.report.false_claims import NAME, false_claims

COLUMNS = ("paper", "made_from", "statement", "how", "met", "samples", "verdict", "verdict_of_that",
           "accepted", "subtle")  # fmt: skip


def written(folder, rows):
    with (folder / NAME).open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        table.writerows(rows)
    return false_claims(folder)


def row(verdict="fails", of_that="holds", accepted=0, subtle=0, how="sign", met=3, samples=128, of="C1"):
    return ("paper", of, "it sinks", how, met, samples, verdict, of_that, accepted, subtle)


@pytest.mark.parametrize("count", [1, 20, 150])
def test_without_an_accepted_claim_the_bound_is_that_of_none_among_so_many(count, tmp_path):
    """Clopper and Pearson: 1 - 0.025^(1/n)."""
    said = written(tmp_path, [row()] * count).sentences
    (bound,) = re.findall(r"up to (\d+) %", said)
    assert float(bound) == round(100.0 * (1.0 - 0.025 ** (1.0 / count)))
    assert "accept none" in said
    assert "rate is 0 %" in said


def test_every_kind_of_verdict_is_counted_once(tmp_path):
    rows = [row("holds", accepted=1, subtle=1)] * 2 + [row(of="C2")] * 5
    rows += [row("depends", "fails", subtle=1, of="C3")] * 3
    found = written(tmp_path, rows)
    said = found.sentences
    assert said.startswith(
        "The checks that judge the claims were tested with 10 deliberately false claims. 5 of the false "
        "claims differ only slightly from a claim of a paper. The checks accept 2 of the false claims. "
        "5 false claims fail, "
    )
    assert "and 3 depend on unspecified inputs. The false-positive rate is 20 %" in said
    assert said.endswith(
        "The checks also accept 2 of the 3 original claims, from which the false claims were made."
    )
    assert found.rows[0].share == "3 of 128"
    assert found.rows[0].how == "one sign changed"


@pytest.mark.parametrize("verdict", ["not comparable", "not reproducible"])
def test_a_claim_without_a_grade_does_not_count_as_undecided(verdict, tmp_path):
    rows = [row()] * 2 + [row("depends")] + [row(verdict)] * 3
    said = written(tmp_path, rows).sentences
    assert (
        "2 false claims fail, and 1 depend on unspecified inputs. 3 false claims cannot be graded. The false"
        in said
    )


def test_a_claim_without_samples_has_no_share_and_no_file_has_no_summary(tmp_path):
    assert false_claims(tmp_path) is None
    assert written(tmp_path, []) is None
    assert written(tmp_path, [row(met="", samples="")]).rows[0].share == ""


class Claim:
    paper, id = "paper", "C1"


def database(cases):
    db = sqlite3.connect(":memory:")
    db.execute("create table margins (paper, id, place, base, judged, met, same, margin)")
    rows = [("paper", "C1", json.dumps(place), *others) for place, *others in cases]
    rows += [("paper", "C2", "{}", 1, 1, 1, 0, 0.9), ("other", "C1", "{}", 1, 1, 1, 0, 0.9)]
    db.executemany("insert into margins values (?, ?, ?, ?, ?, ?, ?, ?)", rows)
    return db


@pytest.mark.parametrize("seed", range(5))
def test_each_case_has_the_inputs_of_its_sample_by_number(seed):
    """Samples are a part of all, in any order; cases that are not judged or have no margin are left out."""
    draw = np.random.default_rng(seed)
    numbers = draw.permutation(40)[:12]
    mass = draw.uniform(1.0, 2.0, 12)
    dataset = xr.Dataset(
        {"assumed_mass": ("sample", mass, {"long_name": "riser[0].mass"}), "other": ("sample", mass)},
        {"sample": numbers},
    )
    used = draw.permutation(numbers)[:8]
    cases = [
        ({"sample": int(number), "law": "gas" if k % 2 else "line"}, 0, 1, k % 2, k == 2, 0.1 * k - 0.3)
        for k, number in enumerate(used)
    ]
    left_out = [({"sample": int(numbers[0]), "law": "gas"}, 0, 0, 1, 0, 0.9),
                ({"sample": int(numbers[0]), "law": "gas"}, 0, 1, 1, 0, None)]  # fmt: skip
    base = ({"sample": int(numbers[0]), "law": "gas"}, 1, 0, 1, 0, 0.25)
    found = _cases(
        database([base, *cases, *left_out]), Claim, _samples(dataset), {"riser[0].mass": "the mass"}
    )
    assert found.base == 0.25
    np.testing.assert_allclose(found.margin, 0.1 * np.arange(8) - 0.3)
    assert found.met.tolist() == [False, True] * 4
    assert found.same.tolist() == [k == 2 for k in range(8)]
    by_number = dict(zip(numbers.tolist(), mass, strict=True))
    assert found.inputs["the mass"].tolist() == [by_number[int(number)] for number in used]
    (law,) = (values for name, values in found.inputs.items() if name != "the mass")
    assert law.tolist() == ["line", "gas"] * 4


@pytest.mark.parametrize("count", [FEWEST - 1, FEWEST])
def test_fewer_than_three_cases_have_no_curve(count):
    cases = [({"law": str(k)}, 0, 1, 1, 0, 0.1) for k in range(count)]
    found = _cases(database(cases), Claim, _samples(None), {})
    assert (found is None) == (count < 3)
