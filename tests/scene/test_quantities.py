"""One table of what runs return: the same scenes have a quantity for limits, for plots and in runs."""

import subprocess
import sys
from pathlib import Path

import pytest
from random_rigs import moving, written

from riserstudy.dataset.limits import NOT_LIMITED
from riserstudy.dataset.variables import ENDINGS, arrays_of, attributes
from riserstudy.model.mesh import prescribed
from riserstudy.records.facts import point_columns
from riserstudy.scene.limits import OF_ONE_PLACE, UNITS
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.simulation.error_estimate import CONTROLLED, HISTORIES
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import finish, march
from riserstudy.simulation.starting_mesh import coarsest_mesh, period
from riserstudy.simulation.vortex_vibration_statistics import FIELDS
from riserstudy.study.collect import HISTORIES as STORED
from riserstudy.study.needed import MOMENTS, PLACES

SCENES = Path(__file__).parents[2] / "config/scenes"


@pytest.mark.parametrize("name", QUANTITIES)
def test_every_quantity_has_a_label_and_a_unit(name):
    assert attributes(name)["long_name"]
    assert attributes(name)["units"]


SHORT = ["bench/s2c", "bench/s3", "chang2020/heave", "liu2017/ref_0"]
#: ends that are free, held and joined, in a plane and in space; strings and beams; at rest and over time
OTHER = [
    *("bench/s4a", "bench/s4b", "bench/s4c", "bench/s4d", "bench/s4e"),
    *("hard/conductor", "hard/hang_off", "hard/snap", "mao_hangoff/steady"),
]


def scene_of(scene):
    """The scene on a mesh of its own choice, for a few seconds, or until there is something to count."""
    file = read_scene(SCENES / f"{scene}.yaml")
    moves = file.tree["analysis"].get("duration")
    short = {"analysis.duration": "2 s", "analysis.output": {"interval": "1 s"}}
    short = short if moves and scene in SHORT + OTHER else {}
    coarse = {"analysis.accuracy": "10 %", "analysis.mesh": None, "analysis.step": None}
    return file.with_values(coarse | short, "test").resolved()


def short_run(scene):
    made = scene_of(scene)
    mesh = coarsest_mesh(made)
    step = period(made) / 24.0 if made.analysis.duration else None
    return made, finish(made, mesh, march(made, mesh, step)).arrays


def returned(arrays):
    return {n for n in QUANTITIES for e in ("", "_max", "_static") if n + e in arrays}


def check(made, arrays):
    """A run returns the quantities that its scene has, in the arrays that the table says."""
    moves = made.analysis.duration is not None
    for name, quantity in QUANTITIES.items():
        if quantity.is_array:
            found = {name + end for end in ("", *ENDINGS) if name + end in arrays}
            assert bool(found) == (not quantity.lacks(made)), name
            assert found <= set(arrays_of(name)), name
            over_time = {name + end for end in quantity.endings if end not in ("", "_static")}
            assert not (found and moves) or over_time <= found, name
            if found and moves:
                assert (name in found) == (quantity.history or not quantity.along), name


@pytest.mark.parametrize("scene", [*SHORT, *OTHER])
def test_runs_return_what_the_table_says_that_their_scene_has(scene):
    check(*short_run(scene))


@pytest.mark.parametrize("seed", range(6))
def test_drawn_rigs_return_what_the_table_says(seed):
    tree = moving(seed, spatial=bool(seed % 2), conductor=seed % 3 == 0)
    more = {"analysis.duration": "1 s", "analysis.output": {"interval": "0.5 s"}, "analysis.step": "0.25 s"}
    made = SceneFile("rig.yaml", written(tree)).with_values(more, "test").resolved()
    mesh = prescribed(made, 30)
    check(made, finish(made, mesh, march(made, mesh, 0.25)).arrays)


