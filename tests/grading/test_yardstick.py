"""Words of size have one bound each; what differs by less than that of a difference is a third answer."""

import itertools
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from riserstudy.errors import InputError
from riserstudy.grading.grade import answers, graded, judged
from riserstudy.grading.models import Item
from riserstudy.grading.published import read_published
from riserstudy.grading.rows import row_of
from riserstudy.grading.words_of_size_file import WordsFile, read_words
from riserstudy.grading.yardstick import alike, all_along, all_of, growing, less, more, more_on_the_whole

CONFIG = Path(__file__).parents[2] / "config"
TABLE = read_words(CONFIG)
EVERY = [name for first, of in TABLE.words.items() for name in (first, *of.also)]
SMALLER, EVIDENT, SIMILAR = (TABLE.word(name) for name in ("smaller", "evident", "similar"))
TRUE, SAME, FALSE = 1.0, 0.0, -1.0
PAPERS = ("chang2020", "fem_riser", "liu2017", "liu2020", "mao_hangoff")


def answer(condition):
    return answers(judged(xr.zeros_like(condition.margin), condition))


def row(values, axis="step"):
    return xr.DataArray(values, {axis: np.arange(len(values)) * 1.0}, axis)


def pairs(seed, count=200):
    """Values of any size beside others a few per cent away."""
    draw = np.random.default_rng(seed)
    other = 10.0 ** draw.uniform(-6, 9, count)
    return row(other * (1.0 + draw.uniform(-0.1, 0.1, count))), row(other)


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("word", [SMALLER, EVIDENT], ids=lambda word: word.name)
def test_a_change_is_more_or_less_or_none(seed, word):
    value, other = pairs(seed)
    up, down = answer(more(value, other, word)).values, answer(less(value, other, word)).values
    assert not ((up == TRUE) & (down != FALSE)).any()  # never both
    np.testing.assert_array_equal(up == SAME, down == SAME)  # none is none either way
    np.testing.assert_array_equal(down, answer(more(other, value, word)).values)
    # by counting on the fingers: a per cent of the larger value
    apart = 100.0 * (1.0 - np.minimum(value, other) / np.maximum(value, other)).values
    np.testing.assert_array_equal(up == SAME, apart < 100.0 * word.band)
    np.testing.assert_array_equal(up == TRUE, (value > other).values & (apart > 100.0 * word.bound))


@pytest.mark.parametrize("seed", range(10))
def test_answers_do_not_hang_on_the_unit(seed):
    value, other = pairs(seed)
    for scale in (1e-3, 25.4, 1e6):
        for compare in (more, less, alike):
            word = SIMILAR if compare is alike else EVIDENT
            xr.testing.assert_equal(
                answer(compare(value, other, word)), answer(compare(scale * value, scale * other, word))
            )


@pytest.mark.parametrize("seed", range(10))
def test_what_is_evident_is_a_difference_and_nothing_evident_is_similar(seed):
    value, other = pairs(seed)
    evident, smaller = answer(less(value, other, EVIDENT)), answer(less(value, other, SMALLER))
    assert (smaller.values[evident.values == TRUE] == TRUE).all()
    similar = answer(alike(value, other, SIMILAR))
    assert not ((similar == TRUE) & (evident == TRUE)).any()


@pytest.mark.parametrize("seed", range(20))
def test_conditions_at_once_are_as_true_as_the_least_of_them(seed):
    """False where one is false, no difference where one is none and no other is false."""
    values = [pairs(3 * seed + k) for k in range(3)]
    each = [more(*pair, SMALLER) for pair in values]
    least = np.min([answer(condition).values for condition in each], axis=0)
    for order in itertools.permutations(each):
        np.testing.assert_array_equal(answer(all_of(*order)).values, least)
    stacked = type(each[0])(*(xr.concat(part, "of") for part in zip(*each, strict=True)))
    np.testing.assert_array_equal(answer(all_along(stacked, "of")).values, least)


def test_a_missing_value_makes_no_condition_true_or_false():
    gap, other = row([1.0, np.nan, 3.0]), row([0.5, 0.5, 0.5])
    assert np.isnan(answer(more(gap, other, SMALLER)).values).tolist() == [False, True, False]
    both = all_of(more(gap, other, SMALLER), less(gap, other, SMALLER))
    assert np.isnan(answer(both).values).tolist() == [False, True, False]
    assert np.isnan(answer(all_along(more(gap, other, SMALLER), "step")))
    assert np.isnan(answer(growing(gap, "step", SMALLER)))


@pytest.mark.parametrize(
    "values, up, down",
    [
        ([1.0, 1.1, 1.2], TRUE, FALSE),
        ([1.0, 1.2, 1.19, 1.3], TRUE, FALSE),  # a step back by 0.8 % is none
        ([1.0, 1.2, 1.1, 1.3], FALSE, FALSE),
        ([1.0, 1.005, 1.01], SAME, SAME),
        ([1.0, 0.99, 1.01, 1.0], SAME, SAME),
        ([1.0, 1.3, 1.0], FALSE, FALSE),
        ([1.2, 1.1, 1.0], FALSE, TRUE),
    ],
)
def test_values_grow_from_end_to_end_and_never_turn_back(values, up, down):
    assert answer(growing(row(values), "step", SMALLER)).item() == up
    assert answer(growing(row(values), "step", SMALLER, -1.0)).item() == down


