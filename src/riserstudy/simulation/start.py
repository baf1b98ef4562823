"""The initial state of a run: at equilibrium, or as ``analysis.start`` states."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.layout import per_segment, stiffness
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.equilibrium import settle_undeflected
from riserstudy.solve.evaluate import move_to


def begin(scene: Resolved, model: Model, mesh: Mesh) -> None:
    """Set a model at equilibrium to the initial state of the scene, at time zero.

    Raises SimulationError when the scene starts from an equilibrium without current that does not exist.
    """
    state = model.s
    if scene.analysis.start == "unstretched":
        state.r[:, : len(mesh.s)] = _unstretched(scene, model, mesh)
    if scene.analysis.start == "undeflected":
        still = settle_undeflected(scene, mesh, len(state.dim))
        state.r[:], state.moment[:] = still.s.r, still.s.moment
    move_to(model.programs, model.state, 0.0)


def _unstretched(scene: Resolved, model: Model, mesh: Mesh) -> NDArray[np.float64]:
    """Positions of the nodes, (d, n + 1), m, if each segment keeps its direction and curvature at rest.

    A hung-off riser keeps the place of its upper end, any other riser that of its lower end.
    """
    s = model.s
    r = s.r[:, : len(mesh.s)]
    tension = np.einsum("ke,ke->e", s.segment, s.tangent)
    flexibility = per_segment(scene, mesh, lambda k: 1.0 / stiffness(scene.riser[k]).axial)
    laid = np.zeros_like(r)
    laid[:, 1:] = np.cumsum(np.diff(r, axis=1) - tension * flexibility * mesh.l0 * s.tangent, axis=1)
    kept = mesh.ring if scene.bottom.hold == "free" else 0
    return np.asarray(laid + (r - laid)[:, [kept]])
