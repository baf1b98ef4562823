"""The error of a run on a prescribed mesh if coarser meshes are no coarser, or if none resolves bending.

A section has at least one segment: with many sections, meshes of fewer segments are nearly the same mesh, and
the runs on them differ by little.
"""

import copy
import random
from itertools import pairwise

import pytest
from random_rigs import moving, written
from some_seeds import seeds

from riserstudy.errors import SimulationError
from riserstudy.model.mesh import prescribed
from riserstudy.records.warning import sentences
from riserstudy.scene.at_rest import static
from riserstudy.scene.limits import ANGLES
from riserstudy.scene.load import SceneFile
from riserstudy.simulation import resolving_mesh
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import single
from riserstudy.simulation.starting_mesh import coarsest_mesh

QUANTITIES = ("displacement", "moment", "tension")
SMALL = 1e-3  # errors below which the convergence of the finest run counts


def of_many_sections(tree, count, draw):
    """The rig with its sections cut at random places into about this number of sections, of drawn masses."""
    length = sum(section["length"] for section in tree["riser"])
    sections = []
    for section in tree["riser"]:
        parts = max(1, round(count * section["length"] / length))
        cuts = [0.0, *sorted(draw.random() for _ in range(parts - 1)), 1.0]
        for k, (low, up) in enumerate(pairwise(cuts)):
            part = copy.deepcopy(section) | {"name": f"{section['name']} {k}"}
            part["length"] *= up - low
            part["mass"] *= draw.uniform(0.8, 1.2)
            if k:
                part.pop("flex_joint_below", None)
            sections.append(part)
    tree["riser"] = sections


def check_errors(tree, elements, fine, quantities=QUANTITIES):
    """The estimated errors of a run are at least those against a run on a fine mesh of a scene."""
    tree["analysis"]["mesh"] = {"elements": elements}
    scene = SceneFile("rig.yaml", written(tree)).resolved()
    found = run(scene)
    true = difference(found, single(scene, fine(scene), scene.analysis.step and scene.analysis.step / 4.0))
    estimated = found.facts["error_estimate"]
    for name in quantities:
        if name in true:  # there is no angle without a flex joint
            assert true[name] <= max(1.25 * estimated[name], SMALL), (name, elements)


def eight_times_as_fine(scene):
    return prescribed(scene, scene.analysis.mesh.elements).halved().halved().halved()


def graded_and_fine(scene):
    """Segments of some centimetres at bending layers, where shear converges late."""
    mesh = coarsest_mesh(static(scene))
    while len(mesh.l0) < 2000:
        mesh = mesh.halved()
    return mesh


@pytest.mark.long
@pytest.mark.parametrize("count", [0, 5, 12, 30])
@pytest.mark.parametrize("seed", seeds(10, few=5))
def test_the_error_at_rest_is_not_underestimated(seed, count):
    for elements in (1, 2, 4, 8, 16, 32, 64):
        tree = moving(seed, spatial=seed % 2 == 1, conductor=seed % 5 == 4)
        of_many_sections(tree, count, random.Random(seed))
        tree["analysis"] = {}
        check_errors(tree, elements, graded_and_fine, (*QUANTITIES, "shear", *ANGLES))


@pytest.mark.parametrize("count", [0, 12, 30])
@pytest.mark.parametrize("seed", range(4))
def test_the_error_of_a_motion_is_not_underestimated(seed, count):
    for elements in (8, 24):
        tree = moving(seed, spatial=seed % 2 == 1, conductor=seed % 3 == 2)
        of_many_sections(tree, count, random.Random(seed))
        tree["analysis"]["duration"] = 12 * tree["analysis"]["output"]["interval"]
        check_errors(tree, elements, eight_times_as_fine)


@pytest.mark.parametrize("count", [1, 30])
def test_without_any_comparison_no_error_is_estimated(count, monkeypatch):
    """If no run on a mesh that resolves bending is possible, coarser meshes decide, if there are any."""

    def fails(*_, **__):
        raise SimulationError("no equilibrium")

    tree = moving(0, spatial=False, conductor=False)
    of_many_sections(tree, count, random.Random(0))
    tree["analysis"] = {"mesh": {"elements": 24}}
    monkeypatch.setattr(resolving_mesh, "march", fails)
    found = run(SceneFile("rig.yaml", written(tree)).resolved()).facts
    warned = any("the error is not estimated" in warning for warning in sentences(found["warnings"]))
    assert warned == (count == 30)
    assert bool(found["error_estimate"]) == (count == 1)
