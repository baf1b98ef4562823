"""The outcome of a disconnect does not depend on how a scene is written, nor on the interval of outputs."""

import copy
import json
from types import SimpleNamespace

import numpy as np
import pytest
from changes import in_other_units, lifted, mirrored, moved_by_the_top, rotated, split
from random_rigs import moving, written

from riserstudy.dataset.recoil_table import recoil
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

WITHIN = 2e-4  # of a value, or of SMALL (m, kN or m/s) where it is larger
SMALL = 0.05
LATER = 0.02  # s, between times of equal events
WAYS = (in_other_units, lifted, mirrored, moved_by_the_top, rotated, split)
CASES = [(seed, bool(seed % 2)) for seed in range(4)]


def recoiling(seed, spatial):
    """A rig in motion that disconnects: some with a drained riser, some with recoil valves."""
    tree = moving(seed, spatial=spatial, conductor=False)
    at = 0.7 * tree["analysis"]["duration"]
    stop = {"collapse": "6 m", "stroke": "8 m", "stiffness": "5 MN/m"}
    tree["top"]["telescopic_joint"]["stop"] = stop
    tree["bottom"]["body"] = {"name": "LMRP", "mass": 7e4, "submerged_weight": "300 kN"}
    tree["disconnect"] = {"at": f"{at!r} s", "over": "0.3 s", "stack": {"stiffness": "100 MN/m"}}
    if seed % 3 == 0:
        tree["disconnect"]["drain"] = {"friction": 0.02, "losses": 1.5}
    if "gas" in tree["top"].get("tensioners", {}):
        valve = {"oil_density": "900 kg/m^3", "opening": "0.05 m^2", "discharge": 0.7, "residual": 0.2}
        tree["disconnect"]["recoil_valve"] = valve | {"over": "2 s", "delay": "0.4 s"}
    tree["analysis"]["duration"] = at + 15.0
    return tree


def told_seldom(tree, draw):
    """With the outputs of another interval."""
    tree = copy.deepcopy(tree)
    tree["analysis"]["output"]["interval"] *= float(draw.uniform(2.0, 4.0))
    return SimpleNamespace(tree=written(tree))


def outcome(tree):
    """Rows of the table by quantity, and warnings."""
    scene = SceneFile("rig.yaml", tree).resolved()
    facts = run(scene, estimated=False).facts
    attrs = {**facts, "extremes": json.dumps(facts["extremes"])}
    rows = recoil(scene, SimpleNamespace(attrs=attrs)).rows
    return {row[0]: row[1:] for row in rows}, sentences(facts["warnings"])


@pytest.mark.parametrize("seed, spatial", CASES)
def test_a_disconnect_written_otherwise_has_the_same_outcome(seed, spatial):
    tree = recoiling(seed, spatial)
    rows, warnings = outcome(written(tree))
    assert rows["largest lift"][0] > 0.1  # m: it does disconnect
    for way in (*WAYS, told_seldom):
        found, said = outcome(way(tree, np.random.default_rng(seed)).tree)
        assert said == warnings, way.__name__
        assert found.keys() == rows.keys()
        for name, (value, unit, time, note) in rows.items():
            other, _, later, words = found[name]
            about = f"{way.__name__}: {name}, {unit}"
            assert words == note, about
            assert (other is None, later is None) == (value is None, time is None), about
            if value is not None:
                assert other == pytest.approx(value, rel=WITHIN, abs=WITHIN * SMALL), about
            if time is not None:
                assert later == pytest.approx(time, abs=LATER), about
