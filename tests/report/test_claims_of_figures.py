"""Which figures a number or claim is linked to."""

from types import SimpleNamespace

from riserstudy.report.pictures import claims_by_figure

READS = {
    "fig08": {"paper/runs"},
    "fig09": {"paper/other"},
    "samples": {"paper/open"},
    "trends": {"paper/open", "paper/other"},
    "drawing": set(),
}


def figures_of(figure, *rests):
    claim = SimpleNamespace(paper="paper", id="C1", figure=figure)
    of = claims_by_figure([claim], [*READS], {("paper", "C1"): set(rests)}, READS)
    return [name for name, claims in of.items() if claims]


def test_a_claim_has_the_printed_figure_that_it_names_and_own_ones_that_show_what_it_rests_on():
    assert figures_of("8a", "paper/runs", "paper/open") == ["fig08", "samples"]


def test_a_figure_that_shows_more_than_a_claim_rests_on_is_not_linked():
    assert figures_of("8a", "paper/open", "paper/runs", "paper/more") == ["fig08", "samples"]
    assert figures_of("8", "paper/runs") == ["fig08"]


def test_a_claim_that_names_no_figure_has_all_that_show_something_of_it():
    assert figures_of("", "paper/other") == ["fig09", "trends"]
