"""Tables of scenes give no value that an axis replaces at all points: those of rigs with drawn options."""

import json
from pathlib import Path

import numpy as np
import pytest
from random_rigs import at_mid_stroke, law, rig, written

from riserstudy.dataset.provenance import scene_file_of
from riserstudy.report.scenes import flat, scene_tables
from riserstudy.scene.paths import within
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.models import StudyFile
from riserstudy.study.study import Study

pytestmark = pytest.mark.usefixtures("own_store")
LAWS = ("linear", "gas", "table")


def options(tree, draw):
    """Axes whose options set parts of a rig, each at all points or at some."""
    rig_of = tree["top"]["tensioners"]
    present = next(name for name in LAWS if name in rig_of)
    pull = at_mid_stroke(rig_of)
    laws = {}
    for kind in draw.permutation([name for name in LAWS if name != present]).tolist():
        new = written(law(kind, pull, draw))
        laws[kind] = {f"top.tensioners.{present}": None, f"top.tensioners.{kind}": new[kind]}
    drag = f"{draw.uniform(0.6, 0.9):.3f}"
    flows = {
        "calm": {"current": None},
        "fast": {"current.profile.surface_speed": {"assumed": "1.1 m/s", "because": "a storm"}},
        "as it is": {},
    }
    chosen = draw.permutation([*flows])[: int(draw.integers(1, 4))].tolist()
    drags = {"rough": {"riser[0].drag.coefficient": float(drag)}}
    kept = int(draw.integers(1, 3))
    return {
        "law": dict(list(laws.items())[:kept]),
        "flow": {name: flows[name] for name in chosen},
        "drag": drags,
    }


def made(folder: Path, seed: int):
    """A study of a rig at rest, and its dataset."""
    draw = np.random.default_rng(seed)
    tree = rig(seed, spatial=bool(seed % 2), conductor=False)
    tree["analysis"] = {"mesh": {"elements": 12}}
    (folder / "rig.yaml").write_text(json.dumps(written(tree)))
    axes = options(tree, draw)
    model = {"scene": "rig.yaml", "caption": "c", "axes": axes}
    file = StudyFile.model_validate({"paper": "own", "studies": {"rest": model}})
    study = Study("own", "rest", file.studies["rest"], folder, "standard")
    return file, dataset_of(study, results_of(study, 1, lambda _: None)[0])


@pytest.mark.parametrize("seed", range(9))
def test_a_value_of_the_table_holds_at_a_point_and_what_is_missing_at_none(tmp_path, seed):
    file, dataset = made(tmp_path, seed)
    (table,) = scene_tables({"rest": dataset}, file, tmp_path)
    shape = dataset["point_key"].shape
    held = {}
    for place in np.ndindex(shape):
        index = dict(zip(map(str, dataset["point_key"].dims), place, strict=True))
        for path, value in flat(scene_file_of(dataset, index).tree).items():
            held.setdefault(path, set()).add(value)
    shown = dict(table.rows)
    for path, (value,) in shown.items():
        if value.status == "axis" and value.value == "varied":
            assert value.why in dataset.dims
        else:
            assert value.value in held[path], path
    of_one = [axis for axis in dataset["point_key"].dims if dataset.sizes[axis] == 1]
    for axis in of_one:  # what its option sets is there
        (sets,) = json.loads(dataset[axis].attrs["sets"]).values()
        parts = [path for path, value in sets.items() if value is not None]
        assert all(any(within(path, part) for path in shown) for part in parts)
    assert "drag" in of_one
