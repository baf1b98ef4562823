"""The engine compared with what is known: all of it holds, and what does not is told."""

import re
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

import made_parts
from chapters.numerics import closed_forms as known
from chapters.numerics.measured.validation import validation
from chapters.numerics.report.section import section
from chapters.numerics.report.tables import tables
from riserstudy.study.measured import Setting
from riserstudy.study.read import read_studies

ROOT = Path(__file__).parents[3]
STUDY = read_studies(ROOT / "config", "numerics").measured["validation"]
SETTING = Setting(ROOT / "config", "preview")
sys.path.append(str(ROOT / "tests/verification"))
reference = import_module("reference")  # closed forms of the tests, written apart


@pytest.fixture(scope="module")
def found():
    """The dataset, as the workflow makes it."""
    return validation(STUDY, SETTING)


@pytest.mark.long
def test_every_number_is_within_its_tolerance_of_what_is_known(found):
    bad = found.isel(row=~found["holds"].values)
    assert bad["name"].values.tolist() == []
    assert {*found["kind"].values.tolist()} == {"closed form", "second method", "conservation law"}
    assert found.sizes["row"] > 40
    assert np.isfinite(found["error"]).all()


@pytest.mark.parametrize("kind", ["closed form", "second method", "conservation law"])
def test_the_page_lists_what_is_compared_and_how_closely(found, kind):
    """Numbers of the page are of the standard tier: known values agree to what they are printed to."""
    page = (ROOT / "docs/validation.md").read_text("utf-8")
    mark = f"<!-- made: validation {kind} -->\n"
    stands = page.partition(mark)[2].partition("<!-- end -->")[0].strip().splitlines()
    should = made_parts.known(found, kind).splitlines()
    assert len(stands) == len(should) > 2
    for line, other in zip(stands, should, strict=True):
        told, made = ([cell.strip() for cell in row.split("|")] for row in (line, other))
        assert told[:3] + told[4:] == made[:3] + made[4:]
        if made[3][0].isdigit():
            number, value = (float(cells[3].split()[0]) for cells in (told, made))
            assert number == pytest.approx(value, rel=2e-3)


def test_tolerances_leave_room_for_what_they_say_and_no_more(found):
    whole = found["name"].str.endswith("over the whole run")
    assert float(found["tolerance"].where(~whole).max()) <= 2e-3
    asked = {"displacement": 0.002, "moment": 0.01, "tension": 0.01}  # by default
    for row in np.flatnonzero(whole):
        quantity = str(found["quantity"][row].item()).rpartition(" ")[2]
        assert found["tolerance"][row] == asked[quantity]
    assert (found["because"] != "").all()


def test_an_engine_that_errs_does_not_hold_and_is_named(found, monkeypatch):
    from chapters.numerics import validation_cases as cases

    heavier = {"riser[0].mass": "1010 kg/m"}  # 0.4 %, which the closed form does not know of
    wrong = STUDY.scenes["S4a"].replaced(set=heavier)
    study = STUDY.replaced(scenes=STUDY.scenes | {"S4a": wrong}, stored={})
    monkeypatch.setattr("chapters.numerics.measured.validation.CASES", (cases.taut_beam, cases.cable))
    found = validation(study, SETTING)
    assert found["holds"].values.tolist() == [False, False, True]
    assert float(found["error"][0]) == pytest.approx(0.002, rel=0.02)
    (said,) = section({"validation": found}).sentences
    assert said.startswith("1 of 3 results agree with a known value within the tolerance of the comparison.")
    assert "beam under tension, frequency 1; beam under tension, frequency 5." in said
    (table,) = tables({"validation": found})
    assert [row[8].text for row in table.rows] == ["does not hold", "does not hold", "holds"]


def test_the_page_shows_every_row(found, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "docs/_extensions")
    made = import_module("made_pages")
    monkeypatch.setattr(made, "ROOT", tmp_path)
    made._validated.cache_clear()
    (tmp_path / "results/numerics").mkdir(parents=True)
    found.to_netcdf(tmp_path / "results/numerics/validation.nc")
    kinds = dict(zip(*np.unique(found["kind"], return_counts=True), strict=True))
    for kind, count in kinds.items():
        lines = made.validation(f" {kind}").splitlines()
        assert len(lines) == 2 + count
        assert {line.count("|") for line in lines} == {7}
        assert "does not hold" not in made.validation(kind)
        assert not re.search(r"\de[-+]?\d", made.validation(kind) + made_parts.known(found, kind))
        # and the page has a place for it
        assert f"<!-- made: validation {kind} -->" in (ROOT / "docs/validation.md").read_text("utf-8")
    found.assign(holds=~found["holds"]).to_netcdf(tmp_path / "results/numerics/validation.nc")
    made._validated.cache_clear()
    for kind, count in kinds.items():
        assert made.validation(kind).count("does not hold") == count


def test_closed_forms_are_those_that_the_tests_have_of_their_own():
    ei = reference.EI
    along, across = reference.cantilever_tip(50.0, ei, 324054.15)
    assert known.elastica_tip(50.0, ei, 324054.15) == pytest.approx((along, across), rel=1e-10)
    cable = reference.catenary(np.array([850.0]))
    assert known.elastic_catenary(850.0, 1000.0, 5e8, 700.0, 300.0) == pytest.approx(
        (float(cable.tension[0]), cable.horizontal), rel=1e-10
    )
    w, _, moment = reference.uniform_load(np.array([266.5]), 533.0, 2275e3, ei, 1.0)
    expected = float(w[0]), -float(moment[0])
    assert known.taut_beam_under_load(533.0, 2275e3, ei, 1.0) == pytest.approx(expected, rel=1e-10)
    assert known.self_buckling() == pytest.approx(7.8373, abs=1e-4)  # as printed in textbooks
    beam = 533.0, 2275e3, ei, 1006.0
    even = known.beam_on_varying_tension(533.0, 2275e3, 1e-9, ei, 1006.0, 32)
    assert even == pytest.approx(known.taut_beam_frequency(1, *beam), rel=1e-6)
    work = [known.gas_work(0.1, 150e5, 3.0, 1.4, reach) for reach in (1.999, 2.001)]
    pull = known.gas_pull(0.1, 150e5, 3.0, 1.4, 2.0)
    assert (work[1] - work[0]) / 0.002 == pytest.approx(pull, rel=1e-6)
