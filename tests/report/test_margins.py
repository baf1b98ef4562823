"""Margins of verdicts as the report says them."""

import pytest

from riserstudy.grading.words import margin_in_words


@pytest.mark.parametrize(
    "margin, said",
    [
        (0.104, "The base case agrees with the paper; its margin to disagreement is 10 %."),
        (-0.79, "The base case disagrees with the paper; its margin to agreement is 79 %."),
        (-0.001, "The margin of the base case to a change of the outcome is less than 1 %."),
        (0.004, "The margin of the base case to a change of the outcome is less than 1 %."),
    ],
)
def test_a_margin_is_positive_where_the_base_case_agrees_unless_it_rounds_to_nothing(margin, said):
    assert margin_in_words(margin, None, None) == said


def test_a_range_of_margins_with_a_negative_end_is_explained():
    found = margin_in_words(-0.79, -0.9, 0.41)
    assert found == (
        "The base case disagrees with the paper; its margin to agreement is 79 %. In 90 % of all cases "
        "the margin is −90 to +41 %; a negative margin means disagreement."
    )


@pytest.mark.parametrize("low, high, said", [(0.041, 0.044, "+4 %."), (0.004, 0.41, "0 to +41 %.")])
def test_a_range_of_positive_margins_needs_no_explanation(low, high, said):
    assert margin_in_words(0.1, low, high).endswith(f"In 90 % of all cases the margin is {said}")
