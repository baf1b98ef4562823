"""The database has each value of a point's scene with its origin, also where an axis sets or removes it."""

import json
from pathlib import Path

import numpy as np
import pytest
import workspace
from ruamel.yaml import YAML

from riserstudy import load_scene, query
from riserstudy.database.parameters import TITLES
from riserstudy.scene.paths import leaves, within

#: values of some paths, from the whole part to a value in it
VALUES = {
    "riser[0].drag": [{"coefficient": 1.2, "diameter": "1 m"}, {"coefficient": 0.9, "diameter": "39 in"}],
    "riser[0].drag.coefficient": [0.7, 1.4],
    "platform.surge.amplitude": ["1.5 m", "200 cm"],
    "platform.surge": [{"amplitude": "1 m", "period": "11 s", "ramp": "11 s"}],
    "bottom.rotation": ["free", {"stiffness": "40 kN*m/deg"}],
}
FIRST = [path for path in VALUES if "surge" not in path]
SECOND = [path for path in VALUES if path not in FIRST]


SCENE = Path("config/scenes/surge.yaml")


def with_origin(draw, value, number):
    """A value with an origin, or without one."""
    reason = f"reason {number}, it's 'so'"
    kinds = [
        {"assumed": value, "because": reason},
        {"derived": value, "from": reason},
        {"chosen": value, "because": reason},
    ]
    return [*kinds, value][int(draw.integers(4))]


def labels(draw, paths):
    """Labels that each set one of some paths, or none."""
    found = {"as in the scene": {}}
    for number in range(3):
        path = str(draw.choice(paths))
        value = VALUES[path][int(draw.integers(len(VALUES[path])))]
        found[f"label {number}"] = {path: with_origin(draw, value, number)}
    return found


def origin_of(file, path, set_by_axis, plain):
    """Origin and reason of a value in a scene that has all values, from the part that states one.

    ``plain``: origin of values of the scene file that state none.
    """
    stated = [part for part in file.origins if within(path, part)]
    if stated:
        nearest = file.origins[max(stated, key=len)]
        return nearest.status, nearest.why
    return "varied" if any(within(path, own) for own in set_by_axis) else plain, ""


@pytest.mark.parametrize("seed", range(4))
def test_each_point_has_the_values_and_origins_that_its_own_scene_states(mine, seed):
    draw = np.random.default_rng(seed)
    axes = {"one": labels(draw, FIRST), "two": labels(draw, SECOND)}
    path, yaml = Path("config/studies/plain.yaml"), YAML()
    tree = yaml.load(path)
    about = {"scene": "scenes/surge.yaml", "set": workspace.PRESCRIBED, "caption": "origins", "axes": axes}
    tree["studies"] = {"origins": json.loads(json.dumps(about))}
    tree["derived"], tree["figures"] = {}, {}
    yaml.dump(tree, path)
    if seed % 2:  # a scene of a paper
        yaml.dump({"paper": "plain"} | yaml.load(SCENE), SCENE)
    plain = "published" if seed % 2 else "given"
    workspace.simulate("plain", "origins")
    workspace.built()
    base = load_scene(SCENE).with_values(workspace.PRESCRIBED, "test")
    asked = "select path, as_written, origin, because from points join parameters using (point)"
    asked += " where study = 'plain/origins' and position = ?"
    told = set()
    for position, (one, two) in enumerate(np.ndindex(4, 4)):
        sets = [[*axes["one"].values()][one], [*axes["two"].values()][two]]
        file = base.with_values(sets[0], "test").with_values(sets[1], "test")
        found = query(asked, [position])
        scene = {k: of for k, of in leaves(file.tree) if k.split(".")[0] not in TITLES}
        written = {k: of if isinstance(of, str) else json.dumps(of) for k, of in scene.items()}
        assert dict(zip(found["path"], found["as_written"], strict=True)) == written
        assert len(found) == len(written)
        for where, _, origin, because in found.itertuples(index=False):
            assert (origin, because) == origin_of(file, where, {**sets[0], **sets[1]}, plain), (where, sets)
            told.add(origin)
    assert {plain, "assumed"} <= told
