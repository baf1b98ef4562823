"""Soil along a conductor whose diameter changes, at a node of the mesh: rigs in plane and space."""

import copy

import numpy as np
import pytest
from random_rigs import rig, written
from scipy.integrate import quad

from riserstudy.model.mesh import even
from riserstudy.model.soil import sand_resistance, springs, ultimate_resistance
from riserstudy.scene.load import SceneFile

CLAY = {
    "strength_at_mudline": "5 kPa", "strength_gradient": "1.5 kPa/m", "submerged_unit_weight": "6 kN/m^3",
    "strain_at_half_strength": 0.01, "depth_factor": 0.5, "straight_up_to": 0.01,
}  # fmt: skip
SAND = {
    "friction_angle": "32 deg", "submerged_unit_weight": "9 kN/m^3", "initial_modulus": "12 MN/m^3",
    "loading": "cyclic",
}  # fmt: skip
DEPTH = 40.0  # m, of the conductor below the mudline


def stepped(seed, spatial, resistance):
    """A rig on a conductor with a slimmer lower part; the depth (m) of the step, the diameters (m)."""
    draw = np.random.default_rng((seed, 11))
    tree = rig(seed, spatial=spatial, conductor=True)
    low = tree["riser"][0]
    high = copy.deepcopy(low)
    length = float(draw.uniform(24.0, 38.0))
    low |= {"name": "casing", "length": length, "outer_diameter": float(draw.uniform(0.4, 0.7))}
    low["inner_diameter"] = low["outer_diameter"] - 0.06
    high["length"] -= length
    tree["riser"].insert(1, high)
    tree["soil"] = {"mudline": tree["soil"]["mudline"], "resistance": resistance}
    file = SceneFile("rig.yaml", written(tree))
    return file.resolved(), DEPTH - length, (high["outer_diameter"], low["outer_diameter"])


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("resistance", [CLAY, SAND])
@pytest.mark.parametrize("seed", range(4))
def test_springs_resist_what_the_soil_resists_over_the_depth(seed, resistance, spatial):
    """The integral of the largest resistance, by quadrature of each part."""
    scene, step, (above, below) = stepped(seed, spatial, resistance)
    of = scene.soil.resistance
    law = ultimate_resistance if resistance is CLAY else sand_resistance
    parts = ((0.0, step, above), (step, DEPTH, below))
    whole = sum(quad(lambda z, d=d: law(of, z, d), a, b, limit=200)[0] for a, b, d in parts)
    held = springs(scene.soil, scene.riser, even(scene, 800), scene.bottom.elevation)
    if resistance is CLAY:
        total = held.ultimate.sum()
    else:  # the cubics at their ends
        last = held.places[:, -1] - held.places[:, -2]
        total = sum((held.force[row, :, -1] * last ** (3 - row)).sum() for row in range(4))
    assert total == pytest.approx(whole, rel=1e-3)
