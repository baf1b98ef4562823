"""Largest moments of Liu et al. 2020 are those of the riser, whatever the telescopic joint above it carries.

Cylinders that pull unequally, of which one has failed, turn the ring. A stiff joint then has a larger moment
above the ring than the riser below it.
"""

import numpy as np
import pytest
import xarray as xr
from random_rigs import on_cylinders, written

from chapters.liu2020 import below_ring
from chapters.liu2020.claims.motions import same_influence
from chapters.liu2020.derived import motion, statics
from riserstudy.dataset.extremes import OVER
from riserstudy.grading.word_of_size import Word
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

RINGS = {"from the lower flex joint to the ring": 533.0, "from the lower to the upper flex joint": 510.5}


def turned(seed, spatial):
    """A run of a rig with a failed cylinder below a stiff joint, and the elevation of its ring (m)."""
    tree = on_cylinders(seed, "arrangement", spatial=spatial, conductor=False)
    tree["top"]["rotation"] = "free"
    tree["top"]["tensioners"]["failed"] = [0]
    tree["top"]["tensioners"]["arrangement"]["ring_radius"] = 1.0
    tree["top"]["telescopic_joint"]["bending_stiffness"] = 1e11
    tree["analysis"]["duration"] = 10.0 * tree["analysis"]["output"]["interval"]
    found = run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False)
    return found, sum(section["length"] for section in tree["riser"])


def dataset(found, statistics):
    """What a study of one run keeps of it, with or without the statistics at the run's own nodes."""
    names = ("bending_moment_max", "bending_moment_min", "bending_moment_static")
    data = {name: (("roll_period", "s_node"), found.arrays[name][None]) for name in names}
    for name in ("largest_bending_moment", "largest_bending_moment_s"):
        data[name] = ("roll_period", [found.facts[name]])
    coordinates = {"roll_period": [10.0], "s_node": found.arrays["s_node"]}
    if statistics:
        ends = [float(found.arrays[names[0]].max()), float(found.arrays[names[1]].min())]
        data["value_of_statistic"] = (("roll_period", OVER), [ends])
        coordinates[OVER] = ["bending_moment max", "bending_moment min"]
    return xr.Dataset(data, coordinates)


@pytest.mark.parametrize("spatial", [False, True])
def test_a_larger_moment_in_the_joint_is_not_the_riser_s(spatial, monkeypatch):
    jumped = 0
    for seed in range(4):
        found, ring = turned(seed, spatial)
        monkeypatch.setattr(below_ring, "RING", ring)
        node, moment = found.arrays["s_node"], found.arrays["bending_moment"]
        # from the histories of all nodes up to the ring; steps between outputs and nodes add little
        of_riser = np.abs(moment[:, node <= ring + 1e-6]).max()
        for statistics in (False, True):
            value = motion.roll_assumed(dataset(found, statistics))["largest_bending_moment"].item()
            assert value >= (1.0 - 1e-9) * of_riser
            assert value == pytest.approx(of_riser, rel=0.05)
        jumped += found.facts["largest_bending_moment"] > 1.1 * of_riser
    assert jumped


@pytest.mark.parametrize("seed", range(8))
def test_the_ring_of_each_run_is_where_its_length_puts_it(seed):
    """Drawn moments: the largest of a run is at its ring, above the jump there, or anywhere below it."""
    draw = np.random.default_rng(seed)
    names = draw.choice(list(RINGS), 6)
    ring = np.array([RINGS[name] for name in names])
    below, above = draw.uniform(10.0, 50.0, 6), draw.uniform(10.0, 50.0, 6)
    place = np.where(above > below, ring, draw.uniform(0.0, 500.0, 6))
    sign = draw.choice([-1.0, 1.0], 6)
    s = np.array([0.0, 400.0, 510.5, 533.0, 557.0])
    # a study interpolates along the joint from the node of the ring, and does not know the jump
    nodes = np.where(s[None] == ring[:, None], (sign * below)[:, None], 0.0)
    runs = xr.Dataset(
        {
            "bending_moment_max": (("sample", "s_node"), np.maximum(nodes, 0.0)),
            "bending_moment_min": (("sample", "s_node"), np.minimum(nodes, 0.0)),
            "largest_bending_moment": ("sample", np.maximum(below, above)),
            "largest_bending_moment_s": ("sample", place),
            "assumed_printed_length": ("sample", names),
        },
        {"sample": np.arange(6), "s_node": s},
    )
    for read in (runs, runs.drop_vars("assumed_printed_length").rename(sample="variant")):
        if "variant" in read.dims:
            ends = {"from the lower to the upper flex joint": "533 m to the upper flex joint"}
            read = read.assign_coords(variant=[ends.get(str(name), str(name)) for name in names])
        np.testing.assert_allclose(below_ring.largest_moment(read), below)
    motions = xr.concat([runs, 3.0 * runs.drop_vars("assumed_printed_length")], "motion", coords="minimal")
    motions = motions.assign(
        {name: runs[name] for name in ("assumed_printed_length", "largest_bending_moment_s")}
    ).assign_coords(motion=["roll", "pitch"])
    ratio = same_influence(motions, "pitch", "roll", Word("same", 0.02, True, 0.02)).value
    np.testing.assert_allclose(ratio, 3.0)


@pytest.mark.parametrize("seed", range(4))
def test_static_moments_are_those_of_the_riser_too(seed, monkeypatch):
    draw = np.random.default_rng(seed)
    below = float(draw.uniform(10.0, 50.0))
    s = np.array([0.0, 480.0, 533.0, 557.0])
    force = xr.DataArray([[3.0, 1.0]], dims=("tensioner_model", "counted"))
    monkeypatch.setattr(statics, "_force", lambda runs: force)
    runs = xr.Dataset(
        {
            "bending_moment_static": (("tensioner_model", "s_node"), [[0.0, 5.0, -below, 0.0]]),
            "x_static": (("tensioner_model", "s_node"), [[0.0, 1.0, 2.0, 0.0]]),
            "largest_bending_moment": ("tensioner_model", [2.0 * below]),
            "largest_bending_moment_s": ("tensioner_model", [533.0]),
        },
        {"tensioner_model": ["gas law"], "s_node": s},
    )
    found = statics.statics_tuned(runs)
    assert found["largest_bending_moment"].item() == pytest.approx(below)
    assert found["largest_bending_moment_near_ring"].item() == pytest.approx(below)
