"""Scene S1 with its top held, in OpenSeesPy: the beams of S2c, Newton's method.

OpenSees has no water: drag comes as nodal loads, taken anew from the shape that they gave, three times.
"""

from __future__ import annotations

import time
from importlib import metadata
from typing import Any

import current
import numpy as np
from scene import AXIAL_STIFFNESS, BENDING_STIFFNESS, DRAG, LENGTH, WEIGHT

from peers import openseespy_s2c
from peers.openseespy_s2c import solver

PASSES = 3
LADDER = [(n, None, {}) for n in (12, 20, 32, 48, 100, 200)]
available = openseespy_s2c.available


def run(elements: int, step: None) -> dict[str, Any]:
    """The equilibrium on uniform elements."""
    import openseespy.opensees as ops

    h = LENGTH / elements
    s = np.linspace(0.0, LENGTH, elements + 1)
    top = elements + 1
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Corotational", 1)
    for i in range(1, top + 1):
        ops.node(i, 0.0, (i - 1) * h)
    for i in range(1, top):
        ops.element("elasticBeamColumn", i, i, i + 1, AXIAL_STIFFNESS, 1.0, BENDING_STIFFNESS, 1)
    ops.fix(1, 1, 1, 0)
    ops.fix(top, 1, 0, 0)
    ops.timeSeries("Constant", 1)
    x, z = np.zeros(top), s * current.HEIGHT / LENGTH
    started = time.process_time()
    solver("NormDispIncr", 1e-9)
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    for count in range(PASSES):
        tx, tz = np.gradient(x), np.gradient(z)
        length = np.hypot(tx, tz)
        passing = current.speed(z) * tz / length
        force = DRAG * h * np.abs(passing) * passing / length
        if count:
            ops.remove("loadPattern", 1)
        ops.pattern("Plain", 1, 1)
        ops.sp(top, 2, current.HEIGHT - LENGTH)
        for i in range(2, top):
            ops.load(i, force[i - 1] * tz[i - 1], -force[i - 1] * tx[i - 1] - WEIGHT * h, 0.0)
        if ops.analyze(1):
            raise RuntimeError("OpenSees: no static equilibrium")
        x = np.array([ops.nodeDisp(i, 1) for i in range(1, top + 1)])
        z = s + np.array([ops.nodeDisp(i, 2) for i in range(1, top + 1)])
    seconds = time.process_time() - started
    moment = np.array([0.0, *(ops.eleResponse(i, "localForce")[5] for i in range(1, top))])
    ops.wipe()
    return {
        "s": s,
        "x": x,
        "moment_s": s,
        "moment": moment,
        "seconds": seconds,
        "meta": {
            "scheme": f"Newton, {PASSES} passes",
            "step": None,
            "version": metadata.version("openseespy"),
            "failed": False,
        },
    }
