"""Shares are of samples within an interpretation; numbers of one case are judged in one case."""

import numpy as np
import pytest
import xarray as xr
from some_seeds import seeds

from riserstudy.grading.cases import regrade
from riserstudy.grading.found import answers
from riserstudy.grading.grade import Found, graded, judged
from riserstudy.grading.models import Item, PublishedFile
from riserstudy.grading.readings import readings_of
from riserstudy.grading.rows import row_of
from riserstudy.grading.word_of_size import Word
from riserstudy.grading.yardstick import less
from riserstudy.records.graded import Grounds

LINES = ["chord", "tangent", "least squares", "secant"]
SMALLER = Word("smaller", 0.02, False, 0.02)
ABOUT = {"id": "C1", "figure": "1", "kind": "claim", "statement": "s", "check": "c"}


def runs(values, **coords):
    about = {"assumed_a": ("sample", np.arange(len(values)) * 1.0, {"long_name": "a"})}
    here = about if "sample" in coords else {}
    return xr.Dataset({"x": (tuple(coords), values)} | here, coords)


def claim(space, at_base, **more):
    """A claim that x is smaller than 1."""
    item = Item(**ABOUT | more, reads={"runs": "base"}, over={"runs": "space"})
    check = lambda runs: judged(runs["x"], less(runs["x"], 1.0, SMALLER))  # noqa: E731
    return graded("own", item, lambda _: check, {"base": at_base, "space": space})


def of_lines(shares, count=128, other=1.5):
    """Samples of which a share is smaller on each line; others are ``other``."""
    sample = np.arange(count)
    values = np.stack([np.where(sample < s * count, 0.5, other) for s in shares], axis=1)
    return runs(values, sample=sample, line=LINES[: len(shares)])


@pytest.mark.parametrize("seed", seeds(60, few=20))
def test_a_verdict_is_that_of_every_interpretation_or_depends(seed):
    draw = np.random.default_rng(seed)
    shares = draw.choice([0.0, 0.03, 0.5, 0.97, 1.0], draw.integers(2, 5))
    other = draw.choice([1.0, 1.5])  # no difference, or false
    space = of_lines(shares, other=other)
    base = of_lines([1.0], other=other).isel(sample=0)
    found = claim(space, base, base={"line": LINES[0]})
    alone = base.isel(line=0, drop=True)
    each = {claim(space.sel(line=l, drop=True), alone).verdict for l in space["line"].values}
    assert found.verdict == (each.pop() if len(each) == 1 else "depends")
    assert regrade("claim", found.cases) == found.verdict
    # of the interpretation of the base case, and of no other
    own = found.grounds.share
    assert (own.met, own.samples) == (np.sum(space["x"].sel(line=LINES[0]) == 0.5), 128)
    wanted = {1.0: "true", 0.97: "true", 0.5: "depends"}
    never = "no difference" if other == 1.0 else "false"
    told = {r.place["line"]: r.answer for r in found.grounds.readings}
    assert told == {
        line: wanted.get(share, never) for line, share in zip(space["line"].values, shares, strict=True)
    }
    pooled = f"in {int((space['x'] == 0.5).sum())} of {space['x'].size}"
    row = row_of(found)
    assert pooled not in f"{row.depends_on} {row.note}"


def test_a_row_says_first_what_is_certain():
    base = of_lines([1.0]).isel(sample=0)
    found = claim(of_lines([1.0, 0.0, 0.5]), base, base={"line": "chord"})
    assert row_of(found).depends_on == (
        "line: true with “chord”; false with “tangent”; "
        "with “least squares”, true in 64 of 128 samples (50 %, 95 % confidence interval 41 to 59 %), "
        "depending most on a"
    )
    same = claim(of_lines([1.0, 0.0], other=1.0), base, base={"line": "chord"})
    assert row_of(same).depends_on == "line: true with “chord”; no difference with “tangent”"
    every = claim(of_lines([1.0, 1.0]), base, base={"line": "chord"})
    assert every.verdict == "holds"
    assert row_of(every).note.startswith("True with every interpretation (“chord”; “tangent”). ")


def test_without_samples_interpretations_are_told_by_the_fewest_axes_that_decide():
    values = np.ones((3, 4, 2)) * 2.0
    values[1] = 0.5
    axes = {"flow": ["a", "b", "c"], "profile": list("pqrs"), "weight": ["u", "v"]}
    space = runs(values, **axes)
    base = {"flow": "b", "profile": "p", "weight": "u"}
    item = Item(**ABOUT, reads={"runs": "space"}, base=base)
    check = lambda runs: judged(runs["x"], less(runs["x"], 1.0, SMALLER))  # noqa: E731
    found = graded("own", item, lambda _: check, {"space": space})
    assert found.grounds.share is None
    assert row_of(found).depends_on == "flow: true with “b”; false with “a” and “c”"
    never = graded("own", item, lambda _: check, {"space": space.assign(x=space["x"] * 0.0 + 2.0)})
    assert row_of(never).note.startswith("False with all 24 interpretations. ")
    space["x"][0, 0, 0] = 0.5
    answer = answers(check(space))
    assert len(readings_of("claim", answer, space, None)) == values.size  # none of them is left out


