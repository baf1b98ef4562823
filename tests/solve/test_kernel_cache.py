"""Compiled code is used as it was written, or compiled anew."""

import random
from pathlib import Path

import pytest
from numba import config
from numba.core.caching import IndexDataCacheFile, UserProvidedCacheLocator

from riserstudy.solve import jit

DATA = ("reduced", list(range(200)))


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setattr(jit, "kernel_cache", lambda: tmp_path)
    made = IndexDataCacheFile(str(tmp_path), "kernel", "stamp")
    made.save("signature", DATA)
    return made


def test_what_is_saved_is_loaded(cache):
    assert cache.load("signature") == DATA
    assert cache.load("another") is None


@pytest.mark.parametrize("kind", ["nbi", "nbc"])
def test_no_damaged_file_is_loaded_and_the_next_save_heals_it(cache, tmp_path, kind):
    (file,) = tmp_path.glob(f"*.{kind}")
    whole, rng = file.read_bytes(), random.Random(2)
    for _ in range(200):
        damaged = bytearray(whole[: rng.choice([len(whole), rng.randrange(len(whole))])])
        if len(damaged) == len(whole):
            damaged[rng.randrange(len(damaged))] ^= 1 << rng.randrange(8)
        file.write_bytes(damaged)
        assert cache.load("signature") is None
    cache.save("signature", DATA)
    assert cache.load("signature") == DATA


def test_a_file_under_another_s_name_is_not_loaded(cache, tmp_path):
    cache.save("other", ("other", [1]))
    one, other = sorted(tmp_path.glob("*.nbc"))
    one.write_bytes(other.read_bytes())
    assert cache.load("signature") is None
    assert cache.load("other") == ("other", [1])


def test_code_of_other_sources_is_not_loaded(cache, tmp_path):
    assert IndexDataCacheFile(str(tmp_path), "kernel", "newer").load("signature") is None
    assert Path(tmp_path / "kernel.nbi").exists()


def test_a_cache_that_cannot_be_written_is_read_and_asked_for_nothing_more(
    cache, tmp_path, monkeypatch
):
    """What lies below a file can be made by nobody, not even root."""
    (tmp_path / "file").touch()
    monkeypatch.setattr(jit, "kernel_cache", lambda: tmp_path / "file" / "cache")
    cache.save("another", DATA)
    assert cache.load("another") is None
    assert cache.load("signature") == DATA
    monkeypatch.setattr(config, "CACHE_DIR", str(tmp_path / "file" / "cache"))
    assert UserProvidedCacheLocator.from_function(cache.load, __file__) is not None
