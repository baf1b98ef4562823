"""Supports of the riser's ends, and the unknowns that solvers therefore do not change."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from riserstudy.effects.first_order_motion import FirstOrderMotion
from riserstudy.effects.support import Support
from riserstudy.model.layout import AXES, Layout, flexibility_of
from riserstudy.model.model import Effect, Report
from riserstudy.model.platform_motion import centre
from riserstudy.model.vessel import unknowns

#: names of position and speed of a vessel without its first-order motion, direction by direction
LOW_FREQUENCY = (
    "low_frequency_surge",
    "low_frequency_speed_x",
    "low_frequency_sway",
    "low_frequency_speed_y",
)

Pairs = list[tuple[int, int]]  # (node, unknown); moments are numbered before positions


class Hold(NamedTuple):
    """A held node, the directions x, y, z in which it is held, and those that follow the platform."""

    node: int
    place: list[float]  # m
    held: list[bool]
    follow: list[bool]
    because: str


def holds(of: Layout) -> Iterator[Hold]:
    """Supports of the riser's ends."""
    bottom, top = of.scene.bottom, of.scene.top
    if bottom.hold in ("wellhead", "foot"):
        sideways = bottom.hold == "wellhead"
        place = [0.0, 0.0, of.bottom]
        yield Hold(0, place, [sideways, sideways, True], [False] * 3, "bottom.hold")
    held = [top.x not in (None, "free")] * 2 + [top.z != "free"]
    follow = [top.x == "platform"] * 2 + [top.z == "platform"]
    if top.x == "vessel":
        held[0], held[1] = False, (of.last, 1) not in unknowns(of.scene, of.d, of.last)
        follow[1] = of.scene.platform is not None
    if any(held[k] for k in AXES[of.d]):
        yield Hold(of.last, top_at_rest(of), held, follow, "top.x, top.z")


def top_at_rest(of: Layout) -> list[float]:
    """Position of the upper end at rest, with the platform in its rest position (m).

    If the upper end is free in z, its elevation is that of the unstretched riser.
    """
    high = of.bottom + float(of.mesh.l0.sum()) if of.top is None else of.top
    return [of.scene.top.offset or 0.0, 0.0, high]


def first_order(of: Layout, report: Report) -> Iterator[Effect]:
    """First-order motion of the platform, added to that of a vessel; ``report`` as in `model.vessel`."""
    if of.scene.vessel is None or of.scene.platform is None:
        return
    rest = np.array(top_at_rest(of))
    free = sum(node == of.last for node, _ in unknowns(of.scene, of.d, of.last))
    probe = report(*LOW_FREQUENCY[: 2 * free])
    arm, scratch = rest - centre(of.scene.platform), np.zeros((3, 3))
    record = FirstOrderMotion(of.last, free, rest[:2], arm, scratch, probe)
    yield Effect("first-order motion", record, "vessel, platform")


def supports(of: Layout) -> Iterator[Effect]:
    """Effects that hold nodes in their positions."""
    axes = np.array(AXES[of.d])
    for hold in holds(of):
        record = Support(
            hold.node,
            np.array(hold.place),
            axes,
            np.array(hold.held, np.int64)[axes],
            np.array(hold.follow, np.int64)[axes],
            np.array(hold.place) - centre(of.scene.platform),
            np.zeros((3, 3)),
        )
        yield Effect("support", record, hold.because)


def fixed(of: Layout) -> Pairs:
    """Unknowns that solvers do not change: held positions, moments of free ends, unused loose unknowns."""
    pairs = [
        (hold.node, of.m + k) for hold in holds(of) for k, axis in enumerate(AXES[of.d]) if hold.held[axis]
    ]
    for node, end in ((0, of.scene.bottom), (of.last, of.scene.top)):
        if flexibility_of(end.rotation) is None:
            pairs += [(node, u) for u in range(of.m)]
    loose = range(of.last + 1, of.last + 1 + of.loose)
    every = {(node, k) for node in loose for k in range(of.m + of.d)}
    return [*pairs, *every.difference(afloat(of))]


def afloat(of: Layout) -> Pairs:
    """Unknowns that are free in a dynamic run because a vessel floats, but held in statics."""
    return [(node, of.m + k) for node, k in unknowns(of.scene, of.d, of.last)]
