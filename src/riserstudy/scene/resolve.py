"""The scene as the model needs it, with all derived quantities computed.

Each step takes a scene and returns one. Quantities that follow from several parts are computed here, once.
"""

from __future__ import annotations

from typing import Any

from riserstudy.inputs.misfit import Misfit
from riserstudy.records.numerals import newtons
from riserstudy.scene.disconnect import too_late
from riserstudy.scene.ends import TensionLoss
from riserstudy.scene.forcing import Translation
from riserstudy.scene.geometry import at_level, span
from riserstudy.scene.parts import Parts
from riserstudy.scene.waterline import cut
from riserstudy.scene.weight import weighed, with_attachments

JOINT = "top.telescopic_joint.tension"


class Resolved(Parts):
    """A scene with all derived quantities: sections have weights, releases have times."""


def resolve(scene: Parts) -> Resolved:
    """The scene with all quantities that follow from its parts, which must have passed `check_rules`.

    Raises Misfit if a quantity cannot be derived, or its value is impossible.
    """
    resolved = Resolved.model_construct(scene.model_fields_set, **dict(scene))
    for step in (_bodies, _loaded, _sections, _carried, _timed, _valved, _with_rigid_body):
        resolved = step(resolved)
    return resolved


def _bodies(scene: Resolved) -> Resolved:
    """The scene with the weights in air of bodies above the water surface that are given without weight."""
    ends, surface = span(scene), scene.water.surface if scene.water else None
    if ends is None or surface is None:
        return scene
    ring = ends.bottom + sum(section.total_length for section in scene.riser)
    for name, elevation in (("bottom", ends.bottom), ("top", ring)):
        end = getattr(scene, name)
        body, dry = end.body, at_level(surface, elevation) >= surface
        if body and dry and body.submerged_weight is None and not body.weightless:
            air = body.weight(scene.gravity or 0.0, 0.0)
            body = body.replaced(submerged_weight=air, density=None, displaced_volume=None)
            scene = scene.replaced(**{name: end.replaced(body=body)})
    return scene


def _loaded(scene: Resolved) -> Resolved:
    """The scene with the weights and the top tension that follow from a buoyant factor."""
    if scene.buoyancy is None:
        return scene
    path, sections = "buoyancy", scene.riser
    if scene.gravity is None or not all(s.mass for s in sections):
        found, also = "requires gravity and the mass of every section", ("gravity", "riser")
        raise Misfit(path, found, "add gravity and masses, or remove buoyancy", also)
    if any(s.modules or s.lines for s in sections):
        found = "does not work with modules or lines of sections"
        raise Misfit(path, found, "remove buoyancy, or the modules and lines", ("riser",))
    if any(s.submerged_weight is not None for s in sections) or scene.top.tension is not None:
        found = "determines submerged_weight and top.tension, which are also given"
        remedy = "remove buoyancy, or remove submerged_weight and top.tension"
        raise Misfit(path, found, remedy, ("riser", "top.tension"))
    if scene.top.z != "free" or scene.top.tensioners:
        found = "determines the top tension, which requires 'top.z: free' without tensioners"
        remedy = "write 'top.z: free' and remove top.tensioners, or remove buoyancy"
        raise Misfit(path, found, remedy, ("top.z", "top.tensioners"))
    riser, tension = scene.buoyancy.loads(sections, scene.gravity)
    return scene.replaced(riser=riser, top=scene.top.replaced(tension=tension + scene.ring_weight))


def _sections(scene: Resolved) -> Resolved:
    """The scene with sections divided at the water surface, weighed, and with modules and lines added."""
    for sections in (cut, weighed, with_attachments):
        riser = sections(scene)
        scene = scene if riser is scene.riser else scene.replaced(riser=riser)
    return scene


