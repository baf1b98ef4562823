"""The compiled part of the Hermite beam: banded linear algebra, and Newmark's method with drag and waves.

Bands hold A[i, i + k] of a symmetric matrix at [i, k]; an element's vectors are its two ends' (u, u').
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.solve.jit import inner, kernel

Array = NDArray[np.float64]
CALM = 1e-12  # relative speed of the water that counts as zero (m/s)
LAGGED, PICARD, NEWTON = 0, 1, 2  # state from which the drag takes |U - u.|
# time steps with one correction, after which a second one measures convergence again
CONFIRM_EVERY = 32
SAFETY = 4.0  # factor on the predicted next correction
EPSILON = 2e-16  # relative rounding of an acceleration
NEAR = 1e6  # corrections below this multiple of the tolerance converge quadratically


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
    inertia: Array  # (n, 4) kg, mass of water whose acceleration loads the pipe, times weight
    frequency: Array  # (c,) rad/s
    number: Array  # (c,) rad/m, negative for waves against x
    phase: Array  # (c,) rad
    ramp: float  # (s) half a cosine; 0 for none


class Steps(NamedTuple):
    """Parameters of Newmark's method."""

    h: float  # (s)
    each: int  # time steps from one stored step to the next
    beta: float  # a share
    gamma: float  # a share
    drag: int  # 0: |U - u.| of the previous step, 1: of the previous iteration, 2: Newton
    tolerance: float  # (m) correction at which an iteration ends
    iterations: int  # largest number in a time step


class Prescribed(NamedTuple):
    """Unknowns with a prescribed motion."""

    unknowns: NDArray[np.int64]  # (fixed,)
    motion: Array  # (3, fixed, steps) displacement, velocity, acceleration


@kernel
def flow(mesh: Mesh, sea: Sea, t: float, u: Array, water: Array, push: Array) -> None:
    """Velocity of the water across the beam (m/s) and force of its acceleration (N) at the Gauss points.

    The waves are evaluated at the displacements u of the beam, (2n + 2,), at time t (s). The component across
    an inclined beam is speed - rise u'. Velocity and force are written to ``water`` and ``push``, (n, 4).
    """
    for e in range(water.shape[0]):
        for g in range(4):
            water[e, g], push[e, g] = sea.current[e, g], 0.0
    if t <= 0.0:
        return
    grown, rate = 1.0, 0.0
    if t < sea.ramp:
        p = pi / sea.ramp
        grown, rate = 0.5 * (1.0 - cos(p * t)), 0.5 * p * sin(p * t)
    for c in range(len(sea.frequency)):
        w = sea.frequency[c]
        sign = -1.0 if sea.number[c] < 0.0 else 1.0
        for e in range(water.shape[0]):
            if sea.speed[c, e, 0] < CALM and sea.speed[c, e, 3] < CALM:
                continue
            for g in range(4):
                x, lean = 0.0, 0.0
                for i in range(4):
                    x += mesh.value[e, g, i] * u[2 * e + i]
                    lean += mesh.slope[e, g, i] * u[2 * e + i]
                angle = sea.number[c] * x - w * t + sea.phase[c]
                sine, cosine = sin(angle), cos(angle)
                along, up = sign * sea.speed[c, e, g], sea.rise[c, e, g] * lean
                here = along * cosine - up * sine
                turned = along * sine + up * cosine
                water[e, g] += grown * here
                push[e, g] += (grown * w * turned + rate * here) * sea.inertia[e, g]


@kernel
def pin(band: Array, right: Array, dof: int) -> None:
    """Replace row and column of a band (2n + 2, 4) by the identity, the right side (2n + 2,) by zero."""
    band[dof] = 0.0
    band[dof, 0] = 1.0
    right[dof] = 0.0
    for k in range(1, min(4, dof + 1)):
        band[dof - k, k] = 0.0


@kernel
def factorise(band: Array) -> int:
    """L D L' of a band (2n + 2, 4) in place; returns the first row without a positive finite pivot, or -1."""
    # amounts to subtract from the following rows
    own = own_1 = own_2 = next_0 = next_1 = third = 0.0
    for i in range(band.shape[0]):
        pivot, one, two, three = (band[i, 0] - own, band[i, 1] - own_1, band[i, 2] - own_2, band[i, 3])
        if not pivot > 0.0:
            return i
        inverse = 1.0 / pivot
        band[i, 0] = pivot
        band[i, 1], band[i, 2], band[i, 3] = one * inverse, two * inverse, three * inverse
        own = next_0 + band[i, 1] * one
        own_1, own_2 = next_1 + band[i, 1] * two, band[i, 1] * three
        next_0, next_1 = third + band[i, 2] * two, band[i, 2] * three
        third = band[i, 3] * three
    return -1


