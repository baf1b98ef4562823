"""How printed numbers and claims are graded."""

import csv
import io
import json
from importlib import import_module

import numpy as np
import pytest
import xarray as xr
from invented import dataset, number_row, row, samples

from riserstudy.chapters.derive import derive
from riserstudy.errors import InputError, SimulationError
from riserstudy.grading import verdict_sentences
from riserstudy.grading.grade import Found, _answers, graded
from riserstudy.grading.models import Item
from riserstudy.grading.names import input_name, option_name
from riserstudy.grading.rows import ErratumRow, Row, table
from riserstudy.records.graded import Grounds, Influence

COLUMNS = (
    "paper,id,figure,kind,statement,published,simulated,unit,error,verdict,depends_on,"
    "margin,margin_low,margin_high,note,grounds"
)


def test_a_number_is_reproduced_with_its_error_in_the_row():
    found = number_row({"base": dataset(2.04)})
    assert (found.verdict, found.simulated, found.published) == ("reproduced", 2.04, 2.0)
    assert found.error == pytest.approx(0.02)


def test_a_missed_number_fails_with_its_error():
    found = number_row({"base": dataset(3.0)})
    assert (found.verdict, found.error) == ("fails", 0.5)


def test_a_calibrated_value_anywhere_on_the_path_is_told():
    path = {"base": dataset(2.0, **{"top.tension": "calibrated", "riser": "assumed"})}
    assert number_row(path).verdict == "calibrated"
    assert number_row({"base": dataset(2.0, riser="assumed")}).verdict == "reproduced"


def test_derived_datasets_hand_the_origins_of_their_sources_on(monkeypatch):
    module = import_module("riserstudy.chapters.derive")
    monkeypatch.setattr(module, "function_of", lambda *_: lambda **sources: xr.Dataset())
    sources = {"a": dataset(1.0, x="calibrated", y="assumed"), "b": dataset(1.0, x="assumed")}
    origins = json.loads(derive("chang2020", "invented", sources).attrs["origins"])
    assert origins == {"x": "calibrated", "y": "assumed"}


def test_a_number_met_in_some_samples_depends():
    levers = ["in", "in", "out", "out"] * 4
    space = dataset([2.0, 2.0, 5.0, 5.0] * 4).merge(samples(lever=levers))
    found = number_row({"base": dataset(5.0), "space": space}, over={"runs": "space"})
    assert found.verdict == "depends"
    assert found.depends_on == "lever; met in 8 of 16 samples (50 %)"
    assert found.error == 1.5


def test_a_claim_is_graded_over_its_samples_and_tells_the_base_case():
    options = {"at_least": 3.0}
    space = dataset(np.arange(60.0)).merge(samples(lever=["in"] * 60))
    about = {"kind": "claim", "check": "claim", "with": options, "over": {"runs": "space"}}
    found = row({"base": dataset(5.0), "space": space}, **about)
    assert found.verdict == "holds"
    assert found.note == ("True in 57 of 60 samples (95 %). Base case: the value is 5; the claim is true.")
    beside = row(
        {"base": dataset(4.0), "space": space, "other": dataset(3.0)},
        **about,
        further_cases={"Settled": {"runs": "other"}},
    )
    assert beside.note.endswith(
        "Base case: the value is 4; the claim is true. Settled: the value is 3; the claim is true."
    )


@pytest.mark.parametrize("count", [1, 2, 8, 58, 59, 200])
@pytest.mark.parametrize("base", [True, False])
def test_a_claim_holds_where_its_base_and_enough_samples_are_true(count, base):
    """Of 59 draws that are all true, and not of 58, one may say at 95 % confidence that 95 % are."""
    enough = count >= np.log(0.05) / np.log(0.95)
    space = dataset(np.full(count, 5.0)).merge(samples(lever=["in"] * count))
    about = {"kind": "claim", "check": "claim", "with": {"at_least": 3.0}}
    datasets = {"base": dataset(5.0 if base else 1.0), "space": space}
    found = row(datasets, **about, over={"runs": "space"})
    assert found.verdict == ("holds" if base and enough else "depends")
    share = f"true in {count} of {count} samples"
    if not base:
        assert found.depends_on.startswith(f"the base case; {share}")
    elif not enough:
        assert found.depends_on.startswith(f"too few samples ({count}; at least 59 are needed); {share}")


