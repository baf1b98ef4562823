"""Functions written out while compiling do what they do in Python."""

import numpy as np
import pytest
from numba import njit

from riserstudy.solve import rows, vec
from riserstudy.solve.unroll import unrolled

RNG = np.random.default_rng(3)


def numbers(count):
    return tuple(float(x) for x in RNG.standard_normal(count))


@njit
def compiled_divide(like, row):
    return rows.divide(like, row)


@njit
def compiled_norm(a):
    return vec.norm(a)


@njit
def compiled_times(a, b):
    return vec.times(a, vec.skew(b))


@pytest.mark.parametrize("size", [1, 2, 3, 6])
def test_a_block_row_is_divided_as_in_python_and_as_by_numpy(size):
    like, row = (0.0,) * size, numbers(size * (2 * size + 1))
    found = compiled_divide(like, row)
    for mine, plain in zip(found, rows.divide(like, row), strict=True):
        np.testing.assert_allclose(mine, plain, rtol=1e-12)
    lines = np.array(row).reshape(size, 2 * size + 1)
    expected = np.linalg.solve(lines[:, :size], lines[:, size:])
    np.testing.assert_allclose(np.reshape(found[0], (size, size)), expected[:, :size], rtol=1e-9)
    np.testing.assert_allclose(found[1], expected[:, size], rtol=1e-9)


def test_roots_and_constants_are_written_out():
    a, b = numbers(9), numbers(3)
    assert compiled_norm(a) == pytest.approx(np.linalg.norm(a), rel=1e-14)
    turned = np.reshape(compiled_times(a, b), (3, 3)) @ np.array([1.0, 2.0, 3.0])
    np.testing.assert_allclose(turned, np.reshape(a, (3, 3)) @ np.cross(b, [1.0, 2.0, 3.0]))


@unrolled
def exchanged(array, i, j, a):
    for k, x in enumerate(a):
        array[k, i], array[k, j] = array[k, j] / 2, 1 - x
    return -a[0], (array[0, i], 3)


@njit
def compiled_exchange(array, a):
    for i in range(array.shape[1] - 1):
        last = exchanged(array, i, i + 1, a)
    return last


def test_arrays_are_read_and_written_in_order_whatever_their_layout():
    a, whole = numbers(2), RNG.standard_normal((8, 4))
    for array in (whole[:2].copy(), np.asfortranarray(whole[:2]), whole[::4].copy()[:, ::2]):
        mine, plain = array.copy(order="A"), array.copy()
        (first, second), (plain_first, plain_second) = compiled_exchange(mine, a), _plain(plain, a)
        assert (first, *second) == pytest.approx((plain_first, *plain_second))
        np.testing.assert_allclose(mine, plain)


def _plain(array, a):
    for i in range(array.shape[1] - 1):
        last = exchanged(array, i, i + 1, a)
    return last
