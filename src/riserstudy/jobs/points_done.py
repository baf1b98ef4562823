"""Tell in the log of a job how many of its points are done: what runs the study reads it there."""

from __future__ import annotations

import time

OFTEN = 0.5  # s between two lines


class PointsDone:
    """Prints ``12 of 40 points``, not more often than anybody looks."""

    def __init__(self) -> None:
        self._last_notice = 0.0

    def __call__(self, done: int, total: int) -> None:
        """Print how many are done, of how many."""
        now = time.monotonic()
        if done == total or now - self._last_notice > OFTEN:
            self._last_notice = now
            print(f"{done} of {total} points", flush=True)
