"""The same riser in Exudyn: planar ANCF cable elements (cubic Hermite), generalised-alpha.

Exudyn has no water. Weight in water, added mass and drag come from one generic object over all nodes,
with consistent shape functions: drag by a user function in Python (three points an element, quadratic in
the normal velocity) with its tangent. One liberty: the added mass acts along x, not along
the moving normal, since a mass that follows the motion would be refilled at every evaluation; with slopes
below 0.03 this is 1e-3 of the axial inertia.
"""

from __future__ import annotations

import math
import time
from importlib import metadata
from itertools import pairwise
from typing import Any

import numpy as np
import scene
from scipy.sparse import csr_matrix

RHO_INF = 0.8
TOLERANCE = 1e-4  # relative, of the residual
LADDER = [
    (6, 0.3, {"tolerance": 1e-3}),
    (10, 0.25, {"tolerance": 1e-3}),
    (14, 0.1, {"tolerance": 1e-3}),
    (18, 0.05, {}),
    (40, 0.1, {}),
    (72, 0.05, {"tolerance": 1e-5}),
    (96, 0.025, {"tolerance": 1e-5}),
]


def available() -> str | None:
    """Why this peer cannot run, or None."""
    try:
        import exudyn  # noqa: F401
    except ImportError as error:
        return f"{type(error).__name__}: {error}"
    return None


class Water:
    """Weight in water, added mass and drag on the coordinates x, z, x', z' of each node.

    Arrays over (element, Gauss point, shape function); an element has eight coordinates, x and z in turn.
    """

    def __init__(self, elements: int) -> None:
        h = scene.LENGTH / elements
        places, weights = np.polynomial.legendre.leggauss(3)
        u = 0.5 * (1.0 + places)[:, None]
        self.value = np.hstack(
            [1 - 3 * u**2 + 2 * u**3, h * (u - 2 * u**2 + u**3), 3 * u**2 - 2 * u**3, h * (u**3 - u**2)]
        )
        self.slope = np.hstack(
            [(6 * u**2 - 6 * u) / h, 1 - 4 * u + 3 * u**2, (6 * u - 6 * u**2) / h, 3 * u**2 - 2 * u]
        )
        weight = 0.5 * weights * h
        self.size = 4 * (elements + 1)
        self.own = 4 * np.arange(elements)[:, None] + np.arange(8)  # coordinates of each element
        self.drag = scene.DRAG * weight
        mass = np.zeros((8, 8))
        mass[::2, ::2] = scene.ADDED_MASS * self.value.T @ (weight[:, None] * self.value)
        self.mass = self.matrix(np.broadcast_to(mass, (elements, 8, 8)))
        self.force = np.bincount(
            self.own[:, 1::2].ravel(), np.tile(-scene.WEIGHT * weight @ self.value, elements)
        )

    def matrix(self, blocks: np.ndarray) -> csr_matrix:
        """Assemble elements' blocks."""
        rows, columns = np.broadcast_arrays(self.own[:, :, None], self.own[:, None, :])
        out = csr_matrix((blocks.ravel(), (rows.ravel(), columns.ravel())), shape=(self.size, self.size))
        out.eliminate_zeros()
        return out

    def motion(self, q: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, ...]:
        """Normal velocity and the normal's components at the points."""
        q, v = np.asarray(q)[self.own], np.asarray(v)[self.own]
        tx, tz = q[:, ::2] @ self.slope.T, 1.0 + q[:, 1::2] @ self.slope.T
        length = np.sqrt(tx * tx + tz * tz)
        nx, nz = tz / length, -tx / length
        return (v[:, ::2] @ self.value.T) * nx + (v[:, 1::2] @ self.value.T) * nz, nx, nz

    def load(self, mbs: Any, t: float, item: int, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Drag."""
        vn, nx, nz = self.motion(q, v)
        f = -self.drag * np.abs(vn) * vn
        blocks = np.empty(self.own.shape)
        blocks[:, ::2], blocks[:, 1::2] = (f * nx) @ self.value, (f * nz) @ self.value
        return np.bincount(self.own.ravel(), blocks.ravel())

    def tangent(
        self, mbs: Any, t: float, item: int, q: np.ndarray, v: np.ndarray, by_q: float, by_v: float
    ) -> Any:
        """The part of drag's tangent that matters: by normal velocity."""
        import exudyn

        vn, nx, nz = self.motion(q, v)
        normal = np.empty((*vn.shape, 8))
        normal[..., ::2], normal[..., 1::2] = nx[..., None] * self.value, nz[..., None] * self.value
        factor = by_v * 2.0 * self.drag * np.abs(vn)
        out = exudyn.MatrixContainer()
        out.SetWithSparseMatrix(self.matrix(np.einsum("eg,egi,egj->eij", factor, normal, normal)))
        return out


def surge(mbs: Any, t: float, number: int, offset: float) -> float:
    """Position of the top."""
    ramp = 0.5 * (1.0 - math.cos(math.pi * t / scene.RAMP)) if t < scene.RAMP else 1.0
    return scene.AMPLITUDE * ramp * math.sin(2.0 * math.pi * t / scene.PERIOD)


def build(
    elements: int, moments: bool, water: Water | None = None, height: float | None = None, moves: bool = True
) -> tuple[Any, list[Any], list[Any], np.ndarray]:
    """The riser at rest; sensors of the nodes' positions and of moments, and where the latter are.

    Moments are taken at two points an element, where a cubic's curvature is best. The top is held at a
    height (m), by default the static one, and moves sideways or not.
    """
    import exudyn
    import exudyn.itemInterface as item

    mbs = exudyn.SystemContainer().AddSystem()
    s = np.linspace(0.0, scene.LENGTH, elements + 1)
    bottom = scene.TOP_TENSION - scene.WEIGHT * scene.LENGTH
    strain = (bottom + scene.WEIGHT * s) / scene.AXIAL_STIFFNESS
    nodes = [
        mbs.AddNode(
            item.NodePoint2DSlope1(
                referenceCoordinates=[0.0, place, 0.0, 1.0], initialCoordinates=[0.0, height - place, 0.0, e]
            )
        )
        for place, height, e in zip(s, scene.static_height(s), strain, strict=True)
    ]
    cables = [
        mbs.AddObject(
            item.ObjectANCFCable2D(
                length=scene.LENGTH / elements,
                massPerLength=scene.MASS,
                bendingStiffness=scene.BENDING_STIFFNESS,
                axialStiffness=scene.AXIAL_STIFFNESS,
                nodeNumbers=[a, b],
                useReducedOrderIntegration=1,
            )
        )
        for a, b in pairwise(nodes)
    ]
    water = water or Water(elements)
    mass = exudyn.MatrixContainer()
    mass.SetWithSparseMatrix(water.mass)
    mbs.AddObject(
        item.ObjectGenericODE2(
            nodeNumbers=nodes,
            massMatrix=mass,
            forceVector=water.force,
            forceUserFunction=water.load,
            jacobianUserFunction=water.tangent,
        )
    )
    still = mbs.AddNode(item.NodePointGround())
    ground = mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=still, coordinate=0))
    stretch = float((height or scene.static_height(scene.LENGTH)) - scene.LENGTH)
    for node, coordinate, how in (
        (nodes[0], 0, {}),
        (nodes[0], 1, {}),
        (nodes[-1], 1, {"offset": stretch}),
        (nodes[-1], 0, {"offsetUserFunction": surge} if moves else {}),
    ):
        marker = mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate))
        mbs.AddObject(item.ObjectConnectorCoordinate(markerNumbers=[ground, marker], **how))
    kind = exudyn.OutputVariableType
    places = 0.5 * (1.0 + np.array([-1.0, 1.0]) / np.sqrt(3.0)) * scene.LENGTH / elements
    position = [
        item.SensorNode(nodeNumber=k, storeInternal=True, outputVariableType=kind.Position) for k in nodes
    ]
    bending = [
        item.SensorBody(
            bodyNumber=k, localPosition=[place, 0, 0], storeInternal=True, outputVariableType=kind.TorqueLocal
        )
        for k in cables
        for place in places
        if moments
    ]
    both = [[mbs.AddSensor(sensor) for sensor in group] for group in (position, bending)]
    mbs.Assemble()
    return mbs, *both, (s[:-1, None] + places).ravel()