@pytest.mark.parametrize("scene, moves", [("bench/s2c", False), ("bench/s2c", True), ("bench/s4b", False)])
def test_the_beam_returns_what_the_table_says(scene, moves):
    """It has neither shear nor stresses nor an upper angle, and its lower angle only over time."""
    fixed = {"analysis.solver": "hermite", "analysis.mesh": {"elements": 20}, "analysis.accuracy": None}
    fixed |= {"analysis.step": "0.5 s", "analysis.duration": "2 s"} if moves else {"analysis.step": None}
    fixed |= {"analysis.output": {"interval": "1 s"}} if moves else {"analysis.output": None}
    fixed |= {} if moves else {"analysis.duration": None, "analysis.start": None, "analysis.method": None}
    made = read_scene(SCENES / f"{scene}.yaml").with_values(fixed, "test").resolved()
    mesh = prescribed(made, 20)
    check(made, finish(made, mesh, march(made, mesh, made.analysis.step)).arrays)


def test_histories_along_the_riser_are_those_that_meshes_are_compared_by():
    along = {name for name, of in QUANTITIES.items() if of.along and of.history}
    assert along == set(HISTORIES) == set(STORED) == set(FIELDS)
    assert along == (PLACES | MOMENTS | {"effective_tension"}) & set(QUANTITIES)
    assert {name for name, of in QUANTITIES.items() if of.is_array and of.limit_unit} <= set(UNITS)


def test_errors_are_controlled_by_a_tolerance_or_told_with_limits():
    errors = {error for of in QUANTITIES.values() for error in of.errors}
    assert errors == {*CONTROLLED, *NOT_LIMITED}
    assert not {*CONTROLLED} & {*NOT_LIMITED}
    assert errors == {c.about.part for c in point_columns() if c.fact == "error_estimate" and c.about.part}
    for key, names in OF_ONE_PLACE.items():
        assert set(names) == {n for n, of in QUANTITIES.items() if of.limit_unit and of.errors == (key,)}


@pytest.mark.parametrize("scene", [*SHORT, "design/recoil", "design/wellhead"])
def test_runs_return_at_rest_what_the_table_says(scene):
    _, arrays = short_run(scene)
    for name in returned(arrays):
        assert (f"{name}_static" in arrays) == QUANTITIES[name].at_rest, name


@pytest.mark.long
@pytest.mark.parametrize("scene", [*SHORT, "design/recoil", "design/wellhead"])
def test_the_errors_of_a_quantity_are_estimated_where_runs_return_it(scene):
    """Unless it is zero on every mesh, as the moment of an upright riser."""
    made = scene_of(scene)
    found = run(made, estimated=True)
    estimated = found.facts["error_estimate"]
    for name in returned(found.arrays):
        values = [found.arrays[name + e] for e in ("", "_max", "_min") if name + e in found.arrays]
        if any(abs(each).max() > 1e-6 for each in values):
            assert set(QUANTITIES[name].errors) <= set(estimated), name
    assert set(estimated) <= {error for of in QUANTITIES.values() for error in of.errors}


def test_a_throw_away_quantity_needs_no_other_entry():
    """Put into the table before anything reads it, as an edit of the file would."""
    program = """if True:
        from riserstudy.scene.quantities import QUANTITIES, Quantity
        QUANTITIES["noise"] = Quantity("platform", lambda s: bool(s.platform), "m", along=True)
        from riserstudy import load_scene
        from riserstudy.dataset.variables import of_runs
        from riserstudy.scene.limit_inputs import lacks
        from riserstudy.scene.limits import ALONG, Limit
        limit = Limit(output="noise", mode="drilling", at="riser", largest="3 m")
        scene = load_scene("bench/s4e.yaml").resolved()
        print(of_runs("noise_max"), "noise" in ALONG, limit.allowable, lacks(scene, limit))"""
    command = [sys.executable, "-c", program]
    ran = subprocess.run(command, cwd=SCENES, capture_output=True, text=True)
    assert ran.stdout.strip() == "True True 3.0 ['platform']", ran.stderr
