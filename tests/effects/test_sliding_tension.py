"""The stop at which a telescopic joint collapses: the same checks as for the one at which it is drawn out."""

import numpy as np
import pytest
from derivatives import DIFFERENCES, check_blocks, relative
from rig import Rig, dense_tangent, differences

from riserstudy.effects.sliding_tension import SlidingTension


def collapsed(d):
    rig = Rig(SlidingTension, d, longest=np.inf, shortest=50.0)
    rig.evaluate()
    assert rig.s.length[rig.record.segment] < 49.0
    return rig


@pytest.mark.parametrize("d", [1, 2, 3])
def test_it_pushes_by_its_stiffness(d):
    rig = collapsed(d)
    beyond = 50.0 - rig.s.length[-1]
    pulls = rig.evaluate()[rig.m :, -1]
    expected = -(rig.record.tension - rig.record.stiffness * beyond) * rig.s.tangent[:, -1]
    np.testing.assert_allclose(pulls, expected, rtol=1e-12)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_its_tangent_and_its_energy_belong_to_its_force(d):
    rig = collapsed(d)
    check_blocks(rig, dense_tangent(rig.s), differences(rig.evaluate, rig.s.r, 1e-3))
    rig.s.v[:] = 0.0
    slope = differences(rig.potential, rig.s.r, 1e-3)
    assert relative(-slope[0], rig.evaluate()[rig.m :].ravel()) < DIFFERENCES
