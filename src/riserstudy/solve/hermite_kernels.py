"""The compiled part of the Hermite beam: banded linear algebra, and Newmark's method with drag and waves.

Bands hold A[i, i + k] of a symmetric matrix at [i, k]; an element's vectors are its two ends' (u, u').
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[np.float64]
CALM = 1e-12  # speed of water that is none (m/s)


class Mesh(NamedTuple):
    """The discretised beam; bands hold A[i, i + k] of a symmetric matrix at [i, k]."""

    value: Array  # (n, 4 points, 4) shape functions at the Gauss points
    slope: Array  # (n, 4 points, 4) their derivatives
    mass: Array  # (n, 4, 4) kg
    stiffness: Array  # (n, 4, 4) N/m
    loads: Array  # (n, 4) N, from the distributed load
    strength: Array  # (n, 4) N s2/m2, drag times weight
    force: Array  # (2n + 2,) N, the loads and the ends' forces
    mass_band: Array  # (2n + 2, 4), point masses included
    stiffness_band: Array  # (2n + 2, 4), rotational springs included


class Sea(NamedTuple):
    """Water at the Gauss points: a steady current and wave components, calm up to t = 0."""

    current: Array  # (n, 4) m/s
    speed: Array  # (c, n, 4) m/s, amplitudes of the waves' horizontal velocity
    rise: Array  # (c, n, 4) m/s, of their vertical velocity
    inertia: Array  # (n, 4) kg, water that accelerates the pipe, times weight
    frequency: Array  # (c,) rad/s
    number: Array  # (c,) rad/m, negative for waves against x
    phase: Array  # (c,) rad
    ramp: float  # (s) half a cosine; 0 for none


class Steps(NamedTuple):
    """Newmark's method as it is stepped."""

    h: float  # (s)
    each: int  # steps between those that are stored
    beta: float  # a share
    gamma: float  # a share
    drag: int  # 0 lags |U - u.|, 1 repeats with the last iterate's, 2 is Newton
    tolerance: float  # (m) the correction that ends an iteration
    iterations: int  # at most, a step


class Prescribed(NamedTuple):
    """Unknowns whose motion is given."""

    unknowns: NDArray[np.int64]  # (fixed,)
    motion: Array  # (3, fixed, steps) displacement, velocity, acceleration


@njit(cache=True, nogil=True)
def flow(mesh: Mesh, sea: Sea, t: float, u: Array, water: Array, push: Array) -> None:
    """Velocity of the water across the beam (m/s) and force of its acceleration (N) at the Gauss points.

    The waves are met where the beam is at displacements u, (2n + 2,), at time t (s); across a leaning beam is
    speed - rise u'. Both go to ``water`` and ``push``, (n, 4).
    """
    for e in range(water.shape[0]):
        for g in range(water.shape[1]):
            water[e, g], push[e, g] = sea.current[e, g], 0.0
    if t <= 0.0:
        return
    grown, rate = 1.0, 0.0
    if t < sea.ramp:
        p = pi / sea.ramp
        grown, rate = 0.5 * (1.0 - cos(p * t)), 0.5 * p * sin(p * t)
    for c in range(len(sea.frequency)):
        w = sea.frequency[c]
        for e in range(len(water)):
            if sea.speed[c, e, 0] < CALM and sea.speed[c, e, 3] < CALM:
                continue
            for g in range(4):
                x, lean = 0.0, 0.0
                for i in range(4):
                    x += mesh.value[e, g, i] * u[2 * e + i]
                    lean += mesh.slope[e, g, i] * u[2 * e + i]
                angle = sea.number[c] * x - w * t + sea.phase[c]
                along, up = sea.speed[c, e, g], sea.rise[c, e, g] * lean
                if sea.number[c] < 0.0:
                    along = -along
                here = along * cos(angle) - up * sin(angle)
                turned = along * sin(angle) + up * cos(angle)
                water[e, g] += grown * here
                push[e, g] += (grown * w * turned + rate * here) * sea.inertia[e, g]


@njit(cache=True, nogil=True)
def pin(band: Array, right: Array, dof: int) -> None:
    """Replace row and column of a band (2n + 2, 4) by the identity, the right side (2n + 2,) by zero."""
    band[dof] = 0.0
    band[dof, 0] = 1.0
    right[dof] = 0.0
    for k in range(1, min(4, dof + 1)):
        band[dof - k, k] = 0.0


@njit(cache=True, nogil=True)
def factorise(band: Array) -> int:
    """L D L' of a band (2n + 2, 4) in place; the first row with a pivot not positive, or no number, or -1."""
    n = len(band)
    for i in range(n):
        if not band[i, 0] > 0.0:
            return i
        for j in range(1, min(4, n - i)):
            share = band[i, j] / band[i, 0]
            for k in range(j, 4):
                band[i + j, k - j] -= share * band[i, k]
            band[i, j] = share
    return -1


