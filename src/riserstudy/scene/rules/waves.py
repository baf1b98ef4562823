"""Requirements of waves and vortices."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.alike import alike
from riserstudy.scene.base import ALONG_X

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.parts import Parts


def sea(scene: Parts) -> Iterator[Misfit]:
    """A wave requires a sea of known depth, gravity, and sections with drag or added mass."""
    response = scene.platform and scene.platform.response
    if response and response.wave is None and scene.wave is None:
        found, remedy = "needs a wave", "add wave to it or to the scene"
        yield Misfit("platform.response", found, remedy, ("wave",))
    if scene.wave is None:
        return
    if scene.water is None or None in (scene.water.surface, scene.water.seabed):
        found, also = "needs water.surface and water.seabed", ("water.surface", "water.seabed")
        yield Misfit("wave", found, "add both", also)
    if scene.gravity is None:
        yield Misfit("wave", "needs gravity", "add gravity", ("gravity",))
    if not any(s.drag or s.added_mass for s in scene.riser):
        found = "needs a riser section with drag or added mass"
        yield Misfit("wave", found, "add one, or leave wave out", ("riser",))
    for k, section in enumerate(scene.riser):
        if section.added_mass and section.added_mass.direction:
            found, remedy = "a wave needs added_mass across the pipe", "leave its direction out"
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
            found = f"{math.degrees(turn):.4g} deg turns the hull, but not the RAOs of platform.response"
            remedy = "leave it out, and turn wave, current and wind in the scene instead"
            yield Misfit(path, found, remedy, ("platform.response",))


def viv(scene: Parts) -> Iterator[Misfit]:
    """Vortex-induced vibration requires a flow, a duration, and drag, which limits the amplitude."""
    shedding = {f"riser[{k}].viv": s for k, s in enumerate(scene.riser) if s.viv}
    if not shedding:
        return
    for path, section in shedding.items():
        if section.drag is None or section.drag.direction:
            found, remedy = "needs drag across the pipe", "add it: it limits the amplitude"
            yield Misfit(path, found, remedy, (path.replace("viv", "drag"),))
    first = next(iter(shedding))
    if not scene.current and not scene.wave:
        found, also = "needs water that flows past the riser", ("current", "wave")
        yield Misfit(first, found, "add a current or a wave", also)
    if scene.analysis.duration is None:
        found, remedy = "needs analysis.duration", "add it: a static scene has no vortices"
        yield Misfit(first, found, remedy, ("analysis.duration",))
    if scene.analysis.method == "explicit":
        found, remedy = "explicit stepping does not include vortices", "use an implicit method"
        yield Misfit(first, found, remedy, ("analysis.method",))
    if not scene.current and any(s.viv.ramp is None for s in shedding.values() if s.viv):
        remedy = "it has no default without a current"
        yield Misfit(f"{first}.ramp", "missing", remedy, ("current",))
    for name in ("ramp", "seed"):
        if not alike(getattr(s.viv, name) for s in shedding.values()):
            remedy = f"{name} must be the same in all sections"
            yield Misfit(f"{first}.{name}", "differs between sections", remedy, tuple(shedding))
