"""Calm seas are those of small heights, periods and speeds, in whatever unit an axis has them."""

import numpy as np
import pytest

from riserstudy.errors import InputError
from riserstudy.fatigue.occurrence import Occurrence, within

SEAS = Occurrence({"axis": np.array([1.0, 5.0])}, np.array([0.5, 0.5]), ())
GRID = {"axis": np.array([2.0, 6.0])}


@pytest.mark.parametrize("unit", ["m", "ft", "cm", "s", "min", "m s-1", "m/s", "knot", "ft/s", "km h-1"])
def test_calm_seas_are_the_calmest_simulated_sea(unit):
    found = within(SEAS, GRID, True, {"axis": unit})
    assert found.values["axis"].tolist() == [2.0, 5.0]
    with pytest.raises(InputError, match="add --calm"):
        within(SEAS, GRID, False, {"axis": unit})


@pytest.mark.parametrize("unit", ["degree", "rad", "1", "", "kg m-3", "kN"])
def test_other_values_below_the_range_are_refused(unit):
    with pytest.raises(InputError, match="outside the simulated range"):
        within(SEAS, GRID, True, {"axis": unit})