@njit(cache=True, nogil=True)
def substitute(band: Array, x: Array) -> None:
    """Solve for x, (2n + 2,), in place with the factors of ``factorise``."""
    n = len(band)
    for i in range(n):
        for j in range(1, min(4, n - i)):
            x[i + j] -= band[i, j] * x[i]
    for i in range(n - 1, -1, -1):
        x[i] /= band[i, 0]
        for j in range(1, min(4, n - i)):
            x[i] -= band[i, j] * x[i + j]


@njit(cache=True, nogil=True)
def multiply(band: Array, x: Array, out: Array) -> None:
    """Add the symmetric band (2n + 2, 4) times x to out, both (2n + 2,)."""
    n = len(band)
    for i in range(n):
        out[i] += band[i, 0] * x[i]
        for j in range(1, min(4, n - i)):
            out[i] += band[i, j] * x[i + j]
            out[i + j] += band[i, j] * x[i]


@njit(cache=True, nogil=True)
def add_water(
    out: Array,
    band: Array,
    mesh: Mesh,
    water: Array,
    push: Array,
    v: Array,
    lag: Array,
    factor: float,
) -> None:
    """Subtract push and drag c |U - lag| (U - v) from out (N); add ``factor`` c |U - lag| to the band.

    Water and push are (n, 4) at the Gauss points, v and lag (2n + 2,) in m/s, the factor is in s.
    """
    for e in range(len(mesh.value)):
        shape = mesh.value[e]
        for g in range(4):
            relative, weighing = water[e, g], water[e, g]
            for i in range(4):
                relative -= shape[g, i] * v[2 * e + i]
                weighing -= shape[g, i] * lag[2 * e + i]
            damping = mesh.strength[e, g] * abs(weighing)
            for i in range(4):
                out[2 * e + i] -= (damping * relative + push[e, g]) * shape[g, i]
                for j in range(i, 4):
                    band[2 * e + i, j - i] += factor * damping * shape[g, i] * shape[g, j]


@njit(cache=True, nogil=True)
def march(
    mesh: Mesh, sea: Sea, damping: Array, start: Array, prescribed: Prescribed, steps: Steps
) -> tuple[Array, int, int]:
    """Newmark's method from the displacements ``start``, (2n + 2,), with ``damping``, a band (2n + 2, 4).

    Returns u, v, a at the stored steps, (3, stored, 2n + 2), the most iterations and the failed step or -1.
    Step 0 only finds the initial acceleration, linear in the unknowns.
    """
    fixed, forced = prescribed.unknowns, prescribed.motion
    h, beta, gamma = steps.h, steps.beta, steps.gamma
    mass, stiffness = mesh.mass_band, mesh.stiffness_band
    history = np.zeros((3, (forced.shape[2] - 1) // steps.each + 1, len(start)))
    u, v, a = start.copy(), np.zeros_like(start), np.zeros_like(start)
    steady = mass + gamma * h * damping + beta * h * h * stiffness
    water, push = np.zeros_like(sea.current), np.zeros_like(sea.current)
    most = 0
    for step in range(forced.shape[2]):
        moving = 1.0 if step > 0 else 0.0
        lag = v.copy()
        u += moving * h * (v + 0.5 * h * a)
        v += moving * h * a
        for k in range(len(fixed)):
            u[fixed[k]], v[fixed[k]], a[fixed[k]] = forced[:, k, step]
        flow(mesh, sea, step * h, u, water, push)  # where it is predicted to be
        for iteration in range(steps.iterations):
            band = steady.copy() if step > 0 else mass.copy()
            residual = -mesh.force
            multiply(mass, a, residual)
            multiply(damping, v, residual)
            multiply(stiffness, u, residual)
            if steps.drag == 2 or iteration > 0 or step == 0:
                lag[:] = v
            factor = moving * gamma * h * (2.0 if steps.drag == 2 else 1.0)
            add_water(residual, band, mesh, water, push, v, lag, factor)
            for dof in fixed:
                pin(band, residual, dof)
            if factorise(band) >= 0:
                return history, most, step
            substitute(band, residual)
            a -= residual
            v -= moving * gamma * h * residual
            u -= moving * beta * h * h * residual
            most = max(most, iteration + 1)
            size = np.sqrt(np.sum(residual**2)) * h * h
            if size < steps.tolerance or (size < np.inf and (step == 0 or steps.drag == 0)):
                break
            if iteration == steps.iterations - 1 or not size < np.inf:
                return history, most, step
        if step % steps.each == 0:
            stored = step // steps.each
            history[0, stored], history[1, stored], history[2, stored] = u, v, a
    return history, most, -1
