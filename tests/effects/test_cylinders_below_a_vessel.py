"""Cylinders whose deck moves with a vessel: equal and opposite pulls, and energy, slopes by both nodes."""

import numpy as np
import pytest
from rig import Rig, dense_tangent, differences
from surroundings import N

from riserstudy.effects.cylinders_in_space import CylindersInSpace

DIFFERENCES = 1e-7  # of fourth order, steps of 1e-3 m: relative to the largest entry


def below_a_vessel(d, ring=N - 1):
    rig = Rig(CylindersInSpace, d, node=ring, vessel=N, centre=np.zeros(3))
    rig.s.v[:] = 0.0
    return rig


@pytest.mark.parametrize("d", [2, 3])
def test_the_vessel_bears_what_the_ring_is_pulled_by_aside(d):
    rig = below_a_vessel(d)
    force = rig.evaluate()[rig.m :]
    np.testing.assert_allclose(force[: d - 1].sum(axis=1), 0.0, atol=1e-9 * abs(force).max())
    assert abs(force[: d - 1, N]).max() > 1e3
    assert force[-1, N] == 0.0  # a vessel does not heave


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("ring", [N - 1, N])
def test_the_tangent_is_the_slope_of_both_forces_by_both_positions(d, ring):
    rig = below_a_vessel(d, ring)
    rig.evaluate()
    tangent = dense_tangent(rig.s)[rig.m * (N + 1) :, rig.m * (N + 1) :]
    slope = differences(lambda: rig.evaluate()[rig.m :], rig.s.r, 1e-3)
    assert np.abs(tangent + slope).max() < DIFFERENCES * np.abs(slope).max()


@pytest.mark.parametrize("d", [2, 3])
def test_moving_ring_and_vessel_together_changes_no_force(d):
    rig = below_a_vessel(d)
    before = rig.evaluate()
    rig.s.r[: d - 1] += 37.5
    after = rig.evaluate()
    np.testing.assert_allclose(after, before, atol=1e-8 * abs(before).max())
