"""Whose cache it is, and that what is remembered is what was remembered."""

import os
import random

import pytest
import xarray as xr

from riserstudy.dataset.netcdf import write_netcdf
from riserstudy.errors import InputError, SimulationError
from riserstudy.files import cache as cache_files
from riserstudy.files.cache import cache_folder, remembered
from riserstudy.files.csv_files import write_csv
from riserstudy.files.whole import whole_file, write_whole
from riserstudy.solve.kernel_cache import kernel_cache


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path / "cache"))
    (tmp_path / "cache").mkdir(mode=0o755)
    cache_files._refuse_foreign.cache_clear()
    yield tmp_path / "cache"
    cache_files._refuse_foreign.cache_clear()


def test_a_cache_that_anyone_can_write_to_is_refused(cache):
    assert cache_folder() == cache
    cache.chmod(0o777)
    cache_files._refuse_foreign.cache_clear()
    with pytest.raises(InputError, match="any user can write to this cache folder"):
        cache_folder()


def test_a_cache_that_others_of_a_group_can_write_to_is_refused(cache, monkeypatch):
    cache.chmod(0o775)
    monkeypatch.setattr(cache_files, "_group_of_one", lambda group: group != cache.stat().st_gid)
    with pytest.raises(InputError, match="a group of users can write to this cache folder"):
        cache_folder()


def test_a_group_of_one_is_that_of_the_user_or_the_administrator():
    import grp

    others = [g.gr_gid for g in grp.getgrall() if g.gr_gid not in (0, os.getuid())]
    assert cache_files._group_of_one(0)
    assert cache_files._group_of_one(os.getuid())
    assert not all(map(cache_files._group_of_one, others))


def test_compiled_kernels_that_others_can_replace_are_refused(cache):
    numba = cache / "numba"
    numba.mkdir()
    numba.chmod(0o777)
    with pytest.raises(InputError, match="any user can write to this cache folder"):
        kernel_cache()
    cache.chmod(0o700)  # where they cannot get in
    assert kernel_cache().parent == numba


def test_a_cache_that_is_made_is_private_whatever_the_umask(tmp_path, monkeypatch):
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path / "new/cache"))
    before = os.umask(0)
    try:
        assert cache_folder().stat().st_mode & 0o777 == 0o700
    finally:
        os.umask(before)


def test_a_cache_of_another_user_is_refused(cache, monkeypatch):
    monkeypatch.setattr(os, "getuid", lambda: cache.stat().st_uid + 1)
    with pytest.raises(InputError, match="belongs to another user"):
        cache_folder()


def test_an_installed_package_keeps_nothing_where_one_works(tmp_path, monkeypatch):
    monkeypatch.delenv("RISERSTUDY_CACHE", raising=False)
    monkeypatch.setattr(cache_files, "PACKAGE", tmp_path / "lib/site-packages/riserstudy")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "mine"))
    monkeypatch.chdir(tmp_path)
    assert cache_folder().name == "riserstudy"
    assert cache_folder().parent != tmp_path


def test_what_is_remembered_is_made_anew_when_it_was_damaged(cache):
    made = []

    def make():
        made.append(1)
        return {"length": "600 N/m"}

    assert remembered("scenes/a", make) == remembered("scenes/a", make) == make()
    assert len(made) == 2
    file = cache / "scenes/a.json"
    whole, rng = file.read_bytes(), random.Random(4)
    for count in range(100):
        damaged = bytearray(whole)
        damaged[rng.randrange(len(whole))] ^= 1 << rng.randrange(8)
        file.write_bytes(damaged)
        assert remembered("scenes/a", make) == {"length": "600 N/m"}
        assert len(made) == count + 3
    file.rename(cache / "scenes/b.json")
    assert remembered("scenes/b", lambda: "b") == "b"


@pytest.mark.parametrize("umask", [0o002, 0o022, 0o077])
def test_others_may_read_a_file_as_they_may_any_other(tmp_path, umask):
    before = os.umask(umask)
    try:
        write_whole(tmp_path / "whole.json", b"{}")
        (tmp_path / "plain.json").write_bytes(b"{}")
    finally:
        os.umask(before)
    modes = {file.name: file.stat().st_mode for file in tmp_path.iterdir()}
    assert modes["whole.json"] == modes["plain.json"]


@pytest.mark.parametrize("missing", ["a source", "the target's own folder"])
def test_what_kept_a_file_from_being_written_is_named(tmp_path, missing):
    source, target = tmp_path / "source.csv", tmp_path / "page.html"
    if missing != "a source":
        source.write_text("1")
        target = tmp_path / "no folder" / "page.html"
    with pytest.raises(SimulationError) as refused, whole_file(target) as partial:
        partial.write_text(source.read_text())
    assert str(target) in str(refused.value)
    assert (str(source) in str(refused.value)) == (missing == "a source")
    assert ("disk is full" in str(refused.value)) == (missing != "a source")
    assert not target.exists()


@pytest.mark.parametrize("seed", range(12))
def test_a_file_may_have_the_longest_name_that_a_system_allows(tmp_path, seed):
    """Its temporary name, which is longer, may not keep a result from being written."""
    draw = random.Random(seed)
    letters = draw.choice(["n", "nüm", "水ab", "😀"])
    name, most = "", 255 - draw.choice([0, 0, 1, 3, 9, 14]) - len(".nc")
    while len(f"{name}{letters[len(name) % len(letters)]}".encode()) <= most:
        name += letters[len(name) % len(letters)]
    dataset = xr.Dataset({"x": ("s", [1.0, 2.0])})
    write_netcdf(dataset, tmp_path / f"{name}.nc", {})
    write_whole(tmp_path / f"{name}.js", b"{}")
    write_csv(tmp_path / f"{name}.cs", ["a"], [[1]])
    assert {file.name for file in tmp_path.iterdir()} == {f"{name}{end}" for end in (".nc", ".js", ".cs")}
    assert xr.load_dataset(tmp_path / f"{name}.nc", engine="netcdf4")["x"].values.tolist() == [1.0, 2.0]
