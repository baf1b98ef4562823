"""Natural modes over a grid: what ``modes`` gives for each scene, stored as points are."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from short_study import CURRENT, SCENE

import riserstudy
from riserstudy.database import prune
from riserstudy.database.read_dataset import read_dataset
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.errors import InputError, SimulationError
from riserstudy.inputs.plain_yaml import plain_yaml
from riserstudy.scene.load import read_scene
from riserstudy.study import modes as of_study
from riserstudy.study import simulate_points
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.new import new_study
from riserstudy.study.repeat_point import rerun
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel

ROOT = Path(__file__).parents[2]
MASS = 500.0  # kg/m
#: without weight its tension is the same all along
STRING = {
    "title": "a string",
    "riser": [
        {
            "name": "a",
            "length": "400 m",
            "axial_stiffness": "1e10 N",
            "mass": f"{MASS} kg/m",
            "submerged_weight": "0 N/m",
            "lateral_load": "1 N/m",
        }
    ],
    "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "free"},
    "top": {"x": "held", "z": "free", "tension": "1 MN", "rotation": "free"},
    "analysis": {"mesh": {"elements": 200}},
}
TENSION = {"path": "top.tension", "unit": "kN", "values": [500, 900.5, 2000]}
LENGTH = {"path": "riser[0].length", "unit": "m", "values": [200, 350]}
AT_REST = {"platform": None, "top.x": "held", "analysis": {"mesh": {"elements": 30}}}


@pytest.fixture(autouse=True)
def own_files(own_store, tmp_path):
    (tmp_path / "string.yaml").write_text(json.dumps(STRING))
    (tmp_path / "riser.yaml").write_text(SCENE)
    (tmp_path / "current.csv").write_text(CURRENT)


def study(folder, **about):
    about = {"caption": "c", "scene": "string.yaml", "axes": {"tension": TENSION}} | about
    return Study("own", "one", StudyModel.model_validate(about), folder, "standard")


def made(folder, **about):
    planned = study(folder, **about)
    return dataset_of(planned, results_of(planned, 1, lambda _: None)[0])


def test_periods_and_shapes_of_strings_are_those_of_the_closed_form(tmp_path):
    """f = n / 2 L sqrt(T / m), and a sine; the string is stretched by a ten-thousandth."""
    found = made(tmp_path, axes={"tension": TENSION, "length": LENGTH}, modes=3)
    assert found["natural_period"].dims == ("tension", "length", "mode")
    tension, length, mode = (found[name] for name in ("tension", "length", "mode"))
    period = 2.0 * length / mode * np.sqrt(MASS / (1e3 * tension))
    np.testing.assert_allclose(
        found["natural_period"], period.transpose("tension", "length", "mode"), rtol=1e-3
    )
    np.testing.assert_allclose(found["natural_frequency"] * found["natural_period"], 1.0)
    assert (found["mode_motion"] == "lateral").all()
    sine = np.sin(np.pi * mode * found["s_relative"])
    shape = found["mode_shape_x"]
    np.testing.assert_allclose(abs(shape).max("s_relative"), 1.0, atol=1e-3)
    off = abs(shape - sine).max("s_relative")  # the larger of two equal sides may be either
    other = abs(shape + sine).max("s_relative")
    assert float(np.minimum(off, other).max()) < 5e-3
    assert float(off.sel(mode=1).max()) < 5e-3


@pytest.mark.parametrize("scene, on_top", [("riser.yaml", AT_REST), ("string.yaml", {})])
def test_modes_of_a_point_are_those_of_its_scene(scene, on_top, tmp_path):
    found = made(tmp_path, scene=scene, set=on_top, modes=4, keep=["x"])
    file = read_scene(tmp_path / scene).with_values(on_top, "test")
    for tension in found["tension"].values:
        alone = riserstudy.modes(file.with_values({"top.tension": f"{tension} kN"}, "test"), 4)
        point = found.sel(tension=tension)
        for name, own in (("natural_period", "natural_period"), ("natural_frequency", "frequency")):
            np.testing.assert_array_equal(point[name], alone[own])
        assert point["mode_motion"].values.tolist() == alone["motion"].values.tolist()
        at_nodes = np.interp(
            alone["s"], point["s_relative"] * float(alone["s"][-1]), point["mode_shape_x"][0]
        )
        np.testing.assert_allclose(at_nodes, alone["x"][0], atol=2e-3)
        largest = np.maximum(abs(alone["x"]).max("s"), abs(alone["z"]).max("s"))
        np.testing.assert_array_equal(largest, 1.0)


def test_what_is_stored_is_not_made_again_and_runs_are_shared(tmp_path, monkeypatch):
    plain = made(tmp_path)  # whose points the next needs, too
    simulated, computed = [], []
    run, make = simulate_points._simulate, of_study.modes_result
    monkeypatch.setattr(of_study, "modes_result", lambda *a: computed.append(1) or make(*a))
    monkeypatch.setattr("riserstudy.simulation.refine.run", lambda *a, **k: simulated.append(1))
    first = made(tmp_path, modes=3)
    assert (len(simulated), len(computed)) == (0, 3)
    again = made(tmp_path, modes=3)
    assert (len(simulated), len(computed)) == (0, 3)
    xr.testing.assert_identical(again, first)
    more = made(tmp_path, modes=5)
    assert (len(simulated), len(computed)) == (0, 6)
    xr.testing.assert_equal(more["natural_period"].sel(mode=[1, 2, 3]), first["natural_period"])
    np.testing.assert_array_equal(first["point_key"], plain["point_key"])
    assert run is simulate_points._simulate


def test_the_study_of_the_page_about_own_studies_runs_as_it_stands(tmp_path, monkeypatch):
    text = (ROOT / "docs/own_study.md").read_text("utf-8")
    block = next(b for b in re.findall(r"```yaml\n(.*?)```", text, re.DOTALL) if "modes:" in b)
    new_study(tmp_path / "new")
    model = plain_yaml(block, "page")["studies"]["periods"]
    planned = Study(
        "example", "periods", StudyModel.model_validate(model), tmp_path / "new/config", "standard"
    )
    found = dataset_of(planned, results_of(planned, 1, lambda _: None)[0])
    first = found["natural_period"].sel(mode=1)
    assert (np.diff(first) > 0.0).all()  # the cylinders pull the same: less tension is left below
    assert "x" not in found


def test_the_digest_tells_how_many_modes_are_asked_for(tmp_path):
    digests = {study(tmp_path, **about).digest for about in ({}, {"modes": 3}, {"modes": 4})}
    assert len(digests) == 3


def test_a_point_with_modes_is_run_anew(tmp_path):
    write_dataset(made(tmp_path, modes=3), tmp_path / "one.nc")
    dataset = xr.load_dataset(tmp_path / "one.nc", decode_times=False)
    found = rerun(dataset, {"tension": "900.5"})
    assert {"natural_period", "mode_shape_x", "mode_motion"} <= found.changes.keys()
    assert max(found.changes.values()) <= 1e-9
    other = dataset.copy(deep=True)
    other["natural_period"].values[1, 0] *= 1.001
    assert rerun(other, {"tension": "900.5"}).changes["natural_period"] == pytest.approx(1e-3, rel=0.01)


def test_the_database_has_periods_and_leaves_shapes_to_the_dataset(tmp_path):
    write_dataset(made(tmp_path, modes=3), tmp_path / "one.nc")
    grids = read_dataset(tmp_path / "one.nc").grids
    over = {tuple(axis.name for axis in grid.axes): grid for grid, _ in grids}
    assert over.keys() == {("tension",), ("tension", "mode")}
    names = {variable.name for variable in over["tension", "mode"].variables}
    assert names == {"natural_period", "natural_frequency", "frequency_error", "mode_motion"}


def test_what_is_needed_of_the_store_are_modes_too(tmp_path):
    for name in ("studies", "scenes"):
        (tmp_path / name).mkdir()
    (tmp_path / "scenes/string.yaml").write_text(json.dumps(STRING))
    tiers = {tier: {} for tier in ("preview", "standard", "reference")}
    config = {"papers": ["own"], "tier": "standard", "tiers": tiers}
    (tmp_path / "config.yaml").write_text(json.dumps(config))
    model = {"scene": "scenes/string.yaml", "caption": "c", "axes": {"tension": TENSION}, "modes": 3}
    (tmp_path / "studies/own.yaml").write_text(json.dumps({"paper": "own", "studies": {"one": model}}))
    keys = [point.key for point in study(tmp_path, scene="scenes/string.yaml").plan]
    assert prune.planned(tmp_path, tmp_path) == {*keys, *(of_study.key_of_modes(key, 3) for key in keys)}


def test_a_scene_without_mass_has_no_modes(tmp_path):
    massless = {"riser[0].mass": None}
    with pytest.raises(SimulationError, match="modes require mass"):
        made(tmp_path, set=massless, modes=2)
    file = read_scene(tmp_path / "string.yaml").with_values(massless, "test")
    with pytest.raises(SimulationError, match="modes require mass"):
        riserstudy.sweep(file, {"top.tension": ["900 kN", "1 MN"]}, modes=2, cores=1, progress=False)


def test_a_sweep_has_modes_and_none_where_a_point_fails(tmp_path):
    axes = {"mass": {"some": {}, "none": {"riser[0].mass": None}}}
    found = riserstudy.sweep(tmp_path / "string.yaml", axes, modes=2, cores=1, progress=False)
    assert "modes require mass" in str(found["failure"].sel(mass="none").item())
    assert np.isfinite(found["natural_period"].sel(mass="some")).all()
    assert np.isnan(found["natural_period"].sel(mass="none")).all()


def test_an_axis_may_be_called_mode_where_no_modes_are_asked_for(tmp_path):
    axes = {"mode": {"soft": {}, "hard": {"top.tension": "2 MN"}}}
    assert study(tmp_path, axes=axes).axes["mode"]
    with pytest.raises(ValueError, match=r"axes\.mode: this is also the name of an output of modes"):
        study(tmp_path, axes=axes, modes=2)


@pytest.mark.parametrize("count", [0, -1])
def test_no_mode_is_no_request(count, tmp_path):
    with pytest.raises(InputError, match="1 or more"):
        riserstudy.modes(tmp_path / "string.yaml", count)
    with pytest.raises(ValueError, match="modes"):
        study(tmp_path, modes=count)
