"""An edit of a study file that changes its dataset is seen; what it leaves alone is not simulated."""

import copy
import json
import random
import re

import pytest
from pydantic import ValidationError

from riserstudy.errors import InputError
from riserstudy.inputs.plain_yaml import plain_yaml
from riserstudy.study import store
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.models import StudyFile
from riserstudy.study.study import Study

SCENE = {
    "title": "hung",
    "riser": [
        {
            "name": "all",
            "length": "500 m",
            "axial_stiffness": "5e9 N",
            "submerged_weight": "1 kN/m",
            "mass": "200 kg/m",
        }
    ],
    "bottom": {"hold": "wellhead", "elevation": "0 m"},
    "top": {"z": "free", "tension": "1 MN"},
    "analysis": {},
}
LIMIT = {"output": "effective_tension", "mode": "connected"}
ASSUMED = {"assumed": "1 kN/m", "range": ["0.9 kN/m", "1.1 kN/m"], "because": "a guess"}
STUDY = {
    "scene": "hung.yaml",
    "caption": "pulled",
    "error_because": "the mesh is what is studied",
    "set": {
        "note": "a note",
        "riser[0].submerged_weight": ASSUMED,
        "riser[0].axial_stiffness": {"derived": "5e9 N", "from": "E A"},
        "analysis.mesh": {"elements": 4},
    },
    "limits": [
        LIMIT | {"smallest": {"assumed": "350 kN", "because": "the workflow uses itself"}},
        LIMIT | {"largest": "2 MN"},
        {"output": "lower_end_tension", "largest": "2 MN", "mode": "disconnect"},
    ],
    "axes": {
        "allow": {
            "loose": {"limits[1].largest": "4.9 MN", "title": "loose"},
            "tight": {"limits[1].largest": {"calibrated": "1.5 MN", "to": "own/N1"}},
        },
        "smallest": {
            "path": "limits[0].smallest",
            "unit": "kN",
            "factor": 2,
            "offset": 1,
            "values": [0, 175],
            "preview": [0],
        },
        "phase": {"only": {"limits[2].mode": "drilling"}},
        "rule": "readings",
        "sample": {"count": {"preview": 2, "standard": 2, "reference": 4}, "seed": 7, "readings": ["code"]},
    },
    "keep": ["effective_tension", "z"],
    "modes": 1,
}
READINGS = {
    "rule": {"old": {"limits[2].largest": "3 MN"}, "new": {"limits[2].largest": "4 MN"}},
    "code": {"first": {"note": "first"}, "second": {"note": "second", "top.tension": "1.2 MN"}},
}
FILE = {"paper": "own", "readings": READINGS, "studies": {"pull": STUDY}}
#: words that mean something, each with another of its kind
OTHER = {
    "drilling": "connected",
    "connected": "drilling",
    "kN": "N",
    "hung.yaml": "again.yaml",
    "z": "z_static",
    "effective_tension": "lower_end_tension",
    "code": "rule",
}
TIMES = ("wall_seconds", "solve_seconds")


def leaves(tree, way=()):
    """The way to every value."""
    items = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in items:
        here = (*way, key)
        yield from leaves(value, here) if isinstance(value, dict | list) else [here]


def edited(way, seed):
    """The file with another value at the end of a way."""
    file, draw = copy.deepcopy(FILE), random.Random(f"{way} {seed}")
    here = file
    for step in way[:-1]:
        here = here[step]
    old, by = here[way[-1]], draw.uniform(1.01, 1.2)
    if isinstance(old, str):
        number = re.match(r"[0-9.e]+(?= )", old)
        other = f"{float(number[0]) * by}{old[number.end() :]}" if number else f"{old} {seed}"
        here[way[-1]] = OTHER.get(old, other)
    else:
        here[way[-1]] = old + 1 if way[-1] in ("seed", "elements", "modes", 0) else old * by
    if way[-1] in ("preview", "standard", "reference"):
        here[way[-1]] = old + 1
    return file


def renamed(way, name):
    """The file with another name for what stands at the end of a way, in its place."""
    file = copy.deepcopy(FILE)
    here = file
    for step in way[:-1]:
        here = here[step]
    items = [(name if key == way[-1] else key, value) for key, value in here.items()]
    here.clear()
    here.update(items)
    return file


