"""A fault of a unit in a heading is a sentence about this unit, with the remedy for this unit."""

import pytest

from riserstudy.errors import InputError
from riserstudy.fatigue.occurrence import _factor
from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.units import to_si, unit_factor
from riserstudy.seas.columns import head

WRONG = {
    "m/q": "the unit 'm/q' is not known; use",
    "m'm": """the unit "m'm" is not known; use""",
    "5 m": "the unit '5 m' is not known; use",
    "kg": "the unit 'kg' has the wrong dimension; use",
    "ton": "the unit 'ton' contains 'ton', which means 1000 kg, 2000 lb or 2240 lb; write t, short_ton",
    "mt": "the unit 'mt' contains 'mt', which means a thousandth of a tonne; write t or kg",
    "km^9/m^5": "the unit 'km^9/m^5' has the wrong dimension; use",
    "km^21/m^20": "the unit 'km^21/m^20' is larger than 1e+30 m; use",
}


@pytest.mark.parametrize("unit", WRONG)
def test_a_heading_with_a_wrong_unit_is_told_about_the_unit(unit):
    for refused in (lambda: head("seas.csv", f"hs ({unit})"), lambda: _factor("seas.csv", "hs", unit, "m")):
        with pytest.raises(InputError) as error:
            refused()
        assert WRONG[unit] in str(error.value)


@pytest.mark.parametrize("unit", [unit for unit in WRONG if unit != "km^21/m^20"])
def test_a_value_with_a_wrong_unit_is_quoted_whole(unit):
    with pytest.raises(Misfit) as error:
        to_si(f"3 {unit}", "m")
    assert error.value.found.startswith(repr(f"3 {unit}"))


@pytest.mark.parametrize("unit", ["ft", "km", "m", "in", "cm"])
def test_the_factor_of_a_unit_is_the_value_of_one(unit):
    assert unit_factor(unit, "m") == to_si(f"1 {unit}", "m")


def test_a_pressure_has_a_factor_without_a_zero():
    """A factor converts differences, which are alike for absolute and gauge pressures."""
    assert unit_factor("bar", "Pa") == 1e5