@kernel
def substitute(band: Array, x: Array) -> None:
    """Solve for x, (2n + 2,), in place with the factors of ``factorise``."""
    n = band.shape[0]
    one = two = three = 0.0  # values of the previous, or the following, rows
    for i in range(n):
        here = x[i]
        here -= one
        one, two, three = two + band[i, 1] * here, three + band[i, 2] * here, band[i, 3] * here
        x[i] = here
    one = two = three = 0.0
    for i in range(n - 1, -1, -1):
        here = x[i] / band[i, 0] - band[i, 1] * one - band[i, 2] * two - band[i, 3] * three
        one, two, three = here, one, two
        x[i] = here


@inner
def multiply(band: Array, x: Array, out: Array) -> None:
    """Add the symmetric band (2n + 2, 4) times x to out, both (2n + 2,)."""
    n = band.shape[0]
    for i in range(n):
        out[i] += band[i, 0] * x[i]
    for k in range(1, 4):
        for i in range(n - k):
            out[i] += band[i, k] * x[i + k]
            out[i + k] += band[i, k] * x[i]


@inner
def add_water(
    out: Array, band: Array, mesh: Mesh, water: Array, push: Array, v: Array, lag: Array, factor: float
) -> None:
    """Add inertia force and drag c |U - lag| (U - v) to out (N); add ``factor`` c |U - lag| to the band.

    Water and push are (n, 4) at the Gauss points, v and lag (2n + 2,) in m/s, the factor is in s.
    """
    value = mesh.value
    for e in range(water.shape[0]):  # sums of an element in registers take half the time
        i = 2 * e
        v0, v1, v2, v3 = v[i], v[i + 1], v[i + 2], v[i + 3]
        lag0, lag1, lag2, lag3 = lag[i], lag[i + 1], lag[i + 2], lag[i + 3]
        f0 = f1 = f2 = f3 = 0.0
        k00 = k01 = k02 = k03 = k11 = k12 = k13 = k22 = k23 = k33 = 0.0
        for g in range(4):
            a, b, c, d = value[e, g, 0], value[e, g, 1], value[e, g, 2], value[e, g, 3]
            relative = water[e, g] - (a * v0 + b * v1 + c * v2 + d * v3)
            weighing = water[e, g] - (a * lag0 + b * lag1 + c * lag2 + d * lag3)
            damping = mesh.strength[e, g] * abs(weighing)
            force, slope = damping * relative + push[e, g], factor * damping
            f0, f1, f2, f3 = f0 + force * a, f1 + force * b, f2 + force * c, f3 + force * d
            ka, kb, kc, kd = slope * a, slope * b, slope * c, slope * d
            k00, k01, k02, k03 = k00 + ka * a, k01 + ka * b, k02 + ka * c, k03 + ka * d
            k11, k12, k13 = k11 + kb * b, k12 + kb * c, k13 + kb * d
            k22, k23, k33 = k22 + kc * c, k23 + kc * d, k33 + kd * d
        for k, force in enumerate((f0, f1, f2, f3)):
            out[i + k] += force
        for k, slope in enumerate((k00, k01, k02, k03)):
            band[i, k] += slope
        for k, slope in enumerate((k11, k12, k13)):
            band[i + 1, k] += slope
        band[i + 2, 0] += k22
        band[i + 2, 1] += k23
        band[i + 3, 0] += k33


