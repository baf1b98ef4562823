"""Static displacement of a riser in a current by two methods that are independent of the engine.

Both solve the small-slope beam (EI u'')'' - (T u')' = c |U| U. Its upper end is pinned, its lower end is
pinned or has a rotational spring. Tension and current are evaluated on the straight, undeformed riser.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_bvp

from riserstudy.model.sea import current_table
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.ends import FlexJoint
from riserstudy.scene.resolve import Resolved

ELEMENTS = 400


class Beamlike(NamedTuple):
    """Data of the small-slope beam, from a scene with one section and a top tension."""

    length: float  # m
    stiffness: float  # N m2
    tension: float  # N, at the top
    weight: float  # N/m
    drag: float  # N s2/m3
    elevation: FloatArray  # m above the bottom, of the current table
    speed: FloatArray  # m/s
    spring: float = 0.0  # N m/rad, rotational stiffness of the lower end

    def current(self, s: FloatArray) -> FloatArray:
        """Speed of the water at arclengths (m/s)."""
        return np.interp(s, self.elevation, self.speed)

    def pull(self, s: FloatArray) -> FloatArray:
        """Tension at arclengths (N)."""
        return self.tension - self.weight * (self.length - s)


def beamlike(scene: Resolved) -> Beamlike:
    """Beam data of a scene."""
    pipe = scene.riser[0]
    if not (scene.top.tension and scene.current and scene.water and pipe.drag):
        raise TypeError("a beam in a current needs top tension, current and drag")
    outer, inner = pipe.outer_diameter or 0.0, pipe.inner_diameter or 0.0
    rotation = scene.bottom.rotation
    z, speed = current_table(scene.current, scene.water)
    return Beamlike(
        pipe.total_length,
        (pipe.young_modulus or 0.0) * math.pi / 64.0 * (outer**4 - inner**4),
        scene.top.tension,
        pipe.submerged_weight or 0.0,
        0.5 * scene.water.density * pipe.drag.constant * pipe.drag.diameter,
        z - (scene.bottom.elevation or 0.0),
        speed,
        rotation.stiffness if isinstance(rotation, FlexJoint) else 0.0,
    )


def by_hermite_elements(beam: Beamlike, at: FloatArray) -> FloatArray:
    """Displacement (m) at arclengths by cubic finite elements."""
    # Imported here because it loads compiled kernels, which other derived datasets do not need.
    from riserstudy.solve.hermite import statics
    from riserstudy.solve.hermite_beam import Beam, End

    s = np.linspace(0.0, beam.length, ELEMENTS + 1)
    pull = beam.pull(s)
    whole = np.ones(ELEMENTS)
    response = statics(
        Beam(
            s=s,
            bending_stiffness=np.full((ELEMENTS, 2), beam.stiffness),
            tension=np.column_stack([pull[:-1], pull[1:]]),
            mass=whole,
            added_mass=0.0 * whole,
            drag=beam.drag * whole,
            load=np.zeros((ELEMENTS, 2)),
            current=beam.current,
            bottom=End(rotation_stiffness=beam.spring),
        )
    )
    return np.interp(at, s, np.asarray(response.displacement))


def by_collocation(beam: Beamlike, at: FloatArray) -> FloatArray:
    """Displacement (m) at arclengths by SciPy's solver of boundary value problems.

    Unknowns over x = s / L: u/L, slope, M L / EI and Q L^2 / EI. Q is the force across the undeformed riser.
    """
    scale = beam.length**2 / beam.stiffness
    turning = beam.spring * beam.length / beam.stiffness  # M = K u' at the lower end

    def slopes(x: FloatArray, y: FloatArray) -> FloatArray:
        s = beam.length * x
        water = beam.current(s)
        load = beam.drag * np.abs(water) * water
        # M' = T u' - Q and Q' = -load
        return np.vstack([y[1], y[2], scale * beam.pull(s) * y[1] - y[3], -scale * beam.length * load])

    def ends(low: FloatArray, high: FloatArray) -> FloatArray:
        return np.array([low[0], low[2] - turning * low[1], high[0], high[2]])

    x = np.linspace(0.0, 1.0, 401)
    solution = solve_bvp(slopes, ends, x, np.zeros((4, x.size)), tol=1e-6, max_nodes=20000)
    if not solution.success:
        raise RuntimeError(f"boundary value problem: {solution.message}")
    return np.asarray(beam.length * solution.sol(at / beam.length)[0])
