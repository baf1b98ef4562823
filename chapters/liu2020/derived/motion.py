"""Liu et al. 2020, motions of the platform: surge, roll, response in waves, three hours of a sea."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import xarray as xr
from scipy.signal import welch

from chapters.liu2020.below_ring import RING, at_depths, first_at, largest_moment, on_riser, ring_of
from chapters.liu2020.periods import beats, first_harmonic, half_swing, settling
from riserstudy.dataset.describe import described, sampled, scenes_of
from riserstudy.model.rao import operator
from riserstudy.scene.resolve import Resolved

PAPER = "liu2020"
SURGE_PERIOD = 15.0  # s
DEPTHS = (100.0, 200.0, 300.0, 400.0)  # m below the riser's top, as in Fig 18
PERIODS = np.arange(5.0, 30.01, 0.1)  # s, of the plotted responses, as in Figs 21 and 22
OF_RISER = "largest magnitude of the bending moment of the riser, below the ring"
ARRIVED = 0.05  # share of the largest displacement at a depth at which motion there begins


# surge


def surge(surge_case: xr.Dataset) -> xr.Dataset:
    """Motion at four depths over (tensioner_model, depth), and the time at which it begins."""
    riser = _below_ring(surge_case["x"])
    x = _between_nodes(riser)
    dataset = _moved(x, lag_at(DEPTHS, riser, SURGE_PERIOD)).assign(arrival=first_at(x, ARRIVED))
    return described(dataset, PAPER, "displacement under surge at four depths")


def surge_readings(surge_open: xr.Dataset) -> xr.Dataset:
    """Steady-state motion at four depths for every sample of the unspecified inputs."""
    x = at_depths(surge_open["x"], ring_of(surge_open), DEPTHS)
    dataset = _moved(x, _lag(x, SURGE_PERIOD, "depth")).assign(sampled(surge_open))
    return described(dataset, PAPER, "displacement under surge, for samples of the unspecified inputs")


def surge_stiff(surge_stiff_case: xr.Dataset) -> xr.Dataset:
    """Lag at four depths on tensioners of almost constant length, over (tensioner_model, depth)."""
    lag = lag_at(DEPTHS, surge_stiff_case["x"], SURGE_PERIOD)
    dataset = xr.Dataset({"displacement_lag": lag})
    return described(dataset, PAPER, "lag under surge on tensioners of almost constant length")


def surge_stiff_readings(surge_stiff_open: xr.Dataset) -> xr.Dataset:
    """Lag at four depths on tensioners of almost constant length, for every sample."""
    x = at_depths(surge_stiff_open["x"], ring_of(surge_stiff_open), DEPTHS)
    dataset = xr.Dataset({"displacement_lag": _lag(x, SURGE_PERIOD, "depth")})
    title = "lag under surge on tensioners of almost constant length, for samples of the unspecified inputs"
    return described(dataset.assign(sampled(surge_stiff_open)), PAPER, title)


def surge_arrival(surge_start: xr.Dataset) -> xr.Dataset:
    """Time at which surge motion begins at four depths, for every sample of the unspecified inputs."""
    return _arrivals(surge_start, "surge, for samples of the unspecified inputs")


def roll_travel(roll_case: xr.Dataset) -> xr.Dataset:
    """Time at which motion under roll begins at four depths."""
    riser = _below_ring(roll_case["x"]).sel(time=slice(0.0, 60.0))
    dataset = xr.Dataset({"arrival": first_at(_between_nodes(riser), ARRIVED)})
    return described(dataset, PAPER, "start of the motion under roll")


def roll_arrival(roll_start: xr.Dataset) -> xr.Dataset:
    """Time at which motion under roll begins, for every sample of the unspecified inputs."""
    return _arrivals(roll_start, "start of the motion under roll, for samples of the unspecified inputs")


def _arrivals(runs: xr.Dataset, title: str) -> xr.Dataset:
    x = at_depths(runs["x"], ring_of(runs), DEPTHS)
    dataset = xr.Dataset({"arrival": first_at(x, ARRIVED)}).assign(sampled(runs))
    return described(dataset, PAPER, title)


def _below_ring(values: xr.DataArray) -> xr.DataArray:
    return values.sel(s=values["s"] <= RING + 1e-6)


def _between_nodes(riser: xr.DataArray) -> xr.DataArray:
    depth = xr.DataArray(list(DEPTHS), dims="depth", name="depth")
    return riser.interp(s=RING - depth, method="cubic").assign_coords(depth=depth).drop_vars("s")


def _moved(x: xr.DataArray, lag: xr.DataArray) -> xr.Dataset:
    """Amplitude and lag along the riser, settling, and difference from the displacement with the gas law."""
    last = x.sel(time=slice(float(x["time"][-1]) - SURGE_PERIOD, None))
    law = last.sel(tensioner_model="gas law", drop=True)
    over = ["time", "depth"]
    return xr.Dataset(
        {
            "displacement_amplitude": half_swing(x, SURGE_PERIOD),
            "displacement_lag": lag,
            "displacement_apart": np.sqrt(((last - law) ** 2).mean(over) / (law**2).mean(over)),
            "settling": settling(x, SURGE_PERIOD),
        }
    )


def lag_at(depths: Sequence[float], x: xr.DataArray, period: str | float) -> xr.DataArray:
    """Lag of the first harmonic at depths below the ring, unwrapped from node to node from the ring down.

    The lag may increase by more than half a turn between distant depths, but not between two nodes.

    Parameters
    ----------
    depths : depths below the ring (m), in any order.
    x : displacement at the nodes of the riser (m), over ``time``, ``s`` and any further dimensions.
    period : as in ``first_harmonic``.

    Returns
    -------
    Lag over ``depth`` and the further dimensions (rad), within half a turn at the ring.
    """
    depth = xr.DataArray(list(depths), dims="depth", name="depth")
    down = _below_ring(x).sortby("s", ascending=False)
    near = _lag(down, period, "s").interp(s=RING - depth, method="linear")
    exact = _lag(down.interp(s=RING - depth, method="cubic"), period, "depth")
    turns = np.round((near - exact) / (2.0 * np.pi))
    return (exact + 2.0 * np.pi * turns).drop_vars("s").assign_coords(depth=depth)


def _lag(x: xr.DataArray, period: str | float, along: str) -> xr.DataArray:
    """Lag of the first harmonic, unwrapped along a dimension (rad)."""
    lag = -xr.apply_ufunc(np.angle, first_harmonic(x, period))
    unwrapped: xr.DataArray = xr.apply_ufunc(
        np.unwrap, lag, input_core_dims=[[along]], output_core_dims=[[along]]
    )
    return unwrapped


# roll


def roll(roll_runs: xr.Dataset, roll_small: xr.Dataset) -> xr.Dataset:
    """Largest bending moment over (roll_amplitude, roll_period), and the settling of the moment."""
    both = [
        xr.Dataset(
            {
                "largest_bending_moment": largest_moment(runs),
                "settling": beats(runs["bending_moment"].isel(s=-1, drop=True), "roll_period"),
            }
        ).reset_coords(drop=True)
        for runs in (roll_small, roll_runs)
    ]
    made = described(
        xr.concat(both, "roll_amplitude"),
        PAPER,
        "largest bending moment under roll, centre of rotation calibrated",
    )
    made["largest_bending_moment"].attrs["long_name"] = OF_RISER
    made["settling"].attrs["long_name"] = (
        "largest change of the moment amplitude at the ring between successive periods, "
        "divided by the largest amplitude"
    )
    return made


def roll_assumed(roll_base: xr.Dataset) -> xr.Dataset:
    """Largest bending moment under roll about an assumed centre."""
    return _rolled(roll_base, "largest bending moment under roll, centre of rotation assumed")


def roll_readings(roll_open: xr.Dataset) -> xr.Dataset:
    """Largest bending moment under roll for every sample of the unspecified inputs."""
    return _rolled(roll_open, "roll, for samples of the unspecified inputs")


def varied_roll(roll_variants: xr.Dataset) -> xr.Dataset:
    """Largest bending moment under roll over (variant, roll_period)."""
    return _rolled(roll_variants, "largest bending moment under roll, in variants of the riser")


def roll_ways(roll_geometry: xr.Dataset) -> xr.Dataset:
    """Largest moment under roll over (geometry, tensioner_model, roll_amplitude, roll_period)."""
    return _rolled(roll_geometry, "largest bending moment under roll, for several geometries")


def roll_about_joint(roll_geometry: xr.Dataset) -> xr.Dataset:
    """Largest moment on the cylinders, with the platform rotating about the upper flex joint."""
    geometry = next(str(g) for g in roll_geometry["geometry"].values if "in the flex joint" in g)
    runs = roll_geometry.sel(geometry=geometry, tensioner_model="gas law", drop=True)
    return _rolled(runs, "largest bending moment under roll about the upper flex joint")


def _rolled(runs: xr.Dataset, title: str) -> xr.Dataset:
    """Largest moment along the riser, and its settling: in steady state both extremes are equal in size."""
    high = runs["bending_moment_max"].max("s_node")
    low = runs["bending_moment_min"].min("s_node")
    settled = abs(high + low) / (high - low)
    dataset = xr.Dataset({"largest_bending_moment": largest_moment(runs), "settling": settled})
    made = described(dataset.assign(sampled(runs)), PAPER, title)
    made["largest_bending_moment"].attrs["long_name"] = OF_RISER
    made["settling"].attrs["long_name"] = (
        "difference of largest and smallest moment, as magnitudes, divided by their sum"
    )
    return made


# response in waves


def rao_table(rao_runs: xr.Dataset) -> xr.Dataset:
    """Platform motion per metre of wave amplitude, over (platform_unit, wave_period)."""
    period = xr.DataArray(PERIODS, dims="wave_period", name="wave_period")
    names = {"surge": "rao_surge", "heave": "rao_heave", "pitch": "rao_pitch"}
    one = rao_runs.isel(reference=[0], motion=[0], wave_period=[0])
    units = {}
    for place, scene in scenes_of(one):
        response = scene.platform and scene.platform.response
        if not response:
            raise TypeError("a scene without response")
        w = 2.0 * math.pi / PERIODS
        units[place["platform_unit"]] = xr.Dataset(
            {
                variable: period.copy(data=np.abs(operator(response, name, w)))
                for name, variable in names.items()
            }
        )
    label = xr.DataArray(list(units), dims="platform_unit", name="platform_unit")
    dataset = xr.concat(units.values(), label).assign_coords(wave_period=period)
    return described(dataset, PAPER, "response of three generic semi-submersibles")


def rao(rao_runs: xr.Dataset) -> xr.Dataset:
    """Largest stress amplitude along the riser by each motion, and the motion's share of the sum."""
    swing = half_swing(fibre_stress(rao_runs), "wave_period").max(["s", "side"])
    return described(_shared(swing), PAPER, "stress amplitude by each motion of the platform in waves of 3 m")


