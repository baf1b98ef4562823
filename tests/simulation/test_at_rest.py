"""What is asked at rest does not depend on how a run would begin: on motions and ramps."""

import copy
import json

import numpy as np
import pytest
from random_rigs import rig, timed, written

from riserstudy import modes, simulate
from riserstudy.design import engine_tension
from riserstudy.design.operability import offsets
from riserstudy.design.tension import Tolerances
from riserstudy.design.vortex_screening import screening
from riserstudy.scene.load import SceneFile

LIMITS = [
    {"output": "lfj_angle", "largest": "1 deg", "mode": "drilling"},
    {"output": "joint_stroke", "largest": "1.5 m", "mode": "connected"},
]
ALONG = ("x", "y", "z", "effective_tension", "bending_moment")
TOLERANCES = Tolerances(weight=1.05, buoyancy=0.96)
KINDS = ("harmonic", "time series", "current with a ramp")
RIGS = [(seed, kind) for seed in range(3) for kind in KINDS]


def pair(seed, kind):
    """A rig that stays where it is in the whole current, and the same whose run begins elsewhere."""
    still = rig(seed, spatial=seed % 2 == 1)
    for section in still["riser"]:
        section["buoyancy_lift"] = "0 N/m"
    other = copy.deepcopy(still)
    draw = np.random.default_rng(seed)
    first = draw.uniform(2.0, 4.0, 3).tolist()
    if kind == "current with a ramp":
        other["current"]["ramp"] = 20.0
    for name, size in zip(("surge", "sway", "heave"), first, strict=True):
        if kind == "harmonic" and (name != "sway" or seed % 2):
            other["platform"][name] = {"amplitude": size, "period": 12.0, "phase": 0.5}
        elif kind == "time series" and name != "sway":
            points = [{"time": f"{t} s", "value": f"{size + t / 20.0} m"} for t in (0, 15, 30, 45)]
            other["platform"][name] = {"points": points}
    return [SceneFile("rig.yaml", written(tree) | {"limits": LIMITS}) for tree in (still, other)]


def in_time(file):
    analysis = written(timed(40.0, 0.2, 60, 1.0))
    return file.with_values({"analysis": analysis}, "test")


@pytest.mark.parametrize("seed, kind", RIGS)
def test_a_run_at_rest_does_not_begin_a_motion_or_a_ramp(seed, kind):
    one, other = (simulate(file, progress=False) for file in pair(seed, kind))
    for name in ALONG:
        if name in one:
            size = float(abs(one[name]).max())
            np.testing.assert_allclose(other[name], one[name], atol=1e-9 * size)
    uses = [[row["utilisation"] for row in json.loads(run.attrs["limits"])] for run in (one, other)]
    assert uses[0][0] > 0.0
    np.testing.assert_allclose(uses[1], uses[0], rtol=1e-7)


@pytest.mark.long
@pytest.mark.parametrize("seed, kind", RIGS)
def test_modes_and_offsets_are_those_of_the_riser_at_rest(seed, kind):
    one, other = (in_time(file) for file in pair(seed, kind))
    frequency = [modes(file, 6)["frequency"].values for file in (one, other)]
    np.testing.assert_allclose(frequency[1], frequency[0], rtol=1e-7)
    found = [[o[:2] for o in offsets(file.resolved(), 60.0, {})] for file in (one, other)]
    np.testing.assert_allclose(found[1], found[0], atol=1e-3)


@pytest.mark.parametrize("seed, kind", RIGS[:6])
def test_screening_and_tension_are_those_of_the_riser_at_rest(seed, kind):
    one, other = (in_time(file) for file in pair(seed, kind))
    screened = [screening(file) for file in (one, other)]
    for name in ("current_speed", "natural_frequency", "amplitude"):
        np.testing.assert_allclose(screened[1][name], screened[0][name], rtol=1e-6, atol=1e-9)
    needed = [engine_tension.needed(file.resolved(), TOLERANCES) for file in (one, other)]
    assert needed[1].tension == pytest.approx(needed[0].tension, rel=1e-7)
