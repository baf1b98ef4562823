"""Errors name the file at fault: the study that set a value, or the table, not the scene they are put on."""

from pathlib import Path

import pytest

from riserstudy.errors import InputError
from riserstudy.scene.error_source import is_known
from riserstudy.scene.load import read_scene

SCENES = Path(__file__).parents[2] / "config/scenes"
SCENE = SCENES / "bench/s2c.yaml"
LAYER = "config/studies/own.yaml: studies.runs"


@pytest.mark.parametrize(
    "sets, where, field",
    [
        ({"platform.surge.amplitudo": "1 m"}, LAYER, "platform.surge.amplitudo"),
        ({"platform.surge.amplitude": "1 kg"}, LAYER, "platform.surge.amplitude"),
        ({"platform.surge": {"amplitude": "1 kg"}}, LAYER, "platform.surge"),
        ({"platform.surje": None}, LAYER, "platform.surje"),
        ({"riser[0].drag.coefizient": None}, LAYER, "riser[0].drag.coefizient"),
        ({"platform.sway.amplitude": "1 m"}, f"{SCENE} with {LAYER}", "platform.sway.period"),
        ({"platform": None}, f"{SCENE} with {LAYER}", ""),
        ({"top": None}, LAYER, "top"),
        (
            {"riser[0].drag.coefficient": [{"elevation": "0 m", "value": "a"}]},
            LAYER,
            "riser[0].drag.coefficient",
        ),
        ({"riser[0].inner_diameter": "1 m"}, f"{SCENE} with {LAYER}", "riser[0]"),
    ],
)
def test_what_a_study_sets_is_told_of_the_study(sets, where, field):
    with pytest.raises(InputError) as refused:
        read_scene(SCENE).with_values(sets, LAYER).resolved()
    assert (refused.value.where, refused.value.field[: len(field)]) == (where, field)


def test_what_stands_in_the_scene_is_told_of_the_scene(tmp_path):
    scene = tmp_path / "own.yaml"
    scene.write_text(SCENE.read_text().replace("15 s, ramp", "15 kg, ramp"))
    with pytest.raises(InputError) as refused:
        read_scene(scene).with_values({"riser[0].length": "534 m"}, LAYER).resolved()
    assert refused.value.where == str(scene)


@pytest.mark.parametrize("rows", ["", "0, 1\n"])
def test_a_table_that_says_too_little_is_told_of_the_table(tmp_path, rows):
    (tmp_path / "current.csv").write_text("elevation (m), speed (m/s)\n" + rows)
    scene = tmp_path / "own.yaml"
    scene.write_text(SCENE.read_text() + "current: {profile: {file: current.csv}}\n")
    with pytest.raises(InputError) as refused:
        read_scene(scene).resolved()
    assert refused.value.where == str(tmp_path / "current.csv")


@pytest.mark.parametrize(
    "path", ["wave", "platform.surge", "riser[0].contents", "analysis.mesh", "top.tensioners.table"]
)
def test_null_may_take_out_what_a_scene_can_have_but_has_not(path):
    read_scene(SCENE).with_values({path: None}, LAYER)


def test_every_path_of_every_scene_is_known():
    def paths(tree, way=""):
        if isinstance(tree, dict):
            for key, value in tree.items():
                yield from paths(value, f"{way}.{key}" if way else key)
        elif isinstance(tree, list):
            for k, value in enumerate(tree):
                yield from paths(value, f"{way}[{k}]")
        else:
            yield way

    every = {p for file in SCENES.rglob("*.yaml") for p in paths(read_scene(file).tree)}
    tables = (".file", "coefficient[")  # read before the scene is checked, or under two names
    unknown = [p for p in sorted(every) if not is_known(p) and not p.endswith(tables[0])]
    assert len(every) > 100
    assert unknown == []