def rao_readings(rao_open: xr.Dataset) -> xr.Dataset:
    """Stress amplitudes and shares by motion, for every sample of the unspecified inputs."""
    ring = ring_of(rao_open)
    swings = []
    for period in rao_open["wave_period"].values:  # one at a time: all histories fill the memory
        stress = fibre_stress(rao_open.sel(wave_period=period), ring)
        swings.append(half_swing(stress, float(period)).max(["s", "side"]))
    dataset = _shared(xr.concat(swings, rao_open["wave_period"])).assign(sampled(rao_open))
    return described(dataset, PAPER, "stress amplitude by motion, for samples of the unspecified inputs")


def waves(wave_runs: xr.Dataset) -> xr.Dataset:
    """Largest stress amplitude along the riser by all motions together, with and without waves on it."""
    swing = half_swing(fibre_stress(wave_runs), "wave_period").max(["s", "side"])
    dataset = swing.to_dataset(name="stress_amplitude")
    return described(dataset, PAPER, "stress amplitude in waves of 3 m that act on the riser too")


def _shared(stress: xr.DataArray) -> xr.Dataset:
    return xr.Dataset({"stress_amplitude": stress, "stress_share": stress / stress.sum("motion")})


def fibre_stress(runs: xr.Dataset, ring: xr.DataArray | None = None) -> xr.DataArray:
    """Stress along the riser in both outermost fibres, T/A + M D/(2 I) and T/A - M D/(2 I) (Pa).

    Parameters
    ----------
    runs : runs with histories of tension and moment.
    ring : arclength of the ring (m); 533 m if absent.
    """
    _, scene = next(scenes_of(runs.isel({dim: [0] for dim in runs["point_key"].dims})))
    area, modulus = section(scene)
    up_to = xr.DataArray(RING) if ring is None else ring
    bending = runs["bending_moment"].fillna(0.0) / modulus  # heave alone causes no bending
    side = xr.DataArray([1.0, -1.0], dims="side")
    return on_riser(runs["effective_tension"], up_to) / area + side * bending


