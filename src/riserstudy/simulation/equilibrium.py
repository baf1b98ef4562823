"""The static equilibrium from which a run starts."""

from __future__ import annotations

import numpy as np

from riserstudy.errors import PhysicallyUnstable
from riserstudy.model.build import build
from riserstudy.model.layout import stiffness
from riserstudy.model.mesh import Mesh, even
from riserstudy.model.model import Model
from riserstudy.model.platform_motion import centre
from riserstudy.scene.at_rest import at_rest
from riserstudy.scene.forcing import Position
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.continuation import Lost, by_parts, search
from riserstudy.solve.statics import Equilibrium, NoEquilibrium, unstable_directions

BUCKLING = 20  # smallest number of segments for the check of buckling


def settle(scene: Resolved, mesh: Mesh, d: int | None = None) -> tuple[Model, Equilibrium]:
    """Model at static equilibrium, in ``d`` directions if more than the scene needs.

    For a dynamic run, it is the equilibrium at the start of the run; for a static scene, the state at rest.
    Raises SimulationError when no equilibrium is found.
    """
    elevation = _elevation_at_rest(scene, mesh, d)
    return _equilibrium(scene if scene.analysis.duration else at_rest(scene), mesh, elevation, d)


def settle_undeflected(scene: Resolved, mesh: Mesh, d: int) -> Model:
    """Model at static equilibrium without the current, with its top at the same elevation as with it.

    Raises SimulationError when no equilibrium is found.
    """
    elevation = _elevation_at_rest(scene, mesh, d)
    return _equilibrium(scene.replaced(current=None), mesh, elevation, d)[0]


def _elevation_at_rest(scene: Resolved, mesh: Mesh, d: int | None) -> float | None:
    """Elevation of the riser's top (m) where it follows from statics and positions depend on it; else None.

    The platform is at rest and the current has its full speed, however a run itself begins.
    """
    if scene.top.held_at_tension is not None:
        return _elevation_under_tension(at_rest(scene), mesh, d)
    if _turns_about_a_rising_end(scene):
        return _top(_equilibrium(at_rest(scene), mesh, None, d)[0], mesh)
    return None


def _elevation_under_tension(scene: Resolved, mesh: Mesh, d: int | None) -> float:
    """Elevation of the riser's top (m), without the heave and tilt of the platform's position at rest.

    There the riser has the tension ``held_at_tension`` at its top, below a body.
    """
    top = scene.top
    tension = (top.held_at_tension or 0.0) + scene.ring_weight
    pulled = scene.replaced(top=top.replaced(z="free", held_at_tension=None, tension=tension))
    first = _top(_equilibrium(pulled, mesh, None, d)[0], mesh)
    place = scene.platform.position if scene.platform else None
    if place is None:
        return first
    # tilts move the top aside by a lever arm that depends on its elevation
    elevation = _without(place, scene, first)
    return _without(place, scene, _top(_equilibrium(pulled, mesh, elevation, d)[0], mesh))


def _without(place: Position, scene: Resolved, elevation: float) -> float:
    """Elevation of the riser's top (m) without the heave and tilt of the platform's position."""
    if scene.top.z != "platform":
        return elevation
    from scipy.spatial.transform import Rotation  # loaded where it is needed: it takes long

    turn = Rotation.from_euler("xyz", [place.roll or 0.0, place.pitch or 0.0, place.yaw or 0.0]).as_matrix()
    about = centre(scene.platform)
    aside = np.array([scene.top.offset or 0.0, 0.0]) - about[:2]
    up = elevation - (place.heave or 0.0) - about[2]
    return float(about[2] + (up - turn[2, :2] @ aside) / turn[2, 2])


def _top(model: Model, mesh: Mesh) -> float:
    return float(model.s.r[-1, mesh.ring])


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
            f"lowest point would be {-lowest:.4g} m below its lower end; increase the top tension"
        )
    if equilibrium.unstable or not _stands_sideways(scene, mesh, model, elevation):
        raise PhysicallyUnstable(
            "the static equilibrium is unstable, because the riser buckles sideways under its own weight; "
            "increase the top tension, or hold the ends"
        )
    return model, equilibrium


def _stands_sideways(scene: Resolved, mesh: Mesh, model: Model, elevation: float | None) -> bool:
    """Whether an axial model in compression is also stable if it can move laterally."""
    s = model.s
    tension = np.einsum("ke,ke->e", s.segment, s.tangent)
    if len(s.dim) > 1 or float(tension.min()) >= -rounding(scene):
        return True
    top = scene.top if scene.top.x else scene.top.replaced(x="held")
    # one segment cannot buckle; a spring without bending stiffness may carry compression
    bends = all(stiffness(section).bending > 0.0 for section in scene.riser)
    fine = even(scene, BUCKLING) if bends and len(mesh.l0) < BUCKLING else mesh
    planar = build(scene.replaced(top=top), fine, elevation, d=2)
    planar.s.r[1] = np.interp(fine.s, mesh.s, s.r[0])
    return unstable_directions(planar.programs, planar.state, planar.fixed) == 0


def rounding(scene: Resolved) -> float:
    """Largest compression by rounding errors in a weightless riser (N)."""
    return 1e-9 * max(stiffness(section).axial for section in scene.riser)
