"""Margins of verdicts in the tables of the report."""

import pytest

from riserstudy.grading.verdict_sentences import margin_rows


@pytest.mark.parametrize(
    "margin, said", [(0.104, "+10 %"), (-0.79, "−79 %"), (-0.001, "less than 1 %"), (0.004, "less than 1 %")]
)
def test_a_margin_is_positive_where_the_base_case_agrees_unless_it_rounds_to_nothing(margin, said):
    assert margin_rows(margin, None, None) == [("Margin of the base case", said)]


@pytest.mark.parametrize(
    "low, high, said", [(-0.9, 0.41, "−90 to +41 %"), (0.041, 0.044, "+4 %"), (0.004, 0.41, "0 to +41 %")]
)
def test_a_range_of_margins_has_signs_and_equal_ends_are_one_number(low, high, said):
    assert margin_rows(0.1, low, high)[1] == ("Margins of 90 % of all cases", said)
