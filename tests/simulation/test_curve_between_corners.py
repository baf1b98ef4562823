"""Curves whose moment is a parabola between corners: values between nodes, and the largest one."""

import numpy as np
import pytest

from riserstudy.simulation.curve import curve, largest_moment
from riserstudy.simulation.section_forces import shear


def drawn(draw):
    """Nodes (m) that are uneven, corners at some of them, and a parabola for each part between corners."""
    parts = int(draw.integers(1, 4))
    counts = draw.integers(1, 6, parts)
    s = np.r_[0.0, np.cumsum(draw.uniform(0.5, 3.0, counts.sum()))]
    ends = np.r_[0, np.cumsum(counts)]
    corner = np.zeros(len(s))
    corner[ends[1:-1]] = 1.0
    values, laws = [draw.uniform(1.0, 4.0)], []
    for a, b in zip(s[ends[:-1]], s[ends[1:]], strict=True):
        slope, bend = draw.uniform(-0.3, 0.3), draw.uniform(-0.2, 0.2)
        if (s > a).sum() - (s > b).sum() == 1:
            bend = 0.0  # of two nodes, the curve is the line
        start = values[-1]
        laws.append(
            lambda x, a=a, start=start, slope=slope, bend=bend: start + (x - a) * (slope + bend * (x - a))
        )
        values.append(laws[-1](b))

    def at(x):
        return laws[min(max(int(np.searchsorted(s[ends], x)) - 1, 0), parts - 1)](x)

    return s, corner, np.vectorize(at, otypes=[float]), s[ends]


@pytest.mark.parametrize("seed", range(40))
def test_parabolas_between_corners_are_themselves(seed):
    draw = np.random.default_rng(seed)
    s, corner, law, _ = drawn(draw)
    places = np.r_[np.sort(draw.uniform(0.0, s[-1], 60)), s]
    of = curve(s, corner)
    np.testing.assert_allclose(of.cubic(law(s), places), law(places), rtol=1e-9, atol=1e-9)
    two = np.stack([law(s), -2.0 * law(s)])
    np.testing.assert_allclose(of.cubic(two, places)[1], -2.0 * law(places), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("seed", range(60))
def test_the_largest_moment_is_that_of_a_dense_scan(seed):
    """Except where it is next to a corner or an end, of which the nodes and middles are looked at."""
    draw = np.random.default_rng(seed)
    s, corner, law, ends = drawn(draw)
    sign = draw.choice([-1.0, 1.0])
    found, place = largest_moment(
        {"s_node": s, "mesh_corner": corner, "bending_moment_static": sign * law(s)}
    )
    scan = np.sort(np.r_[np.linspace(0.0, s[-1], 20001), s])
    size = np.abs(law(scan))
    k = int(size.argmax())
    seen = np.abs(law(np.r_[s, 0.5 * (s[1:] + s[:-1])])).max()
    assert seen - 1e-12 <= found <= size[k] + 1e-6
    node = int(np.searchsorted(s, scan[k]))
    near = {*ends} & {*s[max(node - 1, 0) : node + 1]}
    if not near or scan[k] in s:
        assert (found, place) == (pytest.approx(size[k], abs=1e-6), pytest.approx(scan[k], abs=0.05))
        assert found == pytest.approx(abs(float(law(place))), abs=1e-6)


@pytest.mark.parametrize("seed", range(40))
def test_shear_is_the_slope_of_the_moment_and_at_corners_the_larger_of_both(seed):
    """By differences of the parabolas on either side; in space, of each component."""
    draw = np.random.default_rng(seed)
    s, corner, law, _ = drawn(draw)
    h = 1e-6
    nodes = range(len(s))
    up = np.array([(law(s[k] + h) - law(s[k])) / h if k < len(s) - 1 else 0.0 for k in nodes])
    down = np.array([(law(s[k]) - law(s[k] - h)) / h if k else 0.0 for k in nodes])
    expected = np.where(abs(down) > abs(up), down, up)
    arrays = {"s_node": s, "mesh_corner": corner}
    np.testing.assert_allclose(shear(arrays, law(s), False, None), expected, atol=1e-5)
    away = np.array([0.6, 0.0, -0.8])
    spatial = shear(arrays, away[:, None] * law(s), True, None)
    np.testing.assert_allclose(spatial, abs(expected), atol=1e-5)


@pytest.mark.parametrize("seed", range(20))
def test_shear_of_a_telescopic_joint_is_that_of_its_own_line(seed):
    """The joint begins with another moment than the riser below it has at the ring."""
    draw = np.random.default_rng(seed)
    s = np.r_[0.0, np.cumsum(draw.uniform(1.0, 3.0, 4))]
    moment, above = draw.uniform(-2.0, 2.0, 5), draw.uniform(-2.0, 2.0)
    corner = np.array([0.0, 0.0, 0.0, 1.0, 0.0])
    found = shear({"s_node": s, "mesh_corner": corner}, moment, False, np.array(above))
    assert found[-1] == pytest.approx((moment[-1] - above) / (s[-1] - s[-2]))
    plain = shear({"s_node": s, "mesh_corner": corner}, moment, False, None)
    np.testing.assert_allclose(found[:3], plain[:3])
