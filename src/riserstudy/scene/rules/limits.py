"""Whether the places of limits and fatigue details are on the riser, and their outputs can be computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit
from riserstudy.records.numerals import at_most
from riserstudy.scene.fatigue import A_PERIOD
from riserstudy.scene.quantities import range_lacks

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.fatigue import Detail
    from riserstudy.scene.parts import Parts


def limits(scene: Parts) -> Iterator[Misfit]:
    """Limits must name sections of the riser, and a stroke must be measured from the right state."""
    names = [section.name for section in scene.riser]
    for k, limit in enumerate(scene.limits or []):
        try:
            limit.sections(names)
        except Misfit as fault:
            yield fault.below(f"limits[{k}].at")
        if limit.output == "stroke" and scene.top.telescopic_joint:
            found = "'stroke' is measured from the static equilibrium, not from the length of the joint"
            remedy = "write 'joint_stroke', which is measured from the length of the joint"
            yield Misfit(f"limits[{k}].output", found, remedy, ("top.telescopic_joint",))


def fatigue(scene: Parts) -> Iterator[Misfit]:
    """Fatigue requires loads that recur, and outputs that are frequent enough for the peaks of stress."""
    a = scene.analysis
    if scene.fatigue is None:
        return
    if a.duration is None or a.output is None:
        found, also = "a static run has no stress cycles", ("analysis.duration",)
        yield Misfit("fatigue", found, "add analysis.duration and output, or remove fatigue", also)
        return
    if a.solver:
        found, remedy = "does not work with analysis.solver", "remove analysis.solver"
        yield Misfit("fatigue", found, remedy, ("analysis.solver",))
    if scene.events or scene.top.tension_loss:
        found = "requires loads that recur, so it excludes events such as a disconnect or a tension loss"
        remedy = "remove fatigue, or the events"
        yield Misfit("fatigue", found, remedy, ("disconnect", "top"))
    shortest = scene.shortest_period
    if shortest and a.output.interval > shortest / A_PERIOD:
        found = f"{a.output.interval:g} s is too long: outputs miss peaks of stress, which fatigue requires"
        longest = at_most(shortest / A_PERIOD)
        remedy = f"give at most {longest} s, which is {A_PERIOD} outputs in the shortest period"
        yield Misfit("analysis.output.interval", found, remedy, ("fatigue", "wave", "platform"))
    known: set[str] = set()
    for k, detail in enumerate(scene.fatigue.details):
        if detail.name in known:
            found = f"two details are named {detail.name!r}"
            yield Misfit(f"fatigue.details[{k}].name", found, "give each detail a different name")
        known.add(detail.name)
        yield from (fault.below(f"fatigue.details[{k}]") for fault in _detail(scene, detail))


def _detail(scene: Parts, detail: Detail) -> Iterator[Misfit]:
    """A detail must be at sections for which the stress of the wall can be computed."""
    try:
        names = detail.sections([section.name for section in scene.riser])
    except Misfit as fault:
        yield fault.below("at")
        return
    lacking = [lack for s in scene.riser if s.name in names for lack in range_lacks(scene, s)]
    if detail.face is not None and lacking:
        found = f"the wall stress cannot be computed without {lacking[0]}"
        yield Misfit("face", found, "add this input, or choose other sections by 'at'")
