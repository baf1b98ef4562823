"""A stored point comes back as it was put, or counts as missing; nothing stored is unpickled."""

import hashlib
import io
import os
import pickle
import random

import numpy as np
import pytest

from riserstudy.dataset.result import Result
from riserstudy.scene.load import SceneFile
from riserstudy.study import store

KEY = "ab0123"


@pytest.fixture
def point(tmp_path, monkeypatch):
    """The file of a stored point."""
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path))
    arrays = {"time": np.linspace(0.0, 1.0, 11), "x": np.eye(11)}
    store.put(KEY, Result(arrays, {"wall_seconds": 1.0}), SceneFile("a.yaml", {"title": "a"}))
    return tmp_path / "points/ab" / f"{KEY}.npz"


def test_a_point_comes_back_as_it_was_put(point):
    found = store.get(KEY)
    assert found.facts == {"wall_seconds": 1.0}
    np.testing.assert_array_equal(found.arrays["x"], np.eye(11))
    assert [about["scene"] for about in store.about_points()] == [{"title": "a"}]
    assert [path.name for path in point.parent.iterdir()] == [point.name]


def test_a_damaged_point_counts_as_missing_wherever_it_is_damaged(point):
    whole, rng = point.read_bytes(), random.Random(1)
    for _ in range(300):
        damaged = bytearray(whole[: rng.choice([len(whole), rng.randrange(len(whole))])])
        if len(damaged) == len(whole):
            damaged[rng.randrange(len(damaged))] ^= 1 << rng.randrange(8)
        point.write_bytes(damaged)
        assert store.get(KEY) is None
        assert list(store.about_points()) == []


class Touch:
    """What, unpickled, leaves a mark."""

    def __init__(self, mark):
        self.mark = mark

    def __reduce__(self):
        return os.mkdir, (str(self.mark),)


def test_nothing_stored_is_unpickled(tmp_path, monkeypatch):
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path))
    mark, point = tmp_path / "mark", tmp_path / "points/ab/ab.npz"
    point.parent.mkdir(parents=True)
    evil = np.array([Touch(mark)], dtype=object)
    for arrays in ({"x": evil, "about": np.array("{}")}, {"about": evil}):
        content = io.BytesIO()
        np.savez(content, **arrays)
        point.write_bytes(content.getvalue() + hashlib.sha256(content.getvalue()).digest())
        with pytest.raises(ValueError, match="allow_pickle=False"):
            store.get("ab")
    point.write_bytes(pickle.dumps(Touch(mark)))
    assert store.get("ab") is None
    assert not mark.exists()
    pickle.loads(point.read_bytes())
    assert mark.exists()
