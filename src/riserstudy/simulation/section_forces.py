"""Forces within the riser that nodes do not hold themselves: shear, and tension at its lower end."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.mesh import Mesh
from riserstudy.scene.limit_inputs import wall_lacks
from riserstudy.scene.models import Scene
from riserstudy.simulation.curve import curve_of
from riserstudy.simulation.wall_stress import along_the_riser

FloatArray = NDArray[np.float64]
Arrays = dict[str, FloatArray]


def riser_foot(scene: Scene, mesh: Mesh) -> int:
    """The riser's lowest node: that of its inner flex joint, or its lower end."""
    return mesh.foot(scene.lowest_riser_section)


def shear(arrays: Arrays, moment: FloatArray) -> FloatArray:
    """Shear force (N) at the nodes, (..., n + 1), from the slope of the moment (N m), (..., n + 1).

    Where it jumps, at joints and where sections meet, it is that of the side which has more.

    References
    ----------
    Balance of moments on an element of a rod: the force normal to it is dM/ds.
    """
    of = curve_of(arrays)
    e = np.arange(len(of.s) - 1)
    above, below = of.low.of(moment, e), of.up.of(moment, e)
    force = np.zeros(moment.shape)
    force[..., :-1] = above
    force[..., -1] = below[..., -1]
    inner = force[..., 1:-1]
    force[..., 1:-1] = np.where(np.abs(below[..., :-1]) > np.abs(inner), below[..., :-1], inner)
    return force


def derived(
    scene: Scene, mesh: Mesh, arrays: Arrays, bent: FloatArray | None
) -> tuple[Arrays, Arrays]:
    """Shear, stress of the wall and lower-end tension: at rest, and over time where all nodes have one.

    Parameters
    ----------
    bent : components of the moment at rest, (3, n + 1), N m; None in a plane.

    Returns
    -------
    ``shear_force`` (N), signed in a plane, its size in space, and ``von_mises_stress`` (Pa) over the nodes,
    at rest and as envelopes of the outputs; ``lower_end_tension`` (N) at rest and over time. With them the
    histories that envelopes are of, (time, n + 1).
    """
    foot = riser_foot(scene, mesh)
    forces: Arrays = {"lower_end_tension_static": arrays["effective_tension_static"][foot]}
    whole = "time" in arrays and len(arrays["s"]) == len(arrays["s_node"])
    if whole:
        forces["lower_end_tension"] = arrays["effective_tension"][:, foot]
    histories: Arrays = {}
    if "bending_moment_static" in arrays:
        rest = arrays["bending_moment_static"] if bent is None else bent
        forces["shear_force_static"] = _size(shear(arrays, rest), bent is not None)
        if whole:
            moment = arrays.get("mesh_moment", arrays["bending_moment"])
            histories["shear_force"] = _size(shear(arrays, moment), "mesh_moment" in arrays)
    if not all(wall_lacks(scene, section) for section in scene.riser):
        forces["von_mises_stress_static"] = _stress(scene, mesh, arrays, "_static")
        if whole:
            histories["von_mises_stress"] = _stress(scene, mesh, arrays, "")
    for name, values in histories.items():
        forces |= {name + "_max": values.max(axis=0), name + "_min": values.min(axis=0)}
        if name == "shear_force":
            forces[name + "_absmax"] = np.abs(values).max(axis=0)
    return forces, histories


def _stress(scene: Scene, mesh: Mesh, arrays: Arrays, ending: str) -> FloatArray:
    """Of the riser's nodes; a telescopic joint has none."""
    names = ("z", "effective_tension", "bending_moment")
    still = np.zeros_like(arrays["z" + ending])
    values = (arrays.get(name + ending, still) for name in names)
    return along_the_riser(scene, mesh, *values)


def _size(values: FloatArray, components: bool) -> FloatArray:
    """Of components (..., 3, n + 1) their size, else the values."""
    return np.asarray(np.linalg.norm(values, axis=-2)) if components else values
