"""Section forces that are not values of nodes: shear, and tension at the riser's lower end."""

from __future__ import annotations

import math

import numpy as np

from riserstudy.model.mesh import Mesh
from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.scene.quantities import wall_lacks
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.curve import curve_of
from riserstudy.simulation.wall_stress import along_the_riser, nodes_of, wall_of
from riserstudy.solve.record import NO_SECTION, Record, Section


def riser_foot(scene: Resolved, mesh: Mesh) -> int:
    """The riser's lowest node: at its inner flex joint, or its lower end."""
    return mesh.foot(scene.lowest_riser_section)


def shear_of(arrays: Arrays) -> Section:
    """Inputs of a record for shear alone at every time step; empty for a scene without bending.

    ``arrays``: of the scene at rest on the mesh.
    """
    if "bending_moment_static" not in arrays:
        return NO_SECTION
    return NO_SECTION._replace(shear=curve_of(arrays).slope_weights)


def section_of(scene: Resolved, mesh: Mesh, arrays: Arrays) -> Section:
    """Inputs of a record for shear and wall stress at every time step; empty if there is neither.

    ``arrays``: of the scene at rest on the mesh.
    """
    plain = shear_of(arrays)
    filled = [k for k, section in enumerate(scene.riser) if section.contents][::-1]
    rows, places = [], []
    for k, section in enumerate(scene.riser):
        if wall_lacks(scene, section):
            continue
        wall, nodes = wall_of(section), nodes_of(mesh, k)
        row = (wall.outer, wall.inner, wall.area, wall.second_moment, *section.pipe_shares)
        inside = filled.index(k) if k in filled else -1
        places += [(node, inside) for node in range(nodes.start, nodes.stop)]
        rows += [row] * (nodes.stop - nodes.start)
    if not rows:
        return plain
    gravity = scene.gravity or 0.0
    columns, ends = [], []
    for k in filled:
        contents, nodes = scene.riser[k].contents, nodes_of(mesh, k)
        if contents:  # all sections in this list have contents
            level = math.nan if contents.level is None else contents.level
            columns.append((contents.density * gravity, level))
            ends.append((nodes.stop - 1, nodes.start))
    sea = (0.0, 0.0)
    if scene.water and scene.water.surface is not None:
        sea = (scene.water.density * gravity, scene.water.surface)
    return Section(
        plain.shear,
        np.array(rows),
        np.array(places, np.int64),
        np.array(columns).reshape(-1, 2),
        np.array(ends, np.int64).reshape(-1, 2),
        np.array(sea),
    )


def envelopes_of(record: Record) -> Arrays:
    """Envelopes of shear (N) and von Mises stress (Pa) in a record, at the nodes, (n + 1,).

    Shear includes both sides of a node. Stress is zero where the wall is not known.
    """
    found: Arrays = {}
    if record.shear.shape[1]:
        end = len(record.largest) - bool(len(record.wall))
        sides = slice(end - 2, end)
        most, least = record.largest[sides].max(axis=0), record.smallest[sides].min(axis=0)
        found["shear_force_absmax"] = np.maximum(abs(most), abs(least))
        found |= {"shear_force_max": most, "shear_force_min": least}
    if len(record.wall):
        found |= {"von_mises_stress_max": record.largest[-1], "von_mises_stress_min": record.smallest[-1]}
    return found


def shear(arrays: Arrays, moment: FloatArray, spatial: bool, above_ring: FloatArray | None) -> FloatArray:
    """Shear force (N) at the nodes, (..., n + 1), from the slope of the moment (N m).

    At joints and between sections, where shear may jump, it is the value with the larger magnitude.
    ``moment``: (..., n + 1), or in space its components (..., 3, n + 1); the result is then the magnitude.
    ``above_ring``: the moment (N m) at which a telescopic joint begins, (...) or (..., 3); None without one.

    References
    ----------
    Balance of moments on an element of a rod: the force normal to it is dM/ds.
    """
    of = curve_of(arrays)
    e = np.arange(len(of.s) - 1)
    above, below = of.low.of(moment, e), of.up.of(moment, e)
    if above_ring is not None:
        for side in (above, below):
            side[..., -1] += (moment[..., -2] - above_ring) / (of.s[-1] - of.s[-2])
    if spatial:  # the magnitude of each side first: components from two sides are not one force
        above, below = np.linalg.norm(above, axis=-2), np.linalg.norm(below, axis=-2)
    force = np.zeros((*above.shape[:-1], len(of.s)))
    force[..., :-1] = above
    force[..., -1] = below[..., -1]
    inner = force[..., 1:-1]
    force[..., 1:-1] = np.where(np.abs(below[..., :-1]) > np.abs(inner), below[..., :-1], inner)
    return force


def derived(scene: Resolved, mesh: Mesh, arrays: Arrays, bent: FloatArray | None) -> tuple[Arrays, Arrays]:
    """Shear, wall stress and lower-end tension: at rest, and over time if all nodes have histories.

    ``bent``: components of the moment at rest, (3, n + 1), N m; None in a plane.

    Returns
    -------
    ``shear_force`` (N), with a sign in a plane and a magnitude in space, and ``von_mises_stress`` (Pa), at
    the nodes at rest; ``lower_end_tension`` (N) at rest and over time. Also histories of shear and stress,
    (time, n + 1); their envelopes are over all time steps, see `envelopes_of`.
    """
    foot = riser_foot(scene, mesh)
    forces: Arrays = {"lower_end_tension_static": arrays["effective_tension_static"][foot]}
    whole = "time" in arrays and len(arrays["s"]) == len(arrays["s_node"])
    if whole:
        forces["lower_end_tension"] = arrays["effective_tension"][:, foot]
    histories: Arrays = {}
    if "bending_moment_static" in arrays:
        rest = arrays["bending_moment_static"] if bent is None else bent
        forces["shear_force_static"] = shear(
            arrays, rest, bent is not None, arrays.get("mesh_above_ring_static")
        )
        if whole:
            moment = arrays.get("mesh_moment", arrays["bending_moment"])
            spatial = "mesh_moment" in arrays
            histories["shear_force"] = shear(arrays, moment, spatial, arrays.get("mesh_above_ring"))
    if not all(wall_lacks(scene, section) for section in scene.riser):
        rest = forces["von_mises_stress_static"] = _stress(scene, mesh, arrays, "_static")
        for name in ("von_mises_stress_max", "von_mises_stress_min"):
            if name in arrays:  # no wall, no stress
                forces[name] = np.where(np.isnan(rest), np.nan, arrays[name])
        if whole:
            histories["von_mises_stress"] = _stress(scene, mesh, arrays, "")
    return forces, histories


def _stress(scene: Resolved, mesh: Mesh, arrays: Arrays, ending: str) -> FloatArray:
    """Von Mises stress (Pa) at the riser's nodes; a telescopic joint has none."""
    names = ("z", "effective_tension", "bending_moment")
    still = np.zeros_like(arrays["z" + ending])
    values = (arrays.get(name + ending, still) for name in names)
    return along_the_riser(scene, mesh, *values)
