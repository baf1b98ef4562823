"""Offsets at which limits are reached: a closed form, runs at what was found, and what cannot be told."""

import math
from pathlib import Path

import pytest

from riserstudy import load_scene
from riserstudy.dataset.limits import demand_of
from riserstudy.design.operability import CLOSE, AtRest, offsets, offsets_of

SCENE = Path(__file__).parents[2] / "config/scenes/design/riser.yaml"


def scene(*limits, **changed):
    told = [{"mode": "drilling", **limit} for limit in limits]
    return load_scene(SCENE, **{"limits": told, **changed}).resolved()


def angle_by_closed_form(offset):
    """Angle (rad) over a lower flex joint, hinge above: constant tension, uniform load, small angles."""
    tension, bending, length, load = 2e6, 1.4e8, 1000.0, 150.0
    stiffness = math.degrees(127e3)
    k = math.sqrt(tension / bending)
    pinned = offset / length + load * length / (2.0 * tension) * (
        1.0 - math.tanh(0.5 * k * length) / (0.5 * k * length)
    )
    return pinned / (1.0 + stiffness / tension * (k / math.tanh(k * length) - 1.0 / length))


def test_both_offsets_are_those_of_the_closed_form(tmp_path):
    loaded = tmp_path / "loaded.yaml"
    loaded.write_text(
        """
title: constant tension and uniform load
riser:
  - name: riser
    length: 1000 m
    axial_stiffness: 1e10 N
    bending_stiffness: 1.4e8 N*m^2
    lateral_load: 150 N/m
bottom: {hold: wellhead, elevation: 0 m, rotation: {stiffness: 127 kN*m/deg}}
top: {x: held, z: free, tension: 2 MN, rotation: free}
limits: [{output: lfj_angle, largest: 2 deg, mode: drilling}]
analysis: {mesh: {elements: 400, layers: {bottom: 8 m, top: 8 m}}}
""",
        "utf-8",
    )
    (found,) = offsets(load_scene(loaded).resolved(), 100.0, {})
    at_zero, slope = (angle_by_closed_form(0.0), angle_by_closed_form(1.0) - angle_by_closed_form(0.0))
    allowable = math.radians(2.0)
    assert found.high == pytest.approx((allowable - at_zero) / slope, abs=2.0 * CLOSE)
    # the form is for small slopes, true to half their square: at the top those of offset and load add up
    largest_slope = 87.0 / 1000.0 + 150.0 * 1000.0 / (2.0 * 2e6)
    expected = (-allowable - at_zero) / slope
    assert found.low == pytest.approx(expected, rel=0.5 * largest_slope**2)
    assert math.degrees(angle_by_closed_form(30.0)) == pytest.approx(2.67710, abs=1e-5)


def test_a_run_at_an_offset_that_was_found_uses_all_of_its_limit():
    limits = (
        {"output": "lfj_angle", "largest": "4 deg"},
        {"output": "ufj_angle", "mean": "2 deg"},
        {"output": "joint_stroke", "largest": "6 m"},
        {"output": "von_mises_stress", "largest": "200 MPa"},
    )
    riser = scene(*limits, **{"current.profile.surface_speed": "1 m/s"})
    for limit, found in zip(riser.limits, offsets(riser, 240.0, {}), strict=True):
        for offset in (found.low, found.high):
            demand = demand_of(riser, limit, AtRest(riser, 240.0).extremes(offset))[0]
            assert demand == pytest.approx(limit.allowable, rel=2e-3)  # 5 cm of 40 m and more


def test_an_allowance_is_taken_off_all_but_means():
    allowance = {"lfj_angle": math.radians(1.0)}
    four, mean = offsets(
        scene({"output": "lfj_angle", "largest": "4 deg"}, {"output": "lfj_angle", "mean": "4 deg"}),
        240.0,
        allowance,
    )
    three, plain = offsets(
        scene({"output": "lfj_angle", "largest": "3 deg"}, {"output": "lfj_angle", "mean": "4 deg"}),
        240.0,
        {},
    )
    assert four.high == pytest.approx(three.high, abs=CLOSE)
    assert mean.high == pytest.approx(plain.high, abs=CLOSE)
    assert mean.high > four.high + 10.0


