"""Tensioned beam with cubic Hermite elements and Newmark's method: the papers' method, and a second solver.

Planar, small slope, u lateral over unstretched arclength s from the bottom, end to end:

    (m + m_a) u.. - (T u')' + (EI u'')'' = q + c |U - u.| (U - u.) + m_w U.

It shares no code with the lumped-mass engine. It omits large rotations and axial strain: in a 2 m surge of a
533 m riser, they change the displacement by 0.09 % of the surge and the largest moment by 0.04 %. It is
validated against closed forms, observed orders and, at small amplitude, the geometrically exact reference of
the verification tests. It is not validated for negative tension.

Convention: M = EI u''; Q = -M' is the shear force and Q + T u' the lateral force.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from scipy.linalg import eigh

from riserstudy.solve.hermite_beam import Array, Beam, HermiteError, Response, Stepping, Waves
from riserstudy.solve.hermite_kernels import (
    Mesh,
    Prescribed,
    Sea,
    Steps,
    factorise,
    march,
    pin,
    section_forces,
    substitute,
)

# exact for every product in this file except drag
POINT, WEIGHT = np.polynomial.legendre.leggauss(4)
POINT, WEIGHT = (POINT + 1.0) / 2.0, WEIGHT / 2.0


def statics(beam: Beam) -> Response:
    """Equilibrium under load, current and the ends' motion at time zero.

    Without velocity the drag does not depend on u, so Newton's method needs one step.

    Raises
    ------
    HermiteError
        If an array is wrong, or the beam is unstable (a pivot of the stiffness is not positive).
    """
    mesh = _mesh(beam)
    fixed, forced = _prescribed(beam, np.zeros(1))
    u, still = np.zeros((2, 2 * len(beam.s)))
    u[fixed] = forced[0, :, 0]
    sea = _sea(beam)
    drag = np.einsum("eg,egi->ei", mesh.strength * np.abs(sea.current) * sea.current, mesh.value)
    force = mesh.force + _add(drag) - _times(mesh.stiffness_band, u)
    for dof in fixed:
        pin(mesh.stiffness_band, force, dof)
    diagonal = mesh.stiffness_band[:, 0].copy()
    bad = factorise(mesh.stiffness_band)
    # the pivot of a mechanism is a rounding error
    small = mesh.stiffness_band[:, 0] < 1e-12 * diagonal
    if bad >= 0 or small.any():
        where = beam.s[max(bad, int(np.argmax(small))) // 2]
        raise HermiteError(
            f"the beam is unstable at s = {where:.6g} m, where its stiffness is not positive;"
            " increase the tension or the bending stiffness, or hold an end"
        )
    substitute(mesh.stiffness_band, force)
    u += force
    motion = np.stack([u, still, still])[:, None]
    tension = np.ascontiguousarray(beam.tension)
    moment, shear = section_forces(mesh, sea, np.zeros(1), motion, tension, 0.0, 0.0)
    return Response(np.empty(0), u[::2], u[1::2], moment[0], shear[0], 1)


def in_still_water(beam: Beam) -> Beam:
    """The beam without current and waves."""
    return beam._replace(current=None, waves=None)


def frequencies(beam: Beam, count: int) -> tuple[Array, Array]:
    """Undamped natural frequencies, without drag and current.

    Returns
    -------
    omega : ndarray, shape (count,)
        Circular frequencies, rad/s, ascending.
    modes : ndarray, shape (count, n + 1)
        Lateral displacements of the nodes, scaled to a largest value of one.

    Raises
    ------
    HermiteError
        If an array is wrong or the beam is unstable.
    """
    mesh = _mesh(beam)
    fixed, _ = _prescribed(beam, np.zeros(1))
    free = np.setdiff1d(np.arange(2 * len(beam.s)), fixed)
    dense = [_dense(band)[np.ix_(free, free)] for band in (mesh.stiffness_band, mesh.mass_band)]
    square, vectors = eigh(*dense, subset_by_index=(0, count - 1))
    if not square[0] > 0.0:
        raise HermiteError(
            f"the beam is unstable, since its lowest eigenvalue {square[0]:.3g} 1/s2 is not positive; "
            "increase the tension or the bending stiffness, or hold an end"
        )
    modes = np.zeros((count, 2 * len(beam.s)))
    modes[:, free] = vectors.T
    modes = modes[:, ::2]
    peak = np.take_along_axis(modes, np.abs(modes).argmax(axis=1)[:, None], axis=1)
    return np.sqrt(square), modes / peak


def dynamics(
    beam: Beam,
    times: Array,
    step: float,
    stepping: Stepping = Stepping(),  # noqa: B008  a record that nobody can change
    *,
    start: Literal["equilibrium", "still water", "straight"] = "equilibrium",
) -> Response:
    """Motion from rest by Newmark's method, from static equilibrium, equilibrium in still water, or straight.

    Parameters
    ----------
    beam : Beam
    times : ndarray, shape (time,)
        Output times, s, equally spaced from zero.
    step : float
        Largest time step, s; an output interval is divided into equal steps no longer than this.
    stepping : Stepping
    start : {"equilibrium", "still water", "straight"}
        Shape at time zero. On the last two, current and waves act as a step. A straight beam is upright, so
        an end that is held elsewhere jumps.

    Raises
    ------
    HermiteError
        If an argument is wrong, a step does not converge, or the motion is no longer finite.

    References
    ----------
    Newmark, N. M., A method of computation for structural dynamics, *J. Eng. Mech. Div.* 85(3),
    1959, 67-94, equations 1 and 2.
    """
    _check_stepping(times, step, stepping)
    mesh = _mesh(beam)
    first = np.zeros(2 * len(beam.s))
    if start != "straight":
        rest = statics(beam if start == "equilibrium" else in_still_water(beam))
        first = np.column_stack([rest.displacement, rest.rotation]).ravel()
    each = int(np.ceil(times[1] / step * (1.0 - 1e-12)))
    grid = np.arange(each * (times.size - 1) + 1) * (times[1] / each)
    by_mass, by_stiffness = stepping.rayleigh
    damping = by_mass * mesh.mass_band + by_stiffness * mesh.stiffness_band
    sea = _sea(beam)
    drag, most = DRAG.index(stepping.drag), stepping.iterations
    steps = Steps(grid[1], each, stepping.beta, stepping.gamma, drag, stepping.tolerance, most)
    motion, taken, failed = march(mesh, sea, damping, first, _prescribed(beam, grid), steps)
    if failed >= 0:
        raise HermiteError(
            f"the iteration at t = {grid[failed]:.6g} s did not converge in {most} iterations;"
            " reduce the step, or use Newmark's method with beta 0.25 and gamma 0.5 (drag='newton')"
        )
    tension = np.ascontiguousarray(beam.tension)
    moment, shear = section_forces(mesh, sea, times, motion, tension, *stepping.rayleigh)
    u = motion[0]
    return Response(times, u[:, ::2], u[:, 1::2], moment, shear, taken)


# iterations of drag, in the order of their numbers in the kernels
DRAG = ("lagged", "picard", "newton")


def _check_stepping(times: Array, step: float, stepping: Stepping) -> None:
    """Refuse times that are not equally spaced from zero, and invalid time steps and iterations."""
    gaps = np.diff(times)
    if times.size < 2 or times[0] != 0.0 or not np.allclose(gaps, gaps[0]) or not gaps[0] > 0.0:
        raise HermiteError("the times are not valid; give two or more, from zero on at equal intervals")
    if not step > 0.0:
        raise HermiteError(f"the time step {step} s is not positive; give a step above 0 s")
    if stepping.drag not in DRAG:
        raise HermiteError(f"drag {stepping.drag!r} is not known; use one of {', '.join(DRAG)}")


def _mesh(beam: Beam) -> Mesh:
    """Check the input of the beam, and integrate its elements."""
    n = len(beam.s) - 1
    if n < 1 or not (np.diff(beam.s) > 0.0).all():
        raise HermiteError("s: the nodes are not valid; give two or more, in ascending order")
    for name in ("bending_stiffness", "tension", "load", "mass", "added_mass", "drag"):
        array = np.asarray(getattr(beam, name))
        shape = (n, 2) if name in ("bending_stiffness", "tension", "load") else (n,)
        if array.shape != shape or not np.isfinite(array).all():
            raise HermiteError(
                f"{name}: the array of shape {array.shape} is not valid; give finite values of shape {shape}"
            )
        if name not in ("tension", "load") and (array < 0.0).any():
            raise HermiteError(f"{name}: the smallest value {array.min():.6g} is negative; give 0 or more")
    value, slope, curve = (_shapes(beam, d, POINT) for d in range(3))
    weight = WEIGHT * np.diff(beam.s)[:, None]

    def integral(strength: Array, shape: Array) -> Array:
        return np.asarray(np.einsum("eg,egi,egj->eij", strength * weight, shape, shape))

    mass = integral((beam.mass + beam.added_mass)[:, None], value)
    stiffness = integral(_linear(beam.bending_stiffness), curve) + integral(_linear(beam.tension), slope)
    loads = np.einsum("eg,egi->ei", _linear(beam.load) * weight, value)
    force, mass_band, stiffness_band = _add(loads), _band(mass), _band(stiffness)
    for end, dof in ((beam.bottom, 0), (beam.top, 2 * n)):
        if not end.rotation_stiffness >= 0.0 or not 0.0 <= end.mass < np.inf:
            raise HermiteError(f"{end}: stiffness or mass is negative; give 0 or more")
        mass_band[dof, 0] += end.mass
        force[dof] += end.force
        if end.rotation_stiffness < np.inf:
            stiffness_band[dof + 1, 0] += end.rotation_stiffness
    strength = beam.drag[:, None] * weight
    return Mesh(
        value, slope, mass, stiffness, loads, strength, force, mass_band, stiffness_band
    )  # fmt: skip


def _prescribed(beam: Beam, times: Array) -> Prescribed:
    """Prescribed degrees of freedom and their displacement, velocity, acceleration (3, dof, time)."""
    dofs, motions = [], []
    for end, dof in ((beam.bottom, 0), (beam.top, 2 * len(beam.s) - 2)):
        still = np.zeros((3, len(times)))
        if end.held:
            dofs.append(dof)
            motions.append(still if end.motion is None else np.array(end.motion(times)))
        if end.rotation_stiffness == np.inf:
            dofs.append(dof + 1)
            motions.append(still)
    forced = np.array(motions).reshape(len(dofs), 3, len(times)).swapaxes(0, 1)
    if not np.isfinite(forced).all():
        raise HermiteError("the prescribed motion of an end is not finite; correct the motion")
    return Prescribed(np.array(dofs, dtype=np.int64), forced)


def _shapes(beam: Beam, d: int, xi: Array) -> Array:
    """The d-th derivative of an element's four functions at xi, (n, points, 4)."""
    cubics = ([1, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1])
    unit = np.stack([np.polynomial.Polynomial(c).deriv(d)(xi) for c in cubics], axis=-1)
    return np.asarray(unit * np.diff(beam.s)[:, None, None] ** (np.array([0.0, 1.0, 0.0, 1.0]) - d))


