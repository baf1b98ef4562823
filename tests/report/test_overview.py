"""What the first screen says was found, in words of the figures and not of the papers."""

from types import SimpleNamespace

import numpy as np
import pytest

from riserstudy.report.claims import VERDICTS
from riserstudy.report.overview import findings, totals

CLAIM = SimpleNamespace(paper="paper", id="C1")
OTHER = SimpleNamespace(paper="paper", id="C2")


def figure(name, title, *claims, paper="paper"):
    picture = SimpleNamespace(title=title)
    anchor = f"{paper}-{name}"
    return SimpleNamespace(
        paper=paper, name=name, label=name, picture=picture, claims=[*claims], anchor=anchor
    )


def found(*figures):
    files = {"paper": SimpleNamespace(title="Name: about", finding="C1")}
    return findings([CLAIM, OTHER], files, [*figures])


def test_a_finding_is_what_the_most_particular_figure_with_a_number_says():
    (one,) = found(
        figure("fig03", "it swings by 2 m", CLAIM),
        figure("samples", "all swing by 1 to 3 m", CLAIM, OTHER),
        figure("fig04", "it swings", CLAIM),
    )
    assert (one.sentences, one.figure, one.short) == ("It swings by 2 m.", "paper-fig03", "fig03")
    assert (one.claim, one.paper) == (CLAIM, "Name")


def test_a_finding_without_a_figure_says_nothing_of_its_own():
    (one,) = found(figure("fig03", "it swings by 2 m", OTHER))
    assert (one.sentences, one.figure) == ("", "")


@pytest.mark.parametrize("seed", range(5))
def test_the_totals_add_up_and_name_every_verdict_that_occurs(seed):
    rng = np.random.default_rng(seed)
    claims = [
        SimpleNamespace(verdict=v)
        for v in rng.choice([*VERDICTS][: rng.integers(1, len(VERDICTS) + 1)], 40)
    ]
    said = totals(claims)
    head, _, rest = said.partition(",")
    counts = [int(word) for word in rest.split() if word.isdigit()]
    assert head == "Of 40 published values and claims"
    assert sum(counts) == 40
    assert len(counts) == len({claim.verdict for claim in claims})


def test_nothing_graded_has_no_totals():
    assert totals([]) == ""
