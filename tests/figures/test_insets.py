"""Enlarged parts of panels."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from riserstudy.figures.insets import enlarge

#: left, bottom, width and height of parts of a panel, on each side of another
SIDES = {
    "right": ((0.05, 0.3, 0.2, 0.3), (0.5, 0.1, 0.4, 0.6)),
    "left": ((0.7, 0.3, 0.2, 0.3), (0.1, 0.2, 0.4, 0.5)),
    "above": ((0.4, 0.05, 0.3, 0.2), (0.2, 0.5, 0.6, 0.3)),
    "below": ((0.4, 0.7, 0.3, 0.2), (0.2, 0.1, 0.6, 0.3)),
}


def crossing(one, other):
    """Whether two lines between points cross."""

    def side(a, b, c):
        return np.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))

    return side(*one, other[0]) != side(*one, other[1]) and side(*other, one[0]) != side(*other, one[1])


def corners(left, bottom, width, height):
    return {(x, y) for x in (left, left + width) for y in (bottom, bottom + height)}


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("upside_down", [False, True])
def test_an_enlarged_part_shows_the_same_curves_and_its_leaders_do_not_cross(seed, side, upside_down):
    random = np.random.default_rng(seed)
    part, place = (tuple((np.array(of) + random.uniform(-0.02, 0.02, 4)).tolist()) for of in SIDES[side])
    ax = Figure().subplots()
    curves = random.uniform(0.0, 10.0, (3, 2, 20))
    for k, curve in enumerate(curves):
        ax.plot(*curve, color=f"C{k}", ls=(0, (3.0, k + 1.0)), lw=k + 1.0)
    ax.axvline(4.0, color="black")
    ax.axhline(6.0, color="black")
    ax.set(xlim=(0.0, 10.0), ylim=(10.0, 0.0) if upside_down else (0.0, 10.0))
    left, bottom, width, height = part
    low = 1.0 - bottom - height if upside_down else bottom
    x, y = (10.0 * left, 10.0 * (left + width)), (10.0 * low, 10.0 * (low + height))
    inset = enlarge(ax, place, x, y)
    for line, (line_x, line_y) in zip(inset.lines, curves, strict=False):
        np.testing.assert_array_equal(line.get_data(), (line_x, line_y))
    for ours, theirs in zip(inset.lines, ax.lines, strict=True):
        assert (ours.get_color(), ours.get_linestyle()) == (theirs.get_color(), theirs.get_linestyle())
    assert inset.get_xlim() == pytest.approx(x)
    assert inset.get_ylim() == pytest.approx(y[::-1] if upside_down else y)
    upright, level = (line.get_window_extent() for line in inset.lines[-2:])
    at = inset.transData.transform((4.0, 6.0))
    assert upright.x0 == pytest.approx(at[0], abs=2.0)  # half a line's width
    assert level.y0 == pytest.approx(at[1], abs=2.0)
    leaders = [(text.xy, text.xyann) for text in ax.texts]
    assert len(leaders) == 2
    assert not crossing(*leaders)
    for start, end in leaders:
        assert min(np.hypot(*np.subtract(start, corner)) for corner in corners(*part)) < 1e-9
        assert min(np.hypot(*np.subtract(end, corner)) for corner in corners(*place)) < 1e-9
    sides = (inset.xaxis.get_ticks_position(), inset.yaxis.get_ticks_position())
    assert sides == ("top" if side == "above" else "bottom", "right" if side == "right" else "left")
