"""Units at the door."""

import math
import re
from pathlib import Path

import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import UNITS, numbers

from riserstudy.scene.units import ATMOSPHERE, _registry, factor, to_si, usual_units


@pytest.mark.parametrize(
    "text, unit, value",
    [
        ("21 in", "m", 0.5334),
        ("27 kN*m/deg", "N*m/rad", 27e3 * 57.29577951308232),
        ("2.5 knot", "m/s", 2.5 * 1852.0 / 3600.0),
        ("190.2 bar absolute", "Pa", 190.2e5),
        ("190.2 bar gauge", "Pa", 190.2e5 + ATMOSPHERE),
        ("232 tf", "N", 232e3 * 9.80665),
        ("140 t", "kg", 140e3),
        ("36 deg", "rad", 0.6283185307179586),
        ("206 GPa", "N/m^2", 206e9),
        ("8.6 lb/gal", "kg/m^3", 1030.50727),
        ("12 ppg", "kg/m^3", 12 * 119.826427),
        ("100 psf", "N/m^2", 100 * 4.4482216152605 / 0.3048**2),
        ("1e-3 m^2", "m^2", 1e-3),
        ("3 bbl", "m^3", 3 * 42 * 231 * 0.0254**3),
        ("1 lb/barrel", "kg/m^3", 2.8530102),
        ("-.5 m", "m", -0.5),
    ],
)
def test_a_paper_s_unit_becomes_si(text, unit, value):
    assert to_si(text, unit) == pytest.approx(value, rel=1e-6)


def test_oilfield_units_replace_pint_s_without_a_warning(caplog):
    _registry.__wrapped__()
    assert not caplog.records


@pytest.mark.parametrize(
    "unit, name", [(unit, name) for unit, names in usual_units().items() for name in names]
)
def test_every_unit_that_the_page_lists_is_read_as_the_library_has_it(unit, name):
    kind = " absolute" if unit == "Pa" else ""
    assert to_si(f"3 {name}{kind}", unit) == pytest.approx(3.0 * factor(name, unit))


def test_the_page_lists_names_for_every_field_that_takes_a_unit():
    text = (Path(__file__).parents[2] / "docs/scene.md").read_text("utf-8")
    asked = set(re.findall(r"(?:quantity|quantities) such as `1 ([^`]+)`", text))
    assert asked <= set(usual_units())


@pytest.mark.parametrize(
    "text, unit, said",
    [
        ("20 mt", "kg", "'mt', which means a thousandth of a tonne"),
        ("110 ton", "kg", "'ton', which means 1000 kg, 2000 lb or 2240 lb; write t, short_ton or"),
        ("0.2 tons/m", "kg/m", "'tons', which means 1000 kg, 2000 lb"),
        ("300 ton_force", "N", "'ton_force', which means the weight of 1000 kg or of 2000 lb"),
        ("20 t", "N", "for a force write tf"),
        ("14 kip", "kg", "for a mass write lb"),
        ("14 lb", "N", "for a force write lbf"),
    ],
)
def test_what_is_easily_taken_for_another_unit_is_refused_with_its_name(text, unit, said):
    with pytest.raises(ValueError, match=said):
        to_si(text, unit)


@given(number=numbers, pair=st.sampled_from(UNITS))
def test_units_make_the_round_trip(number, pair):
    name, unit, factor = pair
    # two conversions, a rounding each
    assert to_si(f"{number!r} {name}", unit) == pytest.approx(number * factor, rel=1e-12)
    assert to_si(f"{to_si(f'{number!r} {name}', unit)!r} {unit}", unit) == to_si(f"{number!r} {name}", unit)


def registry_names():
    """All units that pint has, by the name that a scene would write."""
    registry = pint.UnitRegistry()
    return registry, sorted({d.name for d in registry._units.values() if hasattr(d, "name")})


@pytest.mark.parametrize("unit", ["m/m", "rad", "m", "N", "kg", "s", "rad/s", "rad/m", "N/m^2", "kg/m"])
def test_a_unit_that_is_taken_is_proportional_to_the_quantity(unit):
    """Of the quantities nothing, one and two of it, by pint; logarithms and offsets are not."""
    registry, names = registry_names()
    taken = []
    for name in [*names, "dB", "Np", "mdB", "kNp"]:
        try:
            found = to_si(f"1 {name}", unit)
        except ValueError:
            continue
        none, one, two = (registry.Quantity(x, name).to(unit).magnitude for x in (0.0, 1.0, 2.0))
        assert none == 0.0, name
        assert two == pytest.approx(2.0 * one), name
        cycles = 2.0 * math.pi if "hertz" in name else 1.0  # to pint a cycle is no angle
        assert found == pytest.approx(cycles * one), name
        taken.append(name)
    if unit == "m/m":
        assert {*taken} <= {"percent", "permille", "ppm"}
    if unit == "m":
        assert {"meter", "foot", "inch", "yard", "nautical_mile"} <= {*taken}


@pytest.mark.parametrize("text", ["10 dB", "1 Np", "-3 dB", "0.5 turn", "2 pi", "1 octave", "3 bit"])
@pytest.mark.parametrize("unit", ["m/m", "rad", "rad/m", "m", "kg"])
def test_logarithms_and_numbers_with_names_are_no_units(text, unit):
    with pytest.raises(ValueError, match="write a number with a unit"):
        to_si(text, unit)
    with pytest.raises(ValueError, match="write a number with a unit"):
        to_si(f"{text}*{unit.partition('/')[0]}", unit)
