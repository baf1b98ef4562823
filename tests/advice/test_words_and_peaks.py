"""Peaks that measure the changes of an effect, verdicts, and their words, of runs whose answer is known."""

import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.advice.ablation import Ablation, Changed, Measured, Peaks, peaks
from riserstudy.advice.changes import fitting
from riserstudy.advice.effect_cost import freedom
from riserstudy.advice.recommendations import (
    COULD_GO,
    MISSING,
    NEEDED,
    NOT_MISSED,
    _largest,
    accuracy_of,
    longer,
    percent,
    row,
)
from riserstudy.dataset.result import Result
from riserstudy.effects.catalogue import changes
from riserstudy.model.build import build
from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile, read_scene

S = np.array([0.0, 10.0, 20.0, 30.0])
LIMITS = (0.02, 0.05, 0.05)


def run(**arrays):
    """A run of four nodes, whose envelopes are zero where not given."""
    zero = dict.fromkeys(
        ("x_max", "x_min", "y_max", "y_min", "bending_moment_max", "bending_moment_min",
         "bending_moment_static"), np.zeros(4)
    )  # fmt: skip
    own = {"s_node": S, "time": np.arange(3.0), "z_static": S + 0.5, "z_max": S + 0.7, "z_min": S - 1.5}
    own |= {"effective_tension_max": np.array([9e6, 1e6, 3e6, 2e6])}
    return Result(zero | own | {name: np.asarray(of, float) for name, of in arrays.items()}, {})


def test_a_displacement_in_space_is_the_largest_in_any_direction():
    """Not of extremes along both axes, which belong to different times."""
    x, y = np.zeros((3, 4)), np.zeros((3, 4))
    x[0, 1], x[2, 2], y[2, 2] = -6.0, 3.0, 4.0
    found = peaks(run(x=x, y=y, x_min=[0, -6, 0, 0], x_max=[0, 1, 3, 0], y_max=[0, 0, 4, 0]))
    assert found.displacement == pytest.approx(6.0)
    static = {"s_node": S, "x_static": [0, 3, 0, 5], "y_static": [0, 4, 0, 0], "z_static": S}
    still = Result({k: np.asarray(v, float) for k, v in static.items()} | {"effective_tension_static": S}, {})
    assert peaks(still).displacement == pytest.approx(5.0)


def test_a_riser_that_moves_along_itself_alone_is_told_from_its_rest():
    """From 0.5 m below the nodes' places: up by 0.2 m and down by 2 m."""
    assert peaks(run()).displacement == pytest.approx(2.0)
    still = {"z_static": S * 1.01 - 30.0, "effective_tension_static": np.array([9e6, 1e6, 1e6, 4e6])}
    still |= {"s_node": S, "x_static": np.zeros(4)}
    assert peaks(Result(still, {})).displacement == pytest.approx(0.3)  # 1 % of 30 m


def test_moments_count_by_size_and_tension_at_the_two_uppermost_nodes():
    found = peaks(run(bending_moment_min=[0, -8e3, 0, 0], bending_moment_max=[0, 5e3, 0, 0]))
    assert (found.moment, found.tension) == (8e3, 3e6)
    string = run()
    del string.arrays["bending_moment_static"]
    assert math.isnan(peaks(string).moment)


def test_a_change_is_relative_to_the_scene_itself():
    assert Peaks(2.0, 4.0, 1.0).change_to(Peaks(3.0, 3.0, 1.0)) == pytest.approx((0.5, -0.25, 0.0))
    assert math.isnan(Peaks(0.0, 4.0, 1.0).change_to(Peaks(3.0, 3.0, 1.0))[0])


def test_the_scatter_is_half_the_range_of_the_times():
    found = Measured(times=[1.2, 1.0, 0.9])
    assert (found.seconds, found.scatter) == (1.0, pytest.approx(0.15))


def of_kind(kind):
    return next(change for change in changes() if change.kind == kind)


def judged(kind, *sizes, seconds=0.5):
    base = Ablation(None, None, None, peaks=Peaks(1.0, 1.0, 1.0), times=[1.0])
    changed = Changed(of_kind(kind), peaks=Peaks(*(1.0 + size for size in sizes)), times=[seconds])
    return row(base, changed, LIMITS)


@pytest.mark.parametrize("place, limit", list(enumerate(LIMITS)))
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_each_quantity_has_its_own_limit_on_both_sides(place, limit, sign):
    for share, removed, added in ((0.99, COULD_GO, NOT_MISSED), (1.01, NEEDED, MISSING)):
        sizes = [0.0, 0.0, 0.0]
        sizes[place] = sign * share * limit
        assert judged("removed", *sizes).verdict == removed
        assert judged("added", *sizes).verdict == added


def test_an_effect_without_which_there_are_no_moments_is_needed():
    assert judged("removed", 0.0, math.nan, 0.0).verdict == NEEDED


