"""Points in packs are those that were stored, whatever is packed, removed or damaged, and by whomever."""

import random
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

from riserstudy.dataset.result import Result
from riserstudy.scene.load import SceneFile
from riserstudy.study import packs, store


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """An empty store that packs three points and more, five at a time."""
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path))
    monkeypatch.setattr(store, "LEAST", 3)
    monkeypatch.setattr(store, "A_PACK", 5)
    return tmp_path


def keys(count, seed=0):
    """Keys as digests are."""
    draw = random.Random(seed)
    return [f"{draw.getrandbits(128):032x}" for _ in range(count)]


def put(key, value):
    """Store a point of one number."""
    store.put(key, Result({"x": np.array([value])}, {}), SceneFile("a.yaml", {"title": key}))


def values(names):
    """The numbers of points as the store has them, or None."""
    found = {key: store.get(key) for key in names}
    return {key: one and float(one.arrays["x"][0]) for key, one in found.items()}


def files(cache):
    """Files of points and packs."""
    return [path for path in (cache / "points").rglob("*") if path.is_file()]


@pytest.mark.parametrize("seed", range(8))
def test_a_store_that_packs_and_prunes_is_a_dictionary(cache, seed):
    draw, names, model = random.Random(seed), keys(30), {}
    for turn in range(60):
        some = draw.sample(names, draw.randrange(1, 12))
        match draw.randrange(3):
            case 0:
                for key in some:
                    put(key, float(turn))
                    model[key] = float(turn)
            case 1:
                store.pack(some)
            case _ if turn % 5 == 0:
                store.remove([held for held in store.everything() if held.key in some])
                for key in some:
                    model.pop(key, None)
        assert values(names) == {key: model.get(key) for key in names}
        assert {key for key in names if store.has(key)} == model.keys()
    assert {held.key for held in store.everything() if store.about(held.key)} == model.keys()
    assert {held.key for held in store.everything()} >= model.keys()


def test_many_points_have_few_files(cache):
    names = keys(103)
    for number, key in enumerate(names):
        put(key, float(number))
    store.pack(names)
    assert len(files(cache)) == 21  # of five, and of the last three
    assert values(names) == {key: float(number) for number, key in enumerate(names)}


def test_points_that_are_few_stay_as_they_are(cache):
    for key in (names := keys(2)):
        put(key, 1.0)
    store.pack(names)
    assert len(files(cache)) == 2


def test_a_pack_damaged_anywhere_gives_what_was_stored_or_nothing(cache):
    names = keys(5)
    for number, key in enumerate(names):
        put(key, float(number))
    store.pack(names)
    (file,) = files(cache)
    whole, draw, lost = file.read_bytes(), random.Random(1), set()
    for turn in range(400):
        cut = len(whole) if turn % 2 else draw.randrange(len(whole))
        damaged = bytearray(whole[:cut])
        if cut == len(whole):
            damaged[draw.randrange(cut)] ^= 1 << draw.randrange(8)
        file.write_bytes(damaged)
        store._packs_of.cache_clear()
        found = values(names)
        assert all(found[key] in (None, float(number)) for number, key in enumerate(names))
        lost.add(sum(one is None for one in found.values()))
        assert len(list(store.everything())) in (1, 5)
    assert lost >= {1, 5}  # one point, and all of them where the rows are hit


def test_of_two_packs_with_a_point_the_younger_counts(cache):
    names = keys(3)
    for value in (1.0, 2.0):
        for key in names:
            put(key, value)
        store.pack(names)
    assert len(files(cache)) == 2
    assert set(values(names).values()) == {2.0}


def test_packs_of_another_process_are_seen_at_once(cache):
    folder = cache / "points/packs"
    mine, names = packs.Packs(folder), keys(40)
    assert mine.read(names[0]) is None
    for number, key in enumerate(names):
        path = packs.write_pack(folder, {key: bytes([number])})
        assert mine.read(key) == bytes([number])
        if number % 3 == 0:
            path.unlink()
            assert mine.read(key) is None
            assert key not in mine


def pack_all(names):
    """What one of several processes does."""
    store.pack(names)


def test_processes_that_pack_the_same_points_lose_none(cache):
    names = keys(60)
    for number, key in enumerate(names):
        put(key, float(number))
    with ProcessPoolExecutor(4, get_context("fork")) as pool:
        list(pool.map(pack_all, [names] * 8))
    assert values(names) == {key: float(number) for number, key in enumerate(names)}
    assert not list((cache / "points").glob(f"*/*{store.ENDING}"))


def test_a_full_disk_leaves_points_as_they_are(cache, monkeypatch):
    def full(*_, **__):
        raise OSError(28, "No space left on device")

    for key in (names := keys(5)):
        put(key, 1.0)
    monkeypatch.setattr(packs, "write_whole", full)
    store.pack(names)
    assert len(files(cache)) == 5
    assert set(values(names).values()) == {1.0}
