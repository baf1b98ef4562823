"""What the first screen says was found, in words of the figures and not of the papers."""

from types import SimpleNamespace

from riserstudy.report.overview import findings, tiles

CLAIM = SimpleNamespace(paper="paper", id="C1")
OTHER = SimpleNamespace(paper="paper", id="C2")


def figure(name, title, *claims, paper="paper"):
    picture = SimpleNamespace(title=title)
    anchor = f"{paper}-{name}"
    return SimpleNamespace(paper=paper, name=name, picture=picture, claims=[*claims], anchor=anchor)


def found(*figures):
    files = {"paper": SimpleNamespace(title="Name: about", finding="C1")}
    return findings([CLAIM, OTHER], files, [*figures])


def test_a_finding_is_what_the_most_particular_figure_with_a_number_says():
    (one,) = found(
        figure("fig03", "it swings by 2 m", CLAIM),
        figure("samples", "all swing by 1 to 3 m", CLAIM, OTHER),
        figure("fig04", "it swings", CLAIM),
    )
    assert (one.said, one.figure, one.short) == ("It swings by 2 m.", "paper-fig03", "Fig. 3")
    assert (one.claim, one.paper) == (CLAIM, "Name")


def test_a_finding_without_a_figure_says_nothing_of_its_own():
    (one,) = found(figure("fig03", "it swings by 2 m", OTHER))
    assert (one.said, one.figure) == ("", "")


def test_a_tile_is_the_first_sentence_of_its_figure():
    of = figure("cost", "twice as good for 1.3 times the time. Else not", paper="numerics")
    assert [tile.answer for tile in tiles([of])] == ["Twice as good for 1.3 times the time."]
