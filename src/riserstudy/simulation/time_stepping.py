"""March through a scene by its implicit method, from jolt to jolt."""

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
from riserstudy.solve.program import Frozen
from riserstudy.solve.record import forget
from riserstudy.solve.runge_kutta import TABLEAUS, Stages, march_in_stages
from riserstudy.solve.sums import DONE

RHO_INF = 0.8  # default spectral radius
STIFF = "ESDIRK4"  # default with events: the waves that they send die out in its stages
NEWTON = 1e-9  # default tolerance of a correction of positions, in riser lengths
NEWTON_MOMENT = 3e-4  # the same of moments, as a share of the largest
FAR_BELOW = 0.03  # of the accuracy of a moment is what Newton's iteration may leave of it
ITERATIONS, HALVINGS = 12, 6  # of a step, at most
GRADED = 4  # steps that a graded start replaces
MOMENT = 1e-12  # share of a time, between before and after a jolt: more than ENDED leaves


def steps_in(time: float, step: float) -> int:
    """Number of equal steps over a time (s), none longer than a step (s) asked for."""
    return max(1, math.ceil(time / step * (1.0 - 1e-9)))


def march_on(
    scene: Resolved,
    model: Model,
    mesh: Mesh,
    step: float,
    record: Frozen,
    sums: Any,
    since: float = 0.0,
    until: float | None = None,
) -> int:
    """March by the scene's implicit method, with a step (s), anew from every jolt on, gradually from there.

    From a time to another (s), or to the end. Returns DONE, or why it stopped; the sums then tells where.

    Across a jump of a held node's acceleration a step longer than the periods of short segments would make
    moments that are not there, the larger the finer the mesh. A step that the scene gives is kept.
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
        outcome = stepped(
            model.programs, model.state, model.spare, method, model.fixed, record, sums
        )
        if outcome != DONE:
            break
        move_to(model.programs, model.state, stop)  # outputs between steps have moved its effects
    return outcome


def method_of(
    scene: Resolved, mesh: Mesh, step: float, count: int, graded: int = 0
) -> tuple[Any, Callable[..., int]]:
    """What describes a march of so many steps (s) by the scene's implicit method, and what marches."""
    a = scene.analysis
    start, stepped = _method(a.method or (STIFF if scene.events else None))
    share = a.newton_tolerance or NEWTON
    tolerance = Tolerance(share * float(mesh.l0.sum()), _moment_tolerance(a, share))
    return start(step, count, tolerance, ITERATIONS, HALVINGS, graded), stepped


def _moment_tolerance(analysis: Analysis, share: float) -> float:
    """That of Newton's iteration for moments (1), far below the accuracy of the moment."""
    requested = FAR_BELOW * analysis.accuracy if analysis.accuracy else NEWTON_MOMENT
    return min(NEWTON_MOMENT, requested) * min(1.0, share / NEWTON)


def _method(method: Any) -> tuple[Callable[..., Any], Callable[..., int]]:
    """What describes a run by a method from its step on, and what marches."""
    if isinstance(method, str):
        return partial(Stages, TABLEAUS[method].weights), march_in_stages
    if isinstance(method, Newmark):
        return partial(Method, 0.0, 0.0, method.beta, method.gamma), march
    rho = method.rho_inf if isinstance(method, GeneralisedAlpha) else RHO_INF
    return partial(Method, *generalised_alpha(rho)), march
