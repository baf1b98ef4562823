"""How the riser's ends are held."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.parts import Parts


def held(scene: Parts) -> Iterator[Misfit]:
    """A riser must be held at one end at least, and must have the inputs that its supports require."""
    bottom, top = scene.bottom, scene.top
    if bottom.hold == "free" and top.z == "free" and not top.tensioners:
        remedy = "hold one, or hang the top on tensioners"
        yield Misfit("bottom.hold", "both ends are free", remedy, ("top.z", "top.tensioners"))
    if scene.lateral and top.x is None:
        yield Misfit("top.x", f"is needed, because of {scene.lateral}", "add it", (scene.lateral,))
    if top.z != "free" and bottom.hold == "free" and top.elevation is None:
        remedy = "add it"
        yield Misfit("top.elevation", "a hung-off riser needs top.elevation", remedy, ("bottom.hold",))
    for name in ("x", "z"):
        if scene.platform is None and getattr(top, name) == "platform":
            found, remedy = "top is on the platform: needs platform", "add platform"
            yield Misfit(f"top.{name}", found, remedy, ("platform",))
    if top.telescopic_joint and top.telescopic_joint.mid_stroke and bottom.hold == "free":
        found, remedy = "needs a lower end that is held", "give the joint's length alone"
        yield Misfit("top.telescopic_joint.mid_stroke", found, remedy, ("bottom.hold",))
    rig = top.tensioners
    if rig and rig.mid_stroke == "riser in equilibrium" and bottom.hold == "free":
        found, remedy = "needs a lower end that is held", "write 'riser unstretched'"
        yield Misfit("top.tensioners.mid_stroke", found, remedy, ("bottom.hold",))


def followed(scene: Parts) -> Iterator[Misfit]:
    """Translations of the platform must move the upper end or the tensioners; else they have no effect."""
    platform, top = scene.platform, scene.top
    if platform is None:
        return
    rig = top.tensioners
    across = top.x in ("platform", "vessel") or bool(rig and rig.arrangement)
    # the stroke of a free end is measured from the platform
    up = top.z != "held" or rig is not None
    given = platform.response.motions if platform.response and platform.response.motions else []
    for name, follows, end in (
        ("surge", across, "x"), ("sway", across, "x"), ("cruise", across, "x"), ("heave", up, "z"),
    ):  # fmt: skip
        paths = {
            f"platform.{name}": getattr(platform, name),
            f"platform.position.{name}": getattr(platform.position, name, None),
            "platform.response.motions": name in given,
        }
        for path in (path for path, value in paths.items() if value and not follows):
            found = f"{name} of the platform moves nothing: neither the upper end nor a tensioner follows it"
            yield Misfit(path, found, f"write 'top.{end}: platform'", (f"top.{end}",))
