"""Compile time of each kernel, from numba's events at the begin and the end of each signature."""

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
    """Reports the begin of compiling, and its progress."""

    def __init__(self) -> None:
        self.under_way = 0  # nested kernels that are being compiled
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
    """Report the first kernel that this process compiles, and then every few seconds of compiling.

    ``report``: function of the name of a kernel (empty at the beginning), the number of compiled kernels, and
    the compile time so far (s). None: nothing is reported.
    """
    _progress.follow(report)


class Compiled(NamedTuple):
    """One signature of one kernel, and its compile time without the kernels that it calls (s)."""

    kernel: str
    seconds: float


def while_compiling(work: Callable[[], None]) -> list[Compiled]:
    """Run a function, and return what was compiled meanwhile, one row per signature."""
    with install_recorder(COMPILE) as recorder:
        work()
    return own_times(recorder.buffer)


def own_times(noted: list[tuple[float, Event]]) -> list[Compiled]:
    """Compile time of each signature without nested compilations (s), from begin and end events."""
    times: list[Compiled] = []
    open_ones: list[list[Any]] = []  # name, begin, time of nested compilations
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
