"""Whether the parts of a scene fit together: what needs what, and what excludes what.

A rule is a function of the scene that yields what does not fit: path, what was found, what is allowed.
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
    pipe,
    vessel,
    waves,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.inputs.misfit import Misfit
    from riserstudy.scene.parts import Parts

#: in the order in which their faults are named: what is missing first, then what does not match
RULES = (
    pipe.water,
    waves.viv,
    current.acts,
    waves.sea,
    current.levels,
    pipe.gravity,
    pipe.mass,
    ends.held,
    ends.followed,
    pipe.bending,
    vessel.moored,
    vessel.coupled,
    vessel.soil,
    pipe.joint,
    analysis.gauge,
    analysis.ends,
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
    """What does not fit together in a scene whose parts are checked one by one."""
    return chain.from_iterable(rule(scene) for rule in RULES)


def check_rules(scene: Parts) -> None:
    """See that the parts of a scene fit together.

    Raises
    ------
    Misfit
        The first that does not.
    """
    fault = next(misfits(scene), None)
    if fault:
        raise fault
