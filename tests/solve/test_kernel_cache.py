"""Compiled code is used as it was written, or compiled anew."""

import itertools
import os
import random
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from numba import config
from numba.core.caching import IndexDataCacheFile

from riserstudy.folders import PACKAGE
from riserstudy.solve import jit

sys.path.append(str(Path(__file__).parents[1] / "workflow"))
from edits import prose_edit

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


def test_a_cache_that_cannot_be_written_is_read_and_asked_for_nothing_more(cache, tmp_path, monkeypatch):
    """What lies below a file can be made by nobody, not even root."""
    (tmp_path / "file").touch()
    monkeypatch.setattr(jit, "kernel_cache", lambda: tmp_path / "file" / "cache")
    cache.save("another", DATA)
    assert cache.load("another") is None
    assert cache.load("signature") == DATA
    monkeypatch.setattr(config, "CACHE_DIR", str(tmp_path / "file" / "cache"))
    assert jit.KernelLocator.from_function(cache.load, __file__) is not None


TINY = '''
from riserstudy.solve.jit import inner, kernel

STEP = 1.0


@inner
def callee(x):
    return 2.0 * x + STEP


@kernel
def caller(x):
    """Words."""
    if x < 0.0:
        return None
    return callee(x)


def made(up):
    if up:
        @kernel
        def f(x):
            return x + 1.0
    else:
        @kernel
        def f(x):
            return x - 1.0
    return f


def enclosing(number):
    @kernel
    def f(x):
        return callee(x) + number
    return f
'''
CALLS = """
from riserstudy.simulation.compile_times import while_compiling
from riserstudy.solve.tiny import *
said = []
def calls():
    for f in (caller, made(True), made(False), enclosing(0.5), enclosing(-2.5)):
        said.append(f(1.0))
print(len(while_compiling(calls)), *said)
"""


@pytest.fixture
def called(tmp_path):
    """Calls small kernels of a copy of the package: how many were compiled, and what they return."""
    copy = tmp_path / "riserstudy"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    env = os.environ | {"PYTHONPATH": str(tmp_path), "RISERSTUDY_CACHE": str(tmp_path / "cache")}

    seconds = itertools.count(1_700_000_000)

    def call(text):
        # two texts of one size within a second are one to Python's own cache
        (copy / "solve/tiny.py").write_text(text)
        os.utime(copy / "solve/tiny.py", (second := next(seconds), second))
        ran = subprocess.run([sys.executable, "-c", CALLS], env=env, capture_output=True, text=True)
        assert ran.returncode == 0, ran.stderr
        compiled, *results = ran.stdout.split()
        return int(compiled), [float(one) for one in results]

    return call


RETURNED = [3.0, 2.0, 0.0, 3.5, 0.5]


@pytest.mark.long
def test_kernels_are_compiled_once_and_again_when_what_they_do_changes(called):
    assert called(TINY)[0] >= 5
    assert called(TINY) == (0, RETURNED)
    compiled, results = called(TINY.replace("STEP = 1.0", "STEP = 2.0"))
    assert compiled >= 5
    assert results == [4.0, 2.0, 0.0, 4.5, 1.5]


@pytest.mark.long
@pytest.mark.parametrize("seed", range(2))
def test_an_edit_of_prose_compiles_nothing(seed, called):
    """Kernels move within their file, get docstrings and lose them."""
    called(TINY)
    draw, text = random.Random(seed), TINY
    for _ in range(4):
        text = prose_edit(text, draw)[1]
        assert called(text) == (0, RETURNED)
