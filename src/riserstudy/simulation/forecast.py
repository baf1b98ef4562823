"""What a long run will take, from its first periods run to the same accuracy."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from riserstudy.model.mesh import prescribed
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.long_record import is_long
from riserstudy.simulation.piece import longest_ramp, piece_of
from riserstudy.simulation.refine import Refinement
from riserstudy.simulation.run import single
from riserstudy.simulation.starting_mesh import period
from riserstudy.simulation.time_limit import Watch, size

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts

PERIODS = 12.0  # of a scene after its ramps, which are run first
LONG = 20.0  # times these, from which on a run is worth it
ESTIMATED = 2.0  # times a run on a mesh of the scene: with those that tell its error
BY_PIECE = 1.3  # times the last run of a long record in an irregular sea: with a coarser one, and its piece


class Forecast(NamedTuple):
    """What the whole run will come to."""

    seconds: float
    elements: int
    step: float  # s
    piece: float  # the time that was run (s)
    error: dict[str, float]  # estimated for that


def forecast(scene: Resolved, watch: Watch | None = None) -> Forecast | None:
    """Time that a scene will take, from a piece of it; None where it is short, or lets go of the wellhead.

    Parameters
    ----------
    watch : what looks on; absent: nothing does.

    Raises
    ------
    SimulationError
        When the piece cannot be completed.
    TakesTooLong
        When the watch breaks it off.
    """
    a = scene.analysis
    piece = longest_ramp(scene) + PERIODS * period(scene)
    if a.duration is None or a.output is None or scene.events or a.duration < LONG * piece:
        return None
    if scene.vessel or scene.top.tension_loss:
        return None  # what happens later is another motion than that of the first periods
    facts = _facts(piece_of(scene, piece), watch or Watch())
    times, seconds = a.duration / piece, facts["solve_seconds"]
    if a.mesh is not None:
        times *= ESTIMATED
    elif is_long(scene):
        times, seconds = BY_PIECE * times, facts["refinements"][-1]["solve_seconds"]
    return Forecast(
        times * seconds,
        facts["elements"],
        facts["step"],
        piece,
        facts.get("error_estimate", {}),
    )


def _facts(scene: Resolved, watch: Watch) -> RunFacts:
    """Facts of a run of which the first attempt, which loads kernels, does not count."""
    a = scene.analysis
    if a.mesh is not None:
        mesh = prescribed(scene, a.mesh.elements)
        watch.begin(f"the first periods: {size(len(mesh.l0), a.step)}")
        single(scene, mesh, a.step, watch=watch)
        return single(scene, mesh, a.step, watch=watch).facts
    refinement = Refinement(scene, watch)
    watch.begin(f"the first periods: {size(len(refinement.mesh.l0), refinement.step)}")
    single(scene, refinement.mesh, refinement.step, True, watch)
    return refinement.result().facts
