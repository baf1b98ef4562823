"""Explicit accelerations and the power of supports, against dense algebra node by node."""

import numpy as np
import pytest

from riserstudy.solve.explicit import couple, hold
from riserstudy.solve.state import new_state
from riserstudy.solve.vec import solved

NODES = 4


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("d, m, slid", [(1, 0, [0]), (2, 1, [0]), (2, 1, [1]), (3, 3, [0, 2])])
def test_held_directions_keep_their_acceleration_and_supports_supply_the_rest(d, m, slid, seed):
    """Node 0 is held in all directions, the last in those of ``slid``, with coupled masses."""
    random = np.random.default_rng(seed)
    s = new_state(np.ones(NODES - 1), d, m, share=(0.5, 0.0))
    for array in (s.force, s.a, s.v):
        array[:] = random.normal(size=array.shape)
    given_force, given = s.force.copy(), s.a.copy()
    mass = random.normal(size=(NODES, d, d))
    mass = mass @ mass.transpose(0, 2, 1) + np.eye(d)
    s.lump[:] = np.triu(mass).reshape(NODES, d * d).T
    held = {0: list(range(d)), NODES - 1: slid}
    fixed = np.array([(0, u) for u in range(m)] + [(i, m + c) for i in held for c in held[i]])

    power = hold.py_func(s, fixed)
    for i in range(NODES):
        s.a[:, i] = solved(tuple(s.lump[:, i]), tuple(s.force[:, i]))
    power += couple.py_func(s, fixed)

    expected = 0.0
    for i in range(NODES):
        kept = held.get(i, [])
        free = [c for c in range(d) if c not in kept]
        a = given[:, i].copy()
        load = given_force[:, i] - mass[i][:, kept] @ a[kept]
        a[free] = np.linalg.solve(mass[i][np.ix_(free, free)], load[free])
        np.testing.assert_allclose(s.a[:, i], a, rtol=1e-12)
        reaction = mass[i] @ a - given_force[:, i]
        expected += reaction[kept] @ s.v[kept, i]
    assert power == pytest.approx(expected, rel=1e-12)
