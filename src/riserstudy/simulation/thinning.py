"""Outputs of runs that only tell the error of a finer one: no more often than a comparison needs."""

from __future__ import annotations

import math

from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.starting_mesh import period
from riserstudy.simulation.vibration import since

A_PERIOD = 16  # outputs, at least
STEPS = (
    4  # between outputs, at most: what a step resolves may be quicker than any period of the scene
)


def thinned(scene: Resolved, step: float | None) -> tuple[Resolved, bool]:
    """The scene with every second, fourth, ... output left out, and whether any was.

    Powers of two, so that what is left of one run is among the outputs of any finer one. ``step`` is in s.
    """
    output = scene.analysis.output
    if output is None or step is None or scene.analysis.solver == "hermite":
        return scene, False
    if scene.fatigue or since(scene) is not None:  # cycles and frequencies take all outputs
        return scene, False
    often = min(period(scene) / A_PERIOD, STEPS * step) / output.interval
    if often < 2.0:
        return scene, False
    interval = output.interval * 2 ** math.floor(math.log2(often))
    output = output.model_copy(update={"interval": interval})
    analysis = scene.analysis.model_copy(update={"output": output})
    return scene.model_copy(update={"analysis": analysis}), True
