"""Axial force under heave."""

from __future__ import annotations

import numpy as np
import xarray as xr

from chapters.liu2020.below_ring import RING, ring_of
from chapters.liu2020.periods import first_harmonic, half_swing, settling
from riserstudy.dataset.describe import described, sampled

PAPER = "liu2020"


def heave(heave_runs: xr.Dataset) -> xr.Dataset:
    """Amplitude of the axial force over (heave_amplitude, heave_period), with gas law and linearised."""
    dataset = _axial_force(_at_ends(heave_runs, "gas law"))
    linear = _axial_force(_at_ends(heave_runs, "linear"))
    dataset["axial_force_amplitude_linear"] = linear["axial_force_amplitude"]
    return described(dataset, PAPER, "amplitude of the axial force, in heave of the platform")


def heave_readings(heave_open: xr.Dataset) -> xr.Dataset:
    """Amplitude of the axial force for every sample of the unspecified inputs."""
    ring = ring_of(heave_open).rename("s")
    ends = heave_open["effective_tension"].sel(s=xr.concat([xr.zeros_like(ring), ring], "end"))
    dataset = _axial_force(ends.drop_vars("s").rename(end="s")).assign(sampled(heave_open))
    return described(dataset, PAPER, "amplitude of the axial force, for samples of the unspecified inputs")


def _at_ends(runs: xr.Dataset, model: str) -> xr.DataArray:
    return runs["effective_tension"].sel(tensioner_model=model, s=[0.0, RING], drop=True)


def _axial_force(tension: xr.DataArray) -> xr.Dataset:
    """Amplitudes at both riser ends over the last period, the lag between them, and their settling."""
    swing = half_swing(tension, "heave_period")
    ends = first_harmonic(tension, "heave_period")
    lag = xr.apply_ufunc(np.angle, ends.isel(s=-1, drop=True) / ends.isel(s=0, drop=True))
    return xr.Dataset(
        {
            "axial_force_amplitude": swing.isel(s=0, drop=True),
            "axial_force_amplitude_top": swing.isel(s=-1, drop=True),
            "axial_force_lag": lag,
            "axial_force_share": swing.isel(s=-1, drop=True) / tension.isel(s=-1, drop=True).mean("time"),
            "settling": settling(tension, "heave_period").max("s"),
        }
    )
