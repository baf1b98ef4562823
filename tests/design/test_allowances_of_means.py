"""The allowance of a limit on a mean is the change of the mean by the sea, which changes the mean drag."""

import json
from pathlib import Path

import numpy as np
import pytest
from random_rigs import written
from rigs_in_waves import in_waves

from riserstudy import load_scene, simulate
from riserstudy.design.allowances_by_offset import ByOffset
from riserstudy.design.operability import CLOSE, AtRest, offsets_of
from riserstudy.design.sea_allowances import Allowance, allowances
from riserstudy.scene.load import SceneFile
from riserstudy.study.in_sea import Sea, in_sea

SEA, RAMP = Sea(6.0, 10.0), 5.0
RISER = Path(__file__).parents[2] / "config/scenes/design/riser.yaml"
ANGLES = ("lfj_angle", "ufj_angle")


def file_of(seed, spatial):
    """A rig in waves, with outputs at every step and limits on means."""
    tree = in_waves(seed, spatial, 23, "6 m", 20, 40.0, [0.1], [60])
    tree["analysis"]["output"] = {"interval": 0.1}
    tree["current"] = {"profile": {"shape": "uniform", "surface_speed": "0.8 m/s"}}
    limits = [{"output": name, "mean": "1000 rad", "mode": "drilling"} for name in ANGLES]
    return SceneFile("rig.yaml", written(tree) | {"limits": limits})


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_a_mean_changes_by_its_allowance(seed, spatial):
    """In space, the magnitude of a mean rotation changes at most by that of the change."""
    file = file_of(seed, spatial)
    none = dict.fromkeys(("analysis.duration", "analysis.output", "analysis.step"))
    still, moving = simulate(file.with_values(none, "test")), simulate(in_sea(file, SEA, 1))
    after = moving["time"].values >= RAMP - 1e-9
    means = {row["output"]: row.get("mean") for row in json.loads(moving.attrs["extremes"])}
    tried = 0
    for name, one in zip(ANGLES, allowances(file, SEA, 1), strict=True):
        if one.missing:
            assert "as estimated" in one.missing
            continue
        rest = float(np.ravel(still[f"{name}_static"])[0])
        if spatial:
            assert abs(means[name] - rest) <= one.value * (1.0 + 1e-6)
            continue
        mean = np.trapezoid(moving[name].values[after], moving["time"].values[after]) / (40.0 - RAMP)
        assert one.value == pytest.approx(abs(mean - rest), rel=1e-3, abs=1e-7)
        assert one.value > 0.0
        tried += 1
    assert tried or spatial


@pytest.mark.parametrize("change", [0.0, 0.003, 0.01])
@pytest.mark.parametrize("name", ANGLES)
def test_the_change_of_a_mean_is_a_smaller_allowable(name, change):
    """The offsets with an allowance are those without it, of an allowable that is smaller by it."""
    allowed = 0.05
    found = []
    for limit, added in ((allowed, change), (allowed - change, 0.0)):
        limits = [{"output": name, "mean": f"{limit!r} rad", "mode": "drilling"}]
        riser = load_scene(RISER, limits=limits).resolved()
        at = ByOffset([0.0], [Allowance(added)])
        found.append(offsets_of(AtRest(riser, 100.0), riser.limits[0], 100.0, at.at))
    assert found[0][:2] == pytest.approx(found[1][:2], abs=CLOSE)