@pytest.mark.parametrize("accuracy, limits", [(None, (0.01, 0.02, 0.02)), (0.003, (0.003, 0.003, 0.003))])
def test_limits_of_advice_are_the_requested_accuracy_or_the_default(accuracy, limits):
    from riserstudy.simulation.tolerance import DISPLACEMENT, MOMENT

    scene = SimpleNamespace(analysis=SimpleNamespace(accuracy=accuracy))
    expected = limits if accuracy else (DISPLACEMENT, MOMENT, MOMENT)
    assert accuracy_of(scene) == expected
    assert DISPLACEMENT != MOMENT


@pytest.mark.parametrize(
    "value, text",
    [(0.0, "0 %"), (4.9e-5, "0 %"), (5.1e-5, "+0.0051 %"), (0.0234, "+2.3 %"), (-0.0234, "-2.3 %"),
     (0.0996, "+10 %"), (0.1234, "+12 %"), (-1.0, "-100 %"), (12.3, "+1230 %"), (math.nan, "")],
)  # fmt: skip
def test_percentages_have_two_digits_and_a_sign(value, text):
    assert percent(value) == text


@pytest.mark.parametrize(
    "seconds, text", [(1.0, "as before"), (1.04, "as before"), (0.8, "-20 %"), (1.5, "+50 %"),
                      (1.99, "+99 %"), (2.0, "2 times"), (3.14, "3.1 times")]
)  # fmt: skip
def test_run_times_are_told_beyond_their_scatter(seconds, text):
    base = Ablation(None, None, None, times=[0.95, 1.0, 1.05])
    assert longer(base, Changed(of_kind("removed"), times=[seconds])) == text


@pytest.mark.parametrize(
    "sizes, text", [((0.1, 0.2, -0.3), "-30 % tension"), ((-0.5, 0.2, 0.3), "-50 % displacement"),
                    ((0.1, 0.2, 0.15), "+20 % moment"), ((0.101, -0.104, 0.102), "-10 % moment"),
                    ((float("nan"), 0.1, 0.02), "+10 % moment"), ((float("nan"),) * 3, "change not known")]
)  # fmt: skip
def test_the_largest_change_is_told_with_its_quantity_and_sign(sizes, text):
    assert _largest(judged("added", *sizes)) == text


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("spatial", [False, True])
def test_the_number_of_unknowns_is_that_of_the_nodes_that_move(seed, spatial):
    """Every node has its place and its rotations; what a model holds is no unknown."""
    scene = SceneFile("rig.yaml", written(moving(seed, spatial=spatial))).resolved()
    for count in (12, 13):
        model = build(scene, even(scene, count), ring_elevation=0.0)
        free = np.ones((len(model.s.l0) + 1, len(model.s.dof)), bool)
        free[tuple(model.fixed.T)] = False
        found = freedom(scene, model)
        assert found.unknowns == free.sum()
        assert f"less {free.size - free.sum()} that are held" in found.because


@pytest.mark.parametrize("count", [3, 20])
def test_a_string_on_the_wellhead_has_one_unknown_for_each_segment(count):
    section = {"name": "r", "length": "500 m", "axial_stiffness": "5e9 N", "submerged_weight": "1 kN/m"}
    tree = {
        "title": "string", "riser": [section], "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"z": "free", "tension": "1 MN"}, "analysis": {},
    }  # fmt: skip
    scene = SceneFile("string.yaml", tree).resolved()
    assert freedom(scene, build(scene, even(scene, count), ring_elevation=0.0)).unknowns == count


@pytest.mark.parametrize("bottom, top", [(-500.0, None), (None, 0.0), (-480.0, 20.0)])
def test_an_added_current_reaches_from_one_end_of_the_riser_to_the_other(bottom, top):
    """An elevation that is not given follows from the other end and the length of all sections."""
    parts = [
        {"name": name, "length": length, "axial_stiffness": "5e9 N", "submerged_weight": "1 kN/m",
         "bending_stiffness": "1e8 N*m^2", "mass": "500 kg/m",
         "drag": {"coefficient": 1.0, "diameter": "1 m"}}
        for name, length in (("a", "200 m"), ("b", "300 m"))
    ]  # fmt: skip
    tree = {
        "title": "riser", "gravity": "9.81 m/s^2", "riser": parts,
        "bottom": {"hold": "free"} if bottom is None else {"hold": "wellhead", "elevation": f"{bottom} m"},
        "top": {"x": "held", "offset": "5 m"} | ({"tension": "2 MN", "z": "free"} if top is None else
                                                {"elevation": f"{top} m", "z": "held"}),
        "water": {"density": "1025 kg/m^3"}, "analysis": {},
    }  # fmt: skip
    added = [
        file for change, file in fitting(SceneFile("riser.yaml", tree)) if change.label == "with current"
    ]
    over = added[0].resolved().current.profile
    assert (over.seabed, over.surface) == ((-500.0, 0.0) if None in (bottom, top) else (bottom, top))


def test_a_body_without_added_mass_gets_half_of_its_mass():
    file = read_scene(Path(__file__).parents[2] / "config/scenes/mao_hangoff/evacuation.yaml")
    body = {"name": "LMRP", "mass": "84 t", "density": "7850 kg/m^3"}
    bare = file.with_values({"bottom.body": body}, "test")
    (heavy,) = [other for change, other in fitting(bare) if change.label == "with body's added mass"]
    assert heavy.resolved().bottom.body.added_mass.horizontal == 42e3
