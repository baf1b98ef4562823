"""The shape that the search for equilibrium starts from."""

import numpy as np
import pytest

from riserstudy.model.initial_shape import under_a_joint
from riserstudy.model.mesh import Mesh

MESH = Mesh(np.full(6, 10.0), np.zeros(6, np.int64), True)


@pytest.mark.parametrize("offset", [3.0, 30.0, 3000.0])
def test_a_riser_leans_alike_to_either_side_however_far(offset):
    left, right = (under_a_joint(MESH, 2, np.zeros(5), x, 60.0) for x in (-offset, offset))
    np.testing.assert_array_equal(left[0], -right[0])
    np.testing.assert_array_equal(left[2], right[2])
    assert np.hypot(*np.diff(right[[0, 2]])[:, :-1]) == pytest.approx(np.full(5, 10.0))
