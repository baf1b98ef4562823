"""One table of what runs return: the same scenes have a quantity for limits, for plots and in runs."""

import subprocess
import sys
from pathlib import Path

import pytest

from riserstudy.dataset.variables import attributes
from riserstudy.scene.load import read_scene
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import finish, march
from riserstudy.simulation.starting_mesh import coarsest_mesh, period

SCENES = Path(__file__).parents[2] / "config/scenes"


@pytest.mark.parametrize("name", QUANTITIES)
def test_every_quantity_has_a_label_and_a_unit(name):
    assert attributes(name)["long_name"]
    assert attributes(name)["units"]


SHORT = ["bench/s2c", "bench/s3", "chang2020/heave", "liu2017/ref_0"]


def scene_of(scene):
    """The scene on a mesh of its own choice, for a few seconds, or until there is something to count."""
    file = read_scene(SCENES / f"{scene}.yaml")
    short = {"analysis.duration": "2 s", "analysis.output": {"interval": "1 s"}} if scene in SHORT else {}
    coarse = {"analysis.accuracy": "10 %", "analysis.mesh": None, "analysis.step": None}
    return file.with_values(coarse | short, "test").resolved()


def short_run(scene):
    made = scene_of(scene)
    mesh = coarsest_mesh(made)
    return made, finish(made, mesh, march(made, mesh, period(made) / 24.0)).arrays


def returned(arrays):
    return {n for n in QUANTITIES for e in ("", "_max", "_static") if n + e in arrays}


@pytest.mark.parametrize("scene", SHORT)
def test_runs_return_what_the_table_says_that_their_scene_has(scene):
    """Angles aside: which flex joints there are depends on how the scene holds the ends."""
    made, arrays = short_run(scene)
    stems = returned(arrays)
    for name, quantity in QUANTITIES.items():
        if quantity.is_array and not name.endswith("angle"):
            assert (name in stems) == bool(quantity.is_in(made)), name


@pytest.mark.parametrize("scene", [*SHORT, "design/recoil", "design/wellhead"])
def test_runs_return_at_rest_what_the_table_says(scene):
    _, arrays = short_run(scene)
    for name in returned(arrays):
        assert (f"{name}_static" in arrays) == QUANTITIES[name].at_rest, name


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
