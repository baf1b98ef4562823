"""Moments from turning angles: elimination from both ends against the dense matrix."""

import numpy as np
import pytest

from riserstudy.solve.blocktri import factor_flexibility, flexibility_solve
from riserstudy.solve.state import new_state


@pytest.mark.parametrize("hinges", [[], [0], [0, -1], [0, 2, -1]], ids=str)
@pytest.mark.parametrize("loose", [0, 2])
@pytest.mark.parametrize("segments", [1, 2, 3, 4, 5, 8, 9])
def test_moments_times_flexibility_are_the_angles(segments, loose, hinges):
    if max(hinges, default=0) >= segments:
        hinges = [0, -1]
    random = np.random.default_rng(segments)
    s = new_state(np.ones(segments), 2, 1, loose=loose)
    s.flex[: segments + 1] = random.uniform(4.0, 6.0, segments + 1)
    s.flex_up[:segments] = random.uniform(0.5, 2.0, segments)
    carried = np.ones(segments + 1, bool)
    carried[hinges] = False
    angle = random.normal(size=segments + 1 + loose)
    moment = angle.copy()
    factor_flexibility.py_func(s, np.append(~carried, np.zeros(loose, bool)))
    flexibility_solve.py_func(s, moment)
    up = s.flex_up[:segments]
    flexibility = np.diag(s.flex[: segments + 1]) + np.diag(up, 1) + np.diag(up, -1)
    assert np.all(moment[: segments + 1][~carried] == 0.0)
    turned = flexibility[np.ix_(carried, carried)] @ moment[: segments + 1][carried]
    np.testing.assert_allclose(turned, angle[: segments + 1][carried], rtol=1e-12, atol=1e-13)