def test_draws_are_counted_without_the_cells_that_each_is_judged_in():
    quantity = xr.DataArray(np.full((8, 3), 5.0), dims=("sample", "line"))
    space = xr.Dataset({"quantity": quantity.assign_coords(sample=range(8), line=["a", "b", "c"])})
    space = space.assign_attrs(origins="{}").merge(samples(lever=["in"] * 8))
    about = {"kind": "claim", "check": "claim", "with": {"at_least": 3.0}, "over": {"runs": "space"}}
    found = row({"base": dataset(5.0), "space": space}, **about)
    assert (
        found.depends_on
        == "too few samples (8; at least 59 are needed): true with every interpretation (“a”; “b”; “c”)"
    )


def test_all_readings_of_a_grid_are_enough_however_few():
    both = dataset([5.0, 4.0]).rename(sample="reading").assign_coords(reading=["a", "b"])
    about = {"kind": "claim", "check": "claim", "with": {"at_least": 3.0}}
    assert row({"base": both}, **about, base={"reading": "a"}).verdict == "holds"


def test_a_case_of_many_cells_is_told_by_its_range_its_share_and_what_decides():
    levers = ["in", "in", "out", "out"] * 4
    space = dataset([2.0, 2.01, 5.0, 7.0] * 4).merge(samples(lever=levers))
    tuned = {"base": dataset(2.0, **{"top.tension": "calibrated"}), "space": space}
    found = number_row(tuned, further_cases={"Nothing tuned": {"runs": "space"}})
    assert found.verdict == "calibrated"
    told = (
        "Nothing tuned: the values are 2 to 7; the published value is met in 8 of 16 samples (50 %), "
        "depending most on lever."
    )
    assert found.note == told


def test_a_case_of_many_cells_is_told_at_the_base():
    space = dataset([2.0, 5.0]).rename(sample="reading").assign_coords(reading=["a", "b"])
    both = {"base": space, "space": space}
    found = number_row(both, base={"reading": "a"}, further_cases={"Again": {"runs": "space"}})
    assert found.note.endswith("Again: the value is 2; the published value is met.")


def test_a_claim_that_an_option_decides_tells_the_share_under_each():
    models = np.array(["with", "without"] * 8)
    space = dataset(np.where(models == "with", 2.0, 0.0)).merge(samples(model=models))
    about = {"kind": "claim", "check": "claim", "with": {"at_least": 1.0}}
    found = row({"base": dataset(2.0), "space": space}, **about, over={"runs": "space"})
    assert found.verdict == "depends"
    assert "Share of samples true, by model: with 100 %; without 0 %." in found.note


def test_a_paper_may_say_what_its_inputs_are_called():
    models = np.array(["with", "without"] * 8)
    space = dataset(np.where(models == "with", 2.0, 0.0)).merge(samples(model=models))
    about = {"kind": "claim", "check": "claim", "with": {"at_least": 1.0}}
    datasets = {"base": dataset(2.0), "space": space}
    found = row(datasets, **about, over={"runs": "space"}, called={"model": "which model is meant"})
    assert found.depends_on.startswith("which model is meant; true in")
    assert "Share of samples true, by which model is meant: with" in found.note
    assert found.note.startswith("Which model is meant explains")


@pytest.mark.parametrize("word", ["of 2: or 3", "a; b", "e.g. this (5 %)"])
def test_names_of_inputs_may_hold_any_punctuation(word):
    models = np.array(["with; out", "without (3 %)"] * 8)
    space = dataset(np.where(models == "with; out", 2.0, 0.0)).merge(samples(model=models))
    about = {"kind": "claim", "check": "claim", "with": {"at_least": 1.0}}
    datasets = {"base": dataset(2.0), "space": space}
    found = row(datasets, **about, over={"runs": "space"}, called={"model": word})
    (influence,) = Grounds.from_json(found.grounds).decided_by
    assert influence.name == word
    assert influence.by_option == {"with; out": 1.0, "without (3 %)": 0.0}


