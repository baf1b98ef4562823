"""The static equilibrium from which a run starts."""

from __future__ import annotations

import numpy as np

from riserstudy.errors import PhysicallyUnstable
from riserstudy.model.build import build
from riserstudy.model.layout import stiffness
from riserstudy.model.mesh import Mesh, even
from riserstudy.model.model import Model
from riserstudy.scene.at_rest import at_rest
from riserstudy.scene.ends import Top
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.continuation import Lost, by_parts, search
from riserstudy.solve.statics import Equilibrium, NoEquilibrium, unstable_directions

BUCKLING = 20  # smallest number of segments for the check of buckling


def settle(scene: Resolved, mesh: Mesh, d: int | None = None) -> tuple[Model, Equilibrium]:
    """Model at static equilibrium, in ``d`` directions if more than the scene needs.

    For a dynamic run, it is the equilibrium at the start of the run; for a static scene, the state at rest.
    Raises SimulationError when no equilibrium is found.
    """
    scene = scene if scene.analysis.duration else at_rest(scene)
    top = scene.top
    elevation = None
    before = None
    if top.held_at_tension is not None:
        free = Top(x=top.x, z="free", rotation=top.rotation)
        checked = {"offset": top.offset, "tension": top.held_at_tension, "body": top.body}
        before = free.model_copy(update=checked)
    elif _turns_about_a_rising_end(scene):
        before = top
    if before is not None:
        first, _ = _equilibrium(scene.model_copy(update={"top": before}), mesh, None, d)
        elevation = float(first.s.r[-1, mesh.ring])
    return _equilibrium(scene, mesh, elevation, d)


def _turns_about_a_rising_end(scene: Resolved) -> bool:
    """Whether a tilt of the platform moves the top by a lever arm that depends on the static elevation."""
    turning = scene.platform is not None and scene.platform.centre_of_rotation is not None
    return turning and scene.top.x in ("platform", "vessel") and scene.top.z == "free"


def _equilibrium(
    scene: Resolved, mesh: Mesh, elevation: float | None, d: int | None
) -> tuple[Model, Equilibrium]:
    model = build(scene, mesh, elevation, d)
    try:
        equilibrium = search(model, mesh)
    except NoEquilibrium as failure:
        model, equilibrium = by_parts(scene, mesh, elevation, Lost(model, failure))
    elevations = model.s.r[-1, : len(mesh.s)]
    lowest = float(elevations.min() - elevations[0])
    if scene.top.z == "free" and lowest < -1e-3 * float(mesh.l0.sum()):
        raise PhysicallyUnstable(
            "the riser falls over, because the top tension does not carry its weight: in equilibrium, its "
            f"lowest point would be {-lowest:.4g} m below its lower end"
        )
    if equilibrium.unstable or not _stands_sideways(scene, mesh, model, elevation):
        raise PhysicallyUnstable(
            "the static equilibrium is unstable when the riser can move sideways: "
            "it buckles under its own weight; raise the top tension or hold the ends"
        )
    return model, equilibrium


def _stands_sideways(scene: Resolved, mesh: Mesh, model: Model, elevation: float | None) -> bool:
    """Whether an axial model in compression is also stable if it can move laterally."""
    s = model.s
    tension = np.einsum("ke,ke->e", s.segment, s.tangent)
    if len(s.dim) > 1 or float(tension.min()) >= -rounding(scene):
        return True
    top = scene.top if scene.top.x else scene.top.model_copy(update={"x": "held"})
    # one segment cannot buckle; a spring without bending stiffness may carry compression
    bends = all(stiffness(section).bending > 0.0 for section in scene.riser)
    fine = even(scene, BUCKLING) if bends and len(mesh.l0) < BUCKLING else mesh
    planar = build(scene.model_copy(update={"top": top}), fine, elevation, d=2)
    planar.s.r[1] = np.interp(fine.s, mesh.s, s.r[0])
    return unstable_directions(planar.programs, planar.state, planar.fixed) == 0


def rounding(scene: Resolved) -> float:
    """Largest compression by rounding errors in a weightless riser (N)."""
    return 1e-9 * max(stiffness(section).axial for section in scene.riser)
