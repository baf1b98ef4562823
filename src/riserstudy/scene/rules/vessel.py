"""Requirements of a freely floating vessel, and of the soil around a foot."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.forcing import Platform
    from riserstudy.scene.parts import Parts
    from riserstudy.scene.vessel import Vessel


def moored(scene: Parts) -> Iterator[Misfit]:
    """A vessel requires a riser's top that follows it, and forces that the engine can compute."""
    vessel, top = scene.vessel, scene.top
    if (vessel is None) != (top.x != "vessel"):
        remedy = "give both or neither"
        yield Misfit("vessel", "vessel and 'top.x: vessel' go together", remedy, ("top.x",))
    if vessel is None:
        return
    if scene.platform:
        yield from _first_order(scene, vessel, scene.platform)
    if vessel.yaw and scene.spatial and scene.analysis.method == "explicit":
        found = "explicit stepping does not include the forces of a turning hull"
        yield Misfit("vessel.yaw", found, "use an implicit method", ("analysis.method",))
    for name in ("yaw", "coupling") if top.tensioners and top.tensioners.arrangement else ():
        if getattr(vessel, name, None):
            found = "not simulated with top.tensioners.arrangement, whose cylinders pull at the vessel"
            remedy = f"leave out vessel.{name} or the arrangement"
            yield Misfit(f"vessel.{name}", found, remedy, ("top.tensioners.arrangement",))
    if scene.current and scene.current.ramp and (vessel.hull_drag or vessel.yaw):
        found = "the current acts on the hull of the vessel from the start"
        yield Misfit("current.ramp", found, "leave it out", ("vessel",))
    if vessel.hull_drag and scene.water is None:
        yield Misfit("vessel.hull_drag", "needs water", "add water", ("water",))


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
            found = f"top.{name} acts on the platform beside the riser"
            remedy = "put a telescopic_joint between, or leave coupling out"
            yield Misfit("vessel.coupling", found, remedy, (f"top.{name}",))


def soil(scene: Parts) -> Iterator[Misfit]:
    """Soil and a foot require each other."""
    if (scene.bottom.hold == "foot") != (scene.soil is not None):
        remedy = "give both or neither"
        yield Misfit("soil", "soil and 'bottom.hold: foot' go together", remedy, ("bottom.hold",))


def _first_order(scene: Parts, vessel: Vessel, platform: Platform) -> Iterator[Misfit]:
    """In a scene with a vessel, which must keep its heading, a platform has first-order motions only."""
    explicit = scene.analysis.method == "explicit"
    position = platform.position
    remedies: dict[str, tuple[object, str]] = {
        "platform.cruise": (platform.cruise, "the motion of the vessel is computed; leave the cruise out"),
        "vessel.yaw": (
            vessel.yaw,
            "first-order motions are defined for a constant heading; leave out vessel.yaw or the platform",
        ),
        "vessel.coupling": (
            vessel.coupling,
            "an exchange does not include first-order motions; leave out vessel.coupling or the platform",
        ),
        "analysis.method": (explicit, "explicit stepping has no first-order motions; use an implicit method"),
        "platform.position.surge": (
            position and position.surge,
            "the vessel rests at top.offset; give top.offset",
        ),
        "platform.position.sway": (
            position and position.sway,
            "the vessel rests at top.offset; leave it out",
        ),
    }
    for path, (there, remedy) in remedies.items():
        if there:
            found, also = "is not possible with a vessel and a platform", ("vessel", "platform")
            yield Misfit(path, found, remedy, also)
