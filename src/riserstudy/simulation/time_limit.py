"""Watch a march: report its progress, and interrupt it when its time limit is exceeded."""

from __future__ import annotations

import math
import threading
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from riserstudy.solve.record import Record
from riserstudy.solve.sums import Sums

OFTEN = 0.2  # interval of the checks (s)
BEGUN = 1e-9  # share that is reported for a run without an output so far

#: function that receives the name of the present run, and the share of it that is done
Notify = Callable[[str, float], None]


class Watch:
    """Watches marches by a separate thread, because compiled code does not check the time.

    Parameters
    ----------
    patience : time limit of all marches together (s), from now on.
    notify : function that is called at the begin of each run, with a share of 0, and then with the share
        done.
    """

    def __init__(self, patience: float = math.inf, notify: Notify | None = None) -> None:
        self.patience, self._notify = patience, notify
        self._started = clock.perf_counter()
        self._title = ""

    @property
    def spent(self) -> float:
        """Elapsed time since this object was made (s)."""
        return clock.perf_counter() - self._started

    def begin(self, title: str) -> None:
        """Report the name of the run that begins now."""
        self._title = title
        if self._notify:
            self._notify(title, 0.0)

    @contextmanager
    def over(self, record: Record, sums: Sums) -> Iterator[None]:
        """Watch a march that writes its outputs to a record, and stop it at the time limit."""
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
    """Share of the outputs that have been written."""
    return float(record.written[0]) / max(1, len(record.time))


def size(elements: int, step: float | None) -> str:
    """Name of a run in messages, by its mesh and time step (s)."""
    return f"{elements} segments" + (f", steps of {step:.3g} s" if step else "")
