"""Tables that axes name, in any notation: an edit of one is seen, and datasets hold the texts of all."""

import json
from dataclasses import replace

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel
from riserstudy.study.sweep import as_study

NAMES = ("first.csv", "second.csv")
SAMPLES = {"count": dict.fromkeys(("preview", "standard", "reference"), 4)}
#: axes that name both tables, one by each notation
AXES = {
    "path of the file": {name[:-4]: {"current.profile.file": name} for name in NAMES},
    "path of the profile": {name[:-4]: {"current.profile": {"file": name}} for name in NAMES},
    "path of the current": {
        name[:-4]: {"current": {"profile": {"file": name}, "beyond": "hold"}} for name in NAMES
    },
    "with an origin": {
        name[:-4]: {"current.profile.file": {"assumed": name, "because": "a test"}} for name in NAMES
    },
}
ASSUMED = {"assumed": NAMES[0], "options": [*NAMES], "because": "a test"}


def study_of(folder, axis, **sets):
    model = {"scene": "rig.yaml", "caption": "currents", "axes": {"tide": axis}, "set": sets}
    return Study("own", "tides", StudyModel.model_validate(model), folder, "standard")


def write_current(folder, name, speeds):
    rows = [f"{depth}, {speed!r}\n" for depth, speed in zip((0, 100, 400), speeds, strict=True)]
    (folder / name).write_text("depth (m), speed (m/s)\n" + "".join(rows))


def lay_out(folder, seed, spatial, draw):
    tree = rig(seed, spatial=spatial)
    tree.pop("current", None)
    tree["current"] = {"profile": {"file": "base.csv"}, "beyond": "hold"}
    tree["water"] = tree.get("water", {}) | {"surface": 0.0, "density": 1025.0}
    (folder / "rig.yaml").write_text(json.dumps(written(tree)))
    for name in ("base.csv", *NAMES):
        write_current(folder, name, draw.uniform(0.05, 0.8, 3).tolist())


def check_edits(folder, draw, made):
    before = made()
    keys = [point.key for point in before.plan]
    assert {*NAMES} <= {*before.tables}
    for name in NAMES:
        write_current(folder, name, draw.uniform(0.05, 0.8, 3).tolist())
        after = made()
        # the plan, which is cached, is the one that the scenes give now
        assert [point.key for point in after.plan] == [point.key for point in after.grid.points()]
        assert [point.key for point in after.plan] != keys
        assert after.digest != before.digest
        assert after.tables[name] == (folder / name).read_text()
        before, keys = after, [point.key for point in after.plan]


@pytest.mark.parametrize("axis", AXES)
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_an_edit_of_a_table_that_an_axis_names_is_seen(seed, spatial, axis, tmp_path):
    draw = np.random.default_rng(seed)
    lay_out(tmp_path, seed, spatial, draw)
    check_edits(tmp_path, draw, lambda: study_of(tmp_path, AXES[axis]))


@pytest.mark.parametrize("spatial", [False, True])
def test_an_edit_of_a_table_that_samples_choose_is_seen(spatial, tmp_path):
    draw = np.random.default_rng(7)
    lay_out(tmp_path, 7, spatial, draw)
    check_edits(
        tmp_path, draw, lambda: study_of(tmp_path, SAMPLES | {"seed": 1}, **{"current.profile.file": ASSUMED})
    )


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_a_scene_of_a_dataset_is_planned_with_the_tables_of_the_dataset(seed, spatial, tmp_path):
    """Whatever files of their names are beside it."""
    draw = np.random.default_rng(seed)
    lay_out(tmp_path, seed, spatial, draw)
    file = read_scene(tmp_path / "rig.yaml")
    axes = {"water.density": [1020.0 + seed, 1030.0]}
    planned = as_study(file, axes, None)
    elsewhere = tmp_path / "elsewhere"
    for foreign in (False, True):
        elsewhere.mkdir(exist_ok=True)
        held = {"base.csv": (tmp_path / "base.csv").read_text()}
        if foreign:
            write_current(elsewhere, "base.csv", draw.uniform(0.05, 0.8, 3).tolist())
        alone = SceneFile(str(elsewhere / "run.nc"), file.tree, file.origins, held=held)
        study = as_study(alone, axes, None)
        assert [p.key for p in study.plan] == [p.key for p in planned.plan]
        assert study.tables == planned.tables
        other = as_study(
            replace(alone, held={"base.csv": held["base.csv"].replace("400", "500")}), axes, None
        )
        assert {p.key for p in other.plan}.isdisjoint(p.key for p in planned.plan)
