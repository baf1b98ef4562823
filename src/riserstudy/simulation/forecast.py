"""What a long run will take, from its first periods run to the same accuracy."""

from __future__ import annotations

from typing import Any, NamedTuple

from riserstudy.model.mesh import prescribed
from riserstudy.scene.models import Scene
from riserstudy.simulation.refine import Refinement
from riserstudy.simulation.run import single
from riserstudy.simulation.starting_mesh import period
from riserstudy.simulation.watch import Watch, size

PERIODS = 12.0  # of a scene after its ramps, which are run first
LONG = 20.0  # times these, from which on a run is worth it
ESTIMATED = 2.0  # times a run on a mesh of the scene: with those that tell its error


class Forecast(NamedTuple):
    """What the whole run will come to."""

    seconds: float
    elements: int
    step: float  # s
    piece: float  # the time that was run (s)
    error: dict[str, float]  # estimated for that


def forecast(scene: Scene, watch: Watch | None = None) -> Forecast | None:
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
    piece = _longest_ramp(scene) + PERIODS * period(scene)
    if a.duration is None or a.output is None or scene.events or a.duration < LONG * piece:
        return None
    if scene.vessel or scene.top.tension_loss:
        return None  # what happens later is another motion than that of the first periods
    facts = _facts(piece_of(scene, piece), watch or Watch())
    times = a.duration / piece * (1.0 if a.mesh is None else ESTIMATED)
    return Forecast(
        times * facts["solve_seconds"],
        facts["elements"],
        facts["step"],
        piece,
        facts.get("error_estimate", {}),
    )


def piece_of(scene: Scene, piece: float) -> Scene:
    """The first piece of a run (s)."""
    a = scene.analysis
    if a.output is None:
        raise TypeError("a scene without time")  # asked before
    output = a.output.model_copy(update={"start": None, "interval": min(a.output.interval, piece)})
    first = a.model_copy(update={"duration": piece, "output": output})
    return scene.model_copy(update={"analysis": first})


def _longest_ramp(scene: Scene) -> float:
    platform = scene.platform
    growing: list[Any] = [
        scene.wave,
        *(motion for _, motion in (platform.harmonics if platform else [])),
    ]
    growing += [platform.response, platform.cruise] if platform else []
    return max(((one.ramp or 0.0) for one in growing if one), default=0.0)


def _facts(scene: Scene, watch: Watch) -> dict[str, Any]:
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
