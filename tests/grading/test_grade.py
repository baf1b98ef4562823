"""How printed numbers and claims are graded."""

import csv
import inspect
import io
import json
from functools import partial
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from riserstudy.chapters.chang2020 import claims as checks
from riserstudy.chapters.derive import derive
from riserstudy.errors import InputError, SimulationError
from riserstudy.grading import words
from riserstudy.grading.grade import Found, _answers, graded
from riserstudy.grading.models import Item, PublishedFile
from riserstudy.grading.names import input_name, option_name
from riserstudy.grading.published import read_published
from riserstudy.grading.rows import ErratumRow, Row, row_of, table
from riserstudy.grading.sensitivity import (
    correlation_ratio,
    deciding,
    shares_by_option,
    total_effects,
)
from riserstudy.grading.verdict import error, met, verdict_of_claim, verdict_of_number
from riserstudy.records.graded import Grounds, Influence
from riserstudy.study.read import read_studies

CONFIG = Path(__file__).parents[2] / "config"
COLUMNS = (
    "paper,id,figure,kind,statement,published,simulated,unit,error,verdict,depends_on,"
    "margin,margin_low,margin_high,note,grounds"
)


def published(paper="chang2020"):
    studies = read_studies(CONFIG, paper)
    return read_published(CONFIG, paper, {*studies.studies, *studies.derived})


# numbers


@pytest.mark.parametrize(
    "simulated, printed, digit, inside",
    [
        (0.35, 0.3, 0.1, True),  # half a unit of the last digit, on the bound
        (0.3500001, 0.3, 0.1, False),
        (0.25, 0.3, 0.1, True),
        (232.6, 232.0, 1.0, True),  # 1 % is the larger bound here
        (234.32, 232.0, 1.0, True),
        (234.33, 232.0, 1.0, False),
        (-3.1, -3.0, 0.1, False),
        (-3.05, -3.0, 0.1, True),
        (0.04, 0.0, 0.1, True),
        (float("nan"), 1.0, 0.1, False),
    ],
)
def test_a_number_is_met_within_half_its_last_digit_or_one_percent(
    simulated, printed, digit, inside
):
    assert met(simulated, printed, digit) is inside


def test_errors_are_relative_unless_zero_was_printed():
    assert error(1.1, 1.0) == pytest.approx(0.1)
    assert error(-1.1, -1.0) == pytest.approx(-0.1)
    assert error(0.2, 0.0) == 0.2


@pytest.mark.parametrize(
    "hit, share, calibrated, verdict",
    [
        (True, None, False, "reproduced"),
        (True, None, True, "calibrated"),
        (False, None, False, "fails"),
        (False, None, True, "fails"),
        (True, 0.95, False, "reproduced"),
        (True, 0.95, True, "calibrated"),
        (True, 0.949, False, "depends"),
        (True, 0.0, False, "depends"),  # a lucky choice
        (False, 0.0, False, "fails"),
        (False, 1 / 180, False, "depends"),  # one reading of many meets it
        (False, 1.0, False, "depends"),
    ],
)
def test_verdicts_of_numbers(hit, share, calibrated, verdict):
    assert verdict_of_number(hit, share, calibrated) == verdict


@pytest.mark.parametrize(
    "share, verdict",
    [(1.0, "holds"), (0.95, "holds"), (0.949, "depends"), (0.051, "depends"), (0.05, "fails")],
)
def test_verdicts_of_claims(share, verdict):
    assert verdict_of_claim(share, calibrated=False) == verdict


def test_a_claim_that_needs_calibrated_values_does_not_hold_by_itself():
    assert verdict_of_claim(1.0, calibrated=True) == "calibrated"
    assert verdict_of_claim(0.0, calibrated=True) == "fails"


def test_a_share_of_nothing_is_no_share():
    with pytest.raises(ValueError, match="no samples"):
        verdict_of_claim(float("nan"), calibrated=False)


# what decides


def samples(**assumed):
    count = len(next(iter(assumed.values())))
    return xr.Dataset(
        {
            f"assumed_{name}": ("sample", values, {"long_name": name.replace("_", ".")})
            for name, values in assumed.items()
        },
        {"sample": np.arange(count)},
    )


def sampled(count=128):
    random = np.random.default_rng(1)
    return random, samples(
        analysis_start=random.choice(["unstretched", "equilibrium"], count),
        heave_phase=[f"{x} deg" for x in random.uniform(0.0, 360.0, count)],
        heave_period=[f"{x} s" for x in random.uniform(10.0, 25.0, count)],
    )


