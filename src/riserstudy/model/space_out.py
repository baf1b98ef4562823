r"""Space-out: elevation of the ring and length of a telescopic joint, with the riser vertical in equilibrium.

Under the pull P at its ring, a riser stretches by

.. math:: e = \sum_k \frac{L_k}{2 EA_k} (T_k^- + T_k^+),\qquad T(s) = P - \int_s^L w\,ds

with the tensions at the ends of its sections. P depends on e by the law and the inclination of tensioners.
The joint has the length from the ring to its top. Cylinders at mid-stroke pull with their mid-stroke tension.

References
----------
Elementary: the stretch of a hanging rod.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from riserstudy.model.tensioner_law import gas_force, linear_law, table_law, tension_at_mid_stroke
from riserstudy.scene.ends import TelescopicJoint
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.tensioners import Arrangement, Tensioners

HALVINGS = 60  # number of halvings of the range in which the stretch is searched
FURTHEST = 0.05  # upper limit of the stretch, as a share of the riser's length


def joint_of(scene: Resolved) -> TelescopicJoint | None:
    """The telescopic joint of a scene with its length at mid-stroke; None without a joint."""
    joint = scene.top.telescopic_joint
    if joint is None or joint.mid_stroke is None:
        return joint
    ring = _unstretched(scene) + stretch(scene)
    length = (scene.top.elevation or 0.0) - ring
    return joint.replaced(length=length, mid_stroke=None)


def ring_at_mid_stroke(scene: Resolved) -> float:
    """Elevation (m) of the ring with all cylinders at mid-stroke and the riser vertical in still water.

    It is a property of the rig, independent of offset and current. Cylinders of a platform that starts at an
    offset, or moves to this offset, therefore have the same stroke.
    """
    rig, ring, constant = scene.top.tensioners, _unstretched(scene), _constant(scene)
    all_of_them = rig.count * tension_at_mid_stroke(rig, scene.gravity or 0.0) if rig else 0.0
    place = rig.arrangement if rig else None
    if place is None:
        return ring + _stretched_by(scene, constant + all_of_them)
    vertical = _vertical(place, ring, lambda _: all_of_them)
    return ring + _longer(scene, lambda e: constant + vertical(e))


def stretch(scene: Resolved) -> float:
    """Stretch (m) of a vertical riser in equilibrium under the pull at its ring."""
    return _longer(scene, _pull(scene))


def _longer(scene: Resolved, pull: Callable[[float], float]) -> float:
    """Stretch (m) of a vertical riser; ``pull`` is the vertical pull at its ring (N) for a stretch."""
    most = FURTHEST * sum(section.total_length for section in scene.riser)
    low, high = -most, most
    place = scene.top.tensioners and scene.top.tensioners.arrangement
    if place:  # with the ring above the deck, cylinders would pull downwards
        high = min(high, place.deck_elevation - _unstretched(scene))
    with np.errstate(invalid="ignore"):  # the pull of a gas volume of zero is infinite
        for _ in range(HALVINGS):  # the pull decreases with the stretch
            middle = 0.5 * (low + high)
            within = _stretched_by(scene, pull(middle)) <= middle
            low, high = (low, middle) if within else (middle, high)
    return 0.5 * (low + high)


def _unstretched(scene: Resolved) -> float:
    """Elevation of the ring before the riser stretches (m)."""
    return (scene.bottom.elevation or 0.0) + sum(s.total_length for s in scene.riser)


def _stretched_by(scene: Resolved, pull: float) -> float:
    """Stretch (m) of a vertical riser under a constant vertical pull at its ring (N)."""
    gravity = scene.gravity or 0.0
    tension = pull - scene.ring_weight
    total = 0.0
    for section in reversed(scene.riser):
        length = section.total_length
        weight = length * ((section.submerged_weight or 0.0) + section.contents_mass * gravity)
        total += length * (tension - 0.5 * weight) / section.elasticity[0]
        tension -= weight
    return total


def _pull(scene: Resolved) -> Callable[[float], float]:
    """Vertical pull at the ring (N), as a function of the stretch of the riser (m)."""
    rig, constant = scene.top.tensioners, _constant(scene)
    if rig is None:
        return lambda _: constant
    count, gravity = sum(rig.working), scene.gravity or 0.0
    law, place, ring = _law(rig, gravity), rig.arrangement, _unstretched(scene)
    zero = 0.0
    if rig.mid_stroke == "riser in equilibrium":
        zero = ring_at_mid_stroke(scene) - ring
    if place is None:
        return lambda e: constant + count * law(zero - e)
    at_zero = math.hypot(place.deck_radius - place.ring_radius, place.deck_elevation - ring - zero)
    vertical = _vertical(place, ring, lambda length: count * law(length - at_zero))
    return lambda e: constant + vertical(e)


def _vertical(place: Arrangement, ring: float, pulls: Callable[[float], float]) -> Callable[[float], float]:
    """Vertical pull of inclined cylinders (N), as a function of the stretch of the riser (m).

    Parameters
    ----------
    ring : elevation of the ring before the riser stretches (m).
    pulls : pull of all cylinders together along their axes (N), as a function of their length (m).
    """
    aside = place.deck_radius - place.ring_radius

    def vertical(e: float) -> float:
        up = place.deck_elevation - ring - e
        length = math.hypot(aside, up)
        return pulls(length) * up / length

    return vertical


def _constant(scene: Resolved) -> float:
    """Pull at the ring that does not depend on the stroke (N)."""
    joint = scene.top.telescopic_joint
    return (scene.top.tension or 0.0) + ((joint.tension if joint else None) or 0.0)


def _law(rig: Tensioners, gravity: float) -> Callable[[float], float]:
    """Pull of one cylinder (N), as a function of its reach (m)."""
    if rig.table:
        table = table_law(rig.table, rig.interpolation)
        return lambda reach: float(table(reach))
    gas = rig.any_gas
    if gas is not None and not rig.linearised:
        weight = rig.piston_mass * gravity
        return lambda reach: float(gas_force(gas, np.array([reach]))[0]) - weight
    tension, slope = linear_law(rig, gravity)
    return lambda reach: tension + slope * reach
