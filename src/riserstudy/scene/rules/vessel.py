"""Requirements of a freely floating vessel, and of the soil around a foot."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.analysis import USE_IMPLICIT

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.forcing import Platform
    from riserstudy.scene.parts import Parts
    from riserstudy.scene.vessel import Vessel


def moored(scene: Parts) -> Iterator[Misfit]:
    """A vessel requires a riser's top that follows it, and forces that the engine can compute."""
    vessel, top = scene.vessel, scene.top
    if (vessel is None) != (top.x != "vessel"):
        if vessel is None:
            found = "missing, but 'top.x: vessel' requires it"
            remedy = "add vessel, or write 'top.x: platform'"
        else:
            found = "the upper end of the riser does not follow the vessel"
            remedy = "write 'top.x: vessel', or remove vessel"
        yield Misfit("vessel", found, remedy, ("top.x",))
    if vessel is None:
        return
    if scene.platform:
        yield from _first_order(scene, vessel, scene.platform)
    if vessel.yaw and scene.spatial and scene.analysis.method == "explicit":
        found = "'analysis.method: explicit' does not include the forces of a turning hull"
        yield Misfit("vessel.yaw", found, USE_IMPLICIT, ("analysis.method",))
    for name in ("yaw", "coupling") if top.tensioners and top.tensioners.arrangement else ():
        if getattr(vessel, name, None):
            found = "does not work with top.tensioners.arrangement, whose cylinders pull at the vessel"
            remedy = f"remove vessel.{name}, or the arrangement"
            yield Misfit(f"vessel.{name}", found, remedy, ("top.tensioners.arrangement",))
    if scene.current and scene.current.ramp and (vessel.hull_drag or vessel.yaw):
        found = "does not work with a vessel with hull drag or yaw, on which the current acts from the start"
        yield Misfit("current.ramp", found, "remove current.ramp", ("vessel",))
    if vessel.hull_drag and scene.water is None:
        found, remedy = "requires water in the scene", "add water, or remove hull_drag"
        yield Misfit("vessel.hull_drag", found, remedy, ("water",))


def coupled(scene: Parts) -> Iterator[Misfit]:
    """With ``vessel.coupling``, no body, force or tensioner may act at the riser's top without a joint.

    Platform and riser exchange only the force of the riser's end.
    """
    if scene.vessel is None or scene.vessel.coupling is None:
        return
    yield from (fault.below("vessel.coupling") for fault in scene.vessel.coupling.misfits(scene.analysis))
    if scene.top.telescopic_joint:
        return
    for name in ("body", "lateral_force", "tensioners"):
        if getattr(scene.top, name) is not None:
            found = (
                f"requires that only the end of the riser acts on the vessel, but top.{name} acts on it, too"
            )
            remedy = f"add top.telescopic_joint, or remove vessel.coupling or top.{name}"
            yield Misfit("vessel.coupling", found, remedy, (f"top.{name}",))


def soil(scene: Parts) -> Iterator[Misfit]:
    """Soil and a foot require each other."""
    if (scene.bottom.hold == "foot") != (scene.soil is not None):
        if scene.soil is None:
            found = "missing, but 'bottom.hold: foot' (a conductor in the soil) requires it"
            remedy = "add soil, or write 'bottom.hold: wellhead'"
        else:
            found = f"has no effect on a riser with 'bottom.hold: {scene.bottom.hold}'"
            remedy = "write 'bottom.hold: foot' for a conductor in the soil, or remove soil"
        yield Misfit("soil", found, remedy, ("bottom.hold",))


def _first_order(scene: Parts, vessel: Vessel, platform: Platform) -> Iterator[Misfit]:
    """In a scene with a vessel, which must keep its heading, a platform has first-order motions only."""
    explicit = scene.analysis.method == "explicit"
    position = platform.position
    remedies: dict[str, tuple[object, str]] = {
        "platform.cruise": (platform.cruise, "remove it, since the motion of the vessel is computed"),
        "vessel.yaw": (
            vessel.yaw,
            "remove vessel.yaw or the platform, whose first-order motions require a constant heading",
        ),
        "vessel.coupling": (
            vessel.coupling,
            "remove vessel.coupling, or the first-order motions of platform",
        ),
        "analysis.method": (explicit, USE_IMPLICIT),
        "platform.position.surge": (
            position and position.surge,
            "give top.offset instead, which is the position of the vessel",
        ),
        "platform.position.sway": (
            position and position.sway,
            "remove it; top.offset is the position of the vessel",
        ),
    }
    for path, (there, remedy) in remedies.items():
        if there:
            found, also = "does not work in a scene with vessel and platform", ("vessel", "platform")
            yield Misfit(path, found, remedy, also)
