"""Number of finished points of a job: a line in its log, which the progress of the run reads again."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import NamedTuple, Self

OFTEN = 0.5  # s between two lines
TAIL = 4096  # bytes at the end of a log in which the last line about points is looked for


class PointsDone(NamedTuple):
    """Number of finished points, and of all points."""

    done: int
    total: int

    def __str__(self) -> str:
        """The line in the log."""
        return f"{self.done} of {self.total} points"

    @classmethod
    def from_line(cls, line: str) -> Self | None:
        """The numbers in a line of a log; None in any other line."""
        numbers = [int(word) for word in line.split() if word.isascii() and word.isdecimal()]
        found = cls(*numbers) if len(numbers) == 2 else None
        return found if found is not None and str(found) == line else None


class ShowPoints:
    """Prints the number of finished points, not more often than anybody looks."""

    def __init__(self) -> None:
        self._last_notice = 0.0

    def __call__(self, done: int, total: int) -> None:
        """Print how many are done, of how many."""
        now = time.monotonic()
        if done == total or now - self._last_notice > OFTEN:
            self._last_notice = now
            print(PointsDone(done, total), flush=True)


def last_points(log: Path) -> PointsDone | None:
    """The last numbers in a log, whatever lines follow; None without any near its end."""
    try:
        with log.open("rb") as stream:
            size = stream.seek(0, os.SEEK_END)
            stream.seek(max(0, size - TAIL - 1))
            # the first line is cut if the log is longer; the last is not whole while it is written
            lines = stream.read().split(b"\n")[int(size > TAIL + 1) : -1]
    except OSError:
        return None
    found = (PointsDone.from_line(line.decode(errors="replace")) for line in reversed(lines))
    return next((points for points in found if points is not None), None)
