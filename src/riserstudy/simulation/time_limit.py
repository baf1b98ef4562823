"""Look on while a march is at work: tell how far it is, and break it off when its time is up."""

from __future__ import annotations

import math
import threading
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from riserstudy.solve.record import Record
from riserstudy.solve.sums import Sums

OFTEN = 0.2  # s between two looks
BEGUN = 1e-9  # share that is told of a run that has written no output yet

#: is told what is at work, and what share of it is done
Notify = Callable[[str, float], None]


class Watch:
    """What looks on: a thread beside the march, which is compiled code that asks nobody.

    Parameters
    ----------
    patience : time (s) from now on that all marches together may take.
    notify : is told of each run when it begins, with a share of 0, and then of the share that is done.
    """

    def __init__(self, patience: float = math.inf, notify: Notify | None = None) -> None:
        self.patience, self._notify = patience, notify
        self._started = clock.perf_counter()
        self._title = ""

    @property
    def spent(self) -> float:
        """Time since it was made (s)."""
        return clock.perf_counter() - self._started

    def begin(self, title: str) -> None:
        """Tell what is at work from now on."""
        self._title = title
        if self._notify:
            self._notify(title, 0.0)

    @contextmanager
    def over(self, record: Record, sums: Sums) -> Iterator[None]:
        """Look on while a march writes its outputs into a record, and make it stop when time is up."""
        if self._notify is None and self.patience == math.inf:
            yield
            return
        done = threading.Event()

        def look() -> None:
            while not done.wait(OFTEN):
                if self.spent > self.patience:
                    sums.stop[0] = 1
                elif self._notify:
                    self._notify(self._title, max(BEGUN, share(record)))

        looking = threading.Thread(target=look, daemon=True)
        looking.start()
        try:
            yield
        finally:
            done.set()
            looking.join()


def share(record: Record) -> float:
    """Share of the outputs that is written."""
    return float(record.written[0]) / max(1, len(record.time))


def size(elements: int, step: float | None) -> str:
    """How a run is named: by its mesh and step (s)."""
    return f"{elements} segments" + (f", steps of {step:.3g} s" if step else "")
