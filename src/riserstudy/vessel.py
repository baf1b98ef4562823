"""The record of a platform that is free to surge."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.vessel import Vessel
from riserstudy.scene.models import Scene
from riserstudy.sea import current_table

#: what a vessel reports over time, in the order of its probes
VESSEL_PROBES = ("platform_speed_x", "riser_reaction_x", "environment_force_x", "thrust_x")


def vessel(scene: Scene, node: int, probe: int) -> Vessel:
    """Record of the vessel at a node."""
    of = scene.vessel
    if of is None:
        raise TypeError("a scene without vessel")
    thrusters, wind = of.thrusters, of.wind
    current, heading = 0.0, 0.0
    if scene.current and scene.water:
        z, speed = current_table(scene.current, scene.water)
        level = scene.water.surface if scene.water.surface is not None else float(z[-1])
        current, heading = float(np.interp(level, z, speed)), scene.current.heading or 0.0
    return Vessel(
        node=node,
        mass=of.mass + (of.added_mass or 0.0),
        hull=of.hull_drag or 0.0,
        current=_towards(current, heading),
        area=wind.drag if wind else 0.0,
        wind=_towards(wind.speed, wind.heading or 0.0) if wind else np.zeros(2),
        drift=of.wave_drift.along if of.wave_drift else 0.0,
        gain=thrusters.gain if thrusters else 0.0,
        damping=(thrusters.velocity_gain or 0.0) if thrusters else 0.0,
        command=thrusters.command if thrusters else 0.0,
        rise=(thrusters.rise or 0.0) if thrusters else 0.0,
        saturation=(thrusters.saturation or math.inf) if thrusters else math.inf,
        probe=probe,
    )


def _towards(speed: float, heading: float) -> NDArray[np.float64]:
    """A velocity along and across x."""
    return speed * np.array([math.cos(heading), math.sin(heading)])