def test_inputs_and_options_are_told_in_words_and_not_as_paths():
    named = ["current.profile.sum[0].surface_speed", "riser[1].length", "platform_unit", "heave"]
    named += ["riser[0].drag.coefficient", "riser[0].added_mass.diameter"]
    assert [input_name(path) for path in named] == [
        "surface speed of current profile part 1",
        "length of riser section 2",
        "platform unit",
        "heave",
        "drag coefficient of riser section 1",
        "added mass diameter of riser section 1",
    ]
    options = ["None", "from_rest", "along, 1 m/s", "R_1", "power 1/7"]
    assert [option_name(option) for option in options] == [
        "none",
        "from rest",
        "along, 1 m/s",
        "R_1",
        "power 1/7",
    ]


def test_what_cannot_be_compared_says_why():
    found = row({}, kind="claim", reads={}, impossible="the figure has no scale")
    assert (found.verdict, found.note) == ("not reproducible", "the figure has no scale")


def test_a_check_that_finds_no_number_is_an_error():
    with pytest.raises(SimulationError, match="X1"):
        number_row({"base": dataset(float("nan"))})


@pytest.mark.parametrize("check", ["alone", "plain"])
def test_a_check_may_return_the_number_alone(check):
    about = {"kind": "number", "published": 2.0, "unit": "m", "rounding": 0.1}
    ours, theirs = (row({"base": dataset(2.04)}, check=one, **about) for one in ("number", check))
    assert ours == theirs


@pytest.mark.parametrize("check", ["alone", "plain"])
def test_a_number_is_no_answer_to_a_claim(check):
    with pytest.raises(InputError, match=r"X1\.check: .*judged"):
        row({"base": dataset(2.04)}, kind="claim", unit="m", check=check)


def test_the_table_has_the_columns_of_the_contract():
    text = table([number_row({"base": dataset(2.04)})], Row)
    assert text.splitlines()[0] == COLUMNS
    (read,) = csv.DictReader(io.StringIO(text))
    assert (read["published"], read["simulated"], read["depends_on"]) == ("2", "2.04", "")
    assert text.endswith("\n")
    assert table([], ErratumRow) == "paper,id,where,printed,reading,simulation\n"


@pytest.mark.parametrize(
    "premise, told, verdict",
    [
        (120.0, "True in 80 of 80 samples (100 %). 80 of 200 samples meet the premise", "holds"),
        (150.0, "too few samples (50; at least 59 are needed)", "depends"),
        (40.0, "true in 100 of 160 samples (62 %", "depends"),
        (999.0, "None of 200 samples meets the premise of the claim, so no sample is judged", "depends"),
    ],
)
def test_a_claim_is_judged_only_where_what_it_takes_for_granted_is_so(premise, told, verdict):
    """Of samples 0 to 199 those from 100 on are true; the base case, 140, is, too."""
    datasets = {"base": dataset(140.0), "open": dataset(range(200))}
    datasets["open"]["assumed_a"] = ("sample", np.arange(200.0), {"long_name": "a"})
    limits = {"least": 100.0, "premise": premise}
    about = {"kind": "claim", "check": "premised", "over": {"runs": "open"}, "with": limits}
    found = row(datasets, **about)
    assert found.verdict == verdict
    assert told in f"{found.depends_on} {found.note}"


