"""What a check finds is believed where it does not contradict itself; a missing value answers nothing."""

import numpy as np
import pytest
import xarray as xr
from some_seeds import seeds

from riserstudy.errors import InputError, SimulationError
from riserstudy.grading.cases import regrade
from riserstudy.grading.grade import Found, graded, judged
from riserstudy.grading.margin import below
from riserstudy.grading.models import Item
from riserstudy.grading.published import read_published
from riserstudy.grading.rows import row_of
from riserstudy.grading.verdict import met
from riserstudy.study.read import read_studies

CLAIM = {"id": "C1", "figure": "1", "kind": "claim", "statement": "s", "check": "said"}
NUMBER = CLAIM | {"kind": "number", "published": 100.0, "rounding": 1.0}
COUNT = 200


def runs(values):
    dims = ("sample",)[: np.ndim(values)]
    return xr.Dataset({"quantity": (dims, values)}, {"sample": range(len(values))} if dims else {})


def row(check, values, about):
    """A number or claim with a base case of 100 and samples of these values, by a check of a quantity."""
    item = Item(**about, reads={"runs": "base"}, over={"runs": "space"})
    datasets = {"base": runs(100.0), "space": runs(values)}
    return graded("own", item, lambda _: lambda runs: check(runs["quantity"]), datasets)


def said(found):
    """How many of the samples are met, as the row tells it."""
    return f"{row_of(found).depends_on} {row_of(found).note}".lower()


def over_samples(truth, margins):
    """A check that says this of samples, and is true of the base case."""

    def check(value):
        if not value.ndim:
            return Found(value, value < 150.0, None, 150.0 - value)
        return Found(value, value.copy(data=truth), None, value.copy(data=margins))

    return check


@pytest.mark.parametrize("about", [CLAIM, NUMBER], ids=["claim", "number"])
@pytest.mark.parametrize("seed", seeds(40, few=20))
def test_a_missing_value_is_neither_yes_nor_no(seed, about):
    """The verdict is that of the other samples, or depends where the missing ones could turn it."""
    draw = np.random.default_rng(seed)
    hit = draw.random(COUNT) < draw.choice([0.0, 0.03, 0.5, 0.97, 1.0])
    values = np.where(hit, 100.0, 300.0)
    off = draw.random(COUNT) < draw.choice([0.01, 0.1, 0.9])
    off[draw.integers(COUNT)] = True
    off[draw.integers(COUNT)] = False
    check = lambda value: judged(value, 150.0 - value)  # noqa: E731
    found = row(check, np.where(off, np.nan, values), about)
    others = values[~off]
    alone = row(check, others, about)
    could = {
        row(check, np.where(off, way, values), about).verdict for way in (100.0, 300.0)
    }  # were all that is missing hits, or none of it
    assert found.verdict == (alone.verdict if could == {alone.verdict} else "depends")
    share = found.grounds.share
    assert (share.met, share.samples) == ((others == 100.0).sum(), others.size)
    are = "is" if off.sum() == 1 else "are"
    assert f"{off.sum()} of {COUNT} cases {are} left out, because" in said(found)
    assert [case.met for case in found.cases if case.met is None] == [None] * off.sum()
    assert not any(case.judged for case in found.cases if case.met is None)
    assert regrade(found.kind, found.cases) == found.verdict


