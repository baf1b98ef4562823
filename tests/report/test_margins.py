"""Margins of verdicts as the report says them."""

import pytest

from riserstudy.grading.words import margin_in_words


@pytest.mark.parametrize(
    "margin, said", [(0.104, "+10 %"), (-0.79, "−79 %"), (-0.001, "0 %"), (0.004, "0 %")]
)
def test_a_margin_has_a_sign_unless_it_rounds_to_nothing(margin, said):
    assert margin_in_words(margin, None, None) == f"Margin to a change of the outcome: {said}."


def test_a_range_of_margins_stands_in_brackets():
    found = margin_in_words(-0.79, -0.9, 0.41)
    assert found == "Margin to a change of the outcome: −79 % (90 % range −90 to +41 %)."
