r"""Gauge of the largest stress along a section; exerts no force.

.. math:: \sigma = |T_e| / A + |M|\,D / 2I

This sum of axial stress and bending stress is the stress at the outer fibre. The formula uses the effective
tension instead of the wall tension, and therefore neglects pressures.

References
----------
Elementary: Navier's stress of axial force and bending.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.vec import at, dot


class StressGauge(NamedTuple):
    """Gauge over the segments first ... last - 1."""

    first: int
    last: int
    area: float  # A (m2)
    fibre: float  # D / 2I (1/m3)
    probe: int


@inner
def probe(gauge, s):
    """Report the largest stress (Pa)."""
    largest = 0.0
    for e in range(gauge.first, gauge.last):
        axial = abs(dot(at(s.dim, s.segment, e), at(s.dim, s.tangent, e))) / gauge.area
        for i in (e, e + 1):
            square = 0.0
            for u in range(len(s.dof) - len(s.dim)):
                square += s.moment[u, i] ** 2
            largest = max(largest, axial + gauge.fibre * sqrt(square))
    s.probe[gauge.probe] = largest
    return 0.0


register(StressGauge, Called("stress gauge", "analysis.output.stress_in"), probe=probe)
