"""The search for an equilibrium: where it fails, and how many iterations it took."""

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.model.build import build
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.starting_mesh import coarsest_mesh
from riserstudy.solve import statics
from riserstudy.solve.statics import Equilibrium, NoEquilibrium, find_equilibrium


def model_of(seed, spatial):
    scene = SceneFile("rig.yaml", written(rig(seed, spatial=spatial, conductor=False))).resolved()
    return build(scene, coarsest_mesh(scene))


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_a_value_that_is_no_number_is_found_where_it_is(seed, spatial):
    """The forces at its own node and at its neighbours are no numbers either; those of others are."""
    model = model_of(seed, spatial)
    last = len(model.s.l0)
    place = int(np.random.default_rng(seed).integers(4, last - 4))
    model.s.r[0, place] = np.nan
    with pytest.raises(NoEquilibrium) as failed:
        find_equilibrium(model.programs, model.state, model.fixed_at_rest, 1e-6, current=True)
    assert np.isnan(failed.value.residual)
    assert abs(failed.value.node - place) <= 2


@pytest.mark.parametrize("seed", range(20))
def test_iterations_are_those_of_the_parts_of_the_current_that_were_found(seed, monkeypatch):
    """Parts that were tried in vain are halved, and count no iterations."""
    draw, model = np.random.default_rng(seed), model_of(0, False)
    counts, shares = [], []

    def search(*_):
        if shares and draw.random() < 0.4:
            raise NoEquilibrium(3, 1.0, 1.0)
        counts.append(int(draw.integers(1, 30)))
        shares.append(model.s.clock[1])
        return Equilibrium(counts[-1], 0.0, 0)

    monkeypatch.setattr(statics, "_search", search)
    found = find_equilibrium(model.programs, model.state, model.fixed_at_rest, 1e-6, current=True)
    assert found.iterations == sum(counts)
    assert shares[0] == 0.0
    assert shares[-1] == 1.0
    assert (np.diff(shares) > 0.0).all()