def march(mbs: Any, duration: float, step: float, rho_inf: float, tolerance: float) -> float:
    """March a system on one thread by uniform steps (s); the processor time that takes (s)."""
    import exudyn

    settings = exudyn.SimulationSettings()
    integration = settings.timeIntegration
    integration.numberOfSteps = round(duration / step)
    integration.endTime = duration
    integration.generalizedAlpha.spectralRadius = rho_inf
    integration.newton.useModifiedNewton = True
    integration.newton.relativeTolerance = tolerance
    integration.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = 0.5 * step
    settings.linearSolverType = exudyn.LinearSolverType.EigenSparse
    settings.parallel.numberOfThreads = 1
    started = time.process_time()
    mbs.SolveDynamic(settings)
    return time.process_time() - started


def run(
    elements: int, step: float, moments: bool = False, rho_inf: float = RHO_INF, tolerance: float = TOLERANCE
) -> dict[str, Any]:
    """Simulate S2c with uniform elements and steps (s)."""
    mbs, position, bending, inner = build(elements, moments)
    seconds = march(mbs, scene.DURATION, step, rho_inf, tolerance)
    history = [mbs.GetSensorStoredData(k) for k in position]
    nodes = np.linspace(0.0, scene.LENGTH, elements + 1)
    x = np.column_stack([h[:, 1] for h in history]) @ scene.lagrange(nodes, scene.STATIONS).T
    result = {
        "time": scene.TIMES,
        "x": scene.resample(history[0][:, 0], x),
        "seconds": seconds,
        "meta": {
            "scheme": f"generalised-alpha, rho_inf {rho_inf}, tolerance {tolerance}",
            "step": step,
            "version": metadata.version("exudyn"),
            "failed": not (np.abs(x) < scene.BOUND).all(),
        },
    }
    if moments:
        moment = np.column_stack([mbs.GetSensorStoredData(k)[:, 1] for k in bending])
        result["moment_s"] = np.concatenate([[0.0], inner, [scene.LENGTH]])
        result["moment"] = np.pad(moment, [(0, 0), (1, 1)])
    return result
