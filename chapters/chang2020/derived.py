"""Chang et al. 2020: the asymmetry index, Eq. 9, and the reductions of Fig 8, in each interpretation."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.dataset.describe import described, sampled

PAPER = "chang2020"
#: interpretations of the printed motion height H = 5 m, with the amplitude (m) of each
HEIGHTS = {"H is the amplitude": 5.0, "H is twice the amplitude": 2.5}
QUANTITIES = {"heave": "z", "tension": "effective_tension"}


def asymmetry(steady: xr.Dataset, from_rest: xr.Dataset, quasi_static: xr.Dataset) -> xr.Dataset:
    """S = (max x - x_eq) / (x_eq - min x) over (reading, tensioner_model, heave_amplitude).

    x_eq is the static equilibrium of the same law. The quasi-static interpretation uses the equilibria with
    the platform at rest at the two ends of its heave.
    """
    rest = _top(quasi_static)["z_static"].sel(heave_position=0.0, drop=True)
    readings = {
        name: (_top(runs)["z_max"] - rest, rest - _top(runs)["z_min"])
        for name, runs in {"steady": steady, "from_rest": from_rest}.items()
    }
    held = _held(quasi_static, "z_static", steady["heave_amplitude"])
    readings["quasi_static"] = held["above"] - rest, rest - held["below"]
    names = xr.DataArray(list(readings), dims="reading", name="reading")
    up, down = (
        xr.concat([sides[k] for sides in readings.values()], names, coords="minimal", compat="override")
        for k in range(2)
    )
    return described(
        xr.Dataset({"displacement_up": up, "displacement_down": down, "asymmetry_index": up / down}),
        PAPER,
        "asymmetry index S of Eq. 9",
    )


def reductions(
    steady: xr.Dataset, from_rest: xr.Dataset, quasi_static: xr.Dataset, rigid: xr.Dataset
) -> xr.Dataset:
    """Reduction of the riser's oscillation by the tensioner, in every interpretation of the text.

    1 - (with tensioner) / (without) over (quantity, measure, height, reading): swing is the difference
    between largest and smallest value, deviation the standard deviation, peak the largest value.
    """
    ways = {
        (quantity, height, reading): 1.0 - _measures(runs, quantity, a) / _measures(rigid, quantity, a)
        for quantity in QUANTITIES
        for height, a in HEIGHTS.items()
        for reading, runs in {"steady": steady, "from_rest": from_rest, "quasi_static": quasi_static}.items()
    }
    table = xr.concat(ways.values(), "way", coords="minimal", compat="override")
    for k, name in enumerate(("quantity", "height", "reading")):
        table = table.assign_coords({name: ("way", [way[k] for way in ways])})
    table = table.set_index(way=["quantity", "height", "reading"]).unstack("way")
    order = ("quantity", "measure", "height", "reading")
    return described(
        table.transpose(*order).to_dataset(name="reduction"),
        PAPER,
        "reduction of the riser's oscillation by the tensioner",
    )


def reductions_open(open_choices: xr.Dataset) -> xr.Dataset:
    """Return the reductions for every sample of the unspecified inputs, from the record of each.

    Without tensioner the riser's top follows the platform, x = a, and a is x - X of the same run. Tension
    is k_r x with and without tensioner (Eq. 8): heave and tension therefore have one reduction.
    """
    zero = float(open_choices["s"][-1])
    rise = open_choices["z"].isel(s=-1, drop=True) - zero
    platform = rise + open_choices["tensioner_stroke"].isel(cylinder=0, drop=True)
    # outputs miss peaks of the riser's free oscillation, but hardly those of the platform's slow heave
    ends = [_top(open_choices)[f"z_{end}"] - zero for end in ("max", "min")]
    parts = []
    for amplitude in HEIGHTS.values():
        held, bare, high, low = (x.sel(heave_amplitude=amplitude, drop=True) for x in (rise, platform, *ends))
        with_tensioner = _spread(held, high, low)
        parts.append(1.0 - with_tensioner / _spread(bare, bare.max("time"), bare.min("time")))
    height = xr.DataArray(list(HEIGHTS), dims="height", name="height")
    quantity = xr.DataArray(list(QUANTITIES), dims="quantity", name="quantity")
    table = xr.concat(parts, height).expand_dims(quantity=quantity)
    dataset = table.to_dataset(name="reduction").assign(sampled(open_choices))
    return described(dataset, PAPER, "reduction of the oscillation, for samples of the unspecified inputs")


def _spread(history: xr.DataArray, high: xr.DataArray, low: xr.DataArray) -> xr.DataArray:
    """Swing, standard deviation and peak over ``measure``; histories end at their own times.

    ``high``, ``low``: largest and smallest value.
    """
    measures = xr.DataArray(
        ["peak-to-peak range", "standard deviation", "peak"], dims="measure", name="measure"
    )
    return xr.concat([high - low, history.std("time"), high], measures)


def _measures(runs: xr.Dataset, quantity: str, amplitude: float) -> xr.DataArray:
    """Swing, standard deviation and peak of a quantity at the ring, over ``measure``."""
    if "tensioner_model" in runs.dims:
        runs = runs.sel(tensioner_model="gas law", drop=True)
    name = QUANTITIES[quantity]
    zero = float(runs["s_node"][-1]) if name == "z" else 0.0
    if "time" in runs.dims:
        run = _top(runs.sel(heave_amplitude=amplitude, drop=True))
        highest, lowest = run[f"{name}_max"] - zero, run[f"{name}_min"] - zero
        deviation = run[name].isel(s=-1, drop=True).isel(time=slice(None, -1)).std("time")
    else:
        held = _held(runs, f"{name}_static", xr.DataArray(amplitude))
        highest, lowest = held["above"] - zero, held["below"] - zero
        turn = xr.DataArray(np.linspace(0.0, 2.0 * np.pi, 720, endpoint=False), dims="turn")
        at = amplitude * np.sin(turn)
        everywhere = _top(runs)[f"{name}_static"].interp(heave_position=at, method="cubic")
        deviation = everywhere.std("turn")
    measures = xr.DataArray(
        ["peak-to-peak range", "standard deviation", "peak"], dims="measure", name="measure"
    )
    parts = [part.drop_vars(part.coords) for part in (highest - lowest, deviation, highest)]
    return xr.concat(parts, measures)


def _top(runs: xr.Dataset) -> xr.Dataset:
    return runs.isel(s_node=-1, drop=True)


def _held(runs: xr.Dataset, name: str, amplitude: xr.DataArray) -> dict[str, xr.DataArray]:
    """Values with the platform held at the upper and the lower end of its heave."""
    value = _top(runs)[name]
    return {
        side: value.sel(heave_position=sign * amplitude, drop=True).drop_vars(
            "heave_position", errors="ignore"
        )
        for side, sign in (("above", 1.0), ("below", -1.0))
    }
