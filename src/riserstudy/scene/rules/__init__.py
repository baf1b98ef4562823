"""Whether the parts of a scene fit together: parts that require others, and parts that exclude others.

A rule is a function of the scene that yields its faults: the path, the value found and the allowed values.
"""

from __future__ import annotations

from itertools import chain
from typing import TYPE_CHECKING

from riserstudy.scene.rules import (
    analysis,
    current,
    disconnect,
    ends,
    geometry,
    limits,
    motions,
    pipe,
    vessel,
    waves,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.inputs.misfit import Misfit
    from riserstudy.scene.parts import Parts

#: in the order in which their faults are reported: missing parts first, then contradictions
RULES = (
    pipe.water,
    waves.viv,
    current.acts,
    waves.sea,
    current.levels,
    pipe.gravity,
    pipe.mass,
    ends.held,
    ends.moves,
    motions.splines,
    pipe.bending,
    pipe.turning,
    vessel.moored,
    vessel.coupled,
    waves.along_axes,
    vessel.soil,
    pipe.joint,
    analysis.gauge,
    analysis.ends,
    analysis.starts_unstretched,
    analysis.starts_gently,
    analysis.stations,
    analysis.sees_the_disconnect,
    geometry.names,
    geometry.reaches,
    geometry.filled,
    geometry.levels,
    geometry.foot,
    current.covers,
    limits.limits,
    limits.fatigue,
    disconnect.disconnect,
    disconnect.events,
)


def misfits(scene: Parts) -> Iterator[Misfit]:
    """Contradictions between the parts of a scene, each of which was checked alone."""
    return chain.from_iterable(rule(scene) for rule in RULES)


def check_rules(scene: Parts) -> None:
    """Check that the parts of a scene fit together. Raises Misfit with the first fault."""
    fault = next(misfits(scene), None)
    if fault:
        raise fault
