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


#: of another claim, so that figures without any need no claim that fits less
RESTS = {("paper", "C2"): {"paper/open", "paper/other"}, ("paper", "C3"): set()}
BEHIND = {("paper/derived",): {"paper/other"}, ("paper/other",): {"paper/other"}}


def figures_of(figure, *rests, listed=None, alone=False):
    claims = [SimpleNamespace(paper="paper", id="C1", figure=figure)]
    if not alone:
        claims.append(SimpleNamespace(paper="paper", id="C2", figure="99"))
        claims.append(SimpleNamespace(paper="paper", id="C3", figure="8, 9"))
    rest = RESTS | {("paper", "C1"): set(rests)}
    of = claims_by_figure(claims, [*READS], rest, READS, BEHIND, listed or {})
    return [name for name, claims in of.items() if any(c.id == "C1" for c in claims)]


def test_a_claim_has_the_printed_figure_that_it_names_and_own_ones_that_show_what_it_rests_on():
    assert figures_of("8a", "paper/runs", "paper/open") == ["fig08", "samples"]


def test_a_figure_that_shows_more_than_a_claim_rests_on_is_not_linked():
    assert figures_of("8a", "paper/open", "paper/runs", "paper/more") == ["fig08", "samples"]
    assert figures_of("8", "paper/runs") == ["fig08"]


def test_a_claim_that_names_no_figure_has_all_that_show_something_of_it():
    assert figures_of("", "paper/other") == ["fig09", "trends"]


def test_a_figure_without_claims_has_those_that_rest_on_some_of_what_it_shows():
    assert figures_of("8a", "paper/other", alone=True) == ["fig08", "fig09", "trends"]


def test_a_figure_whose_entry_lists_claims_has_these_alone():
    listed = {"drawing": ["C1", "C2"], "trends": ["C2"]}
    assert figures_of("8", listed=listed) == ["fig08", "drawing"]
    assert figures_of("text", "paper/other", listed=listed) == ["fig09", "drawing"]


def test_a_section_or_a_conclusion_is_no_figure_of_that_number():
    assert figures_of("section 8.9", "paper/other") == ["fig09", "trends"]
    assert figures_of("8, conclusion 9", "paper/other") == ["fig08"]


def test_a_claim_that_no_figure_has_is_linked_by_the_runs_behind_it():
    assert figures_of("text", "paper/derived") == ["fig09", "trends"]
    assert figures_of("text", "paper/unknown") == []
