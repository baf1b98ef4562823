"""Axial force under heave."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.chapters.liu2020.periods import first_harmonic, half_swing, settling
from riserstudy.dataset.describe import described, sampled

PAPER = "liu2020"


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
