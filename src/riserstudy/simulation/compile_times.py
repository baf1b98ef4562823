"""What compiling takes, kernel by kernel: numba tells when it begins and ends each signature."""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from typing import Any, NamedTuple

from numba.core import event as events
from numba.core.event import Event, Listener, install_recorder

COMPILE = "numba:compile"
EVERY = 5.0  # s of compiling, after which its progress is reported
Report = Callable[[str, int, float], None]


class _Progress(Listener):  # type: ignore[misc]
    """Reports that compiling begins and, while it lasts, how far it is."""

    def __init__(self) -> None:
        self.under_way = 0  # kernels, each within those that call it
        self.began = 0.0  # s
        self.follow(None)

    def follow(self, report: Report | None) -> None:
        self.report = report
        self.started = False
        self.done = 0  # kernels
        self.spent = self.reported = 0.0  # s

    def on_start(self, event: Event) -> None:
        if self.under_way == 0:
            self.began = clock.perf_counter()
        self.under_way += 1
        self._report(event)

    def on_end(self, event: Event) -> None:
        self.under_way -= 1
        self.done += 1
        self._report(event)
        if self.under_way == 0:
            self.spent += clock.perf_counter() - self.began

    def _report(self, event: Event) -> None:
        if self.report is None:
            return
        spent = self.spent + clock.perf_counter() - self.began
        if not self.started:
            self.started = True
            self.report("", 0, spent)
        elif spent - self.reported >= EVERY:
            self.reported = spent
            self.report(event.data["dispatcher"].py_func.__name__, self.done, spent)


_progress = _Progress()
events.register(COMPILE, _progress)


def follow(report: Report | None) -> None:
    """Report when the first kernel of this process is compiled, and every few seconds of compiling.

    Parameters
    ----------
    report : takes the name of a kernel, empty at the beginning, the number that is compiled, and the time
        that compiling has taken (s). None: nothing is reported.
    """
    _progress.follow(report)


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
