"""Minimum tension: printed cases, the engine beside the formula, and what is missing is said."""

import math
from pathlib import Path

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy import load_scene
from riserstudy.design import engine_tension, tension
from riserstudy.design.recoil import limits
from riserstudy.design.tension import Rig, Tolerances
from riserstudy.design.window import window
from riserstudy.errors import SimulationError
from riserstudy.scene.load import SceneFile

SCENE = Path(__file__).parents[2] / "config/scenes/design/riser.yaml"
AS_TOLD = Tolerances(1.0, 1.0)
MUDS = [f"riser[{k}].contents.density" for k in range(4)]


def scene(**changed):
    """The generic riser in still water, mud up to the tension ring."""
    levels = {f"riser[{k}].contents.level": None for k in range(4)}
    return load_scene(SCENE, **{"current": None, **levels, **changed}).resolved()


def test_the_worked_case_of_a_public_source_comes_out():
    columns = 0.15 * (14.0 * 1500.0 - 10.05 * 1500.0)
    needed = tension.carrying_tension(2000.0, 800.0, columns, Tolerances(1.05, 0.96))
    # of its unrounded factors; kN
    assert float(needed) == pytest.approx(2220.75, abs=1e-9)
    assert tension.setting(2220.75, Rig(6, 1, 0.95, 0.0)) == pytest.approx(2805.16, abs=0.005)


def test_a_fleet_angle_apart_is_worth_its_cosine():
    counted, apart = (Rig(6, 0, math.cos(math.radians(10.0)), 0.0), Rig(6, 0, 1.0, math.radians(10.0)))
    assert tension.setting(1e6, apart) == pytest.approx(tension.setting(1e6, counted), rel=1e-12)
    assert tension.setting(1e6, apart) / 1e6 - 1.0 == pytest.approx(0.0154, abs=1e-4)


def test_with_the_formulas_tension_the_engine_has_the_lower_end_slack():
    riser = scene()
    needed = float(tension.needed(riser, AS_TOLD)[0])
    loaded = engine_tension.with_tension(riser, needed)
    lower_end = engine_tension.along(loaded)[1][0]
    assert abs(lower_end) <= 1e-9 * tension.columns_above(riser).steel[0]


