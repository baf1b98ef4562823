"""On a user's mesh and step the band of workable hours includes those of a fine mesh and a short step."""

import re

import numpy as np
import pytest
from rigs_in_waves import finer, in_waves, limited

from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.synthetic import synthetic

UNITS = {
    "lfj_angle": "rad",
    "effective_tension": "N",
    "joint_stroke": "m",
    "tensioner_force": "N",
    "bending_moment": "N*m",
}
COVERED = 1.5  # most of an error as a multiple of its estimate
CASES = [(seed, spatial) for seed in range(3) for spatial in (False, True)]


def of_seed(seed, spatial):
    """A rig in waves, on few segments by long or short steps."""
    return in_waves(seed, spatial, 12, "3 m", 15, 25.0, [0.2, 0.5, 1.0], [20, 60])


@pytest.mark.parametrize("seed, spatial", CASES)
def test_bands_include_the_demands_and_hours_of_a_fine_mesh(seed, spatial):
    record = synthetic(1, seed).isel(time=slice(None, None, 1100))
    rows = np.column_stack([record[n].values for n in ("significant_wave_height", "peak_period")])
    tree = of_seed(seed, spatial)
    fine = RiserResponse(limited(finer(tree), dict.fromkeys(UNITS, 1e30), UNITS), 1, 3600.0, 1)(rows)
    there = np.isfinite(fine).all(axis=0)  # outputs that the rig has
    fine = fine[:, there]
    outputs = [name for name, known in zip(UNITS, there, strict=True) if known]
    allowed = dict(zip(outputs, np.median(fine, axis=0).tolist(), strict=True))
    found = riser_downtime(limited(tree, allowed, UNITS), record, seeds=1, error=0.5)
    off = np.abs(found.demands.rows.demand - fine)
    assert (off <= COVERED * found.demands.rows.off + 1e-6 * np.abs(fine)).all()
    (mode,) = found.hours.modes
    true = (fine <= list(allowed.values())).all(axis=1).mean()
    assert mode.low <= true <= mode.high
    (line,) = [one for one in found.lines if "the scene's mesh and step, demands have an estimated" in one]
    percent = float(re.search(r"up to ([\d.]+)%", line)[1])
    assert ("give a finer analysis.mesh" in line) == (percent > 5.0)
