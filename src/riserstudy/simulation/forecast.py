"""Estimated elapsed time of a long run, from its first periods at the same tolerance."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from riserstudy.model.mesh import own_mesh
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.long_record import is_long
from riserstudy.simulation.piece import longest_ramp, piece_of
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.run import single
from riserstudy.simulation.starting_mesh import period
from riserstudy.simulation.time_limit import Watch, size

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts

PERIODS = 12.0  # number of periods after the ramps that are run first
# ratio of durations, whole run to first periods, from which on a forecast is worthwhile
LONG = 20.0
# cost of a run on a prescribed mesh with its error estimate, relative to the run alone
ESTIMATED = 2.0
BY_PIECE = 1.3  # cost of a long record with its coarser run and its piece, relative to its last run


class Forecast(NamedTuple):
    """Estimated time and properties of the whole run."""

    seconds: float
    elements: int
    step: float  # s
    piece: float  # simulated time on which the estimate is based (s)
    error: dict[str, float]  # estimated error for this piece


def forecast(scene: Resolved, watch: Watch | None = None) -> Forecast | None:
    """Estimated time of a run, from its first piece; None if the run is short or has events or a vessel.

    ``watch``: reports progress and interrupts the run; absent: no reports and no time limit. Raises
    SimulationError when the piece cannot be completed. Raises TakesTooLong when the watch interrupts it.
    """
    a = scene.analysis
    piece = longest_ramp(scene) + PERIODS * period(scene)
    if a.duration is None or a.output is None or scene.events or a.duration < LONG * piece:
        return None
    if scene.vessel or scene.top.tension_loss:
        return None  # the later motion differs from the motion of the first periods
    facts = _facts(piece_of(scene, piece), watch or Watch())
    times, seconds = a.duration / piece, facts["solve_seconds"]
    if a.mesh is not None:
        times *= ESTIMATED
    elif is_long(scene):
        times, seconds = BY_PIECE * times, facts["refinements"][-1]["solve_seconds"]
    return Forecast(times * seconds, facts["elements"], facts["step"], piece, facts.get("error_estimate", {}))


def _facts(scene: Resolved, watch: Watch) -> RunFacts:
    """Facts of a run; a previous run, which loads the kernels, is not included in its time."""
    a = scene.analysis
    if mesh := own_mesh(scene):
        watch.begin(f"the first periods: {size(len(mesh.l0), a.step)}")
        single(scene, mesh, a.step, watch=watch)
        return single(scene, mesh, a.step, watch=watch).facts
    refinement = Refinement(scene, watch)
    watch.begin(f"the first periods: {size(len(refinement.mesh.l0), refinement.step)}")
    single(scene, refinement.mesh, refinement.step, True, watch)
    return refinement.result().facts
