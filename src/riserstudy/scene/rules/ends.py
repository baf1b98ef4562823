"""How the riser's ends are held."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.followed import NOTHING, followed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.parts import Parts


def held(scene: Parts) -> Iterator[Misfit]:
    """A riser must be held at one end at least, and must have the inputs that its supports require."""
    bottom, top = scene.bottom, scene.top
    if bottom.hold == "free" and top.z == "free" and not top.tensioners:
        remedy = "write 'bottom.hold: wellhead', or hold the top ('top.z'), or give top.tensioners"
        found = "both ends of the riser are free to move vertically"
        yield Misfit("bottom.hold", found, remedy, ("top.z", "top.tensioners"))
    if scene.lateral and top.x is None:
        found = f"missing, but the scene has lateral loads or motion ({scene.lateral})"
        yield Misfit("top.x", found, "add top.x, such as 'x: platform'", (scene.lateral,))
    if top.z != "free" and bottom.hold == "free" and top.elevation is None:
        found = "missing, but a hung-off riser requires it"
        yield Misfit("top.elevation", found, "add it", ("bottom.hold",))
    for name in ("x", "z"):
        if scene.platform is None and getattr(top, name) == "platform":
            found = "the top follows the platform, but the scene has no platform"
            yield Misfit(f"top.{name}", found, "add platform, or write 'held'", ("platform",))
    if top.telescopic_joint and top.telescopic_joint.mid_stroke and bottom.hold == "free":
        found, remedy = "requires a riser that is held at its lower end", "remove mid_stroke"
        yield Misfit("top.telescopic_joint.mid_stroke", found, remedy, ("bottom.hold",))
    rig = top.tensioners
    if rig and rig.mid_stroke == "riser in equilibrium" and bottom.hold == "free":
        found = f"{rig.mid_stroke!r} requires a riser that is held at its lower end"
        remedy = "write 'mid_stroke: riser unstretched'"
        yield Misfit("top.tensioners.mid_stroke", found, remedy, ("bottom.hold",))


def moves(scene: Parts) -> Iterator[Misfit]:
    """Motions of the platform must move the upper end or the tensioners; else they have no effect."""
    platform = scene.platform
    if platform is None:
        return
    response, follows = platform.response, followed(scene)
    given = response.motions if response and response.motions else []
    for name, is_followed in follows.items():
        paths = {
            f"platform.{name}": getattr(platform, name),
            f"platform.position.{name}": getattr(platform.position, name, None),
            "platform.response.motions": name in given,
        }
        end = "z" if name == "heave" else "x"
        for path in (path for path, value in paths.items() if value and not is_followed):
            yield Misfit(
                path,
                f"{name} of the platform {NOTHING}",
                f"write 'top.{end}: platform', or remove this motion",
                (f"top.{end}",),
            )
    if response and not any(follows[name] for name in response.moving):
        also = ("top.x", "top.z")
        yield Misfit("platform.response", NOTHING, "write 'top.x: platform' and 'top.z: platform'", also)
