"""Starts without a ramp are named, and whether a ramp has ended does not hang on the rounding of a time."""

import copy

import pytest
from random_rigs import moving, written

from riserstudy import simulate
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

WAVE = {"height": "4 m", "period": "9 s", "above_mean_level": "stretched"}


def still(seed):
    tree = moving(seed, spatial=False, conductor=False)
    tree["platform"] = {"position": {"surge": 0.0}, "centre_of_rotation": {"elevation": 0.0}}
    return tree


def in_a_wave(**wave):
    tree = written(still(2))
    tree["wave"] = WAVE | wave
    tree["analysis"] = {"duration": "9 s", "accuracy": "20 %", "output": {"interval": "0.5 s"}}
    return simulate(SceneFile("rig.yaml", tree), progress=False)


def test_a_wave_without_a_ramp_is_named_with_its_remedy():
    assert "wave.ramp: 18 s" in in_a_wave().attrs["warnings"]
    assert "ramp" not in in_a_wave(ramp="9 s").attrs["warnings"]


@pytest.mark.parametrize("seed", range(8))
def test_a_ramp_that_ends_on_a_step_ends_alike_in_every_unit_of_time(seed):
    """Times by n steps and by a ramp of another unit differ by rounding; moments must not."""
    tree = moving(seed, spatial=False, conductor=False)
    ramp = 6.0
    tree["platform"]["surge"] = {"amplitude": 2.0, "period": 11.0, "ramp": ramp, "phase": 0.7}
    for motion in ("heave", "pitch"):
        tree["platform"].pop(motion, None)
    # the riser itself at the platform: the node of a telescopic joint's end has no mass to accelerate
    tree["top"] = {"x": "platform", "z": "free", "rotation": "free", "tension": 2e7}
    del tree["current"], tree["water"]["surface"], tree["water"]["seabed"]
    tree["analysis"] |= {"duration": 12.0, "step": 0.1, "output": {"interval": 0.5}}
    moments = []
    for rounding in (-4e-16, 0.0, 4e-16):  # as of a time through another unit and back
        other = copy.deepcopy(tree)
        other["platform"]["surge"]["ramp"] = ramp * (1.0 + rounding)
        # without an estimate: a jolt that a mesh of its own does not resolve would be refused
        result = run(SceneFile("rig.yaml", written(other)).resolved(), estimated=False)
        moments.append(result.arrays["bending_moment"])
    size = float(abs(moments[0]).max())
    for other in moments[1:]:
        assert float(abs(other - moments[0]).max()) < 1e-9 * size
