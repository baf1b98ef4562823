"""How figures are called and headed."""

from riserstudy.report.pictures import heading, labels

NAMES = ["riser", "fig08", "fig12", "samples"]


def test_printed_figures_keep_their_number_and_others_are_counted():
    assert labels(NAMES, "Chang 2020", printed=True) == {
        "riser": "Chang 2020, S1",
        "fig08": "Chang 2020, Fig. 8",
        "fig12": "Chang 2020, Fig. 12",
        "samples": "Chang 2020, S2",
    }


def test_figures_of_a_chapter_without_a_paper_are_numbered():
    assert list(labels(["a", "b"], "Design", printed=False).values()) == ["Design, Fig. 1", "Design, Fig. 2"]


def test_a_figure_is_headed_by_its_label_and_what_it_says():
    assert heading("Chang 2020, Fig. 8", "Tension falls") == "Chang 2020, Fig. 8: Tension falls"
    assert heading("Chang 2020, Fig. 8", "") == "Chang 2020, Fig. 8"
