"""One table of what runs return: the same scenes have a quantity for limits, for plots and in runs."""

import subprocess
import sys
from pathlib import Path

import pytest

from riserstudy.dataset.variables import attributes
from riserstudy.scene.load import read_scene
from riserstudy.scene.outputs import QUANTITIES
from riserstudy.simulation.run import finish, march
from riserstudy.simulation.starting_mesh import coarsest_mesh, period

SCENES = Path(__file__).parents[2] / "config/scenes"


@pytest.mark.parametrize("name", QUANTITIES)
def test_every_quantity_has_a_label_and_a_unit(name):
    assert attributes(name)["long_name"]
    assert attributes(name)["units"]


@pytest.mark.parametrize("scene", ["bench/s2c", "bench/s3", "chang2020/heave", "liu2017/ref_0"])
def test_runs_return_what_the_table_says_that_their_scene_has(scene):
    """Angles aside: which flex joints there are depends on how the scene holds the ends."""
    file = read_scene(SCENES / f"{scene}.yaml")
    short = {"analysis.duration": "2 s", "analysis.output": {"interval": "1 s"}}
    made = file.with_values({"analysis.mesh": None, "analysis.step": None} | short, "test").resolved()
    mesh = coarsest_mesh(made)
    arrays = finish(made, mesh, march(made, mesh, period(made) / 24.0)).arrays
    stems = {n for n in QUANTITIES for e in ("", "_max", "_static") if n + e in arrays}
    for name, quantity in QUANTITIES.items():
        if quantity.is_array and not name.endswith("angle"):
            assert (name in stems) == bool(quantity.is_in(made)), name


def test_a_throw_away_quantity_needs_no_other_entry():
    """Put into the table before anything reads it, as an edit of the file would."""
    program = """if True:
        from riserstudy.scene.outputs import QUANTITIES, Quantity
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
