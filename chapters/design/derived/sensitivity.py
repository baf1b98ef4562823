"""Design, sensitivity: effect of one input at a time on the tension window and the drilling offsets."""

from __future__ import annotations

import math
from typing import Any

import xarray as xr

from chapters.design.derived.operability import allowed
from chapters.design.derived.tension import window_of
from riserstudy.dataset.describe import described, scenes_of
from riserstudy.errors import SimulationError
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.units import to_si

PAPER = "design"
MODE = "drilling"
BASE = "base"


def sensitivity(
    varied: xr.Dataset, settings_varied: dict[str, dict[str, Any]], **settings: Any
) -> xr.Dataset:
    """Return the width of the tension window and the range of drilling offsets, one input at a time.

    Raises SimulationError when a limit cannot be evaluated.

    Parameters
    ----------
    varied : risers at rest over ``varied_input``, the first with all inputs as assumed.
    settings_varied : further variations by name, each with the settings that it changes.
    settings : settings of ``tension_window``, with a number as ``failed``, and of ``operability``.
    """
    scenes = {str(place["varied_input"]): scene for place, scene in scenes_of(varied)}
    gaps = {name: _gap(scene, settings) for name, scene in scenes.items()}
    rooms = {name: _room(scene, settings) for name, scene in scenes.items()}
    for name, changed in settings_varied.items():
        own = settings | changed
        own["allowances"] = settings["allowances"] | changed.get("allowances", {})
        gaps[name] = _gap(scenes[BASE], own)
        rooms[name] = _room(scenes[BASE], own) if "allowances" in changed else rooms[BASE]
    over = "varied_input"
    made = xr.Dataset(
        {
            "setting_gap": (over, [gaps[name] for name in gaps]),
            "drilling_room": (over, [rooms[name] for name in gaps]),
        },
        {over: list(gaps)},
    )
    return described(made, PAPER, "effect of the assumed inputs")


def _gap(scene: Resolved, settings: dict[str, Any]) -> float:
    return window_of(scene, settings, settings["failed"]).gap


def _room(scene: Resolved, settings: dict[str, Any]) -> float:
    from riserstudy.design.operability import AtRest, offsets_at  # loads kernels

    limits = [limit for limit in scene.limits or [] if limit.mode == MODE]
    reach = to_si(settings["reach"], "m")
    found = offsets_at(AtRest(scene, reach), limits, reach, allowed(settings["allowances"]))
    if missing := next((one.missing for one in found if one.missing), ""):
        raise SimulationError(f"range of drilling offsets: not evaluated, because of {missing}")
    if any(math.isnan(one.low) for one in found):
        return 0.0
    return max(min(one.high for one in found) - max(one.low for one in found), 0.0)
