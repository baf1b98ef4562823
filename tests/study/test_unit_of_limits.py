"""Demands and allowables of several limits have no common unit; the attribute `limits` has that of each."""

import json
import sqlite3
from contextlib import closing

import numpy as np
import pytest
import xarray as xr

from riserstudy.database.build import build
from riserstudy.database.sources import Sources
from riserstudy.dataset.variables import attributes
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

HUNG = {
    "title": "hung",
    "riser": [{"name": "all", "length": "500 m", "axial_stiffness": "5e9 N", "submerged_weight": "1 kN/m"}],
    "bottom": {"hold": "wellhead", "elevation": "0 m"},
    "top": {"z": "free", "tension": "1 MN"},
    "analysis": {},
}
LIMITS = [
    ({"output": "effective_tension", "smallest": "350 kN", "mode": "connected"}, "N"),
    ({"output": "lower_end_tension", "largest": "1 MN", "mode": "drilling"}, "N"),
    ({"output": "tensioner_stroke", "largest": "7 m", "mode": "connected"}, "m"),
    ({"output": "lfj_angle", "largest": "2 deg", "mode": "drilling"}, "rad"),
]
OF_LIMITS = ("demand_of_limit", "allowable_of_limit")


pytestmark = pytest.mark.usefixtures("own_store")


@pytest.mark.parametrize("seed", range(6))
def test_no_heading_has_a_unit_that_its_limits_do_not_have(tmp_path, seed):
    draw = np.random.default_rng(seed)
    chosen = [LIMITS[k] for k in draw.permutation(len(LIMITS))[: int(draw.integers(1, 5))]]
    first = chosen[0][0]
    side = "smallest" if "smallest" in first else "largest"
    number, unit = first[side].split()
    axes = {
        "tension": {"path": "top.tension", "unit": "kN", "values": [700.0, 900.0]},
        "allowed": {
            "path": f"limits[0].{side}",
            "unit": unit,
            "values": [float(number), 2.0 * float(number)],
        },
    }
    one = {"scene": "hung.yaml", "caption": "c", "axes": axes, "limits": [limit for limit, _ in chosen]}
    config = tmp_path / "config"
    (config / "studies").mkdir(parents=True)
    (config / "hung.yaml").write_text(json.dumps(HUNG))
    (config / "studies/own.yaml").write_text(json.dumps({"paper": "own", "studies": {"pull": one}}))
    study = Study("own", "pull", read_studies(config, "own").studies["pull"], config, "standard")
    file = tmp_path / "results/own/pull.nc"
    write_dataset(dataset_of(study, results_of(study, 1, lambda _: None)[0]), file)
    with xr.open_dataset(file) as found:
        for name in OF_LIMITS:
            assert "units" not in found[name].attrs
            assert "unit of" in attributes(name)["long_name"]
        assert [row["unit"] for row in json.loads(found.attrs["limits"])] == [unit for _, unit in chosen]
    base = tmp_path / "results/results.sqlite"
    build(base, Sources(config, ["own"], [file]))
    with closing(sqlite3.connect(base)) as db:
        asked = f"select unit from columns where column_name in {OF_LIMITS}"
        assert {unit for (unit,) in db.execute(asked)} == {None}
