"""A stored point comes back as it was put, or counts as missing; nothing stored is unpickled."""

import hashlib
import json
import os
import pickle
import random
import zlib
from contextlib import suppress

import numpy as np
import pytest

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError
from riserstudy.scene.load import SceneFile
from riserstudy.study import store

KEY = "ab0123"


@pytest.fixture
def point(tmp_path, monkeypatch):
    """The file of a stored point."""
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path))
    arrays = {"time": np.linspace(0.0, 1.0, 11), "x": np.eye(11)}
    store.put(KEY, Result(arrays, {"wall_seconds": 1.0}), SceneFile("a.yaml", {"title": "a"}))
    return tmp_path / "points/ab" / f"{KEY}{store.ENDING}"


def test_a_point_comes_back_as_it_was_put(point):
    found = store.get(KEY)
    assert found.facts == {"wall_seconds": 1.0}
    np.testing.assert_array_equal(found.arrays["x"], np.eye(11))
    assert store.about(KEY)["scene"] == {"title": "a"}
    assert [path.name for path in point.parent.iterdir()] == [point.name]


def test_a_damaged_point_counts_as_missing_wherever_it_is_damaged(point):
    whole, rng = point.read_bytes(), random.Random(1)
    for _ in range(300):
        damaged = bytearray(whole[: rng.choice([len(whole), rng.randrange(len(whole))])])
        if len(damaged) == len(whole):
            damaged[rng.randrange(len(damaged))] ^= 1 << rng.randrange(8)
        point.write_bytes(damaged)
        assert store.get(KEY) is None
        assert store.about(KEY) is None


class Touch:
    """What, unpickled, leaves a mark."""

    def __init__(self, mark):
        self.mark = mark

    def __reduce__(self):
        return os.mkdir, (str(self.mark),)


def test_nothing_stored_is_unpickled(tmp_path, monkeypatch):
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path))
    mark, point = tmp_path / "mark", tmp_path / f"points/ab/ab{store.ENDING}"
    point.parent.mkdir(parents=True)
    evil = pickle.dumps(Touch(mark))
    about = json.dumps({"facts": {}, "arrays": {"x": ["|O", [1]]}, "left_out": []}).encode()
    head, body = zlib.compress(about), zlib.compress(evil)
    whole = store.LENGTH.pack(len(head)) + head + body
    for content in (evil, whole):
        point.write_bytes(content + hashlib.sha256(b"ab\n" + content).digest())
        with suppress(ValueError, TypeError, zlib.error):
            store.get("ab")
    point.write_bytes(evil)
    assert store.get("ab") is None
    assert not mark.exists()
    pickle.loads(evil)
    assert mark.exists()


def test_a_point_under_another_s_name_counts_as_missing(point):
    other = point.with_name(f"ab9999{store.ENDING}")
    other.write_bytes(point.read_bytes())
    assert store.get(KEY) is not None
    assert store.get("ab9999") is None


@pytest.mark.parametrize(
    "values", [np.arange(6).reshape(2, 3), np.array(3.0), np.empty((0, 4)), np.eye(3)[:, ::2]]
)
def test_arrays_of_every_shape_come_back(point, values):
    store.put(KEY, Result({"a": values, "b": np.ones(2)}, {}), SceneFile("a.yaml", {}))
    found = store.get(KEY).arrays
    np.testing.assert_array_equal(found["a"], values)
    assert (found["a"].dtype, found["a"].shape) == (values.dtype, values.shape)
    np.testing.assert_array_equal(found["b"], np.ones(2))
    assert list(store.get(KEY, ["b"]).arrays) == ["b"]


def test_a_point_holds_what_is_kept_and_what_others_had_put_there(point):
    run = {name: np.linspace(0.0, 1.0, 5) for name in ("time", "s", "s_node")}
    run |= {name: np.full((5, 5), k) for k, name in enumerate(("effective_tension", "x", "angle"))}
    result, scene = Result(run, {}), SceneFile("a.yaml", {})
    point.unlink()
    store.put(KEY, result, scene, ["effective_tension"])
    held = [*run][:4]
    assert [*store.get(KEY, ["effective_tension"]).arrays] == held
    assert store.get(KEY, ["angle"]) is None
    assert store.get(KEY) is None
    assert store.all_of(KEY).about["left_out"] == ["x", "angle"]
    assert [*store.all_of(KEY).result.arrays] == held
    store.put(KEY, result, scene, ["angle"])
    for name in ("effective_tension", "angle"):
        np.testing.assert_array_equal(store.get(KEY, [name]).arrays[name], run[name])
    assert store.get(KEY) is None
    # what the run does not have at all is not missing
    assert store.get(KEY, ["angle", "ufj_angle_max"]) is not None


def test_a_point_of_a_former_format_is_none(point):
    point.rename(point.with_suffix(".point"))
    assert store.get(KEY) is None
    assert not store.has(KEY)
    assert [held.key for held in store.everything()] == [None]


def test_a_store_that_cannot_be_written_is_told_with_a_remedy(tmp_path, monkeypatch):
    (tmp_path / "points").touch()
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path))
    with pytest.raises(SimulationError, match=r"cannot be written: .*RISERSTUDY_CACHE to another folder$"):
        store.put(KEY, Result({}, {}), SceneFile("a.yaml", {}))
