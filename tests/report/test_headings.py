"""How figures are headed."""

import pytest

from riserstudy.report.pictures import heading


@pytest.mark.parametrize(
    "name, title, headed",
    [
        ("fig08", "Tension falls", "Figure 8: Tension falls"),
        ("fig08", "", "Figure 8"),
        ("dat_force", "Printed forces do not grow", "Printed forces do not grow"),
        ("dat_force", "", "Dat force"),
    ],
)
def test_a_figure_is_headed_by_its_printed_number_and_what_it_says(name, title, headed):
    assert heading(name, title) == headed