def test_tolerances_change_the_engines_tension_as_the_formulas():
    riser = scene()
    for tolerances in (AS_TOLD, Tolerances(1.05, 0.96), Tolerances(1.1, 0.9)):
        formula = tension.needed(riser, tolerances).max()
        assert engine_tension.needed(riser, tolerances).tension == pytest.approx(formula, rel=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_tolerances_apply_to_a_body_at_the_ring_as_well(seed):
    """A body whose weight is given in any form, with a telescopic joint above it and without."""
    draw = np.random.default_rng(seed)
    weights = {
        "submerged_weight": f"{draw.uniform(100.0, 400.0)} kN",
        "density": f"{draw.uniform(2000.0, 8000.0)} kg/m^3",
        "displaced_volume": f"{draw.uniform(1.0, 9.0)} m^3",
    }
    form = sorted(weights)[seed % 3]
    changed = {"top.body": {"name": "ring", "mass": f"{draw.uniform(10.0, 50.0)} t", form: weights[form]}}
    if seed % 2:
        changed |= {"limits": None, "top.z": "free", "top.telescopic_joint": None, "top.tension": "4 MN"}
        changed["top.elevation"] = None
    riser, bare = scene(**changed), scene(**changed | {"top.body": None})
    tolerances = Tolerances(float(draw.uniform(1.0, 1.1)), float(draw.uniform(0.9, 1.0)))
    found, without = (engine_tension.needed(one, tolerances).tension for one in (riser, bare))
    assert found == pytest.approx(tension.needed(riser, tolerances).max(), rel=1e-8)
    assert found - without == pytest.approx(tolerances.weight * riser.ring_weight, rel=1e-6)


def test_the_engines_tension_rises_with_mud_weight_by_bore_times_column():
    light, heavy = (scene(**dict.fromkeys(MUDS, f"{mud} kg/m^3")) for mud in (1200, 1800))
    rise = engine_tension.needed(heavy, AS_TOLD).tension - engine_tension.needed(light, AS_TOLD).tension
    unit_weight = 600.0 * 9.80665
    bore = 0.25 * math.pi * (19.25 * 0.0254) ** 2
    column = 91.44 + 1325.88 + 45.72 + 23.96
    assert rise / unit_weight == pytest.approx(bore * column, rel=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_the_minimum_tension_is_that_of_steel_modules_mud_and_sea_summed_by_hand(seed):
    """Pipes of random dimensions below water: steel in water, uplift and columns, each with its tolerance."""
    draw = np.random.default_rng(seed)
    tolerances = Tolerances(float(draw.uniform(1.0, 1.1)), float(draw.uniform(0.9, 1.0)))
    g, sea, mud = 9.80665, 1025.0, float(draw.uniform(1100.0, 1900.0))
    lengths = [section.total_length for section in scene().riser]
    changed, expected = {"water.surface": "1525 m"}, 0.0
    for k, length in enumerate(lengths):
        outer = float(draw.uniform(0.5, 0.6))
        inner = outer - 2.0 * float(draw.uniform(0.012, 0.03))
        steel, bore = (0.25 * math.pi * area for area in (outer**2 - inner**2, inner**2))
        lift = float(draw.uniform(0.0, 3000.0))
        net = g * (7850.0 * steel - sea * (steel + bore)) - lift
        changed |= {
            f"riser[{k}].outer_diameter": f"{outer!r} m",
            f"riser[{k}].inner_diameter": f"{inner!r} m",
            f"riser[{k}].submerged_weight": f"{net!r} N/m",
            f"riser[{k}].buoyancy_lift": f"{lift!r} N/m",
            f"riser[{k}].contents.density": f"{mud!r} kg/m^3",
        }
        in_water = (7850.0 - sea) * g * steel * tolerances.weight - lift * tolerances.buoyancy
        expected += length * (in_water + (mud - sea) * g * bore)
    ring = scene(**changed).ring_weight * tolerances.weight
    assert tension.needed(scene(**changed), tolerances)[0] == pytest.approx(expected + ring, rel=1e-9)


def test_mud_above_the_ring_is_carried_too():
    filled = load_scene(SCENE, current=None).resolved()
    above = 1440.0 * 9.80665 * 0.25 * math.pi * (19.25 * 0.0254) ** 2 * (1518.0 - 1505.0)
    for way in (tension, engine_tension):
        with_it, without = (
            np.max(getattr(way.needed(one, AS_TOLD), "tension", way.needed(one, AS_TOLD)))
            for one in (filled, scene())
        )
        assert with_it - without == pytest.approx(above, rel=1e-6)


def test_another_point_than_the_lower_end_may_govern():
    """Joints that float push the bottom up; the engine finds the kink on any mesh."""
    floats = {"riser[0].submerged_weight": "-9000 N/m", "riser[0].buoyancy_lift": "13434 N/m"}
    for elements in (8, 120, 480):
        floating = scene(**floats, **{"analysis.mesh.elements": elements})
        formula = tension.needed(floating, AS_TOLD)
        assert formula.argmax() == 1
        slack = engine_tension.needed(floating, AS_TOLD)
        assert slack.s == pytest.approx(91.44)
        assert slack.tension == pytest.approx(formula[1], rel=1e-9)


@pytest.mark.parametrize(
    "changed, missing",
    [
        ({"riser[1].buoyancy_lift": None}, "buoyancy_lift of section 'buoyed joints'"),
        ({"riser[0].contents": None}, "contents of section 'lower bare joints'"),
        ({"water.surface": None, "current": None}, "water.surface"),
    ],
)
def test_what_a_scene_does_not_tell_is_named_and_nothing_evaluated(changed, missing):
    untold = load_scene(SCENE, **{"limits": None, **changed}).resolved()
    assert missing in tension.lacks(untold)
    with pytest.raises(ValueError, match=f"not evaluated: .*{missing.split()[0]}"):
        tension.needed(untold, AS_TOLD)


def test_the_window_names_what_governs_and_closes_where_floors_pass_ceilings():
    rig = Rig(6, 1, 1.0, 0.0)
    of = window(3.0e6, 3.5e6, rig, 6.0e6, 0.9)
    assert (of.floor, of.ceiling) == ("minimum tension", "dynamic tension limit")
    assert of.gap == pytest.approx(5.4e6 - 3.6e6)
    lifted = window(2.0e6, 3.5e6, rig, 6.0e6, 0.9)
    assert lifted.floor == "LMRP lift-off"
    recoiled = window(3.0e6, 3.5e6, rig, 6.0e6, 0.9, recoil=(None, 3.4e6))
    assert recoiled.ceiling == "recoil"
    assert recoiled.gap < 0.0


@pytest.mark.parametrize("seed", range(4))
def test_a_search_that_has_not_converged_has_no_answer(seed, monkeypatch):
    """Rigs in a current, in plane and space: one equilibrium is not enough, twenty are."""
    tree = rig(seed, spatial=bool(seed % 2), conductor=False)
    tree["analysis"] = {"mesh": {"elements": 40}}
    for section in tree["riser"]:
        section["buoyancy_lift"] = "0 N/m"
    riser = SceneFile("rig.yaml", written(tree)).resolved()
    assert abs(engine_tension.needed(riser, AS_TOLD).left) <= 1.0  # N
    monkeypatch.setattr(engine_tension, "MOST", 1)
    with pytest.raises(SimulationError, match="minimum top tension: the search did not converge in 1"):
        engine_tension.needed(riser, AS_TOLD)


@pytest.mark.parametrize("seed", range(6))
def test_no_setting_is_left_where_none_is_safe_in_recoil(seed):
    """Disconnects of which each one re-contacts or strokes out."""
    draw = np.random.default_rng(seed)
    down = draw.random(5) < 0.5
    none = limits(np.sort(draw.uniform(2e6, 6e6, 5)), down, ~down)
    of = window(float(draw.uniform(1e6, 3e6)), None, Rig(6, 1, 0.95, 0.0), 6.7e6, 0.9, none[:1] + none[2:3])
    assert (of.floor, of.ceiling, of.gap) == ("recoil", "recoil", -math.inf)