def study(folder, file):
    for name in ("hung.yaml", "again.yaml"):
        (folder / name).write_text(json.dumps(SCENE))
    checked = StudyFile.model_validate(file)
    (model,) = checked.studies.values()
    return Study("own", "pull", model, folder, "standard", None, checked.readings)


def dataset(made):
    found = dataset_of(made, results_of(made, 1, lambda _: None)[0]).drop_vars(TIMES)
    del found.attrs["digest"]
    return found


def content(found):
    """All that a dataset says, whatever the order of keys."""

    def plain(attributes):
        return {name: _read(value) for name, value in attributes.items()}

    about = {str(name): plain(found[name].attrs) for name in found.variables}
    return {"": plain(found.attrs), **about}


def _read(value):
    try:
        return json.loads(value)
    except (TypeError, ValueError):
        return str(value)


def same(one, other):
    return one.equals(other) and content(one) == content(other)


RENAMED = [
    (("studies", "pull", "axes", "allow", "tight"), "narrow"),
    (("studies", "pull", "axes", "allow"), "allowed"),
    (("studies", "pull", "axes", "smallest"), "least"),
    (("readings", "rule", "old"), "former"),
    (("readings", "code", "second"), "other"),
]
EDITS = [
    *((" ".join(map(str, way)), edited(way, seed)) for way in leaves(FILE) for seed in (1, 2)),
    *((" ".join(map(str, way)) + " renamed", renamed(way, name)) for way, name in RENAMED),
]


@pytest.mark.long
def test_every_edit_that_changes_the_dataset_changes_its_digest(own_store):
    first = study(own_store, FILE)
    before, changed, refused = dataset(first), [], []
    for name, file in EDITS:
        try:
            other = study(own_store, file)
            found = dataset(other)
        except (InputError, ValidationError):
            refused.append(name)
            continue
        if not same(found, before):
            changed.append(name)
            assert other.digest != first.digest, name
    told = {way for way in changed if way.startswith(("studies pull", "readings"))}
    assert len(told) > 40, "edits that change nothing show nothing"
    assert len(refused) < len(EDITS) / 5, refused


@pytest.mark.parametrize("name, file", EDITS[::9], ids=[name for name, _ in EDITS[::9]])
def test_after_an_edit_the_dataset_is_that_of_an_empty_store(name, file, own_store, monkeypatch):
    before = study(own_store, FILE)
    results_of(before, 1, lambda _: None)  # stored, as points of the study before the edit
    try:
        found = dataset(study(own_store, file))
    except (InputError, ValidationError):
        pytest.skip("the edit means nothing")
    monkeypatch.setattr(store, "_file", lambda key: own_store / "empty" / f"{key}.point")
    assert same(found, dataset(study(own_store, file)))


def shuffled(tree, draw, way=()):
    """The same with keys in another order, but for names of axes and labels, which datasets keep in order."""
    if isinstance(tree, list):
        return [shuffled(value, draw, way) for value in tree]
    if not isinstance(tree, dict):
        return tree
    keys = [*tree]
    ordered = way[-1:] == ("axes",) or way[-2:-1] == ("axes",) or way[:1] == ("readings",)
    if not ordered or len(way) > 4 or way[-1] in ("sample", "smallest"):
        draw.shuffle(keys)
    return {key: shuffled(tree[key], draw, (*way, key)) for key in keys}


@pytest.mark.parametrize("seed", range(5))
def test_comments_other_tiers_and_the_order_of_keys_leave_the_digest(own_store, seed):
    draw = random.Random(seed)
    other = shuffled(FILE, draw)
    counts = other["studies"]["pull"]["axes"]["sample"]["count"]
    counts |= {"preview": draw.randint(3, 9), "reference": draw.randint(3, 9)}
    lines = json.dumps(other, indent=2).splitlines()
    lines[draw.randrange(1, len(lines) - 1)] += f"  # {seed}"
    read = plain_yaml("\n".join(lines), "edited")
    assert study(own_store, read).digest == study(own_store, FILE).digest
    assert same(dataset(study(own_store, read)), dataset(study(own_store, FILE)))
