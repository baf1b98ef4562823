"""Processes that share cores use one thread each for products of matrices."""

import os
import subprocess
import sys

import pytest

from riserstudy.blas import THREADS, use_one_thread
from riserstudy.study.processes import each


@pytest.mark.parametrize("chosen", [{}, {"OPENBLAS_NUM_THREADS": "3"}, {"OMP_NUM_THREADS": "4"}])
def test_one_thread_unless_the_user_chose_otherwise(monkeypatch, chosen):
    for name in (*THREADS, "OMP_NUM_THREADS"):
        monkeypatch.delenv(name, raising=False)
    for name, value in chosen.items():
        monkeypatch.setenv(name, value)
    use_one_thread()
    found = {name: os.environ[name] for name in THREADS if name in os.environ}
    every = {} if "OMP_NUM_THREADS" in chosen else dict.fromkeys(THREADS, "1")
    assert found == every | {name: value for name, value in chosen.items() if name in THREADS}


def _variable(name):
    return os.environ.get(name)


def test_processes_of_a_sweep_use_one_thread_and_leave_their_parent_as_it_is(monkeypatch):
    for name in (*THREADS, "OMP_NUM_THREADS"):
        monkeypatch.delenv(name, raising=False)
    assert list(each(_variable, list(THREADS), 2)) == ["1"] * len(THREADS)
    assert not set(THREADS) & set(os.environ)


@pytest.mark.parametrize("module", ["riserstudy.blas", "riserstudy.cli", "riserstudy.jobs"])
def test_it_is_said_before_numpy_is_there_to_hear_it(module):
    code = f"import sys, {module}; print('numpy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
