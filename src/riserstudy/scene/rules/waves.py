"""Requirements of waves and vortices."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.alike import alike
from riserstudy.scene.analysis import USE_IMPLICIT
from riserstudy.scene.base import ALONG_X

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.parts import Parts


def sea(scene: Parts) -> Iterator[Misfit]:
    """A wave requires a sea of known depth, gravity, and sections or bodies with drag or added mass."""
    response = scene.platform and scene.platform.response
    if response and response.wave is None and scene.wave is None:
        found = "requires a wave"
        remedy = "add platform.response.wave (motion only) or wave (motion and forces on the riser)"
        yield Misfit("platform.response", found, remedy, ("wave",))
    if scene.wave is None:
        return
    if scene.water is None or None in (scene.water.surface, scene.water.seabed):
        found = "requires the elevations of water surface and seabed"
        also = ("water.surface", "water.seabed")
        yield Misfit("wave", found, "add water.surface and water.seabed", also)
    if scene.gravity is None:
        found, remedy = "requires gravity in the scene", "add gravity, or remove wave"
        yield Misfit("wave", found, remedy, ("gravity",))
    on_bodies = any(body.drag_area or body.added_mass for body in scene.bodies)
    if not on_bodies and not any(s.drag or s.added_mass for s in scene.riser):
        found = "has no effect: no riser section and no body has drag or added mass"
        yield Misfit("wave", found, "add drag or added_mass to a section, or remove wave", ("riser",))
    for k, section in enumerate(scene.riser):
        if section.added_mass and section.added_mass.direction:
            found = "a wave requires added mass in all directions across the pipe"
            remedy = "remove direction from added_mass"
            yield Misfit(f"riser[{k}].added_mass.direction", found, remedy, ("wave",))


def along_axes(scene: Parts) -> Iterator[Misfit]:
    """Response amplitude operators require a hull along x: they refer to the axes of scene and hull alike."""
    platform, vessel = scene.platform, scene.vessel
    if platform is None or platform.response is None:
        return
    turns = {
        "platform.position.yaw": platform.position and platform.position.yaw,
        "vessel.heading": vessel and vessel.heading,
    }
    for path, turn in turns.items():
        if turn and abs(math.sin(0.5 * turn)) > ALONG_X:
            found = f"{math.degrees(turn):.4g} deg turns the hull, but not the RAOs in platform.response"
            remedy = "remove this angle, and turn the headings of wave, current and wind instead"
            yield Misfit(path, found, remedy, ("platform.response",))


def viv(scene: Parts) -> Iterator[Misfit]:
    """Vortex-induced vibration requires a flow, a duration, and drag, which limits the amplitude."""
    shedding = {f"riser[{k}].viv": s for k, s in enumerate(scene.riser) if s.viv}
    if not shedding:
        return
    for path, section in shedding.items():
        if section.drag is None or section.drag.direction:
            found = "vortex-induced vibration requires drag across the pipe, which limits the amplitude"
            remedy = "add drag without a direction to this section"
            yield Misfit(path, found, remedy, (path.replace("viv", "drag"),))
    first = next(iter(shedding))
    if not scene.current and not scene.wave:
        found = "vortex-induced vibration requires water that flows past the riser"
        yield Misfit(first, found, "add a current or a wave, or remove viv", ("current", "wave"))
    if scene.analysis.duration is None:
        found = "vortex-induced vibration requires a dynamic run"
        remedy = "add analysis.duration and output, or remove viv"
        yield Misfit(first, found, remedy, ("analysis.duration",))
    if scene.analysis.method == "explicit":
        found = "'analysis.method: explicit' does not include vortex-induced vibration"
        yield Misfit(first, found, USE_IMPLICIT, ("analysis.method",))
    if not scene.current and any(s.viv.ramp is None for s in shedding.values() if s.viv):
        remedy = "add it, since its default is defined only with a current"
        yield Misfit(f"{first}.ramp", "missing", remedy, ("current",))
    for name in ("ramp", "seed"):
        if not alike(getattr(s.viv, name) for s in shedding.values()):
            remedy = f"give the same {name} to all sections with viv"
            yield Misfit(f"{first}.{name}", "differs between sections", remedy, tuple(shedding))
