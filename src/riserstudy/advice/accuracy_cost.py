"""Cost of accuracy of one scene: mesh, step, error and time at several requested accuracies."""

from __future__ import annotations

import time as clock
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from riserstudy.errors import TakesTooLong
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.error_estimate import deciding
from riserstudy.simulation.forecast import forecast
from riserstudy.simulation.progress_line import progress_line
from riserstudy.simulation.refine import run
from riserstudy.simulation.simulate import at_accuracy
from riserstudy.simulation.time_limit import Notify, Watch

#: requested relative errors, the cheapest first; None: the default of a scene without a request
REQUESTS = (0.05, 0.01, None, 0.002, 0.0005)
OF_ACCURACY = ("analysis.mesh", "analysis.step", "analysis.accuracy")  # absent by default
SLOWEST = 60.0  # (s) after a request that took longer, no further one is run
PATIENCE = 600.0  # (s) after which a request is stopped


class Price(NamedTuple):
    """Result of one requested accuracy."""

    requested: float | None  # None: the default, which has an error for each quantity
    estimated: float  # largest of moment, or of tension and displacement
    elements: int
    step: float | None  # (s)
    seconds: float  # of all refinements, with compiled kernels; of a long run a forecast
    forecast: bool  # from its first periods


def prices(file: SceneFile, progress: bool = False) -> Iterator[Price]:
    """Run a scene at finer and finer accuracies; the first run, which may compile kernels, is not timed.

    Of a long scene only the first periods are run, and their time is extrapolated. ``progress``: show on a
    terminal which run is at work; elsewhere print it once a run takes long. Raises SimulationError when a run
    cannot be completed. Raises TakesTooLong when a run does not end within ``PATIENCE``.
    """
    for share in REQUESTS:
        with progress_line(progress) as notify:
            price = _price(requesting(file, share), share, notify, share == REQUESTS[0])
        yield price
        if price.seconds > SLOWEST and not price.forecast:
            return


def _price(scene: Resolved, share: float | None, notify: Notify | None, first: bool) -> Price:
    """Return the result of one requested accuracy."""
    if price := forecast(scene, Watch(PATIENCE, notify)):
        error = deciding(price.error)
        return Price(share, error, price.elements, price.step, price.seconds, True)
    if first:
        run(scene, PATIENCE, notify=notify)
    started = clock.perf_counter()
    facts = run(scene, PATIENCE, notify=notify).facts
    if "ended_by" in facts:
        raise TakesTooLong(
            f"no run meets the tolerance ({_requested(share)}) within {PATIENCE:g} s; give a shorter "
            "analysis.duration"
        )
    seconds = clock.perf_counter() - started
    estimated = deciding(facts.get("error_estimate", {}))
    return Price(share, estimated, facts["elements"], facts.get("step"), seconds, False)


def requesting(file: SceneFile, share: float | None) -> Resolved:
    """Return the scene with a requested relative error (1) in place of mesh and step; None: the default."""
    if share is not None:
        return at_accuracy(file, f"{100 * share!r} %").resolved()
    return file.with_values(dict.fromkeys(OF_ACCURACY), "default").resolved()


def _requested(share: float | None) -> str:
    """Return a requested accuracy as a label."""
    return "default" if share is None else f"{100 * share:g} %"


def plot(found: list[Price], title: str, target: Path) -> None:
    """Draw error and time over the requested accuracy."""
    from matplotlib.figure import Figure
    from matplotlib.ticker import NullFormatter

    from riserstudy.figures import save

    figure = Figure((6.0, 3.8), dpi=150, layout="constrained")
    ax = figure.add_subplot()
    ax.loglog([p.seconds for p in found], [p.estimated for p in found], "o-", ms=5)
    for p in found:
        ax.annotate(
            f"  {_requested(p.requested)}: {p.elements} segments", (p.seconds, p.estimated), fontsize=8
        )
    ax.set_xlabel("elapsed time of a run with all refinements (s)")
    ax.set_ylabel("estimated error (-)")
    ax.set_title(title, fontsize="medium")
    ax.margins(x=0.4)
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.grid(alpha=0.3)
    save(figure, target)
