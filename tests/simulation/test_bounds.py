"""Kernels read and write inside their arrays: compiled once more, with every index checked."""

import os
import subprocess
import sys

import pytest


@pytest.mark.slow
def test_no_kernel_leaves_its_arrays(tmp_path):
    """Compiled code cannot raise through an entry, so what it would raise is looked for in the output."""
    checked = os.environ | {"NUMBA_BOUNDSCHECK": "1", "RISERSTUDY_CACHE": str(tmp_path)}
    run = subprocess.run(
        [sys.executable, "-c", "from riserstudy.simulation.warm_up import warm_up; warm_up()"],
        env=checked,
        capture_output=True,
        text=True,
        check=False,
    )
    assert "IndexError" not in run.stderr
    assert run.returncode == 0