def test_a_further_case_over_interpretations_has_no_pooled_share():
    base = of_lines([1.0]).isel(sample=0, line=0, drop=True)
    item = Item(**ABOUT, reads={"runs": "base"}, further_cases={"Open": {"runs": "space"}})
    check = lambda runs: judged(runs["x"], less(runs["x"], 1.0, SMALLER))  # noqa: E731
    space = of_lines([1.0, 0.0])
    note = row_of(graded("own", item, lambda _: check, {"base": base, "space": space})).note
    assert note.endswith(
        "Open: the values are 0.5 to 1.5; the claim is true with “chord”; false with “tangent”."
    )


# numbers of one case


def number(name, published, **more):
    about = {"id": name, "figure": "1", "kind": "number", "statement": "s", "check": name}
    return about | {"published": published, "rounding": published / 100.0} | more


def numbers(one, other, base=(3.0, 3.0), **more):
    """Two numbers, of which a and b are looked up in samples."""
    items = [
        number("a", 1.0, together=["b"], **more), number("b", 2.0)
    ]  # fmt: skip
    reads = {"reads": {"runs": "base"}, "over": {"runs": "space"}}
    file = PublishedFile(paper="own", items=[item | reads for item in items])
    space = runs(np.asarray(one), sample=np.arange(len(one))).rename(x="a").assign(b=("sample", other))
    at_base = xr.Dataset({"a": base[0], "b": base[1]})
    by_id = {item.id: item for item in file.items}
    checks = lambda name: lambda runs: Found(runs[name])  # noqa: E731
    item = by_id["a"]
    return graded("own", item, checks, {"base": at_base, "space": space}, None, [by_id["b"]])


@pytest.mark.parametrize("seed", range(20))
def test_chance_hits_of_a_continuous_spread_meet_no_number(seed):
    """Two forces of which one is always 25 times the other, printed as 26 times."""
    draw = np.random.default_rng(seed)
    size = 10.0 ** draw.uniform(-1, 1, 512)
    found = numbers(size, 2.0 * size * 0.96)
    alone = np.sum(abs(size - 1.0) <= 0.01)
    assert found.verdict == "fails"
    assert found.grounds.share.met == 0
    assert (found.grounds.together.alone.met, found.grounds.together.others) == (alone, ["b"])
    assert f"Judged alone, the published value is met in {alone} of 512 samples" in row_of(found).note
    proportional = numbers(size, 2.0 * size)
    assert proportional.verdict == ("depends" if alone else "fails")
    assert proportional.grounds.share.met == alone


@pytest.mark.parametrize("seed", range(20))
def test_numbers_together_are_met_where_each_is(seed):
    draw = np.random.default_rng(seed)
    one, other = (p * (1.0 + draw.uniform(-0.02, 0.02, 128)) for p in (1.0, 2.0))
    found = numbers(one, other, base=(1.0, 2.0))
    both = (abs(one - 1.0) <= 0.01) & (abs(other / 2.0 - 1.0) <= 0.01)
    judged_cases = [case for case in found.cases if case.judged]
    np.testing.assert_array_equal([case.met for case in judged_cases], both)
    assert all((case.margin > 0.0) == case.met for case in judged_cases)
    missing = numbers(one, np.where(np.arange(128) % 2, np.nan, other), base=(1.0, 2.0))
    assert missing.grounds.missing.cases == 64
    assert missing.grounds.share.samples == 64


@pytest.mark.parametrize("other", ["a", "c"])
def test_a_number_is_judged_with_other_numbers_of_its_paper_alone(other):
    items = [number("a", 1.0, reads={"runs": "x"}, together=[other])]
    with pytest.raises(ValueError, match=f"'{other}' is not the id of another number"):
        PublishedFile(paper="own", items=items)


# what was chosen by a number or claim


@pytest.mark.parametrize("varied, verdict", [(True, "holds"), (False, "calibrated")])
def test_what_was_chosen_by_a_claim_is_told_and_proves_nothing_where_it_is_not_varied(varied, verdict):
    space = of_lines([1.0]).isel(line=0, drop=True)
    chosen = {"what": "the profile", "varied": varied}
    found = claim(space, space.isel(sample=0, drop=True), chosen=chosen)
    assert found.verdict == verdict
    note = row_of(found).note
    then = (
        "The samples also include other values of the chosen input"
        if varied
        else "No sample varies the chosen assumption"
    )
    assert f"the base case agrees with the paper: the profile. {then}" in note
    assert Grounds.from_json(row_of(found).grounds) == found.grounds
    none = of_lines([0.0]).isel(line=0, drop=True)
    never = claim(none, none.isel(sample=0), chosen=chosen)
    assert never.verdict == "fails"