def number(dataset, name):
    return np.array([float(str(value).split()[0]) for value in dataset[name].values])


def test_an_option_that_decides_is_named():
    _, about = sampled()
    outcome = about["assumed_analysis_start"] == "equilibrium"
    found = deciding(outcome, about)
    assert (found.names, found.explained) == (["analysis.start"], 1.0)


def test_a_range_that_decides_is_named_though_its_effect_has_no_direction():
    _, about = sampled()
    phase = number(about, "assumed_heave_phase")
    outcome = xr.DataArray((phase > 90.0) & (phase < 270.0), dims="sample")
    assert deciding(outcome, about).names == ["heave.phase"]


def test_two_inputs_that_decide_only_together_are_both_named():
    _, about = sampled(256)
    late = number(about, "assumed_heave_phase") > 180.0
    outcome = (about["assumed_analysis_start"] == "equilibrium") ^ late
    assert set(deciding(outcome, about).names) == {"analysis.start", "heave.phase"}


def test_an_option_is_not_hidden_by_how_evenly_two_ranges_fill_their_plane():
    """Two samples of a Sobol sequence in a cell of two ranges share the option."""
    levels = np.arange(8)
    a, b = (grid.repeat(2) for grid in np.meshgrid(levels, levels))
    half = (a + b) % 2 == 0  # what the cell knows of the option
    about = samples(
        start=np.where(half, "unstretched", "equilibrium"),
        phase=[f"{x} deg" for x in a + 0.01 * np.arange(128)],
        period=[f"{x} s" for x in b + 0.01 * np.arange(128)[::-1]],
    )
    random = np.random.default_rng(2)
    outcome = xr.DataArray(~half | (random.random(128) > 0.6), dims="sample")
    assert deciding(outcome, about).names[0] == "start"


def test_a_dimension_beside_the_samples_can_decide():
    _, about = sampled(32)
    outcome = xr.DataArray(
        np.tile([True, False], (32, 1)),
        dims=("sample", "compared"),
        coords={"compared": ["as it stands", "from equilibrium"]},
    )
    assert deciding(outcome, about).names == ["compared"]


def test_shares_are_told_by_option_and_not_by_number():
    _, about = sampled(64)
    start, phase = about["assumed_analysis_start"], number(about, "assumed_heave_phase")
    outcome = xr.where((start == "equilibrium") | (phase > 180.0), True, False)
    found = shares_by_option(outcome, about, ["analysis.start", "heave.phase"])
    rest = (phase > 180.0)[start.values == "unstretched"].mean()
    assert found == {"analysis.start": {"equilibrium": 1.0, "unstretched": rest}}


def test_shares_of_a_grid_are_told_by_the_labels_of_its_dimensions():
    outcome = xr.DataArray(
        [[True, False], [True, True]],
        dims=("model", "level"),
        coords={"model": ["gas law", "linear"], "level": [1.0, 2.0]},
    )
    found = shares_by_option(outcome, xr.Dataset(), ["model", "level"])
    assert found == {"model": {"gas law": 0.5, "linear": 1.0}}


def test_nothing_decides_what_never_changes():
    _, about = sampled(16)
    assert deciding(xr.ones_like(about["sample"], bool), about).names == []


@pytest.mark.parametrize("count", [16, 128])
def test_pure_chance_is_not_explained(count):
    random, about = sampled(count)
    outcome = xr.DataArray(random.random(count) > 0.5, dims="sample")
    found = deciding(outcome, about)
    assert (found.names, found.explained) == ([], 0.0)


def test_correlation_ratios_run_from_nothing_to_all():
    outcome = np.array([0.0, 0.0, 1.0, 1.0] * 4)
    assert correlation_ratio(outcome, np.array([0, 0, 1, 1] * 4)) == 1.0
    assert correlation_ratio(outcome, np.array([0, 1, 0, 1] * 4)) == 0.0


def test_total_effects_of_a_grid_count_interactions():
    both = np.array([[True, False], [False, True]])
    outcome = xr.DataArray(both[..., None].repeat(3, 2), dims=("one", "other", "idle"))
    assert total_effects(outcome) == {"one": 1.0, "other": 1.0, "idle": 0.0}
    assert set(deciding(outcome, xr.Dataset()).names) == {"one", "other"}


# rows


