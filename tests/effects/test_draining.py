"""What contents that run out give to the effects that hold them."""

import numpy as np
import pytest
from each.draining import FULL, GRAVITY, along, held, others
from rig import Rig, differences
from surroundings import N

from riserstudy.effects.draining import Draining


@pytest.mark.parametrize("d", [1, 2, 3])
def test_weight_and_contents_have_the_mass_that_is_left(d):
    rig = Rig(Draining, d)
    weight, inside = others(d)
    levels = (rig.record.top, rig.record.water)
    mass = held(*(np.interp(rig.s.clock[0], rig.record.time, level) for level in levels))
    np.testing.assert_allclose(inside.mass, mass, rtol=1e-3)  # sampled to a ten thousandth
    np.testing.assert_array_equal(inside.minus, -inside.mass)
    lifted = weight.load.sum() - rig.record.dead.sum()
    assert lifted == pytest.approx(GRAVITY * (FULL - inside.mass).sum(), rel=1e-12)


@pytest.mark.parametrize("d", [2, 3])
def test_what_leaves_takes_its_motion_with_it(d):
    """The kinetic energy of the contents changes by what the power says, velocities as they are."""
    rig = Rig(Draining, d)
    rig.s.r[:] = np.linspace([0.0] * 3, [30.0, 20.0, 60.0], N + 1).T[[0, 2] if d == 2 else [0, 1, 2]]
    clock = rig.s.clock[:1]

    def kinetic():
        rig.place()
        return np.array([rig.kinetic()])

    grown = differences(kinetic, clock, 1e-4)[0, 0]
    rig.place()
    rig.evaluate()
    _, supplied = rig.flow()
    rig.s.v[:] = np.outer(rig.s.tangent[:, 0], np.ones(N + 1))  # along the pipe: no motion across
    rig.evaluate()
    thrust = (along(rig.record, rig.s, rig.record.mass) * rig.s.v).sum()
    _, straight = rig.flow()
    above = rig.s.r[-1, :-1] + rig.s.r[-1, 1:] - 2.0 * rig.record.level
    up = (rig.record.change * above).sum() * 0.5 * GRAVITY
    assert straight == pytest.approx(thrust + up, rel=1e-9)
    assert grown < 0.0
    assert supplied - up - _work(rig, d) == pytest.approx(grown, rel=1e-6)


def _work(rig, d):
    """Power of the flow's force along the riser at the velocities that a fresh case has."""
    fresh = Rig(Draining, d)
    rig.s.v[:] = fresh.s.v
    rig.evaluate()
    return float((along(rig.record, rig.s, rig.record.mass) * rig.s.v).sum())
