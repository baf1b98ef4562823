"""A task done in several processes."""

import os
import signal
import subprocess
import sys
import time

import psutil
import pytest

from riserstudy.errors import InputError, SimulationError
from riserstudy.study.processes import each

PARENT = """
import time
from riserstudy.study.processes import each
list(each(lambda k: time.sleep(600), range(4), 2))
"""


@pytest.mark.parametrize("processes", [0, 1, 2, 5])
@pytest.mark.parametrize("count", [0, 1, 2, 7])
def test_results_come_in_order_from_so_many_processes(processes, count):
    found = list(each(lambda k: (k * k, os.getpid()), range(count), processes))
    assert [square for square, _ in found] == [k * k for k in range(count)]
    seen = {pid for _, pid in found}
    if processes > 1 and count > 1:
        assert os.getpid() not in seen
        assert len(seen) <= processes
    else:
        assert seen <= {os.getpid()}


@pytest.mark.parametrize("error", [SimulationError("no"), InputError("file", "field", "a", "b")])
def test_errors_come_through(error):
    def fail(k):
        if k == 2:
            raise error

    with pytest.raises(type(error), match=str(error)):
        list(each(fail, range(4), 2))


def test_a_killed_process_is_told():
    def die(k):
        if k == 2:
            os.kill(os.getpid(), signal.SIGKILL)

    with pytest.raises(SimulationError, match="a process was killed"):
        list(each(die, range(4), 2))


def test_processes_end_with_the_one_that_started_them():
    with subprocess.Popen([sys.executable, "-c", PARENT]) as parent:
        of = psutil.Process(parent.pid)
        started = wait_for(lambda: of.children() if len(of.children()) == 2 else [])
        parent.kill()
    assert wait_for(lambda: not any(map(psutil.Process.is_running, started)))


def wait_for(value):
    """The value, as soon as it is there."""
    for _ in range(600):
        if found := value():
            return found
        time.sleep(0.05)
    raise AssertionError
