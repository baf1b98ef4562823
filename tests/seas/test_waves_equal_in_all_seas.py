"""Waves and motions that no sea state changes are refused, or named if they are in addition to the sea."""

import copy

import numpy as np
import pytest
from random_rigs import written
from rigs_in_waves import in_waves

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.synthetic import synthetic

ANGLE = {"output": "ufj_angle", "largest": "9 deg", "mode": "drilling"}
CASES = [(seed, spatial) for seed in range(3) for spatial in (False, True)]
SEA = {"significant_height": "3 m", "peak_period": "9 s", "peak_enhancement": 2.0}
SEA |= {"components": 10, "seed": 1, "above_mean_level": "none"}
REGULAR = {"height": "3 m", "period": "9 s"}
MOVING = {"amplitude": "1 m", "period": "11 s", "ramp": "11 s"}
POINTS = [{"time": f"{t} s", "value": f"{0.3 * (t % 10)} m"} for t in range(0, 25, 5)]


def tree_of(seed, spatial):
    tree = written(in_waves(seed, spatial, 31, "3 m", 10, 20.0, [0.5], [24]))
    return tree | {"limits": [ANGLE]}


def changed(tree, kind, draw):
    """The rig with a wave or a motion that is equal in all seas, and where it is."""
    tree = copy.deepcopy(tree)
    response = tree["platform"]["response"]
    if kind == "regular wave of the water":
        tree["wave"] = REGULAR | {"above_mean_level": "none"}
        return tree, "wave: this regular wave"
    if kind == "regular wave of the platform":
        response["wave"], tree["wave"] = REGULAR, SEA
        return tree, "platform.response.wave: this regular wave"
    del tree["platform"]["response"]
    tree["wave"] = SEA
    name = str(draw.choice(["surge", "heave"]))
    motion = {"harmonic": MOVING, "sum": [MOVING | {"amplitude": "0 m"}, MOVING]}
    tree["platform"][name] = motion.get(kind, {"points": POINTS})
    return tree, f"platform.{name}: the platform would move equally"


@pytest.mark.parametrize(
    "kind", ["regular wave of the water", "regular wave of the platform", "harmonic", "sum", "series"]
)
@pytest.mark.parametrize("seed, spatial", CASES)
def test_what_would_be_equal_in_all_seas_is_refused(seed, spatial, kind):
    """The riser would have hardly more response in the highest sea than in the lowest, and always work."""
    tree, where = changed(tree_of(seed, spatial), kind, np.random.default_rng(seed))
    file = SceneFile("rig.yaml", tree)
    file.resolved()  # the scene itself is allowed
    with pytest.raises(InputError, match=where):
        RiserResponse(file, 1, 3600.0, 1)


@pytest.mark.parametrize("seed, spatial", CASES)
def test_a_platform_at_rest_or_with_a_motion_of_no_size_is_allowed(seed, spatial):
    tree = tree_of(seed, spatial)
    del tree["platform"]["response"]
    tree["wave"] = SEA
    for motion in (None, MOVING | {"amplitude": "0 m"}):
        tree["platform"] |= {"surge": motion} if motion else {}
        assert RiserResponse(SceneFile("rig.yaml", tree), 1, 3600.0, 1).exposure > 0.0


@pytest.mark.parametrize("slow", [False, True])
def test_a_motion_in_addition_to_the_sea_is_named(slow):
    """Such as a slow drift, which the response to waves does not include."""
    tree = tree_of(0, False)
    if slow:
        tree["platform"]["surge"] = MOVING | {"period": "90 s"}
    record = synthetic(2, 8).isel(time=slice(None, None, 887))
    made = riser_downtime(SceneFile("rig.yaml", tree), record, seeds=1, error=0.5)
    named = [line for line in made.lines if line.startswith("prescribed surge of the platform")]
    assert len(named) == slow
