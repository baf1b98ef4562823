"""Scene S1 with its top held, in Exudyn: the elements of S2c, Newton's method.

Drag comes from a user function in Python, without its derivative by the shape, which is small.
"""

from __future__ import annotations

import time
from importlib import metadata
from typing import Any

import current
import numpy as np
from scene import LENGTH

from peers import exudyn_s2c
from peers.exudyn_s2c import Water

LADDER = [(n, None, {}) for n in (4, 6, 8, 12, 16, 24, 48)]
available = exudyn_s2c.available


class Flow(Water):
    """Weight in water, and drag in a current."""

    def load(self, mbs: Any, t: float, item: int, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Drag of the water that passes."""
        _, nx, nz = self.motion(q, v)
        h = LENGTH / len(self.own)
        along = h * (np.arange(len(self.own))[:, None] + np.array([-1.0, 0.0, 1.0]) * np.sqrt(0.15) + 0.5)
        z = along + np.asarray(q)[self.own][:, 1::2] @ self.value.T
        passing = current.speed(z) * nx
        f = self.drag * np.abs(passing) * passing
        blocks = np.empty(self.own.shape)
        blocks[:, ::2], blocks[:, 1::2] = (f * nx) @ self.value, (f * nz) @ self.value
        return np.bincount(self.own.ravel(), blocks.ravel())

    def tangent(self, *arguments: Any) -> Any:
        """Nothing: at rest only the shape could change the drag."""
        import exudyn

        out = exudyn.MatrixContainer()
        out.SetWithSparseMatrix(self.matrix(np.zeros((len(self.own), 8, 8))))
        return out


def run(elements: int, step: None) -> dict[str, Any]:
    """The equilibrium on uniform elements."""
    import exudyn

    mbs, position, bending, inner = exudyn_s2c.build(
        elements, True, water=Flow(elements), height=current.HEIGHT, moves=False
    )
    settings = exudyn.SimulationSettings()
    settings.staticSolver.newton.relativeTolerance = 1e-8
    settings.staticSolver.verboseMode = 0
    settings.staticSolver.numberOfLoadSteps = 1
    settings.solutionSettings.writeSolutionToFile = False
    settings.linearSolverType = exudyn.LinearSolverType.EigenSparse
    settings.parallel.numberOfThreads = 1
    started = time.process_time()
    mbs.SolveStatic(settings)
    seconds = time.process_time() - started
    x = np.array([mbs.GetSensorValues(k)[0] for k in position])
    moment = np.array([np.ravel(mbs.GetSensorValues(k))[0] for k in bending])
    return {
        "s": np.linspace(0.0, LENGTH, elements + 1),
        "x": x,
        "moment_s": np.concatenate([[0.0], inner, [LENGTH]]),
        "moment": np.pad(moment, 1),
        "seconds": seconds,
        "meta": {"scheme": "Newton", "step": None, "version": metadata.version("exudyn"), "failed": False},
    }
