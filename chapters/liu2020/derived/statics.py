"""Liu et al. 2020, statics: horizontal force of the tensioners, displacement and moment by baseline."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from chapters.liu2020.below_ring import largest_moment, on_riser, ring_of
from riserstudy.dataset.describe import described, sampled, scenes_of
from riserstudy.scene.resolve import Resolved

PAPER = "liu2020"
#: the cylinders whose force equals the printed force, by calibration
COUNTED = {"8765 N by all cylinders": "all cylinders", "8765 N by one cylinder": "one cylinder"}
NEAR = 60.0  # m below the ring; the text calls this range near the sea surface
#: deg, of the cylinders between ring and deck, equal for all of them
INCLINATIONS = (0.0, 2.0, 5.7, 9.5, 11.3, 12.8)


def tension_readings(tension: xr.Dataset) -> xr.Dataset:
    """Static tension of all cylinders in every interpretation of Table 2, upright and inclined.

    The vertical part of an inclined cylinder's force is the force times the cosine of the inclination. The
    ring's height hardly changes.
    """
    pull = tension["tensioner_force_static"].sum("cylinder")
    lean = xr.DataArray(list(INCLINATIONS), dims="inclination", name="inclination")
    lean = lean.assign_coords(inclination=lean)
    dataset = xr.Dataset({"top_tension": pull * np.cos(np.deg2rad(lean))})
    return described(dataset, PAPER, "static top tension in every interpretation")


def dat_force(statics: xr.Dataset) -> xr.Dataset:
    """Horizontal force of the tensioners on the ring over (counted, current_profile, surface_speed)."""
    dataset = _force(statics.sel(tensioner_model=["gas law"])).squeeze("tensioner_model", drop=True)
    return described(dataset.to_dataset(name="horizontal_force"), PAPER, "force of the tensioners")


def dat_force_calibrated(statics_calibrated: xr.Dataset) -> xr.Dataset:
    """Horizontal force in each current calibrated to the printed force at 1 m/s, of the cylinders counted."""
    runs = statics_calibrated.sel(tensioner_model=["gas law"])
    force = _force(runs).squeeze("tensioner_model", drop=True)
    parts = [
        force.sel(calibration=calibration, counted=counted, drop=True)
        for calibration, counted in COUNTED.items()
    ]
    dataset = xr.concat(parts, statics_calibrated["calibration"].sel(calibration=list(COUNTED)))
    return described(
        dataset.to_dataset(name="horizontal_force"), PAPER, "force of the tensioners, calibrated"
    )


def statics_tuned(statics_calibrated: xr.Dataset) -> xr.Dataset:
    """Displacement, moments and force in the calibrated currents, for every model of the tensioners."""
    dataset = _at_rest(statics_calibrated)
    return described(dataset, PAPER, "static displacement and moments in calibrated currents")


def statics_readings(statics_open: xr.Dataset) -> xr.Dataset:
    """Displacement, moments and force of every sample, over (sample, tensioner_model, surface_speed)."""
    dataset = _at_rest(statics_open).assign(sampled(statics_open))
    return described(dataset, PAPER, "displacement and static moments, for samples of the unspecified inputs")


def _at_rest(runs: xr.Dataset) -> xr.Dataset:
    """Largest displacement, and largest moment along the whole riser and within 60 m below the ring."""
    ring = ring_of(runs)
    moment, at = abs(runs["bending_moment_static"]), runs["s_node"]
    near = moment.where((at > ring - NEAR) & (at <= ring + 1e-6))
    force = _force(runs.sel(tensioner_model=["gas law"]))
    return xr.Dataset(
        {
            "largest_displacement": abs(on_riser(runs["x_static"], ring, "s_node")).max("s_node"),
            "largest_bending_moment": largest_moment(runs),
            "largest_bending_moment_near_ring": near.max("s_node"),
            "horizontal_force": force.squeeze("tensioner_model", drop=True),
        }
    )


def _force(runs: xr.Dataset) -> xr.DataArray:
    """Horizontal force (N) against the current, of all cylinders and the mean per cylinder."""
    place = list(runs["point_key"].dims)
    total = xr.zeros_like(runs["tensioner_force_static"].isel(cylinder=0, drop=True))
    total.attrs = {}
    needed = runs[["x_static", "z_static", "tensioner_force_static"]].load()
    for at, scene in scenes_of(runs):
        point = needed.sel(at)
        ring = sum(section.total_length for section in scene.riser)
        top = point[["x_static", "z_static"]].where(point["s_node"] <= ring + 1e-6)
        top = top.dropna("s_node").isel(s_node=[-2, -1])
        pull = point["tensioner_force_static"].dropna("cylinder").values
        total.loc[at] = pushed_back(scene, pull, top["x_static"].values, top["z_static"].values)
    total = total.transpose(*place)
    counted = xr.DataArray(["all cylinders", "one cylinder"], dims="counted", name="counted")
    return xr.concat([total, total / runs["tensioner_force_static"].count("cylinder")], counted)


def pushed_back(
    scene: Resolved, pull: NDArray[np.float64], x: NDArray[np.float64], z: NDArray[np.float64]
) -> float:
    """Horizontal force of all cylinders against +x (N).

    Parameters
    ----------
    pull : force of each cylinder (N).
    x, z : positions of the node below the ring and of the ring (m); the ring rotates with the riser.
    """
    rig = scene.top.tensioners
    if rig is None or rig.arrangement is None:
        raise TypeError("no tensioners in space")
    where = rig.arrangement
    bearing = np.array(where.bearings(rig.count))
    lean = np.arctan2(x[1] - x[0], z[1] - z[0])
    round_about = np.stack([np.cos(bearing), np.sin(bearing), np.zeros(rig.count)])
    deck = where.deck_radius * round_about + np.array([[0.0], [0.0], [where.deck_elevation]])
    east, north = where.ring_radius * round_about[:2]
    ring = np.stack([x[1] + east * np.cos(lean), north, z[1] - east * np.sin(lean)])
    line = deck - ring
    return float(-(pull * line[0] / np.sqrt((line**2).sum(axis=0))).sum())
