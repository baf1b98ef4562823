"""Whether a current covers the riser and acts on a part of the scene."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.forcing import Shape
from riserstudy.scene.geometry import ROUNDED, span

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.forcing import Current
    from riserstudy.scene.parts import Parts


def acts(scene: Parts) -> Iterator[Misfit]:
    """A current requires drag, since it acts by drag alone."""
    in_water = [s.drag for s in scene.riser] + [b.drag_area and b.drag_area.horizontal for b in scene.bodies]
    on_hull = scene.vessel and scene.vessel.hull_drag
    if scene.current and not any(in_water) and not on_hull:
        found = "has no effect: no riser section, body or vessel has drag"
        yield Misfit("current", found, "add drag to a section, or remove current", ("riser", "vessel"))


def levels(scene: Parts) -> Iterator[Misfit]:
    """Depths and named shapes of a current require the elevations of mean water level and seabed."""
    water, flow = scene.water, scene.current
    if flow is None or water is None:
        return
    if flow.by_depth and water.surface is None:
        found = "depths require the elevation of the water surface"
        remedy = "add water.surface, or give elevations instead of depths"
        yield Misfit("current.profile", found, remedy, ("water.surface",))
    if None not in (water.surface, water.seabed):
        return
    for part in flow.parts:
        if not (isinstance(part, Shape) and None not in (part.seabed, part.surface)):
            found = "this profile requires the elevations of water surface and seabed"
            also = ("water.surface", "water.seabed")
            yield Misfit("current.profile", found, "add water.surface and water.seabed", also)
            return


def covers(scene: Parts) -> Iterator[Misfit]:
    """A current must be given for the whole length of the riser in the water."""
    flow, ends = scene.current, span(scene)
    if flow is None:
        return
    yield from _in_water(scene, flow)
    given = _levels(scene, flow)
    if flow.beyond is not None or given is None or ends is None:
        # `beyond` covers the rest, or the profile spans the sea, or the riser has no elevations
        return
    low, high = given
    seabed, surface = (scene.water.seabed, scene.water.surface) if scene.water else (None, None)
    needs_low = ends.bottom if seabed is None else max(ends.bottom, seabed)
    needs_high = ends.top if surface is None else min(ends.top, surface)
    slip = min(ROUNDED, 0.01 * (ends.top - ends.bottom))
    if low > needs_low + slip or high < needs_high - slip:
        yield Misfit(
            "current.profile",
            f"covers elevations from {low:g} m to {high:g} m only, but the riser is in water from "
            f"{needs_low:g} m to {needs_high:g} m",
            "extend the profile, or write 'current.beyond: hold' (the end values apply beyond) or "
            "'current.beyond: zero' (still water beyond)",
            ("water", "riser", "bottom.elevation", "top.elevation"),
        )


def _in_water(scene: Parts, flow: Current) -> Iterator[Misfit]:
    """Of points by elevation, one at least must be in the water: depths typed as elevations would not be."""
    surface = scene.water.surface if scene.water else None
    points = flow.profile if isinstance(flow.profile, list) else []
    elevations = [point.elevation for point in points if point.elevation is not None]
    if surface is not None and elevations and min(elevations) >= surface:
        yield Misfit(
            "current.profile",
            f"no point is in the water: the elevations are from {min(elevations):g} m to "
            f"{max(elevations):g} m, and the water surface is at {surface:g} m",
            "give elevations below the surface, or write 'depth' instead of 'elevation'",
            ("water.surface",),
        )


def _levels(scene: Parts, flow: Current) -> tuple[float, float] | None:
    """Lowest and highest elevation of a current profile (m); None if it spans from seabed to surface."""
    if isinstance(flow.profile, list):
        z, _ = flow.table(scene.water)
        return z[0], z[-1]
    lows = [low for part in flow.parts if (low := getattr(part, "seabed", None)) is not None]
    highs = [high for part in flow.parts if (high := getattr(part, "surface", None)) is not None]
    if not lows and not highs:
        return None
    return max(lows, default=-math.inf), min(highs, default=math.inf)