def section(scene: Resolved) -> tuple[float, float]:
    """Area (m2) and section modulus (m3) of the riser's pipe."""
    pipe = scene.riser[0]
    outer, inner = pipe.outer_diameter or 0.0, pipe.inner_diameter or 0.0
    second = math.pi / 64.0 * (outer**4 - inner**4)
    return 0.25 * math.pi * (outer**2 - inner**2), 2.0 * second / outer


# three hours of a sea


def storm(sea: xr.Dataset) -> xr.Dataset:
    """Histories of the response in a sea state, with extremes, standard deviations and spectra."""
    run = sea.squeeze("tensioner_model", drop=True)
    interval = float(run["time"][1] - run["time"][0])
    records: dict[str, xr.DataArray] = {}
    for name in ("x", "effective_tension", "bending_moment", "stroke", "ufj_angle", "lfj_angle"):
        values = run[name]
        records |= {
            name: values,
            f"{name}_max": values.max("time"),
            f"{name}_min": values.min("time"),
            f"{name}_deviation": values.std("time"),
        }
        frequency, density = welch(
            values.values, 1.0 / interval, nperseg=1024, axis=values.dims.index("time")
        )
        dims = ["frequency" if dim == "time" else dim for dim in values.dims]
        spectrum = xr.DataArray(density, dims=dims, coords={"frequency": frequency})
        records[f"{name}_spectrum"] = spectrum
    return described(xr.Dataset(records), PAPER, "three hours of an irregular sea")