@pytest.mark.parametrize("seed", range(20))
def test_a_claim_does_not_hold_with_fewer_samples_than_enough_however_few_meet_its_premise(seed):
    """All samples are true; a stricter premise is evidence of less."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(2, 150))
    datasets = {"base": dataset(draw.uniform(0.0, 200.0)), "open": dataset(draw.uniform(0.0, 100.0, count))}
    datasets["open"]["assumed_a"] = ("sample", draw.random(count), {"long_name": "a"})
    about = {"kind": "claim", "check": "premised", "over": {"runs": "open"}}
    for premise in (0.0, *draw.uniform(0.0, 110.0, 4), 300.0):
        found = row(datasets, **about, **{"with": {"least": -1.0, "premise": premise}})
        judged = int((datasets["open"]["quantity"] >= premise).sum())
        assert (found.verdict == "holds") == (judged >= 59)
        if judged < 59:
            assert found.depends_on.startswith(f"too few samples ({judged}; at least 59")


@pytest.mark.parametrize(
    "values, told",
    [
        (np.full(128, 9.0), "The first 96 of 128 samples are enough for the verdict at 99 % confidence."),
        (
            np.where(np.arange(128) % 20 == 0, 0.0, 9.0),
            "128 samples are too few for the verdict at 99 % confidence",
        ),
        (np.full(64, 9.0), ""),  # too few to say
    ],
)
def test_a_row_tells_when_its_verdict_was_certain(values, told):
    datasets = {"base": dataset(7.0), "open": dataset(values)}
    datasets["open"]["assumed_a"] = ("sample", np.arange(len(values)) * 1.0, {"long_name": "a"})
    about = {"kind": "claim", "check": "claim", "over": {"runs": "open"}, "with": {"at_least": 5.0}}
    note = row(datasets, **about).note
    assert told in note
    assert bool(told) == ("confidence" in note)


def test_a_claim_whose_check_judges_nothing_is_refused_by_name():
    item = Item.model_construct(id="Q1", check="angle", published=None, rounding=None)
    with pytest.raises(InputError, match="Q1: the check angle does not return"):
        _answers(item, Found(xr.DataArray(1.0)))


@pytest.mark.parametrize("explained, said", [(0.08, "no single input or pair"), (0.5, "the model")])
def test_inputs_that_explain_little_are_not_called_deciding(explained, said):
    influence = Influence("model", "the model", None, {})
    grounds = Grounds(because="inputs", decided_by=[influence], explained=explained)
    assert verdict_sentences.decided_by(grounds) == said


def a_force(values):
    return xr.Dataset({"quantity": (("sample",), values, {"units": "N"})}, attrs={"origins": "{}"})


@pytest.mark.parametrize("unit", ["m", "1", "kN", "%", "N m", "s"])
@pytest.mark.parametrize("check", ["number", "alone"])
def test_a_published_unit_that_is_not_that_of_the_checked_variable_is_refused(unit, check):
    runs = a_force([2.0]).isel(sample=0)
    with pytest.raises(InputError, match=f"X1.unit.*{unit}.*returns 'N'"):
        number_row({"base": runs}, unit=unit, check=check)
    assert number_row({"base": runs}, unit="N", check=check).verdict == "reproduced"
    assert number_row({"base": runs}, unit="kg m s-2", check=check).verdict == "reproduced"


@pytest.mark.parametrize("seed", range(5))
def test_a_ratio_of_two_forces_is_no_force(seed):
    force = np.random.default_rng(seed).uniform(1.0, 9.0, 4)
    about = {"id": "X1", "figure": "1", "statement": "invented", "reads": {"runs": "base"}}
    item = Item(**about, kind="number", published=1.0, rounding=0.1, unit="1", check="ratio")
    checks = {"ratio": lambda runs: runs["quantity"].max() / runs["quantity"].max()}
    found = graded("paper", item, checks.__getitem__, {"base": a_force(force)})
    assert (found.verdict, found.simulated) == ("reproduced", 1.0)


def test_a_check_that_names_the_unit_of_its_result_is_held_to_it():
    about = {"id": "X1", "figure": "1", "statement": "invented", "reads": {"runs": "base"}}
    item = Item(**about, kind="number", published=0.002, rounding=0.001, unit="kN", check="largest")
    checks = {
        "largest": lambda runs: (runs["quantity"].max() / 1e3).assign_attrs(units="kN"),
        "of_another_unit": lambda runs: runs["quantity"].max().assign_attrs(units="N"),
    }
    assert graded("paper", item, checks.__getitem__, {"base": a_force([1.0, 2.0])}).verdict == "reproduced"
    other = item.replaced(check="of_another_unit")
    with pytest.raises(InputError, match="'kN', but the check of_another_unit returns 'N'"):
        graded("paper", other, checks.__getitem__, {"base": a_force([1.0, 2.0])})
