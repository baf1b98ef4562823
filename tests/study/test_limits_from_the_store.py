"""A study judges limits as a single run does, although it reads only some facts of a run from the store."""

from pathlib import Path

import numpy as np
import pytest
from random_rigs import moving, rig, shed_vortices, written

from riserstudy.dataset.limits import checked
from riserstudy.scene.limits import UNITS
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.simulation.refine import run
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.sweep import as_study

SCENES = Path(__file__).parents[2] / "config/scenes"
pytestmark = pytest.mark.usefixtures("own_store")


def verdicts(file, axes):
    """Verdicts on the limits of the first point, in a study and of a run alone."""
    study = as_study(file, axes, [])
    found = dataset_of(study, results_of(study, 1, lambda _: None)[0])["verdict_of_limit"]
    scene = study.grid.file((0,))
    alone = checked(scene, scene.resolved(), run(scene.resolved()).facts)
    return found.values[0].tolist(), [one.verdict for one in alone]


@pytest.mark.parametrize("seed", range(4))
def test_limits_of_a_drawn_rig_have_the_same_verdicts(seed):
    """Allowables are near the demands, so that estimated errors decide."""
    tree = moving(seed, spatial=bool(seed % 2), conductor=False)
    tree["analysis"] = {"duration": 10.0, "output": {"interval": 0.5}, "step": 0.5}
    file = SceneFile("rig.yaml", written(tree)).with_values({"analysis.mesh": {"elements": 20}}, "test")
    facts = run(file.resolved()).facts
    demands = {row["output"]: max(abs(row["largest"]), abs(row["smallest"])) for row in facts["extremes"]}
    draw = np.random.default_rng(seed)
    limits = []
    for name, demand in demands.items():
        if name != "stroke" and demand > 0.0:
            allowed = f"{(1.0 + draw.choice([1e-6, 0.01, 0.1, 1.0])) * demand:.12g} {UNITS[name]}"
            limits.append({"output": name, "largest": allowed, "mode": "connected"})
    in_study, alone = verdicts(file.with_values({"limits": limits}, "test"), {"note": ["one", "two"]})
    assert in_study == alone
    assert len(set(alone)) > 1


@pytest.mark.parametrize("seed", range(3))
def test_the_shear_of_a_riser_that_vibrates_is_not_known(seed):
    tree = shed_vortices(rig(seed, spatial=True, conductor=False))
    tree["limits"] = [{"output": "shear_force", "largest": "100 MN", "mode": "connected"}]
    tree["current"] = {"profile": {"shape": "uniform", "surface_speed": 0.5}}
    tree["analysis"] = {"duration": 60.0, "step": 0.5, "mesh": {"elements": 30}, "output": {"interval": 0.25}}
    in_study, alone = verdicts(SceneFile("rig.yaml", written(tree)), {"note": ["one", "two"]})
    assert in_study == alone == ["not evaluated"]


def test_the_error_of_a_clearance_is_a_share_of_the_lift():
    """The lift is three times the clearance, and its error exceeds the margin."""
    limit = {"output": "lmrp_clearance", "smallest": "2 m", "mode": "disconnect"}
    more = {"analysis.mesh": {"elements": 30}, "analysis.step": "0.1 s", "analysis.accuracy": None}
    file = read_scene(SCENES / "design/recoil.yaml").with_values(more | {"limits": [limit]}, "test")
    in_study, alone = verdicts(file, {"note": ["one", "two"]})
    assert in_study == alone == ["not evaluated"]
