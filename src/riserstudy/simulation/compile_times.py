"""What compiling takes, kernel by kernel: numba tells when it begins and ends each signature."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from numba.core import event as events
from numba.core.event import Event, Listener, install_recorder

COMPILE = "numba:compile"


class _First(Listener):  # type: ignore[misc]
    """Does something when a kernel is compiled for the first time."""

    do: Callable[[], None] | None = None

    def on_start(self, event: Event) -> None:
        do, self.do = self.do, None
        if do:
            do()

    def on_end(self, event: Event) -> None:
        pass


_first = _First()
events.register(COMPILE, _first)


def at_first(do: Callable[[], None]) -> None:
    """Do something, and nothing that was to be done, when the next kernel is compiled."""
    _first.do = do


class Compiled(NamedTuple):
    """One signature of one kernel, and the time of its own, without that of kernels it calls (s)."""

    kernel: str
    seconds: float


def while_compiling(work: Callable[[], None]) -> list[Compiled]:
    """Do something, and tell what was compiled on the way, a row a signature."""
    with install_recorder(COMPILE) as recorder:
        work()
    return own_times(recorder.buffer)


def own_times(noted: list[tuple[float, Event]]) -> list[Compiled]:
    """Own time (s) of every compilation, from its begin and end and those nested within."""
    times: list[Compiled] = []
    open_ones: list[list[Any]] = []  # name, begin, time of those within
    for moment, event in noted:
        if event.is_start:
            function = event.data["dispatcher"].py_func
            open_ones.append([f"{function.__module__}.{function.__name__}", moment, 0.0])
        elif open_ones:
            name, begin, within = open_ones.pop()
            times.append(Compiled(name, moment - begin - within))
            if open_ones:
                open_ones[-1][2] += moment - begin
    return times
