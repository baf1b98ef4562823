"""Chang et al. 2020: the asymmetry index, Eq. 9, in each reading of the paper."""

from __future__ import annotations

import xarray as xr

from riserstudy.simulation import attributes


def asymmetry(steady: xr.Dataset, from_rest: xr.Dataset, quasi_static: xr.Dataset) -> xr.Dataset:
    """S = (max x - x_eq) / (x_eq - min x) over (reading, tensioner_model, heave_amplitude).

    x_eq is the static equilibrium of the same law. The quasi-static reading takes the equilibria with
    the platform at rest at the two ends of its heave.
    """
    readings = {"steady": _excursions(steady), "from_rest": _excursions(from_rest)}
    x = quasi_static["z_static"].isel(s_node=-1)
    rest = x.sel(heave_position=0.0, drop=True)

    def away(sign: float) -> xr.DataArray:
        shifted = x.assign_coords(heave_position=sign * x["heave_position"])
        renamed = shifted.rename(heave_position="heave_amplitude")
        return sign * (renamed.sel(heave_amplitude=steady["heave_amplitude"]) - rest)

    readings["quasi_static"] = away(1.0), away(-1.0)
    names = xr.DataArray(list(readings), dims="reading", name="reading")
    up = xr.concat([up for up, _ in readings.values()], names, coords="minimal", compat="override")
    down = xr.concat(
        [down for _, down in readings.values()], names, coords="minimal", compat="override"
    )
    dataset = xr.Dataset(
        {"displacement_up": up, "displacement_down": down, "asymmetry_index": up / down}
    )
    for name in dataset.data_vars:
        dataset[name].attrs = attributes(str(name))
    dataset["heave_amplitude"].attrs = attributes("heave_amplitude")
    dataset.attrs = {"Conventions": "CF-1.11", "paper": "chang2020", "title": "chang2020 asymmetry"}
    return dataset.drop_vars([n for n in dataset.coords if n not in dataset.dims])


def _excursions(dataset: xr.Dataset) -> tuple[xr.DataArray, xr.DataArray]:
    top = dataset.isel(s_node=-1)
    rest = top["z_static"]
    return top["z_max"] - rest, rest - top["z_min"]
