"""A very stiff section, or a very stiff riser, does not hide the errors of moment and shear."""

import pytest
from random_rigs import moving, rig, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

LIKE = 0.02  # relative difference of estimates between a stiff and a rigid stack
STACK = "stack"


def estimates(tree, stiffness, axial="1e11 N", only=STACK):
    """Estimated errors of a rig whose stack, or whole riser, has this bending stiffness (N m^2)."""
    tree = written(tree)
    for one in tree["riser"]:
        if only in (None, one["name"]):
            del one["young_modulus"]
            one |= {"axial_stiffness": axial, "bending_stiffness": f"{stiffness} N*m^2"}
    return run(SceneFile("rig.yaml", tree, {}).resolved()).facts["error_estimate"]


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_estimates_in_motion_do_not_depend_on_how_rigid_the_stack_is(seed, spatial):
    tree = moving(seed, spatial=spatial, conductor=True)
    tree["analysis"]["mesh"]["elements"] = 40
    stiff, rigid = (estimates(tree, of) for of in (1e12, 1e15))
    assert stiff["moment"] > 1e-3
    assert {name: rigid[name] for name in ("moment", "shear")} == pytest.approx(
        {name: stiff[name] for name in ("moment", "shear")}, rel=LIKE
    )


@pytest.mark.parametrize("seed", range(3))
def test_estimates_at_rest_do_not_depend_on_how_rigid_the_stack_is(seed):
    tree = rig(seed + 10, spatial=False, conductor=True)
    tree["analysis"] = {"mesh": {"elements": 60}}
    stiff, rigid = (estimates(tree, of) for of in (1e12, 1e15))
    assert stiff["moment"] > 1e-4
    assert rigid["moment"] == pytest.approx(stiff["moment"], rel=LIKE)
    assert rigid["shear"] == pytest.approx(stiff["shear"], rel=LIKE)


def of_rigid_rig(seed, stiffness, *, spatial):
    """Estimated errors at rest of a rig whose sections all have this bending stiffness (N m^2)."""
    tree = rig(seed + 20, spatial=spatial, conductor=False)
    tree["analysis"] = {"mesh": {"elements": 20}}
    tree["top"]["telescopic_joint"]["bending_stiffness"] = stiffness
    return estimates(tree, stiffness, "1e10 N", only=None)


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_estimates_do_not_depend_on_how_rigid_the_whole_riser_is(seed, spatial):
    stiff, rigid = (of_rigid_rig(seed, of, spatial=spatial) for of in (1e15, 1e17))
    assert stiff["moment"] > 1e-5
    assert rigid["moment"] == pytest.approx(stiff["moment"], rel=LIKE)
    assert rigid["shear"] == pytest.approx(stiff["shear"], rel=LIKE)
