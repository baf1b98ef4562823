"""A unit in the report is the unit of the dataset, in whatever powers: parsed by another library."""

import random
import re

import cf_xarray.units  # defines the notation of CF for pint
import pint
import pytest

from riserstudy.records.units import after_number

NAMES = ("m", "s", "kg", "N", "Pa", "rad", "kN", "Hz", "year", "MN", "J", "W")
RAISED = str.maketrans("²³⁴⁵⁶⁷⁸⁹", "23456789")


@pytest.fixture(scope="module")
def registry():
    return cf_xarray.units.units


def as_formula(text):
    """The text of a unit as a formula: products by blanks, powers by superscripts."""
    plain = re.sub("([²³⁴⁵⁶⁷⁸⁹])", r"**\1", text.strip()).translate(RAISED)
    return re.sub(r"(?<=[\w)]) (?=\w)", " * ", plain)


@pytest.mark.parametrize("seed", range(60))
def test_the_text_of_a_unit_is_that_unit(registry, seed):
    draw = random.Random(seed)
    parts = draw.sample(NAMES, draw.randint(1, 4))
    powers = [draw.choice([1, 1, 1, 2, 3, 4, 5, -1, -1, -2, -3, -6]) for _ in parts]
    name = " ".join(
        part + (str(power) if power != 1 else "") for part, power in zip(parts, powers, strict=True)
    )
    expected = registry.dimensionless
    for part, power in zip(parts, powers, strict=True):
        expected *= registry.Unit(part) ** power
    text = after_number(name)
    assert text.startswith(" ")
    assert "-" not in text
    assert pint.Unit(as_formula(text)) == pint.Unit(str(expected))
    order = re.findall("[A-Za-z]+", text)
    above = [part for part, power in zip(parts, powers, strict=True) if power > 0]
    assert order[: len(above)] == above  # N m, never m N


@pytest.mark.parametrize("name, text", [("", ""), ("1", ""), ("deg", "°"), ("degree", "°"), ("%", " %")])
def test_units_without_powers(name, text):
    assert after_number(name) == text


@pytest.mark.parametrize("name", ["m-", "m0", "bar absolute 3", "hours since 2000-01-01", "m s**-1"])
def test_what_is_not_in_this_notation_is_not_changed(name):
    assert after_number(name) == f" {name}"
