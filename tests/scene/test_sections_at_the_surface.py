"""Sections that reach through the water's surface: the same riser as one that is cut there by hand."""

import copy
import json
import math

import numpy as np
import pytest

from riserstudy import simulate
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile

SURFACE = 3.0


def drawn(seed, by_hand, dressed):
    """A riser whose second section reaches through the surface, as one section or as two."""
    chance = np.random.default_rng(seed)
    low = -float(chance.integers(200, 900))
    under, over = float(chance.integers(5, 40)), float(chance.integers(3, 20))
    outer = float(chance.uniform(0.4, 0.6))
    pipe = {
        "outer_diameter": f"{outer} m", "inner_diameter": f"{outer - 0.05} m", "young_modulus": "207 GPa",
        "wall_density": "7850 kg/m^3", "contents": {"density": f"{chance.integers(1000, 1900)} kg/m^3"},
        "drag": {"coefficient": 1.0, "diameter": f"{outer} m"},
        "added_mass": {"coefficient": 1.0, "diameter": f"{outer} m"},
    }  # fmt: skip
    if dressed:
        pipe["lines"] = [{
            "name": "kill", "outer_diameter": "0.16 m", "inner_diameter": "0.11 m", "tension": "shared",
            "wall_density": "7850 kg/m^3", "contents": "1500 kg/m^3", "young_modulus": "207 GPa",
        }]  # fmt: skip
    modules = {"mass": f"{chance.integers(500, 900)} kg", "lift": "2 kN"} if dressed else None
    long = under + over
    pieces = [("barrel", under, 0), ("barrel, above water", over, 1)] if by_hand else [("barrel", long, 0)]
    upper = []
    for name, length, _ in pieces:
        one = {"name": name, "length": f"{length} m", **pipe}
        if modules:
            share = length / long
            one["modules"] = {
                "mass": f"{share * float(modules['mass'].split()[0])!r} kg", "lift": f"{share * 2.0!r} kN",
            }  # fmt: skip
        upper.append(one)
    below = {"name": "joints", "length": f"{SURFACE - under - low} m", **pipe}
    tree = {
        "title": "riser", "gravity": "9.81 m/s^2",
        "water": {"density": "1025 kg/m^3", "surface": f"{SURFACE} m", "seabed": f"{low - 5.0} m"},
        "riser": [below, *upper],
        "bottom": {"hold": "wellhead", "elevation": f"{low} m", "rotation": {"stiffness": "40 kN*m/deg"}},
        "top": {"x": "platform", "z": "free", "tension": "5 MN", "rotation": "free"},
        "platform": {"position": {"surge": "6 m"}},
        "current": {"profile": {"shape": "uniform", "surface_speed": "0.5 m/s"}},
        "limits": [
            {"output": "bending_moment", "at": "barrel", "largest": "500 kN*m", "mode": "drilling"},
            {"output": "effective_tension", "at": "upper end of barrel", "mean": "9 MN", "mode": "drilling"},
        ],
        "analysis": {"mesh": {"elements": 60}},
    }  # fmt: skip
    return SceneFile("drawn.yaml", tree)


@pytest.mark.parametrize("dressed", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_a_section_through_the_surface_is_the_two_that_it_stands_for(seed, dressed):
    whole, hand = (drawn(seed, by_hand, dressed) for by_hand in (False, True))
    assert [s.name for s in whole.resolved().riser] == [s.name for s in hand.resolved().riser]
    assert whole.resolved().hanging == pytest.approx(hand.resolved().hanging, rel=1e-12)
    one, other = (simulate(file, progress=False) for file in (whole, hand))
    for name in ("effective_tension", "bending_moment", "x"):
        assert one[name].to_numpy() == pytest.approx(other[name].to_numpy(), rel=1e-9, abs=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_a_limit_at_a_section_is_about_both_its_parts(seed):
    file = drawn(seed, False, False)
    run = simulate(file, progress=False)
    moment, tension = json.loads(run.attrs["limits"])
    s, length = run["s"].to_numpy(), file.resolved().riser[0].total_length
    there = np.abs(run["bending_moment"].to_numpy()[s >= length - 1e-9])
    assert moment["demand"] == pytest.approx(there.max())
    assert tension["demand"] == pytest.approx(float(run["effective_tension"][-1]))


def test_the_part_above_weighs_what_no_water_carries():
    lower, upper = drawn(0, False, False).resolved().riser[1:]
    displaced = 9.81 * 1025.0 * 0.25 * math.pi * lower.outer_diameter**2
    assert upper.submerged_weight - lower.submerged_weight == pytest.approx(displaced)


def test_a_stress_of_a_section_that_is_cut_is_refused():
    output = {"interval": "1 s", "stress_in": "barrel"}
    file = drawn(0, False, False).with_values(
        {"analysis.output": output, "analysis.duration": "10 s", "analysis.step": "0.1 s"}, "test"
    )
    with pytest.raises(InputError, match="crosses the water surface"):
        file.resolved()


@pytest.mark.parametrize("dressed", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_a_weight_in_water_above_the_water_has_a_warning(seed, dressed):
    """Cut by hand, the part above the water keeps the weight that is given, and it has to be that in air."""
    tree = copy.deepcopy(drawn(seed, True, dressed).tree)
    _, under, over = tree["riser"]
    scene = drawn(seed, True, dressed).resolved()
    bare = 7850.0 * scene.riser[1].wall_area
    displaced = 1025.0 * 0.25 * math.pi * scene.riser[1].outer_diameter ** 2
    in_water, in_air = 9.81 * (bare - displaced), 9.81 * bare
    under["submerged_weight"] = f"{in_water!r} N/m"
    for weight, warned in ((in_water, True), (in_air, False)):
        over["submerged_weight"] = f"{weight!r} N/m"
        found = simulate(SceneFile("drawn.yaml", tree), progress=False)
        told = [one for one in json.loads(found.attrs["warnings"]) if "weight in air" in one]
        assert bool(told) == warned, told
    whole = simulate(drawn(seed, False, dressed), progress=False)
    np.testing.assert_allclose(found["effective_tension"], whole["effective_tension"], rtol=1e-9, atol=1e-3)
