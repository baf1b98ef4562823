"""Many joints of which one ends at the water surface: the rounding error of their sum is not a section."""

import math
import random
from fractions import Fraction

import pytest

from riserstudy.scene.load import SceneFile

LENGTHS = ("22.86", "27.432", "18.288", "6.1", "3.05", "0.9144", "0.3")
PIPE = {
    "outer_diameter": "0.5334 m", "inner_diameter": "0.4889 m", "young_modulus": "207 GPa",
    "wall_density": "7850 kg/m^3", "contents": {"density": "1200 kg/m^3"},
}  # fmt: skip


def joints(seed):
    """A riser of 20 to 65 joints, with the surface at the upper end of one of them, in decimal numbers."""
    draw = random.Random(seed)
    each = [draw.choice(LENGTHS) for _ in range(draw.randint(20, 65))]
    wet = len(each) - draw.randint(1, 3)
    bottom = Fraction(draw.randint(-30000, 300), 10)
    surface = bottom + sum(map(Fraction, each[:wet]))
    tree = {
        "title": "joints", "gravity": "9.81 m/s^2",
        "water": {"density": "1025 kg/m^3", "surface": f"{float(surface)} m", "seabed": f"{float(bottom)} m"},
        "riser": [{"name": f"joint {k}", "length": f"{length} m", **PIPE} for k, length in enumerate(each)],
        "bottom": {"hold": "wellhead", "elevation": f"{float(bottom)} m", "rotation": "free"},
        "top": {"x": "platform", "z": "free", "tension": "5 MN", "rotation": "free"},
        "platform": {"position": {"surge": "6 m"}}, "analysis": {},
    }  # fmt: skip
    return tree, wet


@pytest.mark.parametrize("seed", range(30))
def test_every_joint_is_one_section_in_water_or_in_air(seed):
    tree, wet = joints(seed)
    riser = SceneFile("joints.yaml", tree).resolved().riser
    assert [section.name for section in riser] == [section["name"] for section in tree["riser"]]
    steel = 7850.0 * 0.25 * math.pi * (0.5334**2 - 0.4889**2)
    displaced = 1025.0 * 0.25 * math.pi * 0.5334**2
    for k, section in enumerate(riser):
        expected = 9.81 * (steel - displaced * (k < wet))
        assert section.submerged_weight == pytest.approx(expected, rel=1e-9)
