"""Statics of the check riser compared with other methods, in the assumed currents."""

from __future__ import annotations

import numpy as np
import xarray as xr

from chapters.liu2020.second_methods import beamlike, by_collocation, by_hermite_elements
from riserstudy.dataset.describe import described, sampled, scenes_of
from riserstudy.model.sea import current_table

PAPER = "liu2020"


def current_profiles(check_riser: xr.Dataset, statics_calibrated: xr.Dataset) -> xr.Dataset:
    """Ratio of the current speed to its surface speed, over (current_profile, depth).

    The last two profiles are calibrated to the tensioners' horizontal force.
    """
    length = float(check_riser["s_node"][-1])
    depth = xr.DataArray(np.linspace(0.0, length, 201), dims="depth", name="depth")
    shares = {}
    for place, scene in scenes_of(check_riser.isel(contents=[0])):
        speed = beamlike(scene).current(length - depth.values)
        shares[place["current_profile"]] = depth.copy(data=speed / speed[0])
    surface = 1.0
    tuned = statics_calibrated.sel(tensioner_model=["gas law"], surface_speed=[surface])
    for place, scene in scenes_of(tuned):
        if scene.current is None or scene.water is None:
            raise TypeError("a scene without current")
        level, speed = current_table(scene.current, scene.water)
        fades = np.interp(scene.water.surface - depth.values, level, speed)
        shares[f"calibrated: {place['calibration']}"] = depth.copy(data=fades / surface)
    names = xr.DataArray(list(shares), dims="current_profile", name="current_profile")
    table = xr.concat(shares.values(), names).assign_coords(depth=depth)
    return described(table.to_dataset(name="current_share"), PAPER, "current profiles (assumed)")


def codes(check_riser: xr.Dataset) -> xr.Dataset:
    """Displacement of the riser of Fig 10 over (code, contents, current_profile, depth)."""
    length = float(check_riser["s_node"][-1])
    depth = xr.DataArray(np.linspace(0.0, length, 201), dims="depth", name="depth")
    at = length - depth
    ours = check_riser["x_static"].interp(s_node=at, method="cubic").drop_vars("s_node")
    curves = {"lumped masses": ours.assign_coords(depth=depth)}
    for name, solve in (("Hermite elements", by_hermite_elements), ("collocation", by_collocation)):
        other = curves["lumped masses"].copy(deep=True)
        for place, scene in scenes_of(check_riser):
            other.loc[place] = solve(beamlike(scene), at.values)
        curves[name] = other
    names = xr.DataArray(list(curves), dims="code", name="code")
    table = xr.concat(curves.values(), names).to_dataset(name="displacement")
    table = table.squeeze("surface_speed", drop=True)
    table["codes_apart"] = _apart(table["displacement"])
    return described(table, PAPER, "displacement of the riser of Fig 10 by three methods")


def codes_readings(check_open: xr.Dataset) -> xr.Dataset:
    """Largest difference between three methods, for every sample of the unspecified inputs."""
    apart = xr.zeros_like(check_open["elements"], dtype=float)
    for place, scene in scenes_of(check_open):
        beam = beamlike(scene)
        at = np.linspace(0.0, beam.length, 201)
        ours = check_open["x"].sel(place).dropna("s")
        curves = [
            ours.interp(s=at, method="cubic").values,
            by_hermite_elements(beam, at),
            by_collocation(beam, at),
        ]
        apart.loc[place] = _apart(xr.DataArray(curves, dims=("code", "depth")))
    dataset = apart.squeeze("surface_speed", drop=True).to_dataset(name="codes_apart")
    dataset = dataset.assign(sampled(check_open))
    return described(dataset, PAPER, "difference of three methods, for samples of the unspecified inputs")


def _apart(moved: xr.DataArray) -> xr.DataArray:
    """Largest difference between methods, divided by the largest displacement."""
    largest = abs(moved).max(["depth", "code"])
    return (moved.max("code") - moved.min("code")).max("depth") / largest
