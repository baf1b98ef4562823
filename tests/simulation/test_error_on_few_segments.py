"""On a user's mesh of few segments no limit is met that the riser exceeds: its estimated error covers it."""

import copy

import pytest
from random_rigs import moving, rig, written

from riserstudy.dataset.limits import checked
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

AT = [("bending_moment", "conductor"), ("bending_moment", "stack"), ("shear_force", "conductor")]
AT += [("shear_force", "section 0"), ("lfj_angle", None), ("bending_moment", "section 0")]
UNITS = {"bending_moment": "N*m", "shear_force": "N", "lfj_angle": "rad"}
FINE = 2500  # segments


def demands(tree, allowable=1e30):
    """Largest value of each output, and its verdict; ``allowable``: one for all, or of each."""
    known = isinstance(allowable, list)
    limits = [
        {"output": output, "mode": "drilling"}
        | ({"at": at} if at else {})
        | {"largest": f"{allowable[k] if known else allowable!r} {UNITS[output]}"}
        for k, (output, at) in enumerate(AT)
    ]
    file = SceneFile("rig.yaml", written(tree) | {"limits": limits})
    return file, limits


def judged(tree, allowable=1e30, *, estimated=True):
    file, _ = demands(tree, allowable)
    scene = file.resolved()
    return checked(file, scene, run(scene, estimated=estimated).facts)


def on(tree, elements, steps=1.0):
    other = copy.deepcopy(tree)
    other["analysis"]["mesh"] = {"elements": elements}
    if "step" in other["analysis"]:
        other["analysis"]["step"] /= steps
    return other


def not_met(tree, elements, fine):
    """Demands on few segments and true ones; limits between them are met by the first only."""
    few = on(tree, elements)
    found = judged(few, estimated=False)
    true = judged(fine, estimated=False)
    between = [0.5 * (one.demand + other.demand) for one, other in zip(found, true, strict=True)]
    verdicts = [one.verdict for one in judged(few, between)]
    too_low = [other.demand > 1.03 * one.demand for one, other in zip(found, true, strict=True)]
    for low, verdict, (output, at) in zip(too_low, verdicts, AT, strict=True):
        assert not low or verdict != "within", (output, at)
    return sum(too_low)


@pytest.mark.parametrize("elements", [20, 40, 80])
@pytest.mark.parametrize("seed", range(6))
def test_a_limit_that_is_exceeded_is_not_met_on_few_segments(seed, elements):
    tree = rig(seed, spatial=bool(seed % 2), conductor=True)
    not_met(tree, elements, on(tree, FINE))


@pytest.mark.parametrize("seed", [1, 3, 9])
def test_nor_in_motion(seed):
    tree = moving(seed, conductor=True)
    assert not_met(tree, 50, on(tree, 600, 2.0)) > 0
