"""Scene S3 in OpenSeesPy: trusses along one axis, implicit steps, about the state at rest.

The springs are linear, so that weight only adds the tension at rest. Drag on the end is a zero-length
``Viscous`` damper of exponent two.
"""

from __future__ import annotations

import time
from importlib import metadata
from typing import Any

import heave
import numpy as np
from scipy.interpolate import CubicSpline

from peers import openseespy_s2c
from peers.openseespy_s2c import solver

TOLERANCE = 1e-2  # J, of a step's energy increment
LADDER = [(8, 0.2, {}), (16, 0.1, {}), (32, 0.05, {}), (64, 0.025, {}), (128, 0.0125, {})]
available = openseespy_s2c.available


def build(elements: int) -> None:
    """The pipe at rest, free of weight."""
    import openseespy.opensees as ops

    h = heave.LENGTH / elements
    top = elements + 1
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.uniaxialMaterial("Elastic", 1, heave.AXIAL_STIFFNESS)
    ops.uniaxialMaterial("Viscous", 2, heave.DRAG, 2.0)
    for i in range(1, top + 1):
        ops.node(i, (i - 1) * h)
        share = 0.5 if i in (1, top) else 1.0
        ops.mass(i, share * heave.MASS * h + (heave.END_MASS if i == 1 else 0.0))
    for i in range(1, top):
        ops.element("Truss", i, i, i + 1, 1.0, 1)
    ops.node(top + 1, 0.0)
    ops.fix(top + 1, 1)
    ops.element("zeroLength", top, top + 1, 1, "-mat", 2, "-dir", 1)


def run(elements: int, step: float, tolerance: float = TOLERANCE) -> dict[str, Any]:
    """Simulate S3 with uniform elements and steps (s) by Newmark's average acceleration."""
    import openseespy.opensees as ops

    build(elements)
    top = elements + 1
    steps = round(heave.DURATION / step)
    times = step * np.arange(steps + 1)
    moved = heave.top_motion(times)
    ops.timeSeries("Path", 1, "-dt", step, "-values", *moved[0].tolist(), "-useLast")
    ops.pattern("Plain", 1, 1)
    ops.sp(top, 1, 1.0)
    solver("EnergyIncr", tolerance)
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    bottom, pull = np.zeros(steps + 1), np.zeros(steps + 1)
    started = time.process_time()
    for i in range(1, steps + 1):
        if ops.analyze(1, step):
            raise RuntimeError(f"OpenSees: no convergence at t = {times[i]:.2f} s")
        bottom[i] = ops.nodeDisp(1, 1)
        pull[i] = ops.basicForce(elements)[0]
    seconds = time.process_time() - started
    ops.wipe()
    pull += heave.STATIC_TOP + 0.5 * heave.MASS * heave.LENGTH / elements * moved[2]
    bottom = CubicSpline(times, bottom)(heave.TIMES)
    return {
        "bottom": bottom,
        "top_tension": CubicSpline(times, pull)(heave.TIMES),
        "seconds": seconds,
        "meta": {
            "scheme": f"Newmark, tolerance {tolerance} J",
            "step": step,
            "version": metadata.version("openseespy"),
            "failed": not (np.abs(bottom) < heave.BOUND).all(),
        },
    }