def _linear(ends: Array) -> Array:
    """Values at the Gauss points, (n, 4), of a quantity that is linear within an element."""
    return np.asarray(ends[:, :1] * (1.0 - POINT) + ends[:, 1:] * POINT)


def _sea(beam: Beam) -> Sea:
    """Current and waves at the Gauss points."""
    s = beam.s[:-1, None] + np.diff(beam.s)[:, None] * POINT
    current = np.zeros(s.shape) if beam.current is None else np.zeros(s.shape) + beam.current(s)
    none = np.zeros(0)
    waves = beam.waves or Waves(lambda s: (np.zeros((0, *s.shape)),) * 2, np.zeros(len(s)), none, none, none)
    sea = Sea(
        current, *waves.flow(s), waves.inertia[:, None] * WEIGHT * np.diff(beam.s)[:, None],
        waves.frequency, waves.number, waves.phase, waves.ramp,
    )  # fmt: skip
    if not all(np.isfinite(part).all() for part in sea):
        raise HermiteError("current or waves are not finite at some elevation of the beam; correct them")
    return sea


def _add(element: Array) -> Array:
    """The nodal vector (2n + 2,) assembled from element vectors (n, 4)."""
    nodal = np.zeros(2 * len(element) + 2)
    nodal[:-2] += element[:, :2].ravel()
    nodal[2:] += element[:, 2:].ravel()
    return nodal


def _band(element: Array) -> Array:
    """Band of the assembled matrix."""
    n = len(element)
    band = np.zeros((2 * n + 2, 4))
    for i in range(4):
        for j in range(i, 4):
            band[i : i + 2 * n : 2, j - i] += element[:, i, j]
    return band


def _times(band: Array, u: Array) -> Array:
    """Product of the matrix of a band and a vector."""
    product = band[:, 0] * u
    for k in range(1, band.shape[1]):
        product[:-k] += band[:-k, k] * u[k:]
        product[k:] += band[:-k, k] * u[:-k]
    return np.asarray(product)


def _dense(band: Array) -> Array:
    """The full matrix of a band."""
    upper = sum(np.diag(band[: len(band) - k, k], k) for k in range(4))
    return np.asarray(upper + np.triu(upper, 1).T)
