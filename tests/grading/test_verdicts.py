"""Verdicts of numbers and claims, from errors and shares of samples."""

import pytest

from riserstudy.grading.verdict import error, met, verdict_of_claim, verdict_of_number


@pytest.mark.parametrize(
    "simulated, printed, digit, inside",
    [
        (0.35, 0.3, 0.1, True),  # half a unit of the last digit, on the bound
        (0.3500001, 0.3, 0.1, False),
        (0.25, 0.3, 0.1, True),
        (232.6, 232.0, 1.0, True),  # 1 % is the larger bound here
        (234.32, 232.0, 1.0, True),
        (234.33, 232.0, 1.0, False),
        (-3.1, -3.0, 0.1, False),
        (-3.05, -3.0, 0.1, True),
        (0.04, 0.0, 0.1, True),
        (float("nan"), 1.0, 0.1, False),
    ],
)
def test_a_number_is_met_within_half_its_last_digit_or_one_percent(simulated, printed, digit, inside):
    assert met(simulated, printed, digit) is inside


def test_errors_are_relative_unless_zero_was_printed():
    assert error(1.1, 1.0) == pytest.approx(0.1)
    assert error(-1.1, -1.0) == pytest.approx(-0.1)
    assert error(0.2, 0.0) == 0.2


@pytest.mark.parametrize(
    "hit, share, calibrated, verdict",
    [
        (True, None, False, "reproduced"),
        (True, None, True, "calibrated"),
        (False, None, False, "fails"),
        (False, None, True, "fails"),
        (True, 0.95, False, "reproduced"),
        (True, 0.95, True, "calibrated"),
        (True, 0.949, False, "depends"),
        (True, 0.0, False, "depends"),  # a lucky choice
        (False, 0.0, False, "fails"),
        (False, 1 / 180, False, "depends"),  # one reading of many meets it
        (False, 1.0, False, "depends"),
    ],
)
def test_verdicts_of_numbers(hit, share, calibrated, verdict):
    assert verdict_of_number(hit, share, calibrated) == verdict


@pytest.mark.parametrize(
    "share, verdict",
    [(1.0, "holds"), (0.95, "holds"), (0.949, "depends"), (0.051, "depends"), (0.05, "fails")],
)
def test_verdicts_of_claims(share, verdict):
    assert verdict_of_claim(share, calibrated=False, base=share > 0.5) == verdict


@pytest.mark.parametrize("base", [True, False])
@pytest.mark.parametrize("met", range(0, 129))
def test_a_claim_fails_where_its_negation_holds(met, base):
    """A base case that contradicts the samples decides neither way."""
    share = met / 128
    opposite = {"holds": "fails", "fails": "holds", "depends": "depends"}
    negated = verdict_of_claim(1.0 - share, calibrated=False, base=not base)
    assert verdict_of_claim(share, calibrated=False, base=base) == opposite[negated]


def test_a_claim_that_needs_calibrated_values_does_not_hold_by_itself():
    assert verdict_of_claim(1.0, calibrated=True) == "calibrated"
    assert verdict_of_claim(0.0, calibrated=True, base=False) == "fails"


def test_a_share_of_nothing_is_no_share():
    with pytest.raises(ValueError, match="no samples"):
        verdict_of_claim(float("nan"), calibrated=False)
