"""Units that results are read in: the same values by another name, for every variable there is."""

import math

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.limit_lines import lines
from riserstudy.dataset.table import OF_ROW, Table
from riserstudy.dataset.tables import in_units
from riserstudy.dataset.unit_systems import UnitSystem, read_in, reading_in, systems
from riserstudy.dataset.variables import attributes, variables
from riserstudy.figures.grid import label, read
from riserstudy.scene.limits import UNITS
from riserstudy.scene.units import factor

STORED = sorted({entry["units"] for entry in variables().values() if "units" in entry})
#: of which feet and kips have no other
COMMON = {"s", "h", "year", "Hz", "1", "knot", "year-1"}
#: as pint spells what people read
SPELT = {
    "lb/gal": "ppg", "ft³": "ft^3", "kip ft": "kip*ft", "kip s²/ft²": "kip*s^2/ft^2", "ft/s²": "ft/s^2",
    "kN m": "kN*m", "kg/m³": "kg/m^3", "N m": "N*m", "m s-1": "m/s", "m s-2": "m/s^2", "kg m-3": "kg/m^3",
    "rad m-1": "rad/m", "kN m-1": "kN/m", "MN m-1": "MN/m", "N m-1": "N/m", "kg m-1": "kg/m",
    "kN s2 m-2": "kN*s^2/m^2", "m3": "m^3", "degree": "deg",
}  # fmt: skip


@pytest.mark.parametrize("unit", STORED)
def test_every_unit_of_a_dataset_has_its_name_in_feet_and_kips(unit):
    assert (read_in(unit, UnitSystem.US).unit != unit) == (unit not in COMMON)


@pytest.mark.parametrize("system", list(UnitSystem))
def test_every_entry_is_the_unit_that_it_names(system):
    for stored, (name, size) in systems()[system].items():
        assert size == pytest.approx(factor(SPELT.get(name, name), SPELT.get(stored, stored)))


@pytest.mark.parametrize("name", [n for n, entry in variables().items() if "units" in entry])
@pytest.mark.parametrize("ending", ["", "_max", "_deviation", "_spectrum"])
def test_what_is_read_in_feet_and_kips_comes_back(name, ending):
    unit = attributes(name + ending).get("units", variables()[name]["units"])
    value = np.random.default_rng(len(name)).uniform(-1e6, 1e6)
    there = read_in(unit, UnitSystem.US)
    if ending == "_spectrum":  # squares of the quantity
        plain = read_in(variables()[name]["units"], UnitSystem.US)
        assert there.factor == pytest.approx(plain.factor**2)
        return
    back = factor(SPELT.get(there.unit, there.unit), SPELT.get(unit, unit)) if unit != there.unit else 1.0
    assert back * there.factor * value == pytest.approx(value)


def test_every_output_that_may_have_a_limit_can_be_read_in_every_system():
    for output, unit in UNITS.items():
        sizes = {
            system: factor(SPELT.get(name, name), unit)
            for system in (UnitSystem.FIELD, UnitSystem.US)
            if (name := read_in(unit, system).unit) != unit
        }
        for system, size in sizes.items():
            assert read_in(unit, system).factor * size == pytest.approx(1.0), (output, system)


def test_a_table_in_another_system_holds_the_same_quantities():
    table = Table(
        ["output", "unit", "largest", "s", "time"],
        ["", "", OF_ROW, "m", "s"],
        [["effective_tension", "N", 4448.2216152605, 0.3048, 7.0], ["lfj_angle", "rad", math.pi, None, 7.0]],
    )  # fmt: skip
    us = in_units(table, UnitSystem.US)
    assert us.units == ["", "", OF_ROW, "ft", "s"]
    assert us.rows[0] == ["effective_tension", "kip", pytest.approx(1.0), pytest.approx(1.0), 7.0]
    assert us.rows[1] == ["lfj_angle", "deg", pytest.approx(180.0), None, 7.0]
    assert in_units(table, UnitSystem.SI) == table


def test_a_limit_is_printed_in_the_units_that_are_asked_for():
    row = {
        "output": "bending_moment", "at": "", "mode": "drilling", "side": "largest", "allowable": 1355817.948,
        "demand": 677908.974, "utilisation": 0.5, "s": 30.48, "time": None, "verdict": "within",
        "missing": "", "origin": "given",
    }  # fmt: skip
    us, plain = (lines([row], system)[1].text for system in (UnitSystem.US, UnitSystem.FIELD))
    assert "500 kip ft  1000 kip ft  50 %  s = 100 ft" in us
    assert "677.9 kN m  1356 kN m  50 %  s = 30.48 m" in plain


def test_a_plot_reads_values_and_says_their_unit_in_one_system():
    values = xr.DataArray([6894757.293168361], dims="s", name="von_mises_stress")
    assert (float(read(values)[0]), "(MPa)" in label(values)) == (pytest.approx(6.894757), True)
    with reading_in(UnitSystem.US):
        assert (float(read(values)[0]), "(ksi)" in label(values)) == (pytest.approx(1.0), True)
    assert "(MPa)" in label(values)
