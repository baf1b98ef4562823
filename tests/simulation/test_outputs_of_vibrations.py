"""Statistics of a vibration do not depend on the output interval, or are not given: seeded scenes."""

import copy

import numpy as np
import pytest
from random_rigs import rig, shed_vortices, timed, written
from short_riser import SCENE

from riserstudy.model.vortices import shortest_shedding_period
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.simulation.vortex_vibration import enter

STATISTICS = ("vibration_rms", "vibration_rms_max", "vibration_frequency")
DENSER = 10  # factor of the denser outputs
STEP = 0.05  # s
KINDS = ("wave", "wave and slow current", "tow", "tow in waves")


def drawn(kind, seed):
    """The short riser in a long wave, in still water below a cruising platform, or in both: a tree."""
    draw = np.random.default_rng((seed, KINDS.index(kind)))
    tree, speed = copy.deepcopy(SCENE), draw.uniform(0.1, 0.5)
    if "wave" in kind:
        wave = {"amplitude": f"{draw.uniform(0.1, 2.0)} m", "period": f"{draw.uniform(8.0, 30.0)} s"}
        tree["wave"] = wave | {"above_mean_level": "none"}
    if kind != "wave":
        still = 0.1 * speed if kind == "wave and slow current" else 0.0
        tree["current"] = {"profile": {"shape": "uniform", "surface_speed": f"{still} m/s"}}
    if "tow" in kind:
        tree["water"]["seabed"] = "-30 m"
        tree["bottom"] = {"hold": "free"}
        tree["top"] = {"x": "platform", "z": "platform", "elevation": "100 m"}
        tree["platform"] = {"cruise": {"speed": f"{speed} m/s", "ramp": "20 s"}}
    tree["analysis"] |= {"duration": "600 s", "step": f"{STEP} s", "output": {"interval": f"{STEP} s"}}
    return tree


def facts_of(scene, arrays, every):
    """Facts of the vibration in every so manieth output of a run."""
    facts = {"warnings": []}
    fewer = {name: arrays[name][::every] for name in ("time", "x", "y")}
    enter(scene, STEP, fewer | {"s": arrays["s"]}, facts)
    return facts


def compare_outputs(scene, seed, periods):
    """Outputs at periods (s) and at shorter intervals: statistics are right, or absent with a warning."""
    arrays = run(scene, estimated=False).arrays
    draw = np.random.default_rng((seed, 9))
    for period in periods:
        for share in (1.0, 0.5, *draw.uniform(0.2, 0.5, 4)):
            every = max(1, round(share * period / DENSER / STEP))
            coarse, dense = (facts_of(scene, arrays, one) for one in (DENSER * every, every))
            for name in STATISTICS:
                if name in coarse:
                    assert coarse[name] == pytest.approx(dense[name], rel=0.05), (name, every)
            missing = [name for name in STATISTICS if name not in coarse]
            assert not missing or any("outputs" in text for text in sentences(coarse["warnings"]))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(3))
def test_statistics_of_coarse_outputs_are_right_or_absent(kind, seed):
    tree = drawn(kind, seed)
    scene = SceneFile("riser.yaml", tree, {}).resolved()
    waves = [float(tree["wave"]["period"].split()[0])] if "wave" in tree else []
    compare_outputs(scene, seed, [shortest_shedding_period(scene), *waves])


@pytest.mark.parametrize("seed", range(8))
def test_statistics_of_coarse_outputs_on_inclined_tensioners_are_right_or_absent(seed):
    """Rigs in a slow current, in waves or below a surging platform, at rest in a plane or with a sway."""
    draw = np.random.default_rng((seed, 5))
    tree = shed_vortices(rig(seed, spatial=bool(seed % 2), conductor=False))
    tree["current"]["profile"]["surface_speed"] = float(draw.uniform(0.02, 0.1))
    motion = {"amplitude": float(draw.uniform(1.0, 3.0)), "period": float(draw.uniform(9.0, 14.0))}
    if seed % 4 < 2:
        tree["wave"] = motion | {"above_mean_level": "none"}
    else:
        tree["platform"]["surge"] = motion | {"ramp": 20.0}
    tree["analysis"] = timed(240.0, STEP, 60, STEP)
    scene = SceneFile("rig.yaml", written(tree)).resolved()
    compare_outputs(scene, seed, [shortest_shedding_period(scene), motion["period"]])
