"""Show on a terminal what a run is at; elsewhere say it once it takes long."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Iterator
from contextlib import contextmanager

from riserstudy.simulation.time_limit import Notify

LATE = 5.0  # s, after which runs are told of where nobody looks on


@contextmanager
def progress_line(progress: bool) -> Iterator[Notify | None]:
    """What is told of runs, and shows it: on a terminal or in a notebook as one line that changes.

    Elsewhere, as in a log, each run that is at work after a while gets a line of its own on stderr.
    """
    if not progress:
        yield None
        return
    from rich.console import Console

    console = Console(file=sys.stderr)
    if not (console.is_terminal or console.is_jupyter):
        yield _lines()
        return
    with console.status("") as status:
        yield lambda title, share: status.update(
            f"{title}" + (f" ({100 * share:.0f} %)" if share > 0.0 else "")
        )


def _lines() -> Notify:
    """Tell by lines."""
    started, last = clock.perf_counter(), ""

    def notify(title: str, share: float) -> None:
        nonlocal last
        if (share == 0.0 or title != last) and clock.perf_counter() - started > LATE:
            print(f"riserstudy: {title}", file=sys.stderr, flush=True)
            last = title

    return notify