def test_a_floor_is_raised_by_its_allowance():
    floor = {"output": "effective_tension", "smallest": "2.2 MN"}
    assert offsets(scene(floor), 100.0, {})[0].high == math.inf
    assert math.isnan(offsets(scene(floor), 100.0, {"effective_tension": 3e5})[0].high)


def test_a_gap_between_the_first_offsets_is_found():
    strong = {"current.profile.surface_speed": "1.5 m/s"}
    (narrow,) = offsets(scene({"output": "lfj_angle", "mean": "0.1 deg"}, **strong), 240.0, {})
    assert 0.0 < narrow.high - narrow.low < 60.0 / 4.0


def test_what_is_not_reached_or_never_kept_or_not_told_is_told_apart():
    never_reached, never_kept, not_told = offsets(
        scene(
            {"output": "von_mises_stress", "largest": "5 GPa"},
            {"output": "von_mises_stress", "largest": "1 MPa"},
            {"output": "tensioner_stroke", "largest": "5 m"},
        ),
        100.0,
        {},
    )
    assert (never_reached.low, never_reached.high) == (-math.inf, math.inf)
    assert math.isnan(never_kept.low)
    assert never_kept.missing == ""
    assert not_told.missing == "top.tensioners"


def test_an_offset_without_equilibrium_is_told_and_taken_for_no_limit():
    riser = scene({"output": "lfj_angle", "largest": "4 deg"})
    at = AtRest(riser, 240.0)
    at.lost[60.0] = "no static equilibrium: for this test"
    both = offsets_of(at, riser.limits[0], 240.0, 0.0)
    assert math.isnan(both.high)
    assert "for this test" in both.missing


@pytest.mark.long
def test_operability_tells_offsets_and_takes_allowances(commands):
    def ends(*more):
        code, out, _ = commands("operability", SCENE, "--reach", "240 m", *more)
        assert code == 0
        line = next(one for one in out.splitlines() if "drilling: largest lfj_angle" in one)
        return [float(part) for part in line.split() if part[0] in "+-"]

    alone, waves = ends(), ends("--allowance", "lfj_angle=1 deg")
    assert alone[0] < waves[0] < 0.0 < waves[1] < alone[1]


def test_an_allowance_of_no_output_is_refused(commands):
    code, _, said = commands("operability", SCENE, "--reach", "240 m", "--allowance", "angle=1 deg")
    assert code == 2
    assert "--allowance" in said


@pytest.mark.parametrize(
    "words, said",
    [
        (["--reach", "0 m"], "not above 0"),
        (["--reach", "-100 m"], "not above 0"),
        (["--reach", "9 m", "--allowance", "lfj_angle=-1 deg"], "negative"),
        (["--reach", "9 m", *2 * ["--allowance", "lfj_angle=1 deg"]], "given twice"),
        (["--reach", "9 m", "--allowance", "tensioner_force=1 kN"], "no limit on the largest or smallest"),
    ],
)
def test_an_option_without_meaning_or_effect_is_refused(commands, words, said):
    """Before, a reach negative met each limit at all offsets; the first of two options was ignored."""
    code, out, error = commands("operability", SCENE, *words)
    assert (code, out) == (2, "")
    assert said in error


def test_each_line_has_the_allowable_value_and_the_allowance_of_its_limit(commands, tmp_path):
    sets = (
        "["
        + ", ".join(f"{{output: lfj_angle, largest: {angle} deg, mode: drilling}}" for angle in (1.5, 2.5))
        + ", {output: effective_tension, smallest: 100 kN, mode: drilling}]"
    )
    words = ["--reach", "240 m", "--set", f"limits={sets}"]
    code, out, err = commands("operability", SCENE, *words)
    assert code == 0, err
    heads, *lines = out.splitlines()
    assert heads.split() == ["limit", "allowable", "offsets"]
    assert [line.split("  ")[1:] for line in lines]
    assert ["1.5 deg" in line for line in lines] == [True, False, False]
    assert ["2.5 deg" in line for line in lines] == [False, True, False]
    assert "100 kN" in lines[2]
    _, out, _ = commands("operability", SCENE, *words, "--allowance", "lfj_angle=0.25 deg")
    heads, *lines = out.splitlines()
    assert heads.split() == ["limit", "allowable", "allowance", "offsets"]
    assert ["0.25 deg" in line for line in lines] == [True, True, False]
