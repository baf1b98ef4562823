"""The same riser in OpenSeesPy: corotational elastic beams, implicit steps.

OpenSees has no water. The nearest it offers:

- Drag: at each node a zero-length ``Viscous`` damper of exponent two, along x instead of the normal and
  on the horizontal instead of the normal velocity (slopes stay below 0.03, so 1e-3 of the drag).
- Added mass: nodal masses, larger along x than along z; as for drag, x stands for the normal.
- Weight in water: nodal loads.

Tried and slower at equal error: consistent mass, modified and accelerated Newton (a third faster, moments
three times worse), HHT, TRBDF2, sparse solvers. GeneralizedAlpha did not converge.
"""

from __future__ import annotations

import time
from importlib import metadata
from typing import Any

import numpy as np
import scene

TOLERANCE = 1.0  # J, of a step's energy increment
LADDER = [
    (20, 0.25, {}),
    (48, 0.15, {}),
    (115, 0.075, {}),
    (115, 0.05, {"tolerance": 0.1}),
    (220, 0.025, {"tolerance": 0.01}),
]


def available() -> str | None:
    """Why this peer cannot run, or None."""
    try:
        import openseespy.opensees  # noqa: F401
    except (ImportError, RuntimeError) as error:
        first: BaseException = error
        while first.__context__:  # the package hides the reason under two messages of its own
            first = first.__context__
        return f"{type(first).__name__}: {first}"
    return None


def build(elements: int) -> None:
    """The riser at rest: its top pulled to the static height, then held."""
    import openseespy.opensees as ops

    h = scene.LENGTH / elements
    top = elements + 1
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Corotational", 1)
    ops.uniaxialMaterial("Viscous", 1, scene.DRAG * h, 2.0)
    for i in range(1, top + 1):
        ops.node(i, 0.0, (i - 1) * h)
    for i in range(1, top):
        ops.element("elasticBeamColumn", i, i, i + 1, scene.AXIAL_STIFFNESS, 1.0, scene.BENDING_STIFFNESS, 1)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for i in range(2, top):
        ops.mass(i, (scene.MASS + scene.ADDED_MASS) * h, scene.MASS * h, 0.0)
        ops.load(i, 0.0, -scene.WEIGHT * h, 0.0)
        ground = top + i
        ops.node(ground, 0.0, (i - 1) * h)
        ops.fix(ground, 1, 1, 1)
        ops.element("zeroLength", ground, ground, i, "-mat", 1, "-dir", 1)
    ops.fix(1, 1, 1, 0)
    ops.sp(top, 2, scene.static_height(scene.LENGTH) - scene.LENGTH)
    ops.sp(top, 1, 0.0)
    solver("NormUnbalance", 1e-3)
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    if ops.analyze(1):
        raise RuntimeError("OpenSees: no static equilibrium")
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    ops.remove("sp", top, 1)


def solver(test: str, tolerance: float) -> None:
    """Full Newton on a banded matrix."""
    import openseespy.opensees as ops

    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test(test, tolerance, 20)
    ops.algorithm("Newton")


def run(elements: int, step: float, moments: bool = False, tolerance: float = TOLERANCE) -> dict[str, Any]:
    """Simulate S2c with uniform elements and steps (s) by Newmark's average acceleration."""
    import openseespy.opensees as ops

    build(elements)
    steps = round(scene.DURATION / step)
    times = step * np.arange(steps + 1)
    surge = scene.top_motion(times)[0].tolist()
    ops.timeSeries("Path", 2, "-dt", step, "-values", *surge, "-useLast")
    ops.pattern("Plain", 2, 2)
    ops.sp(elements + 1, 1, 1.0)
    solver("EnergyIncr", tolerance)
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    x = np.zeros((steps + 1, elements + 1))
    moment = np.zeros_like(x)
    started = time.process_time()
    for i in range(1, steps + 1):
        if ops.analyze(1, step):
            raise RuntimeError(f"OpenSees: no convergence at t = {times[i]:.2f} s")
        x[i] = [ops.nodeDisp(j, 1) for j in range(1, elements + 2)]
        if moments:
            moment[i, 1:] = [ops.eleResponse(j, "localForce")[5] for j in range(1, elements + 1)]
    seconds = time.process_time() - started
    ops.wipe()
    nodes = np.linspace(0.0, scene.LENGTH, elements + 1)
    x = x @ scene.lagrange(nodes, scene.STATIONS).T
    result = {
        "time": scene.TIMES,
        "x": scene.resample(times, x),
        "seconds": seconds,
        "meta": {
            "scheme": f"Newmark, tolerance {tolerance} J",
            "step": step,
            "version": metadata.version("openseespy"),
            "failed": not (np.abs(x) < scene.BOUND).all(),
        },
    }
    if moments:
        result |= {"moment": moment, "moment_s": nodes}
    return result
