"""Numbers in messages: no exponents, at most three digits of meaning."""

import random

import pytest

from riserstudy.records.numerals import at_most, newtons, percent, plain, rounded_up


@pytest.mark.parametrize("seed", range(200))
def test_no_number_has_an_exponent_and_none_loses_more_than_its_digits(seed):
    value = random.Random(seed).choice([-1.0, 1.0]) * 10.0 ** random.Random(seed + 1000).uniform(-8, 12)
    text = plain(value)
    assert "e" not in text
    assert float(text) == pytest.approx(value, rel=5.1e-3)
    force, unit = newtons(value).split(" ")
    assert "e" not in force
    assert float(force) * {"N": 1.0, "kN": 1e3}[unit] == pytest.approx(value, rel=5.1e-3)


@pytest.mark.parametrize("seed", range(50))
def test_a_limit_in_a_message_is_not_exceeded_by_rounding(seed):
    value = 10.0 ** random.Random(seed).uniform(-6, 8)
    for digits in (2, 3):
        text = at_most(value, digits)
        assert "e" not in text.lower()
        assert value * (1.0 - 10.0 ** (1 - digits)) < float(text) <= value
    assert at_most(0.5) == "0.5"


@pytest.mark.parametrize("seed", range(50))
def test_a_bound_in_a_title_is_not_below_what_it_bounds(seed):
    value = 10.0 ** random.Random(seed).uniform(-6, 3)
    for digits in (1, 2):
        text = rounded_up(value, digits)
        assert "e" not in text.lower()
        assert value * (1.0 - 1e-8) <= float(text) < value * (1.0 + 10.0 ** (1 - digits))
    assert rounded_up(100 * 0.03 / 100) == "0.03"


@pytest.mark.parametrize(
    "share, text",
    [
        (0.0, "0 %"),
        (8e-16, "< 0.0001 %"),
        (6e-6, "0.0006 %"),
        (0.00217, "0.22 %"),
        (0.0965, "9.7 %"),
        (0.104, "10 %"),
        (1.1, "110 %"),
        (64.2, "6420 %"),
        (float("inf"), "inf %"),
    ],
)
def test_shares_are_written_in_per_cent(share, text):
    assert percent(share) == text
