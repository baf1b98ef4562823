"""Labels of limits: each limit of a scene has its own in every table and dataset, whatever they repeat."""

import random

import numpy as np
import pytest
import xarray as xr
from random_rigs import moving, written

from riserstudy import sweep
from riserstudy.dataset.limits import coordinates, label, labels
from riserstudy.scene.load import SceneFile

ANGLES = ("lfj_angle", "ufj_angle", "von_mises_stress", "effective_tension")


def limits(seed):
    """Limits of which several differ only in their allowable, or in nothing."""
    draw = random.Random(seed)
    some = []
    for _ in range(draw.randrange(2, 9)):
        output = draw.choice(ANGLES[:2])
        some.append(
            {
                "output": output,
                draw.choice(["largest", "mean"]): f"{draw.choice([2, 4])} deg",
                "mode": draw.choice(["drilling", "connected"]),
            }
        )
    return some


@pytest.mark.parametrize("seed", range(30))
def test_labels_differ_and_begin_with_the_words_of_the_limit(seed):
    tree = written(moving(seed, spatial=bool(seed % 2))) | {"limits": limits(seed)}
    found = SceneFile("rig.yaml", tree).resolved().limits
    names = labels(found)
    assert len({*names}) == len(found)
    assert all(name.startswith(label(one)) for name, one in zip(names, found, strict=True))
    alone = [one for one in found if [label(other) for other in found].count(label(one)) == 1]
    assert all(label(one) in names for one in alone)
    array = xr.DataArray(np.zeros(len(found)), dims="limit", coords=coordinates(found))
    assert array["mode_of_limit"].values.tolist() == [one.mode for one in found]
    parts = zip(*(array[f"{part}_of_limit"].values for part in ("mode", "side", "output")), strict=True)
    assert [f"{mode}: {side} {output}" for mode, side, output in parts] == names
    assert array["limit"].values.tolist() == names


@pytest.mark.parametrize("seed", range(2))
def test_a_study_selects_each_of_its_limits_by_its_label(seed):
    tree = written(moving(seed, spatial=False)) | {"limits": limits(seed)}
    tree["analysis"] = {}  # at rest
    dataset = sweep(SceneFile("rig.yaml", tree), {"riser[0].mass": [600.0, 700.0]}, progress=False)
    assert dataset.indexes["limit"].is_unique
    for k, name in enumerate(dataset["limit"].values):
        xr.testing.assert_equal(
            dataset["use_of_limit"].sel(limit=name, drop=True),
            dataset["use_of_limit"].isel(limit=k, drop=True),
        )
