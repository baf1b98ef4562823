"""Fewer outputs for runs that only serve the error estimate of a finer run."""

from __future__ import annotations

import math

from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.starting_mesh import period
from riserstudy.simulation.vortex_vibration import since

A_PERIOD = 16  # smallest number of outputs in a period
# largest number of time steps between outputs: steps may resolve motion faster than any period
STEPS = 4


def thinned(scene: Resolved, step: float | None) -> tuple[Resolved, bool]:
    """The scene with only every second, fourth, ... output, and whether any output is omitted.

    The factor is a power of two: all remaining outputs are therefore also outputs of any finer run. ``step``
    is in s.
    """
    output = scene.analysis.output
    if output is None or step is None or scene.analysis.solver == "hermite":
        return scene, False
    if scene.fatigue or since(scene) is not None:  # cycles and frequencies require all outputs
        return scene, False
    often = min(period(scene) / A_PERIOD, STEPS * step) / output.interval
    if often < 2.0:
        return scene, False
    interval = output.interval * 2 ** math.floor(math.log2(often))
    analysis = scene.analysis.replaced(output=output.replaced(interval=interval))
    return scene.replaced(analysis=analysis), True
