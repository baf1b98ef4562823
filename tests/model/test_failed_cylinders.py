"""A rig whose cylinders fail during the run has from then on the model of one whose cylinders had failed.

In the same state both have the same energies, masses and forces.
"""

import copy

import numpy as np
import pytest
from random_rigs import on_cylinders, written

from riserstudy.model.build import build
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.events import events_of
from riserstudy.simulation.starting_mesh import coarsest_mesh
from riserstudy.solve.evaluate import energies, forces_and_tangent

LAWS = ("linear", "gas", "table", "two_chamber_gas")


def rig(seed, law, spatial):
    """A rig whose law has pistons if it is of two chambers, with the cylinders that fail."""
    draw = np.random.default_rng((seed, 17))
    drawn = "gas" if law == "two_chamber_gas" else law
    tree = on_cylinders(seed, "arrangement", drawn, spatial=spatial, conductor=False)
    rig = tree["top"]["tensioners"]
    rig["mid_stroke"] = "riser unstretched"  # else it depends on which cylinders pull
    if law == "two_chamber_gas":
        high = rig.pop("gas")
        low = {"area": 0.5 * high["area"], "pressure": 0.01 * high["pressure"], "volume": high["volume"]}
        exponent = high.pop("exponent")
        pistons = {"mass": f"{draw.uniform(1e3, 3e4)!r} kg", "counted": str(draw.choice(["once", "each"]))}
        rig["two_chamber_gas"] = {"high": high, "low": low, "exponent": exponent, "pistons": pistons}
    count = rig["count"]
    lost = draw.permutation(count)[: int(draw.integers(1, count))].tolist()
    rig["failing"] = {"at": f"{0.3 * tree['analysis']['duration']!r} s", "cylinders": lost}
    return tree


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("seed", range(4))
def test_cylinders_that_fail_leave_the_model_of_cylinders_that_have_failed(seed, law, spatial):
    tree = rig(seed, law, spatial)
    before = copy.deepcopy(tree)
    before["top"]["tensioners"]["failed"] = before["top"]["tensioners"].pop("failing")["cylinders"]
    one, other = (SceneFile("rig.yaml", written(of)).resolved() for of in (tree, before))
    mesh = coarsest_mesh(one)
    model, expected = build(one, mesh), build(other, mesh)
    draw = np.random.default_rng(seed)
    for array, size in ((model.s.r, 0.1), (model.s.v, 1.0), (model.s.a, 1.0)):
        array += draw.normal(0.0, size, array.shape)
    event = next(e for e in events_of(one, mesh, {}) if e.at == one.top.tensioners.failing.at)
    found = event.change(model)
    expected.take_state(found)
    np.testing.assert_allclose(
        energies(found.programs, found.state), energies(expected.programs, expected.state), rtol=1e-12
    )
    for of in (found, expected):
        forces_and_tangent(of.programs, of.state)
    scale = np.abs(expected.s.force).max()
    np.testing.assert_allclose(found.s.force, expected.s.force, atol=1e-12 * scale)
    assert (energies(model.programs, model.state)[1] > energies(found.programs, found.state)[1]) == (
        law == "two_chamber_gas"
    )