def _carried(scene: Resolved) -> Resolved:
    """The scene with the linear tensioner law that follows from the suspended weight."""
    rig, path = scene.top.tensioners, "top.tensioners.carried"
    if rig is None or rig.carried is None:
        return scene
    if scene.bottom.hold != "free":
        found = "requires a hung-off riser, whose weight the tensioners carry"
        remedy = "write 'bottom.hold: free', or give another tensioner law"
        raise Misfit(path, found, remedy, ("bottom.hold",))
    if scene.gravity is None:
        found = "requires gravity, from which the weight of the riser is computed"
        raise Misfit(path, found, "add gravity", ("gravity",))
    weight, mass = scene.hanging
    if weight <= 0.0:
        found = f"the submerged weight of the hung-off riser is {weight:g} N, so the tensioners carry nothing"
        raise Misfit(path, found, "increase the weight of riser and body above 0 N", ("riser",))
    place, joint = rig.arrangement, scene.top.telescopic_joint
    for other, pull in (("top.tension", scene.top.tension), (JOINT, joint and joint.tension)):
        if pull:
            found = f"{newtons(pull)} would lift the riser, since top.tensioners.carried carries its weight"
            remedy = "remove it, or replace 'carried' by 'linear' in top.tensioners"
            raise Misfit(other, found, remedy, (path,))
    ring = (scene.top.elevation or 0.0) - (joint.length if joint else 0.0)
    if place and place.deck_elevation <= ring:
        found = f"{place.deck_elevation:g} m is not above the tension ring at {ring:g} m"
        remedy = f"give an elevation above {ring:g} m"
        raise Misfit("top.tensioners.arrangement.deck_elevation", found, remedy, ("top.elevation",))
    return scene.replaced(top=scene.top.replaced(tensioners=rig.carrying(weight, mass, ring)))


def _timed(scene: Resolved) -> Resolved:
    """The scene with the time of the release that follows from its phase of heave."""
    release, path = scene.disconnect, "disconnect.phase"
    if release is None or release.phase is None:
        return scene
    heave = scene.platform.heave if scene.platform else None
    if not isinstance(heave, Translation):
        found = "requires a platform.heave that is a single harmonic (amplitude and period)"
        remedy = "write such a platform.heave, or remove phase"
        raise Misfit(path, found, remedy, ("platform.heave",))
    timed = release.timed(heave.period, heave.phase or 0.0)
    times, duration = {path: timed.at} | timed.times, scene.analysis.duration or 0.0
    if fault := next(too_late(times, duration, "platform.heave"), None):
        raise fault
    return scene.replaced(disconnect=timed)


def _valved(scene: Resolved) -> Resolved:
    """The scene with the loss of top tension that valves cause after the release."""
    release = scene.disconnect
    if release is None or release.valve is None or not scene.top.tension:
        return scene
    left = 1.0 - release.valve.hold * scene.hanging[0] / scene.top.tension
    if not left > 0.0:
        found = (
            f"{release.valve.hold:g} times the suspended weight {newtons(scene.hanging[0])} is not less than "
            f"top.tension {newtons(scene.top.tension)}"
        )
        allowed = "give a smaller hold, or a larger top.tension"
        raise Misfit("disconnect.valve.hold", found, allowed, ("top.tension",))
    share = (1.0 - (release.valve.failed or 0.0)) * left
    loss = TensionLoss.model_construct(share=share, at=release.at, over=release.valve.over)
    return scene.replaced(top=scene.top.replaced(tension_loss=loss))


def _with_rigid_body(scene: Resolved) -> Resolved:
    """The scene with a rigid section below the riser, which represents the body that turns with its end."""
    body = scene.bottom.body
    if body is None or not body.reach:
        return scene
    rigid = scene.riser[0].rigid(body.name, body.reach)
    changed: dict[str, Any] = {"riser": [rigid, *scene.riser]}
    a = scene.analysis
    if a.output and a.output.stations:
        # stations count from the lower end of the riser, which is above the body
        raised = [body.reach + s for s in a.output.stations]
        changed["analysis"] = a.replaced(output=a.output.replaced(stations=raised))
    return scene.replaced(**changed)