@pytest.mark.parametrize("margin", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("seed", range(10))
def test_a_margin_that_is_no_finite_number_is_no_answer(seed, margin):
    """Of 223 samples without an error estimate none is a sample whose error is too large."""
    off = np.random.default_rng(seed).random(COUNT) < 0.6
    margins = np.where(off, margin, 0.5)
    check = over_samples(margins > 0.0, margins)
    found = row(check, np.full(COUNT, 100.0), CLAIM)
    assert found.verdict == "depends"
    assert f"{off.sum()} cases without a result" in said(found)
    assert f"true in {COUNT - off.sum()} of {COUNT - off.sum()} samples" in said(found)


@pytest.mark.parametrize("missing", ["value", "margin"])
def test_a_base_without_an_answer_stops_the_grading(missing):
    def check(value):
        if value.ndim:
            return judged(value, 150.0 - value)
        return judged(value * (np.nan if missing == "value" else 1.0), value * np.nan)

    with pytest.raises(SimulationError, match="own/C1: the check said returns no"):
        row(check, np.full(COUNT, 100.0), CLAIM)


def test_where_nothing_is_found_in_any_sample_the_grading_stops():
    with pytest.raises(SimulationError, match="returns no result in any case"):
        row(lambda value: judged(value, 150.0 - value), np.full(COUNT, np.nan), CLAIM)


def test_what_never_comes_is_an_answer():
    """Two limits that are never reached: neither comes first, which is false and not missing."""
    check = lambda value: judged(value.clip(max=9.0), below(value, np.inf))  # noqa: E731
    found = row(check, np.full(COUNT, np.inf), CLAIM)
    assert (found.grounds.share.met, found.grounds.share.samples) == (0, COUNT)
    assert found.grounds.missing is None


@pytest.mark.parametrize("says", [True, False])
@pytest.mark.parametrize("seed", range(5))
def test_a_check_that_contradicts_its_margin_is_refused(seed, says):
    draw = np.random.default_rng(seed)
    margins = draw.uniform(0.1, 1.0, COUNT) * (1.0 if says else -1.0)
    margins[draw.integers(COUNT)] *= -1.0
    check = over_samples(np.full(COUNT, says), margins)
    with pytest.raises(InputError, match=f"own/claims.py: said: the check is {str(says).lower()} where"):
        row(check, np.full(COUNT, 100.0), CLAIM)


@pytest.mark.parametrize("says", [True, False])
def test_a_margin_of_zero_may_be_true_or_false(says):
    check = over_samples(np.full(COUNT, says), np.zeros(COUNT))
    found = row(check, np.full(COUNT, 100.0), CLAIM)
    assert found.grounds.share.met == (COUNT if says else 0)
    assert found.verdict == ("holds" if says else "depends")  # the base case is true


# what cannot be meant


def test_a_rounding_is_no_coarser_than_its_number():
    draw = np.random.default_rng(3)
    for _ in range(200):
        digits, power = int(draw.integers(1, 999)), int(draw.integers(-6, 7))
        unit = 10.0**power
        number = digits * unit * draw.choice([-1.0, 1.0])
        Item(**NUMBER | {"published": number, "rounding": unit}, reads={"runs": "base"})
        coarse = NUMBER | {"published": number, "rounding": 1000.0 * unit}
        with pytest.raises(ValueError, match="is coarser than the number"):
            Item(**coarse, reads={"runs": "base"})
    Item(**NUMBER | {"published": 0.0, "rounding": 1.0}, reads={"runs": "base"})


@pytest.mark.parametrize("percent", [0.05, 0.15, 0.5, 1.0])
def test_a_number_may_be_held_to_less_than_one_percent(percent):
    about = NUMBER | {"published": 24.417, "rounding": 0.001, "within": f"{percent} %"}
    item = Item(**about, reads={"runs": "base"})
    for off in (0.99, 1.01):
        value = 24.417 * (1.0 + off * percent / 100.0)
        found = graded("own", item, lambda _: lambda runs: Found(runs), {"base": xr.DataArray(value)})
        assert (found.verdict == "reproduced") == (off < 1.0)
        assert (found.margin > 0.0) == (off < 1.0)
    assert f"within {percent:g} %" in row_of(found).note
    assert met(24.4174, 24.417, 0.001, 1e-6)  # printed to no more digits


@pytest.mark.parametrize("within, number", [("2 %", 5.0), ("0 %", 5.0), ("0.1 %", 0.0), ("1 m", 5.0)])
def test_a_share_is_no_larger_than_one_percent_and_of_a_number(within, number):
    about = NUMBER | {"published": number, "within": within}
    with pytest.raises(ValueError, match="within"):
        Item(**about, reads={"runs": "base"})
    with pytest.raises(ValueError, match="within"):
        Item(**CLAIM, within="0.5 %", reads={"runs": "base"})


@pytest.mark.parametrize(
    "base, said",
    [
        ({"line": "tangent"}, "'tangent' is not a value of this axis; use one of chord, least squares"),
        (
            {"lines": "chord"},
            "C1.base.lines: the result of the check has no axis of this name; use one of line",
        ),
    ],
)
def test_a_base_that_is_not_there_is_refused(base, said):
    values = xr.DataArray([1.0, 2.0], {"line": ["chord", "least squares"]}, "line")
    item = Item(**CLAIM, reads={"value": "base"}, base=base)
    check = lambda value: Found(value, value > 0.0)  # noqa: E731
    with pytest.raises(InputError, match=said):
        graded("own", item, lambda _: check, {"base": values})


CHAPTER = """\
def least(runs, at_least, at_most=1.0): ...
def swing(heave, factor=1.0): ...
def fig01(swing): ...
"""


@pytest.mark.parametrize(
    "file, old, new, said",
    [
        ("published", "with: {at_least: 1}", "with: {least: 1}", "least has no argument 'least'"),
        ("published", "with: {at_least: 1}", "with: {at_most: 1}", "least requires the argument 'at_least'"),
        ("published", "reads: {runs", "reads: {run", "least has no argument 'run'"),
        ("studies", "{factor: 2}", "{share: 2}", "swing has no argument 'share'; use only factor, heave"),
        ("studies", "reads: [swing]", "reads: [heave]", "fig01 has no argument 'heave'"),
    ],
)
def test_what_a_function_does_not_take_is_refused_before_any_job(file, old, new, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    texts = {
        "chapters/own/claims.py": CHAPTER,
        "chapters/own/derived.py": CHAPTER,
        "chapters/own/figures.py": CHAPTER,
        "config/scenes/a.yaml": "title: a\n",
        "config/studies/own.yaml": (
            "paper: own\nstudies: {heave: {scene: scenes/a.yaml, caption: c, axes: {}}}\n"
            "derived: {swing: {reads: [heave], with: {factor: 2}}}\n"
            "figures: {fig01: {caption: c, reads: [swing]}}\n"
        ),
        "config/published/own.yaml": (
            "paper: own\nitems: [{id: C1, figure: '1', kind: claim, statement: s, check: least,\n"
            "  reads: {runs: swing}, with: {at_least: 1}}]\n"
        ),
    }
    for name, text in texts.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    read_published(tmp_path / "config", "own", read_studies(tmp_path / "config", "own").datasets)
    path = tmp_path / f"config/{file}/own.yaml"
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new))
    with pytest.raises(InputError, match=said):
        read_published(tmp_path / "config", "own", read_studies(tmp_path / "config", "own").datasets)


@pytest.mark.parametrize("seed", range(12))
def test_a_premise_that_all_samples_share_counts_as_that_of_each(seed):
    """A premise without the samples' dimension would else be ignored."""
    draw = np.random.default_rng(seed)
    share = bool(draw.integers(2))

    def check(given):
        def of(x):
            each = xr.full_like(x, share, bool) if "sample" in x.dims else xr.DataArray(share)
            return judged(x, xr.ones_like(x), xr.DataArray(share) if given == "shared" else each)

        return of

    values = draw.normal(100.0, 1.0, COUNT)
    one, other = (row(check(given), values, CLAIM) for given in ("shared", "each"))
    assert one.verdict == other.verdict == ("holds" if share else "depends")
    assert said(one) == said(other)


def test_a_premise_over_other_cells_than_samples_is_refused():
    value = xr.DataArray(np.ones((3, 4)), dims=("sample", "phase"))
    with pytest.raises(TypeError, match="not over sample, phase"):
        judged(value, value, value > 0.0)
