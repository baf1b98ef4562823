"""Datasets computed from those of the studies: a function each, named in config/studies/example.yaml."""

import xarray as xr


def tension_swing(heave: xr.Dataset) -> xr.Dataset:
    """Half of the range of tension at the riser's top (N), over heave amplitude."""
    top = {"s_node": -1}
    swing = 0.5 * (heave["effective_tension_max"] - heave["effective_tension_min"]).isel(top)
    return swing.drop_vars("s_node").to_dataset(name="tension_swing")
