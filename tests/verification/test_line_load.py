"""A line load on a riser that is not under tension yet: its equilibrium is found on any mesh."""

import math

import numpy as np
import pytest

from riserstudy.model.mesh import prescribed
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.equilibrium import settle

JOINT = 127e3 * 180.0 / math.pi  # N m


def loaded(seed, elements):
    """A weightless riser with a flex joint and short segments at its ends, and its parameters."""
    chance = np.random.default_rng(seed)
    length, tension, load = (
        chance.uniform(800.0, 2000.0),
        chance.uniform(2e6, 6e6),
        chance.uniform(50.0, 200.0),
    )
    tree = {
        "title": "constant tension and line load",
        "riser": [{
            "name": "riser", "length": f"{length!r} m", "axial_stiffness": "1e10 N",
            "bending_stiffness": f"{chance.uniform(0.5e8, 2e8)!r} N*m^2", "lateral_load": f"{load!r} N/m",
        }],
        "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": {"stiffness": "127 kN*m/deg"}},
        "top": {"x": "held", "z": "free", "tension": f"{tension!r} N", "rotation": "free"},
        "analysis": {"mesh": {"elements": elements, "layers": {"bottom": "8 m", "top": "8 m"}}},
    }  # fmt: skip
    return SceneFile("loaded.yaml", tree).resolved(), length, tension, load


@pytest.mark.parametrize("elements", [100, 400, 1000])
@pytest.mark.parametrize("seed", range(12))
def test_a_line_load_sags_like_a_parabola_on_any_mesh(seed, elements):
    scene, length, tension, load = loaded(seed, elements)
    model, equilibrium = settle(scene, prescribed(scene, elements))
    assert equilibrium.unstable == 0
    sag = load * length**2 / (8.0 * tension)
    # the parabola is true to the square of slopes; the joint resists by up to twice its share of T L
    slope, joint = load * length / (2.0 * tension), JOINT / (tension * length)
    assert np.abs(model.s.r[0]).max() == pytest.approx(sag, rel=slope**2 + 2.0 * joint)
