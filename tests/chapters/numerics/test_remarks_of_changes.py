"""Remarks of the table of effects name the fault alone, whatever characters file and fault contain."""

import numpy as np
import pytest
import xarray as xr

from chapters.numerics.report.tables import CHANGES, changes
from riserstudy.advice.ablation import Changed
from riserstudy.effects.catalogue import changes as all_changes
from riserstudy.errors import InputError, InputErrors, SimulationError

CHANGE = "the change 'with drag'"
FILES = ("config/scenes/bench/s4b.yaml", "C:/risers; old/a: b.yaml", "the change 'x': y.yaml")
FAULTS = (
    ("riser[0].submerged_weight", "the weight of section 'upper; lower: joint' is missing"),
    ("riser[0].drag", "has no diameter"),
    ("wave", "has no effect: no riser section has drag"),
    ("", "the scene is empty"),
)


def remark_on(error):
    """The remark about a change whose run ends with an error."""
    changed = Changed(change=next(iter(all_changes())))
    changed.refused(error)
    nothing = (("scene", "change"), np.full((1, 1), np.nan))
    fault = (("scene", "change"), [[changed.fault]])
    of = xr.Dataset(
        {**dict.fromkeys([*CHANGES, "time_change"], nothing), "fault": fault},
        coords={"scene": ["s4b"], "change": ["with drag"]},
    )
    ((*_, cell),) = changes(of).rows
    return cell.text


@pytest.mark.parametrize("file", FILES)
@pytest.mark.parametrize("field, found", FAULTS)
def test_a_change_that_is_refused_is_told_without_file_and_remedy(file, field, found):
    error = InputError(f"{file} with {CHANGE}", field, found, "give a weight")
    told = f"Not possible: {field}: {found}." if field else f"Not possible: {found}."
    assert remark_on(error) == told
    other = InputError(f"{file} with {CHANGE}", "top", "is missing", "give it")
    assert remark_on(InputErrors([error, other])) == told


def test_a_run_that_stops_is_told_whole():
    assert (
        remark_on(SimulationError("it stopped at 3 s: no; why"))
        == "Not possible: it stopped at 3 s: no; why."
    )
