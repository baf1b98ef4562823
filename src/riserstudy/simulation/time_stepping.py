"""March through a scene by its implicit method, from one jump of acceleration to the next."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from typing import Any

from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.scene.analysis import Analysis, GeneralisedAlpha, Newmark
from riserstudy.scene.resolve import Resolved
from riserstudy.solve.evaluate import move_to
from riserstudy.solve.implicit import Method, generalised_alpha, march
from riserstudy.solve.newton import Tolerance
from riserstudy.solve.program import Packed
from riserstudy.solve.record import forget
from riserstudy.solve.runge_kutta import TABLEAUS, Stages, march_in_stages
from riserstudy.solve.sums import DONE

RHO_INF = 0.8  # default spectral radius
STIFF = "ESDIRK4"  # default with events: its stages damp the waves that events send along the riser
NEWTON = 1e-9  # default tolerance of a correction of positions, in riser lengths
NEWTON_MOMENT = 3e-4  # the same for moments, as a share of the largest moment
# tolerance of Newton's iteration for moments, as a share of the tolerance of the moment
FAR_BELOW = 0.03
ITERATIONS, HALVINGS = 12, 6  # largest numbers in a time step
GRADED = 4  # time steps that a graded start replaces
MOMENT = 1e-12  # relative distance in time from a jump, to either side of it: more than by ENDED


def steps_in(time: float, step: float) -> int:
    """Number of equal steps over a time (s), none longer than the requested step (s)."""
    return max(1, math.ceil(time / step * (1.0 - 1e-9)))


def march_on(
    scene: Resolved,
    model: Model,
    mesh: Mesh,
    step: float,
    record: Packed,
    sums: Any,
    since: float = 0.0,
    until: float | None = None,
) -> int:
    """March by the scene's implicit method with a time step (s), with a graded restart at every jump.

    The march is from a time to another (s), or to the end. Returns DONE, or the reason why it stopped;
    ``sums`` then has time and node.

    Across a jump of a held node's acceleration, a step longer than the periods of short segments would cause
    spurious moments, which are larger on finer meshes. A time step that the scene prescribes is not changed.
    """
    a = scene.analysis
    end = (a.duration or 0.0) if until is None else until
    jolts = [] if a.step else scene.jolts
    outcome: int = DONE
    for begin, stop in pairwise([since, *(t for t in jolts if since < t < end), end]):
        sudden = begin in jolts
        # from just after a jolt to just before the next
        begin, stop = begin * (1.0 + MOMENT), stop * (1.0 - MOMENT) if stop < end else end
        count = max(GRADED if sudden else 1, steps_in(stop - begin, step))
        move_to(model.programs, model.state, begin)
        forget(record)
        length, graded = (stop - begin) / count, GRADED if sudden else 0
        method, stepped = method_of(scene, mesh, length, count, graded)
        outcome = stepped(model.programs, model.state, model.spare, method, model.fixed, record, sums)
        if outcome != DONE:
            break
        move_to(model.programs, model.state, stop)  # outputs between steps have moved its effects
    return outcome


def method_of(
    scene: Resolved, mesh: Mesh, step: float, count: int, graded: int = 0
) -> tuple[Any, Callable[..., int]]:
    """Parameters of ``count`` steps (s) by the scene's implicit method, and the function that marches."""
    a = scene.analysis
    start, stepped = _method(a.method or (STIFF if scene.events else None))
    share = a.newton_tolerance or NEWTON
    tolerance = Tolerance(share * float(mesh.l0.sum()), _moment_tolerance(a, share))
    return start(step, count, tolerance, ITERATIONS, HALVINGS, graded), stepped


def _moment_tolerance(analysis: Analysis, share: float) -> float:
    """Tolerance of Newton's iteration for moments (1), far below the tolerance of the moment itself."""
    requested = FAR_BELOW * analysis.accuracy if analysis.accuracy else NEWTON_MOMENT
    return min(NEWTON_MOMENT, requested) * min(1.0, share / NEWTON)


def _method(method: Any) -> tuple[Callable[..., Any], Callable[..., int]]:
    """The constructor of a method's parameters, and the function that marches."""
    if isinstance(method, str):
        return partial(Stages, TABLEAUS[method].weights), march_in_stages
    if isinstance(method, Newmark):
        return partial(Method, 0.0, 0.0, method.beta, method.gamma), march
    rho = method.rho_inf if isinstance(method, GeneralisedAlpha) else RHO_INF
    return partial(Method, *generalised_alpha(rho)), march
