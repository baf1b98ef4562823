"""Mao, Zeng, Liu: elevation of the LMRP in still water, from which its rise is measured.

A record without a ramp of the current starts in the full current, in which the riser is already lifted.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.dataset.describe import scenes_of
from riserstudy.scene.resolve import Resolved


def largest_rise(heave: xr.Dataset) -> xr.DataArray:
    """Largest rise of the LMRP above its elevation in still water (m), over the points of a study."""
    rise: xr.DataArray = heave["z"].isel(s=0, drop=True).max("time") - hanging(heave)
    return rise


def hanging(heave: xr.Dataset) -> xr.DataArray:
    """Elevation of the LMRP (m) in still water below a platform at rest, over the points of a study."""
    points = heave["point_key"]
    elevations = np.array([_elevation(scene) for _, scene in scenes_of(heave)])
    return xr.DataArray(elevations.reshape(points.shape), points.coords, points.dims)


def _elevation(scene: Resolved) -> float:
    """Elevation of the LMRP (m) on a uniform riser of one section; stretch: (W + w L / 2) L / (E A)."""
    (pipe,), body = scene.riser, scene.bottom.body
    if body is None or scene.water is None or pipe.outer_diameter is None:
        raise TypeError("a riser that hangs with its LMRP has a pipe, a body and water")
    g = scene.gravity or 0.0
    area = 0.25 * np.pi * (pipe.outer_diameter**2 - (pipe.inner_diameter or 0.0) ** 2)
    stiffness = (pipe.young_modulus or 0.0) * area
    below = g * ((body.mass or 0.0) - scene.water.density * (body.displaced_volume or 0.0))
    length, weight = pipe.length or 0.0, pipe.submerged_weight or 0.0
    stretch = (below + 0.5 * weight * length) * length / stiffness
    return float((scene.top.elevation or 0.0) - length - stretch)