@kernel
def march(
    mesh: Mesh, sea: Sea, damping: Array, start: Array, prescribed: Prescribed, steps: Steps
) -> tuple[Array, int, int]:
    """Newmark's method from the displacements ``start``, (2n + 2,), with ``damping``, a band (2n + 2, 4).

    Returns u, v, a at the stored steps, (3, stored, 2n + 2), the largest number of iterations, and the failed
    step or -1. Step 0 only computes the initial acceleration, a linear problem.
    """
    fixed, forced = prescribed.unknowns, prescribed.motion
    h, beta, gamma = steps.h, steps.beta, steps.gamma
    mass, stiffness = mesh.mass_band, mesh.stiffness_band
    history = np.zeros((3, (forced.shape[2] - 1) // steps.each + 1, len(start)))
    u, v, a = start.copy(), np.zeros_like(start), np.zeros_like(start)
    steady = mass + gamma * h * damping + beta * h * h * stiffness
    water, push = np.zeros_like(sea.current), np.zeros_like(sea.current)
    most = 0
    # of Newton's iteration: ratio of a correction to the square of the previous one
    curvature = np.inf
    since = 0  # time steps since it was measured
    for step in range(forced.shape[2]):
        moving = 1.0 if step > 0 else 0.0
        lag = v.copy()
        u += moving * h * (v + 0.5 * h * a)
        v += moving * h * a
        for k, dof in enumerate(fixed):
            u[dof], v[dof], a[dof] = forced[0, k, step], forced[1, k, step], forced[2, k, step]
        flow(mesh, sea, step * h, u, water, push)  # at the predicted displacements
        of_unknowns = steady if step > 0 else mass
        linear = -mesh.force
        multiply(mass, a, linear)
        multiply(damping, v, linear)
        multiply(stiffness, u, linear)
        last = 0.0
        for iteration in range(steps.iterations):
            band, change = of_unknowns.copy(), -linear
            if steps.drag == NEWTON or iteration > 0 or step == 0:
                lag[:] = v
            factor = moving * gamma * h * (2.0 if steps.drag == NEWTON else 1.0)
            add_water(change, band, mesh, water, push, v, lag, factor)
            for dof in fixed:
                pin(band, change, dof)
            if factorise(band) >= 0:
                return history, most, step
            substitute(band, change)
            a += change
            v += moving * gamma * h * change
            u += moving * beta * h * h * change
            most = max(most, iteration + 1)
            size = np.sqrt(np.sum(change**2)) * h * h
            rounding = EPSILON * np.sqrt(np.sum(a**2)) * h * h
            if not (size < np.inf and rounding < steps.tolerance):
                return history, most, step  # the iteration diverges
            if last > 0.0:
                curvature = size / (last * last)
            last = size
            known = iteration > 0 or since < CONFIRM_EVERY
            if steps.drag == NEWTON and known and size < NEAR * steps.tolerance:
                # predicted size of the next correction
                size = min(size, SAFETY * curvature * size * size)
            if size < steps.tolerance or step == 0 or steps.drag == LAGGED:
                since = 0 if iteration > 0 else since + 1
                break
            if iteration == steps.iterations - 1:
                return history, most, step
            multiply(of_unknowns, change, linear)
        if step % steps.each == 0:
            stored = step // steps.each
            history[0, stored], history[1, stored], history[2, stored] = u, v, a
    return history, most, -1


@kernel
def section_forces(
    mesh: Mesh, sea: Sea, times: Array, motion: Array, tension: Array, by_mass: float, by_stiffness: float
) -> tuple[Array, Array]:
    """Moment (N m) and shear (N) at the nodes, each (time, n + 1), from the end forces of the elements.

    An element's end forces balance its load, the water's forces, inertia and Rayleigh damping (factors by
    mass, 1/s, and by stiffness, s). At a node, the values of the adjacent elements have their mean.
    ``times``: (time,) s; ``motion``: u, v, a, (3, time, 2n + 2); ``tension``: at the elements' ends, (n, 2).
    """
    n = len(mesh.loads)
    moment, shear = np.zeros((len(times), n + 1)), np.zeros((len(times), n + 1))
    water, push = np.zeros((n, 4)), np.zeros((n, 4))
    for k in range(len(times)):
        u, v, a = motion[0, k], motion[1, k], motion[2, k]
        flow(mesh, sea, times[k], u, water, push)
        for e in range(n):
            i = 2 * e
            f0, f1, f2, f3 = -mesh.loads[e, 0], -mesh.loads[e, 1], -mesh.loads[e, 2], -mesh.loads[e, 3]
            for g in range(4):
                s0, s1, s2, s3 = mesh.value[e, g]
                relative = water[e, g] - (s0 * v[i] + s1 * v[i + 1] + s2 * v[i + 2] + s3 * v[i + 3])
                force = mesh.strength[e, g] * abs(relative) * relative + push[e, g]
                f0, f1, f2, f3 = f0 - force * s0, f1 - force * s1, f2 - force * s2, f3 - force * s3
            for j in range(4):
                bent = u[i + j] + by_stiffness * v[i + j]
                slowed = a[i + j] + by_mass * v[i + j]
                f0 += mesh.stiffness[e, j, 0] * bent + mesh.mass[e, j, 0] * slowed  # both are symmetric
                f1 += mesh.stiffness[e, j, 1] * bent + mesh.mass[e, j, 1] * slowed
                f2 += mesh.stiffness[e, j, 2] * bent + mesh.mass[e, j, 2] * slowed
                f3 += mesh.stiffness[e, j, 3] * bent + mesh.mass[e, j, 3] * slowed
            low = 1.0 if e == 0 else 0.5
            high = 1.0 if e == n - 1 else 0.5
            moment[k, e] -= low * f1
            moment[k, e + 1] += high * f3
            shear[k, e] -= low * (f0 + tension[e, 0] * u[i + 1])
            shear[k, e + 1] += high * (f2 - tension[e, 1] * u[i + 3])
    return moment, shear
