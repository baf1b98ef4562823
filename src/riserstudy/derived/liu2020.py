"""Liu et al. 2020: tension in every reading, statics beside other methods, axial force under heave."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.derived.liu2020_motion import (
    rao,
    rao_readings,
    rao_table,
    roll,
    roll_assumed,
    roll_readings,
    storm,
    surge,
    surge_readings,
    waves,
)
from riserstudy.derived.liu2020_statics import dat_force, dat_force_calibrated, statics_readings
from riserstudy.derived.methods import beamlike, by_collocation, by_hermite_elements
from riserstudy.derived.shared import (
    described,
    first_harmonic,
    half_swing,
    sampled,
    scenes_of,
    settling,
)

__all__ = [
    "codes",
    "codes_readings",
    "current_profiles",
    "dat_force",
    "dat_force_calibrated",
    "heave",
    "heave_readings",
    "rao",
    "rao_readings",
    "rao_table",
    "roll",
    "roll_assumed",
    "roll_readings",
    "statics_readings",
    "storm",
    "surge",
    "surge_readings",
    "tension_readings",
    "waves",
]

PAPER = "liu2020"
#: deg, of cylinders between ring and deck, all alike
INCLINATIONS = (0.0, 2.0, 5.7, 9.5, 11.3, 12.8)


def tension_readings(tension: xr.Dataset) -> xr.Dataset:
    """Tension of all cylinders at rest over the readings of Table 2, upright and inclined.

    An inclined cylinder carries its pull times the cosine; the ring's height hardly changes.
    """
    pull = tension["tensioner_force_static"].sum("cylinder")
    lean = xr.DataArray(list(INCLINATIONS), dims="inclination", name="inclination")
    lean = lean.assign_coords(inclination=lean)
    found = xr.Dataset({"top_tension": pull * np.cos(np.deg2rad(lean))})
    return described(found, PAPER, "top tension at rest in every reading")


def current_profiles(check_riser: xr.Dataset) -> xr.Dataset:
    """Speed of the current over its surface speed, over (current_profile, depth)."""
    length = float(check_riser["s_node"][-1])
    depth = xr.DataArray(np.linspace(0.0, length, 201), dims="depth", name="depth")
    shares = {}
    for place, scene in scenes_of(check_riser.isel(contents=[0])):
        speed = beamlike(scene).current(length - depth.values)
        shares[place["current_profile"]] = depth.copy(data=speed / speed[0])
    names = xr.DataArray(list(shares), dims="current_profile", name="current_profile")
    table = xr.concat(shares.values(), names).assign_coords(depth=depth)
    return described(table.to_dataset(name="current_share"), PAPER, "current profiles (assumed)")


def codes(check_riser: xr.Dataset) -> xr.Dataset:
    """Displacement of the riser of Fig 10 over (code, contents, current_profile, depth)."""
    length = float(check_riser["s_node"][-1])
    depth = xr.DataArray(np.linspace(0.0, length, 201), dims="depth", name="depth")
    at = length - depth
    ours = check_riser["x_static"].interp(s_node=at, method="cubic").drop_vars("s_node")
    found = {"lumped masses": ours.assign_coords(depth=depth)}
    for name, solve in (
        ("Hermite elements", by_hermite_elements),
        ("collocation", by_collocation),
    ):
        other = found["lumped masses"].copy(deep=True)
        for place, scene in scenes_of(check_riser):
            other.loc[place] = solve(beamlike(scene), at.values)
        found[name] = other
    names = xr.DataArray(list(found), dims="code", name="code")
    table = xr.concat(found.values(), names).to_dataset(name="displacement")
    table = table.squeeze("surface_speed", drop=True)
    table["codes_apart"] = _apart(table["displacement"])
    return described(table, PAPER, "displacement of the riser of Fig 10 by three methods")


def codes_readings(check_open: xr.Dataset) -> xr.Dataset:
    """How far three methods are apart for every sample of what the paper leaves open."""
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
    found = apart.squeeze("surface_speed", drop=True).to_dataset(name="codes_apart")
    found = found.assign(sampled(check_open))
    return described(found, PAPER, "difference of three methods over what the paper leaves open")


def _apart(moved: xr.DataArray) -> xr.DataArray:
    """Largest difference between methods over the largest displacement."""
    largest = abs(moved).max(["depth", "code"])
    return (moved.max("code") - moved.min("code")).max("depth") / largest


def heave(heave_runs: xr.Dataset) -> xr.Dataset:
    """Amplitude of the axial force over (heave_amplitude, heave_period), gas law and linear."""
    found = _axial_force(heave_runs.sel(tensioner_model="gas law", drop=True))
    linear = _axial_force(heave_runs.sel(tensioner_model="linear", drop=True))
    found["axial_force_amplitude_linear"] = linear["axial_force_amplitude"]
    return described(found, PAPER, "amplitude of the axial force, platform heaving")


def heave_readings(heave_open: xr.Dataset) -> xr.Dataset:
    """The same for every sample of what the paper leaves open."""
    found = _axial_force(heave_open).assign(sampled(heave_open))
    return described(found, PAPER, "amplitude of the axial force over what the paper leaves open")


def _axial_force(runs: xr.Dataset) -> xr.Dataset:
    """Amplitudes at the riser's ends over the last period, lag between them, and how settled they are."""
    tension = runs["effective_tension"]
    swing = half_swing(tension, "heave_period")
    ends = first_harmonic(tension, "heave_period")
    lag = xr.apply_ufunc(np.angle, ends.isel(s=-1, drop=True) / ends.isel(s=0, drop=True))
    return xr.Dataset(
        {
            "axial_force_amplitude": swing.isel(s=0, drop=True),
            "axial_force_amplitude_top": swing.isel(s=-1, drop=True),
            "axial_force_lag": lag,
            "settling": settling(tension, "heave_period").max("s"),
        }
    )
