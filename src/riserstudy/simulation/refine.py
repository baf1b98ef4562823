"""Run a scene with its mesh and time step, or at a tolerance, which determines both."""

from __future__ import annotations

import math

from riserstudy.dataset.result import Result
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.long_record import refinement_of
from riserstudy.simulation.prescribed_run import refuse_unseen_periods, run_prescribed
from riserstudy.simulation.rival_modes import warn_of_rivals
from riserstudy.simulation.time_limit import Notify, Watch
from riserstudy.simulation.tolerance import add_error_of_outputs, check_error


def run(
    scene: Resolved, patience: float = math.inf, estimated: bool = True, notify: Notify | None = None
) -> Result:
    """Simulate a scene.

    If the scene has a mesh and a time step, they are used, and four coarser runs, with step and mesh doubled
    one at a time, give the estimated error. Otherwise, the one of mesh and step with the larger error is
    halved until the estimated error of displacement, tension and moment is below the tolerance. Raises
    SimulationError when no equilibrium is found or a step fails: time, node, effect and remedy. Raises
    PhysicallyUnstable when a string without bending stiffness buckles, for which finer runs do not converge.
    Raises TakesTooLong when the time limit ends before the first run, or before the run on a prescribed mesh.

    Parameters
    ----------
    patience : time limit (s), after which the finest completed run is the result; its fact ``ended_by`` and a
        warning state this. A run that would not end in time is not begun; a run that exceeds it is
        interrupted.
    estimated : whether the error of a run with mesh and step in the scene is estimated, which doubles the
        time.
    notify : function that receives the name of the present run, and the share of it that is done.
    """
    refuse_unseen_periods(scene)
    watch = Watch(patience, notify)
    result = (
        refinement_of(scene, watch).result()
        if scene.analysis.mesh is None
        else run_prescribed(scene, estimated, watch)
    )
    result.facts["wall_seconds"] = watch.spent
    if scene.fatigue:
        add_error_of_outputs(result)
    check_error(result, scene)
    warn_of_rivals(scene, result.facts)
    return result
