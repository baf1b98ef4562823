"""Scene S3 in Exudyn: planar ANCF cable elements, generalised-alpha.

The end's mass, weight and drag are one generic object on the lowest node, drag by a user function in Python
with its tangent; the tension at the top is the force of the constraint that moves it.
"""

from __future__ import annotations

import math
from importlib import metadata
from itertools import pairwise
from typing import Any

import heave
import numpy as np
from scipy.interpolate import CubicSpline

from peers import exudyn_s2c

RHO_INF = 0.8
TOLERANCE = 1e-6  # relative, of the residual
LADDER = [(2, 0.4, {}), (4, 0.2, {}), (8, 0.1, {}), (8, 0.05, {}), (16, 0.025, {}), (16, 0.0125, {})]
available = exudyn_s2c.available


def drag(mbs: Any, t: float, item: int, q: Any, v: Any) -> list[float]:
    """Drag on the end, along z; the coordinates are x, z and their slopes."""
    return [0.0, -heave.DRAG * abs(v[1]) * v[1], 0.0, 0.0]


def tangent(mbs: Any, t: float, item: int, q: Any, v: Any, by_q: float, by_v: float) -> list[list[float]]:
    """What Exudyn adds to its tangent for the drag."""
    out = np.zeros((4, 4))
    out[1, 1] = by_v * 2.0 * heave.DRAG * abs(v[1])
    return out


def moved(mbs: Any, t: float, number: int, offset: float) -> float:
    """Place of the top from where it would be unstretched."""
    ramp = 0.5 * (1.0 - math.cos(math.pi * t / heave.RAMP)) if t < heave.RAMP else 1.0
    return offset + heave.AMPLITUDE * ramp * math.sin(2.0 * math.pi * t / heave.PERIOD)


def build(elements: int) -> tuple[Any, Any, Any]:
    """The pipe at rest; sensors of the lower end and of the force that moves the top."""
    import exudyn
    import exudyn.itemInterface as item

    mbs = exudyn.SystemContainer().AddSystem()
    s = np.linspace(0.0, heave.LENGTH, elements + 1)
    nodes = [
        mbs.AddNode(
            item.NodePoint2DSlope1(
                referenceCoordinates=[0.0, place, 0.0, 1.0],
                initialCoordinates=[0.0, longer, 0.0, pull / heave.AXIAL_STIFFNESS],
            )
        )
        for place, longer, pull in zip(s, heave.stretch(s), heave.tension(s), strict=True)
    ]
    for pair in pairwise(nodes):
        cable = mbs.AddObject(
            item.ObjectANCFCable2D(
                length=heave.LENGTH / elements,
                massPerLength=heave.MASS,
                bendingStiffness=2.7e8,
                axialStiffness=heave.AXIAL_STIFFNESS,
                nodeNumbers=list(pair),
                useReducedOrderIntegration=1,
            )
        )
        marker = mbs.AddMarker(item.MarkerBodyMass(bodyNumber=cable))
        pull = [0.0, -heave.WEIGHT / heave.MASS, 0.0]
        mbs.AddLoad(item.LoadMassProportional(markerNumber=marker, loadVector=pull))
    mbs.AddObject(
        item.ObjectGenericODE2(
            nodeNumbers=[nodes[0]],
            massMatrix=np.diag([heave.END_MASS, heave.END_MASS, 0.0, 0.0]),
            forceVector=[0.0, -heave.END_WEIGHT, 0.0, 0.0],
            forceUserFunction=drag,
            jacobianUserFunction=tangent,
        )
    )
    still = mbs.AddNode(item.NodePointGround())
    ground = mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=still, coordinate=0))
    joints = []
    for coordinate, how in (
        (0, {}),
        (1, {"offset": float(heave.stretch(heave.LENGTH)), "offsetUserFunction": moved}),
    ):
        marker = mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=nodes[-1], coordinate=coordinate))
        joints.append(mbs.AddObject(item.ObjectConnectorCoordinate(markerNumbers=[ground, marker], **how)))
    kind = exudyn.OutputVariableType
    lower = mbs.AddSensor(
        item.SensorNode(nodeNumber=nodes[0], storeInternal=True, outputVariableType=kind.Position)
    )
    force = mbs.AddSensor(
        item.SensorObject(objectNumber=joints[1], storeInternal=True, outputVariableType=kind.Force)
    )
    mbs.Assemble()
    return mbs, lower, force


def run(elements: int, step: float, rho_inf: float = RHO_INF, tolerance: float = TOLERANCE) -> dict[str, Any]:
    """Simulate S3 with uniform elements and steps (s)."""
    mbs, lower, force = build(elements)
    seconds = exudyn_s2c.march(mbs, heave.DURATION, step, rho_inf, tolerance)
    end, pull = mbs.GetSensorStoredData(lower), mbs.GetSensorStoredData(force)
    bottom = CubicSpline(end[:, 0], end[:, 2])(heave.TIMES)
    bottom -= bottom[0]
    # The reaction at rest is not yet solved for where the history begins.
    top = CubicSpline(pull[1:, 0], np.abs(pull[1:, 1]))(heave.TIMES)
    return {
        "bottom": bottom,
        "top_tension": np.where(pull[1, 0] > heave.TIMES, heave.STATIC_TOP, top),
        "seconds": seconds,
        "meta": {
            "scheme": f"generalised-alpha, rho_inf {rho_inf}, tolerance {tolerance}",
            "step": step,
            "version": metadata.version("exudyn"),
            "failed": not (np.abs(bottom) < heave.BOUND).all(),
        },
    }
