"""What the first screen says was found, in words of the figures and not of the papers."""

from types import SimpleNamespace

import numpy as np
import pytest

from riserstudy.grading.summary import VERDICTS, totals
from riserstudy.records.graded import Grounds, Share
from riserstudy.report.overview import findings, subject

CLAIM = SimpleNamespace(paper="paper", id="C1")
OTHER = SimpleNamespace(paper="paper", id="C2")


def figure(name, title, *claims, paper="paper"):
    picture = SimpleNamespace(title=title)
    anchor = f"{paper}-{name}"
    return SimpleNamespace(
        paper=paper, name=name, label=name, picture=picture, claims=[*claims], anchor=anchor
    )


def found(*figures, title="Name: about", short="Name"):
    files = {"paper": SimpleNamespace(title=title, short=short, finding="C1")}
    return findings([CLAIM, OTHER], files, [*figures])


def test_a_finding_is_what_the_most_particular_figure_with_a_number_says():
    (one,) = found(
        figure("fig03", "it swings by 2 m", CLAIM),
        figure("samples", "all swing by 1 to 3 m", CLAIM, OTHER),
        figure("fig04", "it swings", CLAIM),
    )
    assert (one.sentences, one.figure, one.short) == ("It swings by 2 m.", "paper-fig03", "fig03")
    assert (one.claim, one.paper) == (CLAIM, "Name")


def test_a_title_without_a_short_name_is_not_taken_apart():
    """A time of day, or a ratio, has a colon, too."""
    (one,) = found(figure("fig03", "it swings by 2 m", CLAIM), title="Storm of 12:30", short="")
    assert one.paper == "Storm of 12:30"


def test_a_finding_without_a_figure_says_nothing_of_its_own():
    (one,) = found(figure("fig03", "it swings by 2 m", OTHER))
    assert (one.sentences, one.figure) == ("", "")


@pytest.mark.parametrize("seed", range(10))
def test_the_totals_add_up_and_name_every_verdict_that_occurs(seed):
    rng = np.random.default_rng(seed)
    grounds = [Grounds(because=why, share=Share(8, 8, 8)) for why in ("inputs", "too few samples")]
    claims = [
        (v, grounds[rng.integers(2)])
        for v in rng.choice([*VERDICTS][: rng.integers(1, len(VERDICTS) + 1)], 40)
    ]
    said = totals(claims)
    head, _, rest = said.partition(",")
    head_of_rest, _, remaining = rest.partition("Of the remaining")
    counts = [int(word) for word in head_of_rest.split() if word.isdigit()]
    left, *others = [int(word.rstrip(",")) for word in remaining.split() if word.rstrip(",").isdigit()] or [0]
    assert head == "Of 40 published values and claims"
    assert sum(others) == left
    assert sum(counts) + left == 40
    few = sum(verdict == "depends" and of.because == "too few samples" for verdict, of in claims)
    assert (f"{few} {'is' if few == 1 else 'are'} true in all samples" in said) == (few > 0)
    left_out = {verdict for verdict, of in claims if verdict != "depends" or of.because == "inputs"}
    assert len(counts) + len(others) == len(left_out) + (few > 0)


def test_nothing_graded_has_no_totals():
    assert totals([]) == ""


@pytest.mark.parametrize("seed", range(5))
def test_papers_are_those_whose_values_are_graded(seed):
    draw = np.random.default_rng(seed)
    kinds = draw.integers(0, 4, 6)  # of each study: with a reference, graded
    files = {
        f"s{k}": SimpleNamespace(title=f"Study {k}", reference="A paper" if kind & 1 else "")
        for k, kind in enumerate(kinds)
    }
    claims = [SimpleNamespace(paper=f"s{k}") for k, kind in enumerate(kinds) if kind & 2]
    title, sentence = subject(files, claims)
    papers = sum(kinds == 3)
    assert ("simulated again" in title) == (papers > 0)
    assert ("published paper" in sentence) == (papers > 0)
    if not papers:
        assert title == ", ".join(file.title for file in files.values())
        assert ("graded" in sentence) == bool(claims)


def test_a_study_of_ones_own_with_a_reference_keeps_its_title():
    files = {"own": SimpleNamespace(title="Our riser", reference="Report 17")}
    assert subject(files, [])[0] == "Our riser"
