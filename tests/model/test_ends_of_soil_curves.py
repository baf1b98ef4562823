"""Tables of soil whose curves end at different displacements: beyond its end, a curve is constant."""

import numpy as np
import pytest
from random_rigs import FOOT, rig, written

from riserstudy.model.mesh import even
from riserstudy.model.soil import secant_stiffness, springs
from riserstudy.scene.load import SceneFile

FURTHEST = 0.4  # m, beyond the end of every curve


def resistance(tree, curves, displacement):
    """Resistance (N) of all springs at a displacement (m); ``curves``: rows by depth (m)."""
    table = [
        {"depth": f"{depth!r} m", "displacement": f"{y!r} m", "resistance": f"{p!r} N/m"}
        for depth, rows in curves.items()
        for y, p in rows
    ]
    soil = {"mudline": tree["soil"]["mudline"], "resistance": {"table": table}}
    scene = SceneFile("rig.yaml", tree | {"soil": soil}).resolved()
    held = springs(scene.soil, scene.riser, even(scene, 200), scene.bottom.elevation)
    return secant_stiffness(held, displacement) * displacement, scene.soil.mudline - scene.bottom.elevation


def drawn(draw, most):
    """Curves at three depths that rise to ``most`` and stay there, each up to a displacement of its own."""
    curves = {}
    for depth in (0.0, float(draw.uniform(2.0, 8.0)), float(FOOT)):
        first, last = (float(x) for x in np.sort(draw.uniform(0.01, 0.2, 2)))
        end = most(depth)
        curves[depth] = [(first, 0.6 * end), (last + 0.005, end), (last + 0.02, end)]
    return curves


@pytest.mark.parametrize("seed", range(5))
def test_a_curve_that_is_written_on_at_its_last_resistance_is_the_same(seed):
    draw = np.random.default_rng(seed)
    tree = written(rig(seed, spatial=False, conductor=True))
    curves = drawn(draw, lambda depth: 1e3 + 2e3 * depth)
    on = {depth: [*rows, (FURTHEST, rows[-1][1])] for depth, rows in curves.items()}
    for displacement in draw.uniform(0.005, FURTHEST, 6).tolist():
        short, long = (resistance(tree, each, displacement)[0] for each in (curves, on))
        assert short == pytest.approx(long, rel=1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_beyond_all_curves_the_resistance_is_the_last_one_along_the_conductor(seed):
    draw, last = np.random.default_rng(seed), 4e3
    tree = written(rig(seed, spatial=False, conductor=True))
    each, inside = resistance(tree, drawn(draw, lambda _: last), FURTHEST)
    assert each.sum() == pytest.approx(last * inside, rel=1e-9)