class Checks:
    """Checks of an invented paper."""

    @staticmethod
    def number(runs):
        return Found(runs["quantity"])

    @staticmethod
    def claim(runs, at_least):
        return Found(runs["quantity"], runs["quantity"] >= at_least)

    @staticmethod
    def premised(runs, least, premise):
        return Found(runs["quantity"], runs["quantity"] >= least, runs["quantity"] >= premise)


def dataset(quantity, **origins):
    values = np.asarray(quantity, float)
    dims = ("sample",)[: values.ndim]
    return xr.Dataset({"quantity": (dims, values)}, attrs={"origins": json.dumps(origins)})


def row(datasets, called=None, **about):
    fields = {"id": "X1", "figure": "1", "statement": "invented", "reads": {"runs": "base"}}
    item = Item(**(fields | about))
    return row_of(graded("paper", item, partial(getattr, Checks), datasets, called))


def number_row(datasets, **about):
    about = {"kind": "number", "published": 2.0, "rounding": 0.1, "check": "number"} | about
    return row(datasets, **about)


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
    assert found.note == "True in 57 of 60 samples (95 %). Base case: 5, true."
    beside = row(
        {"base": dataset(4.0), "space": space, "other": dataset(3.0)},
        **about,
        beside={"Settled": {"runs": "other"}},
    )
    assert beside.note.endswith("Base case: 4, true. Settled: 3, true.")


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
        assert found.depends_on.startswith(f"too few samples ({count} of 59); {share}")


def test_draws_are_counted_without_the_cells_that_each_is_judged_in():
    quantity = xr.DataArray(np.full((8, 3), 5.0), dims=("sample", "line"))
    space = xr.Dataset({"quantity": quantity.assign_coords(sample=range(8), line=["a", "b", "c"])})
    space = space.assign_attrs(origins="{}").merge(samples(lever=["in"] * 8))
    about = {
        "kind": "claim",
        "check": "claim",
        "with": {"at_least": 3.0},
        "over": {"runs": "space"},
    }
    found = row({"base": dataset(5.0), "space": space}, **about)
    assert found.depends_on == "too few samples (8 of 59): true with every interpretation (a; b; c)"


def test_all_readings_of_a_grid_are_enough_however_few():
    both = dataset([5.0, 4.0]).rename(sample="reading").assign_coords(reading=["a", "b"])
    about = {"kind": "claim", "check": "claim", "with": {"at_least": 3.0}}
    assert row({"base": both}, **about, base={"reading": "a"}).verdict == "holds"


def test_a_case_of_many_cells_is_told_by_its_range_its_share_and_what_decides():
    levers = ["in", "in", "out", "out"] * 4
    space = dataset([2.0, 2.01, 5.0, 7.0] * 4).merge(samples(lever=levers))
    tuned = {"base": dataset(2.0, **{"top.tension": "calibrated"}), "space": space}
    found = number_row(tuned, beside={"Nothing tuned": {"runs": "space"}})
    assert found.verdict == "calibrated"
    told = "Nothing tuned: 2 to 7, met in 8 of 16 samples (50 %), decided by lever."
    assert found.note == told


def test_a_case_of_many_cells_is_told_at_the_base():
    space = dataset([2.0, 5.0]).rename(sample="reading").assign_coords(reading=["a", "b"])
    both = {"base": space, "space": space}
    found = number_row(both, base={"reading": "a"}, beside={"Again": {"runs": "space"}})
    assert found.note.endswith("Again: 2, met.")


def test_a_claim_that_an_option_decides_tells_the_share_under_each():
    models = np.array(["with", "without"] * 8)
    space = dataset(np.where(models == "with", 2.0, 0.0)).merge(samples(model=models))
    about = {"kind": "claim", "check": "claim", "with": {"at_least": 1.0}}
    found = row({"base": dataset(2.0), "space": space}, **about, over={"runs": "space"})
    assert found.verdict == "depends"
    assert "True by model: with (100 %); without (0 %)." in found.note


def test_a_paper_may_say_what_its_inputs_are_called():
    models = np.array(["with", "without"] * 8)
    space = dataset(np.where(models == "with", 2.0, 0.0)).merge(samples(model=models))
    about = {"kind": "claim", "check": "claim", "with": {"at_least": 1.0}}
    datasets = {"base": dataset(2.0), "space": space}
    found = row(datasets, **about, over={"runs": "space"}, called={"model": "which model is meant"})
    assert found.depends_on.startswith("which model is meant; true in")
    assert "True by which model is meant: with" in found.note
    assert found.note.startswith("Which model is meant explains")


