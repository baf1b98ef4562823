"""Design, tension: minimum top tension by formula and by simulation, and the window of the setting."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from riserstudy.dataset.describe import described, scenes_of
from riserstudy.design import tension
from riserstudy.design.tension import Rig, Tolerances
from riserstudy.design.window import WEIGHED, Ceiling, Window, lift_off, window
from riserstudy.design.window import window_of as window_of_scene
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.units import to_si

PAPER = "design"
FLOORS = ("minimum tension", "LMRP lift-off")


def minimum_tension(muds: xr.Dataset, weight: float, buoyancy: float) -> xr.Dataset:
    """Return the tension at which no point of the riser is slack, by the formula and by the engine.

    Parameters
    ----------
    muds : risers at rest over ``mud_weight``.
    weight, buoyancy : tolerances (shares) of steel weight and of the buoyancy of modules.
    """
    from riserstudy.design import engine_tension  # which loads kernels

    tolerances = Tolerances(weight, buoyancy)
    by_formula, by_engine, at, elevation = [], [], [], np.empty(0)
    for _, scene in scenes_of(muds):
        by_formula.append(tension.needed(scene, tolerances))
        slack = engine_tension.needed(scene, tolerances)
        by_engine.append(slack.tension)
        at.append(slack.s)
        elevation = tension.columns_above(scene).elevation
    mud = muds["mud_weight"]
    along = xr.DataArray(
        np.array(by_formula),
        dims=("mud_weight", "elevation"),
        coords={"mud_weight": mud, "elevation": elevation},
    )
    made = xr.Dataset({"carrying_tension_along": along, "carrying_tension": along.max("elevation")})
    made["governing_elevation"] = along["elevation"][along.argmax("elevation")].drop_vars("elevation")
    made["carrying_tension_engine"] = ("mud_weight", np.array(by_engine))
    made["slack_s"] = ("mud_weight", np.array(at))
    return described(made, PAPER, "minimum top tension by formula and by simulation")


def tension_window(muds: xr.Dataset, failed: list[int], **settings: Any) -> xr.Dataset:
    """Return lower and upper limits of the setting over mud weight and failed units, and the gap.

    The lower limits are calculated by the formula, and by the engine with the riser in its current.

    Parameters
    ----------
    failed : numbers of failed units.
    settings : as for `window_of`.
    """
    from riserstudy.design import engine_tension  # which loads kernels

    shape = (muds.sizes["mud_weight"], len(failed))
    floors, by_engine = np.zeros((*shape, len(FLOORS))), np.zeros((*shape, len(FLOORS)))
    ceiling, gap = np.zeros(shape), np.zeros(shape)
    for i, (_, scene) in enumerate(scenes_of(muds)):
        slack = engine_tension.needed(scene, _tolerances(settings)).tension
        weighed = engine_tension.needed(scene, WEIGHED).tension
        for j, n in enumerate(failed):
            of = window_of(scene, settings, n)
            floors[i, j] = [of.floors[name] for name in FLOORS]
            engine = _window(scene, settings, n, slack, weighed)
            by_engine[i, j] = [engine.floors[name] for name in FLOORS]
            ceiling[i, j], gap[i, j] = of.ceilings[of.ceiling], of.gap
    over = ("mud_weight", "failed_units")
    coords = {"mud_weight": muds["mud_weight"], "failed_units": failed, "floor": list(FLOORS)}
    made = xr.Dataset(
        {
            "setting_floor": ((*over, "floor"), floors),
            "setting_floor_engine": ((*over, "floor"), by_engine),
            "setting_ceiling": (over, ceiling),
            "setting_gap": (over, gap),
        },
        coords,
    )
    return described(made, PAPER, "window of the tension setting")


def window_of(scene: Resolved, settings: dict[str, Any], failed: int) -> Window:
    """Return the window of a scene's setting with the given number of failed units.

    Parameters
    ----------
    settings : ``weight``, ``buoyancy``: tolerances of steel and modules; ``units``, ``tension_ratio``,
        ``fleet_angle``: of the tensioners; ``overpull``: required effective tension between LMRP and stack;
        ``dynamic_limit``, ``share``: dynamic tension limit of all units, and the largest share for a setting.
    """
    overpull = to_si(settings["overpull"], "N")
    tolerances = _tolerances(settings)
    return window_of_scene(scene, tolerances, _rig(settings, failed), overpull, _ceiling(settings))


def _window(scene: Resolved, settings: dict[str, Any], failed: int, needed: float, weighed: float) -> Window:
    """Return the window from the vertical tensions (N) with tolerances on the weights, and without."""
    off = lift_off(scene, to_si(settings["overpull"], "N"), weighed)
    return window(needed, off, _rig(settings, failed), *_ceiling(settings))


def _ceiling(settings: dict[str, Any]) -> Ceiling:
    return Ceiling(to_si(settings["dynamic_limit"], "N"), settings["share"])


def _tolerances(settings: dict[str, Any]) -> Tolerances:
    return Tolerances(settings["weight"], settings["buoyancy"])


def _rig(settings: dict[str, Any], failed: int) -> Rig:
    angle = to_si(settings["fleet_angle"], "rad")
    return Rig(settings["units"], failed, settings["tension_ratio"], angle)
