"""The energy balance of contents that drain does not depend on how a scene is written: seeded rigs."""

import copy

import numpy as np
import pytest
from changes import lifted
from random_rigs import moving, written
from some_seeds import seeds

from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def draining(seed):
    """A rig in motion whose lower end is let go with an LMRP, and whose mud runs out."""
    tree = moving(seed, spatial=seed % 2 == 1, conductor=False)
    at = 0.7 * tree["analysis"]["duration"]
    tree["top"]["telescopic_joint"]["stop"] = {"collapse": "4 m", "stiffness": "5 MN/m"}
    tree["bottom"]["body"] = {"name": "LMRP", "mass": 7e4, "submerged_weight": "300 kN"}
    for k, part in enumerate(tree["riser"]):
        part["inner_diameter"] *= 1.0 - 0.03 * (k % 3)
    tree["disconnect"] = {
        "at": f"{at!r} s",
        "over": "0.3 s",
        "stack": {"stiffness": "100 MN/m"},
        "drain": {"friction": 0.02, "losses": 1.5},
    }
    return tree


def audit_of(tree):
    facts = run(SceneFile("rig.yaml", tree).resolved(), estimated=False).facts
    return facts["audit"], sentences(facts["warnings"])


@pytest.mark.parametrize("seed", seeds(10, few=5))
def test_the_balance_depends_neither_on_the_datum_nor_on_the_outputs(seed):
    """Outputs end before the run, between steps; energies of what leaves do not count from the datum."""
    tree = draining(seed)
    seldom = copy.deepcopy(tree)
    seldom["analysis"]["output"]["interval"] *= 3.37
    one, said = audit_of(written(tree))
    for other in (lifted(tree, np.random.default_rng(seed)).tree, written(seldom)):
        found, again = audit_of(other)
        assert found == pytest.approx(one, rel=1e-5, abs=1e-7 * one["exchanged"])
        assert again == said
