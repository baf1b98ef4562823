"""The initial state of a run: at equilibrium, or as ``analysis.start`` states."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.bending import flexibility
from riserstudy.model.layout import layout_of
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

    A hung-off riser keeps the place of its upper end, any other riser that of its lower end. A telescopic
    joint slides, so it keeps its length. The chord of a bent segment is shorter than its arc: theory, (1).
    """
    s = model.s
    r = s.r[:, : len(mesh.s)]
    chord = np.diff(r, axis=1)
    length = np.hypot.reduce(chord, axis=0, initial=0.0)  # exact for an upright riser
    low, up = s.moment[:, : len(mesh.l0)], s.moment[:, 1 : len(mesh.s)]
    own = mesh.l0
    if len(s.moment):
        turn = flexibility(layout_of(scene, mesh, None, len(s.dim)))
        own = own * (1.0 - turn**2 / 72.0 * (low * low + low * up + up * up).sum(axis=0))
    own = np.where(mesh.section < len(scene.riser), own, length)
    laid = np.zeros_like(r)
    laid[:, 1:] = np.cumsum(own * (chord / length), axis=1)
    kept = mesh.ring if scene.bottom.hold == "free" else 0
    return np.asarray(laid + (r - laid)[:, [kept]])
