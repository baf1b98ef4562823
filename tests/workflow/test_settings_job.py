"""A study that the workflow tunes: a job of its own, made before the points, healed, and not made twice."""

import json
import os

import pytest
import short_study
import xarray as xr
from planning import dry_run

from riserstudy.simulation.compile import compile_once

pytestmark = pytest.mark.long

STUDY = """\
paper: example
studies:
  surge:
    scene: scenes/riser.yaml
    caption: surge of a short riser
    set: {analysis: {duration: 4 s, output: {interval: 0.5 s}, accuracy: 5 %}}
    settings: {points: 2, seed: 1}
    axes:
      amplitude: {path: platform.surge.amplitude, unit: m, values: [0.5, 1, 2]}
      period: {path: platform.surge.period, unit: s, values: [4, 6, 8]}
    keep: [ufj_angle]
figures: {}
"""
DATASET, SETTINGS = "results/example/surge.nc", "results/example/surge.settings.json"


@pytest.mark.parametrize("per_job", [None, 4], ids=["one job", "shards"])
def test_settings_are_tuned_once_and_the_points_depend_on_them(tmp_path, per_job):
    compile_once(print)
    short_study.lay_out(tmp_path)
    (tmp_path / "config/studies/example.yaml").write_text(STUDY)
    if per_job:
        with (tmp_path / "config/config.yaml").open("a") as config:
            config.write(f"points_per_job: {per_job}\n")

    def run():
        status, said = short_study.snakemake(tmp_path, os.environ, DATASET)
        assert status == 0, said
        return said

    def planned():
        status, said = dry_run(tmp_path, os.environ, DATASET)
        assert status == 0, said
        return said

    assert "tune example/surge" in run()
    settings = json.loads((tmp_path / SETTINGS).read_text())
    with xr.open_dataset(tmp_path / DATASET, engine="netcdf4") as dataset:
        assert json.loads(dataset.attrs["settings"]) == settings
        assert (dataset["error_estimated"].values == 1).any()
        assert (dataset["by_request"].values == 0).any() == (settings["setting"] is not None)
        error = dataset[[f"error_{name}" for name in ("displacement", "moment", "tension")]]
        assert float(error.to_array().max()) <= 0.05
    assert "Nothing to be done" in planned()
    if per_job:
        return
    (tmp_path / SETTINGS).write_text("{")
    said = run()
    assert "tune example/surge" in said
    assert json.loads((tmp_path / SETTINGS).read_text()) == settings
    text = (tmp_path / "config/studies/example.yaml").read_text()
    (tmp_path / "config/studies/example.yaml").write_text(text.replace("5 %", "4 %"))
    assert "tune example/surge" in planned()
