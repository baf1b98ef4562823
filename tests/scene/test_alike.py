"""What must be the same in several places is the same in any units, and not where it differs."""

import random

import pytest

from riserstudy.errors import InputError
from riserstudy.scene.alike import alike
from riserstudy.scene.load import SceneFile
from riserstudy.scene.tensioners import Tensioners

TIMES = {"s": 1.0, "min": 1.0 / 60.0, "h": 1.0 / 3600.0, "ms": 1e3, "day": 1.0 / 86400.0}
LENGTHS = {"m": 1.0, "ft": 1.0 / 0.3048, "in": 1.0 / 0.0254, "km": 1e-3, "mm": 1e3}
DENSITIES = {"kg/m^3": 1.0, "t/m^3": 1e-3, "lb/ft^3": 0.45359237**-1 * 0.3048**3, "g/cm^3": 1e-3}


def written(value, units, rng):
    """A value in some unit, to all digits."""
    unit = rng.choice(sorted(units))
    return f"{value * units[unit]!r} {unit}"


def scene(rng, other=1.0, what=""):
    """Three sections with what must be the same in all; ``what`` of the upper one is ``other`` times that."""
    damping, bore, level = rng.uniform(2.0, 20.0), rng.uniform(0.3, 0.45), rng.uniform(2.0, 15.0)
    density = rng.uniform(1050.0, 1800.0)
    sections = []
    for k in range(3):
        times = {what: other} if k == 2 else {}
        sections.append(
            {
                "name": f"section {k}", "length": "100 m", "axial_stiffness": "5e9 N",
                "bending_stiffness": "2e8 N*m^2", "mass": "400 kg/m", "submerged_weight": "2 kN/m",
                "outer_diameter": "0.5 m",
                "inner_diameter": written(bore * times.get("bore", 1.0), LENGTHS, rng),
                "structural_damping": {
                    "ratio": 0.01, "at_period": written(damping * times.get("damping", 1.0), TIMES, rng),
                },
                "contents": {
                    "density": written(density * times.get("density", 1.0), DENSITIES, rng),
                    "level": written(level * times.get("level", 1.0), LENGTHS, rng),
                },
            }
        )  # fmt: skip
    return {
        "title": "alike", "gravity": "9.81 m/s^2", "riser": sections,
        "water": {"density": "1025 kg/m^3", "surface": "0 m", "seabed": "-310 m"},
        "bottom": {"hold": "wellhead", "elevation": "-300 m", "rotation": "free"},
        "top": {"x": "held", "z": "free", "tension": "3 MN", "rotation": "free"},
        "disconnect": {"at": "1 s", "drain": {"friction": 0.01}},
        "analysis": {"duration": "4 s", "mesh": {"elements": 6}, "step": "0.05 s",
                     "output": {"interval": "0.5 s"}},
    }  # fmt: skip


SAME = ("damping", "density", "level")


@pytest.mark.parametrize("seed", range(60))
def test_what_is_the_same_in_all_sections_may_be_written_in_any_units(seed):
    assert SceneFile("a.yaml", scene(random.Random(seed))).resolved()


@pytest.mark.parametrize("what", SAME)
@pytest.mark.parametrize("other", [1.000001, 0.999, 1.1])
def test_what_differs_is_refused_however_little_and_in_any_units(what, other):
    for seed in range(8):
        with pytest.raises(InputError, match=r"the same|differs from the level"):
            SceneFile("a.yaml", scene(random.Random(seed), other, what)).resolved()


@pytest.mark.parametrize("seed", range(60))
def test_a_table_covers_a_stroke_that_ends_with_it_in_any_units(seed):
    rng = random.Random(seed)
    low, high = rng.uniform(-12.0, -2.0), rng.uniform(2.0, 12.0)

    def cylinders(shorter=0.0, longer=0.0):
        rows = [(low, 1.0), (0.0, 1.5), (high, 2.0)]
        return Tensioners.model_validate(
            {
                "count": 6, "mid_stroke": "riser unstretched",
                "table": [{"reach": written(z, LENGTHS, rng), "force": f"{f} MN"} for z, f in rows],
                "stroke": {
                    "shortest": written(low - shorter, LENGTHS, rng),
                    "longest": written(high + longer, LENGTHS, rng), "stop_stiffness": "10 MN/m",
                },
            }
        )  # fmt: skip

    assert cylinders()
    for beyond in ({"shorter": 1e-5}, {"longer": 1e-5}):
        with pytest.raises(ValueError, match="extend it to the whole stroke"):
            cylinders(**beyond)


def test_nothing_is_like_a_number():
    assert alike([])
    assert alike([None, None])
    assert not alike([None, 0.0])
    assert alike([0.0, 0.0])
    assert not alike([1.0, -1.0])
