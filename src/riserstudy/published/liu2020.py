"""Liu et al. 2020: what its numbers, claims and errata are checked against."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from riserstudy.published.grading import Found

# Table 2 and the constant tension


def constant_tension(readings: xr.Dataset) -> Found:
    """Tension of all cylinders in tonnes, in every reading."""
    return Found(readings["top_tension"] / readings["gravity"] / 1e3)


# Fig 10: the check riser


def codes_agree(codes: xr.Dataset, at_most: float) -> Found:
    """Three methods give nearly the same displacement; value: largest difference over the largest."""
    moved = codes["displacement"]
    largest = abs(moved).max(["depth", "code"])
    apart = (moved.max("code") - moved.min("code")).max("depth") / largest
    return Found(apart, apart <= at_most)


# Figs 13 to 15: heave


def uniform(
    heave: xr.Dataset, amplitude: float, period: float, at_most: float, lag: float
) -> Found:
    """Axial force repeats itself, alike at both ends in amplitude and phase (degrees).

    Value: largest relative difference, of the ends and of the last two periods.
    """
    run = heave.sel(heave_amplitude=amplitude, heave_period=period, drop=True)
    apart = abs(run["axial_force_amplitude_top"] / run["axial_force_amplitude"] - 1.0)
    worst = apart.where(apart > run["settling"], run["settling"])
    return Found(worst, (worst <= at_most) & (abs(run["axial_force_lag"]) <= np.deg2rad(lag)))


def amplitude_not_period(heave: xr.Dataset, at_most: float) -> Found:
    """Force grows with every step of heave, and changes little with period; value: largest spread."""
    force = heave["axial_force_amplitude"]
    spread = (force.max("heave_period") / force.min("heave_period") - 1.0).max("heave_amplitude")
    grows = (force.diff("heave_amplitude") > 0).all(["heave_amplitude", "heave_period"])
    return Found(spread, grows & (spread <= at_most))


# errata


def tensions(readings: xr.Dataset) -> dict[str, Any]:
    """Tonnes in the readings that the erratum names."""
    tonnes = constant_tension(readings).value.sel(
        gravity=9.81, pressures="absolute", mid_stroke="riser in equilibrium"
    )
    return {
        "once": float(tonnes.sel(cylinders="six", pistons="6050 kg in all", inclination=0.0)),
        "each": float(tonnes.sel(cylinders="six", pistons="6050 kg each", inclination=0.0)),
        "seven": float(tonnes.sel(cylinders="seven", pistons="6050 kg each", inclination=9.5)),
        "leaning": float(tonnes.sel(cylinders="six", pistons="massless", inclination=12.8)),
    }
