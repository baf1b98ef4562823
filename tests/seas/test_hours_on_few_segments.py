"""On a user's mesh and step the band of workable hours includes those of a fine mesh and a short step."""

import copy

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.scene.load import SceneFile
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
ALONG = {"surge": "0.6 m/m", "surge_phase": "90 deg", "heave": "0.5 m/m", "heave_phase": "0 deg"}
FINER = 4
COVERED = 1.5  # most of an error as a multiple of its estimate
CASES = [(seed, spatial) for seed in range(3) for spatial in (False, True)]


def in_waves(seed, spatial):
    """A rig below a platform that follows an irregular sea, on few segments by long or short steps."""
    tree = rig(seed, spatial=spatial, conductor=False)
    draw = np.random.default_rng((seed, spatial, 12))
    wave = {"significant_height": "3 m", "peak_period": "10 s", "peak_enhancement": 2.0}
    wave |= {"components": 15, "seed": 1}
    operators = [{"period": f"{period} s", **ALONG} for period in (1, 6, 12, 60)]
    tree["platform"]["response"] = {"operators": operators, "phases": "lead", "wave": wave, "ramp": "5 s"}
    step, elements = float(draw.choice([0.2, 0.5, 1.0])), int(draw.choice([20, 60]))
    tree["analysis"] = {"duration": 25.0, "step": step, "mesh": {"elements": elements}}
    tree["analysis"]["output"] = {"interval": 1.0}
    return tree


def finer(tree):
    tree = copy.deepcopy(tree)
    tree["analysis"]["mesh"]["elements"] *= FINER
    tree["analysis"]["step"] /= FINER
    return tree


def file_of(tree, largest):
    limits = [
        {"output": name, "largest": f"{value!r} {UNITS[name]}", "mode": "drilling"}
        for name, value in largest.items()
    ]
    return SceneFile("rig.yaml", written(tree) | {"limits": limits})


@pytest.mark.parametrize("seed, spatial", CASES)
def test_bands_include_the_demands_and_hours_of_a_fine_mesh(seed, spatial):
    record = synthetic(1, seed).isel(time=slice(None, None, 1100))
    rows = np.column_stack([record[n].values for n in ("significant_wave_height", "peak_period")])
    tree = in_waves(seed, spatial)
    fine = RiserResponse(file_of(finer(tree), dict.fromkeys(UNITS, 1e30)), 1, 3600.0, 1)(rows)
    there = np.isfinite(fine).all(axis=0)  # outputs that the rig has
    fine = fine[:, there]
    outputs = [name for name, known in zip(UNITS, there, strict=True) if known]
    allowed = dict(zip(outputs, np.median(fine, axis=0).tolist(), strict=True))
    found = riser_downtime(file_of(tree, allowed), record, seeds=1, error=0.5)
    off = np.abs(found.demands.rows.demand - fine)
    assert (off <= COVERED * found.demands.rows.off + 1e-6 * np.abs(fine)).all()
    (mode,) = found.hours.modes
    true = (fine <= list(allowed.values())).all(axis=1).mean()
    assert mode.low <= true <= mode.high
    assert any("the scene's mesh and step, demands have an estimated error" in line for line in found.lines)
