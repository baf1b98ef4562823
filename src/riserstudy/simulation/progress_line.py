"""Show the progress of a run on a terminal; elsewhere, print lines if a run takes long."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Iterator
from contextlib import contextmanager

from riserstudy.simulation.time_limit import Notify

LATE = 5.0  # time (s) after which a run is reported outside of a terminal


@contextmanager
def progress_line(progress: bool) -> Iterator[Notify | None]:
    """A function that receives the progress of runs, and shows it as one changing line.

    It does this on a terminal or in a notebook. Elsewhere, as in a log, it prints a line on stderr for each
    run that takes longer than `LATE`.
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
    """A function that reports progress by lines."""
    started, last = clock.perf_counter(), ""

    def notify(title: str, share: float) -> None:
        nonlocal last
        if (share == 0.0 or title != last) and clock.perf_counter() - started > LATE:
            print(f"riserstudy: {title}", file=sys.stderr, flush=True)
            last = title

    return notify
