"""The database states the origin of every value of a point, also of values that an axis sets with an origin."""

import json
from pathlib import Path

import numpy as np
import pytest
import workspace
from ruamel.yaml import YAML

from riserstudy import load_scene, query
from riserstudy.scene.paths import within

#: values of some paths, from the whole part to a value in it
VALUES = {
    "riser[0].drag": [{"coefficient": 1.2, "diameter": "1 m"}, {"coefficient": 0.9, "diameter": "39 in"}],
    "riser[0].drag.coefficient": [0.7, 1.4],
    "platform.surge.amplitude": ["1.5 m", "200 cm"],
    "platform.surge": [{"amplitude": "1 m", "period": "11 s", "ramp": "11 s"}],
}
DRAG, SURGE = ([path for path in VALUES if part in path] for part in ("drag", "surge"))


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


def origin_of(file, path, set_by_axis):
    """Origin and reason of a value in a scene that has all values, from the part that states one."""
    stated = [part for part in file.origins if within(path, part)]
    if stated:
        nearest = file.origins[max(stated, key=len)]
        return nearest.status, nearest.why
    return "varied" if any(within(path, own) for own in set_by_axis) else "given", ""


@pytest.mark.parametrize("seed", range(6))
def test_each_value_of_a_point_has_the_origin_that_its_own_scene_states(mine, seed):
    draw = np.random.default_rng(seed)
    axes = {"one": labels(draw, DRAG), "two": labels(draw, SURGE)}
    path, yaml = Path("config/studies/plain.yaml"), YAML()
    tree = yaml.load(path)
    about = {"scene": "scenes/surge.yaml", "set": workspace.PRESCRIBED, "caption": "origins", "axes": axes}
    tree["studies"] = {"origins": json.loads(json.dumps(about))}
    tree["derived"], tree["figures"] = {}, {}
    yaml.dump(tree, path)
    workspace.simulate("plain", "origins")
    workspace.built()
    base = load_scene(Path("config/scenes/surge.yaml")).with_values(workspace.PRESCRIBED, "test")
    asked = "select path, origin, because from points join parameters using (point)"
    asked += " where study = 'plain/origins' and position = ?"
    told = set()
    for position, (one, two) in enumerate(np.ndindex(4, 4)):
        sets = [[*axes["one"].values()][one], [*axes["two"].values()][two]]
        file = base.with_values(sets[0], "test").with_values(sets[1], "test")
        found = query(asked, [position])
        assert {"riser[0].drag.coefficient", "platform.surge.amplitude", "top.tension"} <= {*found["path"]}
        for where, origin, because in found.itertuples(index=False):
            assert (origin, because) == origin_of(file, where, {**sets[0], **sets[1]}), (where, sets)
            told.add(origin)
    assert {"given", "assumed"} <= told
