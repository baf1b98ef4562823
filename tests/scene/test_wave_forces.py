"""Warnings about parts in water without some of its forces: sections without added mass, joints."""

import json
from pathlib import Path

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy import load_scene, simulate
from riserstudy.scene.load import SceneFile
from riserstudy.scene.wave_forces import joint_in_water, without_inertia

BASE = Path(__file__).parents[2] / "config/scenes/fem_riser/base.yaml"
RUN = {"duration": "6 s", "output": {"interval": "1 s"}, "mesh": {"elements": 40}, "step": "0.1 s"}
SHORT = {"analysis": RUN}
MASS = "riser[0].added_mass"


def test_a_scene_with_added_mass_or_without_waves_is_not_warned_of():
    assert without_inertia(load_scene(BASE).resolved()) == []
    assert without_inertia(load_scene(BASE, **{MASS: None, "wave": None}).resolved()) == []


def test_drag_in_waves_without_added_mass_is_told_in_the_run():
    """And it is no coefficient of 0, which leaves the force of the undisturbed water."""
    none = simulate(load_scene(BASE, **SHORT, **{MASS: None}))
    zero = simulate(load_scene(BASE, **SHORT, **{f"{MASS}.coefficient": 0}))
    (said,) = [w for w in json.loads(none.attrs["warnings"]) if "Froude-Krylov" in w]
    assert said.startswith("riser[0].added_mass:")
    assert not any("Froude-Krylov" in w for w in json.loads(zero.attrs["warnings"]))
    moved = np.abs(zero["x"] - zero["x"][0]).max()
    assert np.abs(none["x"] - zero["x"]).max() > 0.01 * moved


@pytest.mark.parametrize("seed", range(12))
def test_a_joint_that_is_mostly_in_water_has_a_warning(seed):
    tree = rig(seed, conductor=False)
    length, top = tree["top"]["telescopic_joint"]["length"], tree["top"]["elevation"]
    share = float(np.random.default_rng(seed).uniform(0.0, 1.2))
    tree["water"]["surface"] = top - length + share * length
    assert bool(joint_in_water(SceneFile("rig.yaml", written(tree)).resolved())) == (share > 0.5)
    del tree["current"]
    assert joint_in_water(SceneFile("rig.yaml", written(tree)).resolved()) == []
