"""Signs of prose on the page: minus, powers, digits in groups, and no line break before a unit."""

import numpy as np
import pytest

from riserstudy.report.formats import parts, share, typeset

UNITS = ("%", "m", "mm", "s", "min", "h", "t", "N", "kN", "MN", "kN m", "kN/m", "m/s", "kg/m³", "MPa", "°")
WORDS = ("the riser", "at a height", "with samples", "in one minute", "after the tank test", "of metres")
PLAIN = str.maketrans("−²³⁴", "-234", "\u00a0")


def prose(draw):
    """A sentence with numbers and their units, and the numbers with units as they must stay together."""
    parts, together = [], []
    for _ in range(6):
        size = 10.0 ** draw.uniform(-3.0, 6.0) * draw.choice([-1.0, 1.0])
        number = f"{size:.{draw.integers(0, 3)}f}"
        unit = str(draw.choice(UNITS))
        parts += [str(draw.choice(WORDS)), number + " " + unit]
        together.append((number, unit))
    return " ".join(parts) + ".", together


@pytest.mark.parametrize("seed", range(30))
def test_numbers_stay_with_their_units_and_nothing_else_changes(seed):
    written, together = prose(np.random.default_rng(seed))
    shown = typeset(written)
    assert shown.translate(PLAIN).replace(" ", "") == written.translate(PLAIN).replace(" ", "")
    assert "-" not in shown
    whole = shown.split(" ")  # parts between which a line may break
    for number, unit in together:
        digits = number.replace("-", "−")
        found = [part.replace("\u00a0", "") for part in whole]
        assert any(part.rstrip(".") == digits + unit.replace(" ", "") for part in found), (number, unit)


@pytest.mark.parametrize("seed", range(9))
def test_whole_numbers_have_groups_of_three_from_five_digits_on(seed):
    draw = np.random.default_rng(seed)
    for number in draw.integers(0, 10 ** draw.integers(1, 9, 40)).tolist():
        groups = typeset(f"for {number} points").removeprefix("for ").removesuffix(" points").split("\u00a0")
        assert int("".join(groups)) == number
        assert [len(group) for group in groups[1:]] == [3] * (len(groups) - 1)
        assert (len(groups) > 1) == (number >= 10_000)


@pytest.mark.parametrize(
    "text",
    [
        "liu2017/open_runs",
        "DNV-RP-C205",
        "riser[2].added_mass",
        "2.5e-5",
        "0.123456",
        "half-length",
        "bench/s2",
    ],
)
def test_names_and_other_numbers_stay_as_they_are(text):
    assert typeset(text) == text


def test_powers_and_references():
    assert typeset("3.2 m3, 80 m2, kg/m3, x^2, Fig 9, Eq. 4") == (
        "3.2\u00a0m³, 80\u00a0m², kg/m³, x², Fig\u00a09, Eq.\u00a04"
    )


@pytest.mark.parametrize("seed", range(9))
def test_a_share_has_no_exponent(seed):
    for value in 10.0 ** np.random.default_rng(seed).uniform(-18.0, 3.0, 50):
        assert "e" not in share(value)
        if (written := share(value)).startswith("<"):
            assert 100.0 * value < float(written.strip("<% "))
        else:
            assert float(written.strip(" %")) == pytest.approx(100.0 * value, rel=0.06)


@pytest.mark.parametrize("seed", range(9))
def test_a_name_breaks_after_slashes_and_underscores_only(seed):
    draw = np.random.default_rng(seed)
    name = "".join(draw.choice(list("abc2_/"), 30))
    of = parts(name)
    assert "".join(of) == name
    assert all(part[-1] in "_/" for part in of[:-1])
    assert not any(set("_/") & set(part[:-1]) for part in of)
