"""Points of any studies, in any order, are one dataset with the values of each study at its own places."""

import numpy as np
import pytest
import workspace
import xarray as xr
from some_seeds import seeds

from riserstudy import dataset_of, query


def own_of(study, position):
    """One point of a study's dataset."""
    with xr.open_dataset(workspace.RESULTS / f"{study}.nc", decode_times=False) as found:
        own = found.load()
    axes = own["point_key"].dims
    places = np.unravel_index(position, [own.sizes[axis] for axis in axes]) if axes else ()
    return own.isel(dict(zip(axes, map(int, places), strict=True)))


def places(whole, own):
    """Where a study's places are in those of all studies; equal ones one after the other."""
    free, found = whole.values.tolist(), []
    for place in own.values.tolist():
        found.append(free.index(place))
        free[found[-1]] = None
    return found


def check(found, own, study):
    """A point of a joined dataset against its own; where the study has no value, there is none."""
    assert found["study"].item() == study
    for name in map(str, found.variables):
        values = found[name]
        if name in ("point", "study") or name in found.dims:
            continue
        if name not in own.variables:
            assert values.dtype.kind not in "fiu" or np.isnan(values.values).all(), name
            continue
        assert own[name].attrs.get("units") == values.attrs.get("units")
        at_own = values.isel({dim: places(found[dim], own[dim]) for dim in own[name].dims})
        wider = [dim for dim in values.dims if dim not in own[name].dims]  # of studies with times
        same = own[name].broadcast_like(at_own).transpose(*at_own.dims)
        np.testing.assert_array_equal(at_own.values, same.values, err_msg=name)
        if own[name].dtype.kind in "fiu":
            times = int(np.prod([found.sizes[dim] for dim in wider]))
            assert int(values.notnull().sum()) == times * int(own[name].notnull().sum()), name


@pytest.mark.long
@pytest.mark.parametrize("seed", seeds(40, few=12))
def test_any_points_in_any_order_are_one_dataset(here, seed):
    draw = np.random.default_rng(seed)
    every = query("select point, study, position from points order by point")
    studies = [*dict.fromkeys(every["study"])]
    chosen = draw.permutation(studies)[: int(draw.integers(1, len(studies) + 1))].tolist()
    mine = [k for k, study in enumerate(every["study"]) if study in chosen]
    first = [next(k for k in mine if every["study"][k] == study) for study in chosen]
    picked = draw.permutation([*first, *draw.choice(mine, int(draw.integers(0, 4)))]).tolist()
    found = dataset_of([int(every["point"][k]) for k in picked])
    assert found["point"].values.tolist() == [int(every["point"][k]) for k in picked]
    for place, k in enumerate(picked):
        study = every["study"][k]
        check(found.isel(point=place), own_of(study, int(every["position"][k])), study)
