"""Input and output of the Hermite beam: beam, ends, waves, stepping, response."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Motion = Callable[[Array], tuple[Array, Array, Array]]


class HermiteError(RuntimeError):
    """A beam that cannot be solved; the message states the place and the remedy."""


class End(NamedTuple):
    """Support of one end; ``End()`` is a pin, ``End(rotation_stiffness=np.inf)`` a clamp."""

    held: bool = True  # lateral motion prescribed; otherwise the end is free
    rotation_stiffness: float = 0.0  # (N m/rad) relative to the vertical
    mass: float = 0.0  # (kg) point mass; this and the force act when the end is free
    force: float = 0.0  # (N) lateral, constant
    motion: Motion | None = None  # times (s) -> displacement, velocity, acceleration; None: at rest


class Beam(NamedTuple):
    """The beam; (n, 2) arrays hold the values at an element's lower and upper end, and are linear between."""

    s: Array  # (n + 1,) m, nodes from the bottom up
    bending_stiffness: Array  # (n, 2) N m2
    tension: Array  # (n, 2) N, effective
    mass: Array  # (n,) kg/m
    added_mass: Array  # (n,) kg/m
    drag: Array  # (n,) N s2/m3, c = rho D Cd / 2
    load: Array  # (n, 2) N/m, lateral
    current: Callable[[Array], Array] | None = None  # s (m) -> U (m/s)
    bottom: End = End()
    top: End = End()
    waves: Waves | None = None


class Waves(NamedTuple):
    """Wave components: velocity speed cos(k x - w t + phase) along x, and rise sin(k x - w t + phase) up."""

    flow: Callable[[Array], tuple[Array, Array]]  # s (m), any shape -> speed, rise, (c, ...) m/s
    inertia: Array  # (n,) kg/m, (1 + C_a) rho A
    frequency: Array  # (c,) rad/s
    number: Array  # (c,) rad/m, negative for waves against x
    phase: Array  # (c,) rad
    ramp: float = 0.0  # (s)


class Stepping(NamedTuple):
    """Newmark's method, and the iteration of a time step.

    ``drag``: ``newton`` uses the exact tangent; ``picard`` uses |U - u.| of the previous iteration and
    repeats until it converges; ``lagged`` uses |U - u.| of the previous step in one solution, of first order
    in the step.
    """

    #: a share; with gamma 1/2: average acceleration, without numerical damping or limit of the step
    beta: float = 0.25
    gamma: float = 0.5  # a share
    drag: Literal["newton", "picard", "lagged"] = "newton"
    #: C = rayleigh[0] M (1/s) + rayleigh[1] K (s), added mass and tension included
    rayleigh: tuple[float, float] = (0.0, 0.0)
    tolerance: float = 1e-10  # (m) largest correction of the displacement that ends the iteration
    iterations: int = 50  # largest number in a time step


class Response(NamedTuple):
    """Nodal results; static results have no time axis, and their ``time`` is empty."""

    time: Array  # (time,) s
    displacement: Array  # (time, n + 1) m
    rotation: Array  # (time, n + 1) rad
    moment: Array  # (time, n + 1) N m
    shear: Array  # (time, n + 1) N
    iterations: int  # largest number in a time step
