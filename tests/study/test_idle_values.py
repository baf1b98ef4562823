"""Axes that change no run, and outputs that no run has, are named: over seeded rigs at rest and in motion."""

from dataclasses import replace

import numpy as np
import pytest
from random_rigs import moving, rig, written

from riserstudy import sweep
from riserstudy.scene.load import SceneFile
from riserstudy.study.idle_values import idle_values
from riserstudy.study.sweep import as_study

SEEDS = range(6)


def file_of(seed, in_motion=False):
    make = moving if in_motion else rig
    tree = make(seed, spatial=bool(seed % 2))
    if not in_motion:
        tree["analysis"] = {"mesh": {"elements": 20}}
    limit = {"output": "lfj_angle", "largest": "3 deg", "mode": "drilling"}
    return SceneFile("rig.yaml", written(tree) | {"limits": [limit]})


@pytest.mark.parametrize("seed", SEEDS)
def test_an_axis_that_changes_no_run_is_named(seed):
    draw, file = np.random.default_rng(seed), file_of(seed)
    offsets = np.sort(draw.uniform(0.0, 5.0, 3)).tolist()
    busy = {"top.offset": [f"{x!r} m" for x in offsets]}
    same = {"joint": {"soft": {"top.offset": "1 m"}, "stiff": {"top.offset": "1 m"}}}
    for axes, idle in (
        (busy, []),
        ({"title": ["one", "two"]}, ["title"]),
        (busy | {"note": ["one", "two", "three"]}, ["note"]),
        (same, ["joint"]),
        ({"limits[0].largest": ["3 deg", "4 deg"]}, []),
    ):
        found = idle_values(as_study(file, axes, None))
        assert [text.partition("axes.")[2].partition(":")[0] for text in found] == idle


@pytest.mark.parametrize("seed", SEEDS)
def test_an_output_that_no_run_has_is_named(seed):
    keep = ["x", "bending_moment_max", "largest_stress", "platform_sway", "damage_rate"]
    axes = {"top.offset": ["1 m", "2 m"]}
    found = idle_values(as_study(file_of(seed, in_motion=True), axes, keep))
    assert [text.partition("'")[2].partition("'")[0] for text in found] == keep[2:]
    first = file_of(seed, in_motion=True).tree["riser"][0]["name"]
    of_wall = {"analysis.output.stress_in": [first]}
    assert not idle_values(as_study(file_of(seed, in_motion=True), of_wall, ["largest_stress"]))


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    "sets, lost",
    [
        ({"top.offset": "3 m"}, ["top.offset"]),
        ({"top.offset": {"assumed": "3 m", "because": "the study varies it"}}, []),
        ({"current.heading": "0 deg"}, ["current.heading"]),
        ({"current": {"profile": {"shape": "uniform", "surface_speed": "1 m/s"}}}, ["current"]),
        ({"bottom.rotation": "fixed"}, []),
        ({"analysis.mesh": {"elements": 30}, "title": "another"}, []),
    ],
)
def test_a_value_that_every_value_of_an_axis_replaces_is_named(seed, sets, lost):
    """A label that keeps the value needs it; an axis within a part needs the part."""
    draw = np.random.default_rng(seed)
    slow, fast = sorted(draw.uniform(0.1, 0.9, 2).tolist())
    flows = {
        name: {"current": {"profile": {"shape": "uniform", "surface_speed": f"{speed!r} m/s"}}}
        for name, speed in (("slow", slow), ("fast", fast))
    }
    axes = {
        "top.offset": [f"{x!r} m" for x in np.sort(draw.uniform(0.0, 5.0, 3)).tolist()],
        "flow": flows,
        "joint": {"fixed": {}, "pinned": {"bottom.rotation": "free"}},
    }
    study = as_study(file_of(seed), axes, None)
    model = study.model.replaced(set=sets)
    found = [text.partition(" set.") for text in idle_values(replace(study, model=model))]
    assert [text.partition(":")[0] for _, sets, text in found if sets] == lost


def test_a_sweep_warns_of_them():
    with pytest.warns(UserWarning, match=r"axes.title: its values change no run"):
        sweep(file_of(0), {"title": ["one", "two"]}, keep=["x"], cores=1, progress=False)
    with pytest.warns(UserWarning, match=r"keep: no run has 'stroke', which needs motion"):
        sweep(file_of(0), {"top.offset": ["1 m"]}, keep=["stroke"], cores=1, progress=False)