@pytest.mark.parametrize("seed", range(20))
def test_a_series_that_is_turned_round_grows_the_other_way(seed):
    values = row(np.cumsum(np.random.default_rng(seed).normal(0.03, 0.05, 8)) + 5.0)
    turned = row(values.values[::-1])
    for sign in (1.0, -1.0):
        one, other = (growing(values, "step", SMALLER, sign), growing(turned, "step", SMALLER, -sign))
        assert answer(one).item() == answer(other).item()


def test_on_the_whole_more_is_nowhere_less():
    other = row([1.0, 1.0, 1.0])
    found = [
        answer(more_on_the_whole(row(values), other, SMALLER, "step")).item()
        for values in ([1.0, 1.2, 1.2], [0.99, 1.2, 1.2], [0.9, 1.2, 1.2], [1.0, 1.01, 1.01])
    ]
    assert found == [TRUE, TRUE, FALSE, SAME]
    early = xr.DataArray([False, True, True], other.coords)
    late = more_on_the_whole(row([0.5, 1.2, 1.2]), other, SMALLER, "step", early)
    assert answer(late).item() == TRUE


# the table


def test_the_table_has_each_word_once_and_words_that_do_not_overlap():
    assert len(set(EVERY)) == len(EVERY)
    words = [TABLE.word(name) for name in EVERY]
    assert {word.band for word in words} == {TABLE.no_difference}
    upper = [word.bound for word in words if word.most]
    lower = [word.bound for word in words if not word.most]
    assert max(upper) <= sorted(set(lower))[1]  # what is hardly a change is no evident one


@pytest.mark.parametrize(
    "words, said",
    [
        ({"small": {"because": "b"}}, "at_least or at_most is required"),
        ({"small": {"at_least": "1 %", "because": "b"}}, "smaller than no_difference"),
        ({"a": {"at_most": "3 %", "also": ["a"], "because": "b"}}, "'a' occurs twice"),
    ],
)
def test_words_that_cannot_be_meant_are_refused(words, said):
    with pytest.raises(ValueError, match=said):
        WordsFile(no_difference="2 %", because="b", words=words)


FILE = """\
paper: paper
items: [{{id: C1, figure: '1', kind: claim, statement: s, check: c, reads: {{runs: base}},
  with: {{size: {{word: {}}}}}}}]
"""


def test_a_word_that_is_not_in_the_table_is_refused_with_those_that_are(tmp_path):
    (tmp_path / "published").mkdir()
    (tmp_path / "published/paper.yaml").write_text(FILE.format("huge"))
    with pytest.raises(InputError, match="words: the file of words does not exist"):
        read_published(tmp_path, "paper", {"base"})
    (tmp_path / "published/words.yaml").write_text(
        "no_difference: 2 %\nbecause: b\nwords: {large: {at_least: 9 %, because: b}}\n"
    )
    with pytest.raises(InputError, match="the word 'huge' is not defined; use one of large"):
        read_published(tmp_path, "paper", {"base"})


@pytest.mark.parametrize("paper", PAPERS)
def test_no_claim_of_a_paper_has_a_bound_of_its_own_for_a_word_of_the_table(paper):
    """A bound that is given by number is of another measure, which the note explains."""
    text = (CONFIG / f"published/{paper}.yaml").read_text()
    for word in EVERY:
        for phrase in (f"{word} means", f"{word} is taken as", f"{word} is taken generously"):
            assert phrase not in text.lower()


# rows


def claim(values, word):
    runs = xr.Dataset(
        {"x": ("sample", values), "assumed_a": ("sample", np.arange(len(values)), {"long_name": "a"})},
        {"sample": range(len(values))},
    )
    item = Item(
        **{"id": "C1", "figure": "1", "kind": "claim", "statement": "s", "check": "c"},
        reads={"runs": "base"}, over={"runs": "space"},
    )  # fmt: skip
    item.options["word"] = word
    check = lambda runs, word: judged(runs["x"], less(runs["x"], 1.0, word))  # noqa: E731
    base = runs.isel(sample=0)
    return graded("own", item, lambda _: check, {"base": base, "space": runs})


def test_differences_of_a_hundredth_of_a_per_cent_hold_nothing():
    """Two thirds of the samples were "smaller" by noise."""
    noise = 1.0 + 1e-4 * np.random.default_rng(1).normal(-0.5, 1.0, 256)
    found = claim(noise, SMALLER)
    assert found.verdict == "fails"
    share = found.grounds.share
    assert (share.met, share.same, share.samples) == (0, 256, 256)
    note = row_of(found).note
    assert (
        'The word "smaller" is interpreted as a difference of at least 2 %; '
        "values that differ by less than 2 % count as equal." in note
    )
    assert (
        "true in 0 of 256 samples (0 %, 95 % confidence interval 0 to 1 %; "
        "in 256, the compared values are nearly equal)" in note.lower()
    )
    assert "Base case: the value is 1; the compared values are nearly equal." in note
    assert all(case.same and not case.met for case in found.cases)
