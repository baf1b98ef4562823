"""Allowances of the chapter, of stored runs, are those of `riserstudy envelope`, which makes its own runs."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.design.derived.seas import _name, _of_seeds
from riserstudy.design.sea_allowances import allowances
from riserstudy.simulation.refine import run
from riserstudy.study.in_sea import Sea, in_sea
from riserstudy.study.read import read_study

CONFIG = Path(__file__).parents[3] / "config"
SEEDS = 3
SMALL = 5e-6  # rad, or m: means over the steps and over the outputs differ by this
KEPT = ("time", "s_node", "lfj_angle", "ufj_angle", "joint_stroke", "von_mises_stress", "effective_tension")
ENDS = ("", "_static", "_max", "_min")


def file_of(draw):
    """The chapter's riser in a sea, with a short run that starts its outputs in the middle of a motion."""
    base = read_study(CONFIG, "design", "seas", "preview", None).base
    start = round(float(draw.uniform(20.0, 40.0)), 1)
    return base.with_values(
        {
            "current.profile.surface_speed": f"{draw.uniform(0.0, 1.5):.2f} m/s",
            "platform.response.ramp": "15 s",
            "analysis.duration": f"{start + 60.0} s",
            "analysis.output": {"start": f"{start} s", "interval": "0.1 s"},
            "analysis.mesh.elements": 240,
            "analysis.step": "0.2 s",
        },
        "test",
    )


def dataset_of(scene):
    arrays = run(scene).arrays
    found = xr.Dataset()
    for name in (name + end for name in KEPT for end in ENDS if name + end in arrays):
        of = arrays[name]
        over = () if np.ndim(of) == 0 else ("time",) if len(of) == len(arrays["time"]) else ("s_node",)
        if np.ndim(of) < 2:
            found[name] = (over, of)
    return found.set_coords(["time", "s_node"])


@pytest.mark.parametrize("seed", range(3))
def test_allowances_are_those_of_the_command(seed):
    """For each limit of drilling and each section, with a start of outputs where no angle is that at rest."""
    draw = np.random.default_rng(seed)
    file, sea = file_of(draw), Sea(float(draw.uniform(1.0, 6.0)), 10.0)
    runs = [dataset_of(in_sea(file, sea, k + 1).resolved()) for k in range(SEEDS)]
    scene = file.resolved()
    places = {s.name: span for s, span in zip(scene.riser, pairwise(scene.borders), strict=True)}
    found = _of_seeds(xr.concat(runs, "seed", data_vars="all", join="override"), places)
    tried = set()
    for limit, expected in zip(scene.limits, allowances(file, sea, SEEDS), strict=True):
        if limit.mode != "drilling" or "as estimated" in expected.missing:
            continue
        one = found[_name(limit)]
        if not one.dims:
            assert float(one) == pytest.approx(expected.value, rel=2e-3, abs=SMALL)
        for place in places if one.dims else ():
            added = float(one.sel(place=place))
            assert added == pytest.approx(expected.by_place[place], rel=2e-3)
        tried.add(_name(limit))
    assert {"lfj_angle", "ufj_angle", "mean_ufj_angle", "joint_stroke"} <= tried
