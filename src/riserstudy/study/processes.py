"""Run a task for many items in several processes, because threads would wait for each other in Python.

Processes are forks if the system supports them well: a fork has all loaded data, and receives only the number
of an item. Otherwise they start empty, and receive the task and its items, which must be picklable. They end
with the process that started them, however it ends.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context, parent_process
from threading import Thread
from typing import Any, TypeVar

from riserstudy.blas import use_one_thread
from riserstudy.errors import InputError, SimulationError

T = TypeVar("T")
R = TypeVar("R")

AT_ONCE = 20_000  # largest number of submitted items, each of which takes memory

_work: tuple[Callable[[Any], Any], Sequence[Any]]


def forks() -> bool:
    """Whether processes are forks: if available, except on macOS, whose libraries fail in forks."""
    return hasattr(os, "fork") and sys.platform != "darwin"


def check_cores(where: str, cores: int | None) -> None:
    """Check a number of processes; None is the number of cores. Raises InputError if it is below 1."""
    if cores is not None and not (cores >= 1 and cores == int(cores)):
        allowed = "give a whole number from 1, or leave it out to use all cores"
        raise InputError(where, "cores", f"{cores!r} is not a number of cores", allowed)


def each(task: Callable[[T], R], items: Sequence[T], processes: int) -> Iterator[R]:
    """Results of a task for each item, in order.

    ``task``: a function of a module, or a ``partial`` of one; closures are not possible on every system.
    Raises SimulationError when a process is killed.
    """
    count = min(processes, len(items))
    if count <= 1:
        yield from map(task, items)
        return
    method = get_context("fork" if forks() else "spawn")
    with ProcessPoolExecutor(count, method, _begin, (task, items)) as pool:
        try:
            for first in range(0, len(items), AT_ONCE):
                yield from pool.map(_do, range(first, min(first + AT_ONCE, len(items))))
        except BrokenProcessPool:
            raise SimulationError(
                "a process was killed, possibly because the memory is full; "
                "repeat the command, which continues after the completed points"
            ) from None


def _begin(task: Callable[[Any], Any], items: Sequence[Any]) -> None:
    global _work
    _work = task, items
    use_one_thread()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # only the parent process handles an interrupt
    Thread(target=_end_with_parent, daemon=True).start()


def _do(number: int) -> Any:
    task, items = _work
    return task(items[number])


def _end_with_parent() -> None:
    if parent := parent_process():
        parent.join()
    os._exit(1)