def test_an_input_is_not_called_nothing():
    item = {"id": "C1", "figure": "1", "kind": "claim", "statement": "s", "impossible": "no scale"}
    with pytest.raises(ValueError, match="called"):
        PublishedFile(paper="p", items=[item], called={"model": ""})


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


def test_the_table_has_the_columns_of_the_contract():
    text = table([number_row({"base": dataset(2.04)})], Row)
    assert text.splitlines()[0] == COLUMNS
    (read,) = csv.DictReader(io.StringIO(text))
    assert (read["published"], read["simulated"], read["depends_on"]) == ("2", "2.04", "")
    assert text.endswith("\n")
    assert table([], ErratumRow) == "paper,id,where,printed,reading,simulation\n"


# the data


@pytest.mark.parametrize(
    "about, fault",
    [
        ({"published": None, "rounding": None}, "every number has a printed value"),
        ({"rounding": None}, "rounding"),
        ({"check": None, "reads": {}}, "one of check, impossible and not_comparable"),
        ({"reads": {}}, "check and reads"),
        ({"over": {"other": "space"}}, "same arguments"),
        ({"beside": {"Settled": {"other": "space"}}}, "same arguments"),
        ({"rounding": 0.0}, "greater than 0"),
        ({"colour": "red"}, "Extra inputs"),
    ],
)
def test_data_that_cannot_be_meant_are_refused(about, fault):
    with pytest.raises(ValueError, match=fault):
        number_row({"base": dataset(2.0)}, **about)


def test_a_published_file_names_its_fault(tmp_path):
    (tmp_path / "published").mkdir()
    path = tmp_path / "published/paper.yaml"
    one = "{id: X1, figure: '1', kind: claim, statement: s, check: c, reads: {runs: base}}"
    path.write_text(f"paper: paper\nitems: [{one}, {one}]\n")
    with pytest.raises(InputError, match="'X1' stands twice"):
        read_published(tmp_path, "paper", {"base"})
    path.write_text(f"paper: paper\nitems: [{one}]\n")
    with pytest.raises(InputError, match="no dataset 'base'; allowed are other"):
        read_published(tmp_path, "paper", {"other"})


def test_every_check_exists_and_takes_what_it_is_given():
    file = published()
    known = {item.id for item in file.items}
    assert {f"A{k}" for k in range(1, 17)} - {"A10"} <= known  # A10 is part of A8
    for entry in (*file.items, *file.errata):
        if entry.check:
            function = getattr(checks, entry.check)
            inspect.signature(function).bind(**entry.reads, **entry.options)


@pytest.mark.parametrize("paper", ["chang2020", "fem_riser", "liu2017", "liu2020", "mao_hangoff"])
def test_the_base_of_a_claim_is_in_every_tier(paper):
    studies = read_studies(CONFIG, paper).studies.values()
    thinned = [
        (name, axis.preview)
        for study in studies
        for name, axis in study.axes.items()
        if getattr(axis, "preview", None)
    ]
    for item in published(paper).items:
        for name, value in (item.base or {}).items():
            for axis, values in thinned:
                assert axis != name or value in values, (
                    f"{item.id}: {name} {value} is not in preview"
                )


@pytest.mark.parametrize(
    "premise, told, verdict",
    [
        (
            120.0,
            "True in 80 of 80 samples (100 %). "
            "Judged where what it takes for granted is so: 80 of 200",
            "holds",
        ),
        (150.0, "too few samples (50 of 59)", "depends"),
        (40.0, "true in 100 of 160 samples (62 %", "depends"),
        (999.0, "is so in none of 200 samples; judged by the base case", "holds"),
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


@pytest.mark.parametrize(
    "values, told",
    [
        (np.full(128, 9.0), "Settled at 99 % confidence by the first 96 samples."),
        (
            np.where(np.arange(128) % 20 == 0, 0.0, 9.0),
            "Near a bound: 128 samples leave the verdict open",
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
    with pytest.raises(InputError, match="Q1: angle judges no claim"):
        _answers(item, Found(xr.DataArray(1.0)))


@pytest.mark.parametrize("explained, said", [(0.08, "no single input or pair"), (0.5, "the model")])
def test_inputs_that_explain_little_are_not_called_deciding(explained, said):
    influence = Influence("model", "the model", None, {})
    grounds = Grounds(because="inputs", decided_by=[influence], explained=explained)
    assert words.decided_by(grounds) == said
