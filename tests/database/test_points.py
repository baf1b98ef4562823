"""From points of the database back to arrays."""

import json
from pathlib import Path

import numpy as np
import pytest
import workspace
import xarray as xr
from ruamel.yaml import YAML

from riserstudy import dataset_of, open_point, query, simulate
from riserstudy.dataset.provenance import scene_file_of
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.study import store


def dataset(name):
    """A dataset as xarray alone reads it."""
    with xr.open_dataset(workspace.RESULTS / f"{name}.nc", decode_times=False) as found:
        return found.load()


def keys(study):
    """Points of a study with their keys."""
    asked = "select point, key from points where study = ? order by position"
    return query(asked, [study])


def test_a_selection_of_points_has_the_arrays_of_their_study(here):
    points = query("select point from plain_surge where amplitude = 2.5 order by period desc")
    found = dataset_of(points["point"])
    surge = dataset("plain/surge").sel(amplitude=2.5).isel(period=[2, 1, 0])
    assert found["x"].dims == ("point", "time", "s")
    assert found["period"].values.tolist() == [15.0, 12.0, 9.0]
    for name in ("x", "bending_moment_max", "wall_seconds", "point_key"):
        np.testing.assert_array_equal(found[name].values, surge[name].values)
    assert found["point"].values.tolist() == points["point"].tolist()
    assert found["x"].attrs["units"] == "m"


def test_points_of_different_grids_stand_over_all_their_nodes_and_times(here):
    meshes, surge = keys("plain/meshes")["point"], keys("plain/surge")["point"]
    chosen = [int(meshes[2]), int(surge[0]), int(meshes[0])]
    found = dataset_of(chosen)
    assert found["point"].values.tolist() == chosen
    assert found["study"].values.tolist() == ["plain/meshes", "plain/surge", "plain/meshes"]
    for place, (name, at) in enumerate(
        [("plain/meshes", {"mesh": 2}), ("plain/surge", {"amplitude": 0, "period": 0})]
    ):
        own = dataset(name).isel(at)
        there = found.isel(point=place).sel(s_node=own["s_node"], time=own["time"], s=own["s"])
        for variable in ("x_max", "x", "bending_moment"):
            np.testing.assert_array_equal(there[variable].values, own[variable].values)
    foreign = ~np.isin(found["s_node"].values, dataset("plain/surge")["s_node"].values)
    assert foreign.any()
    assert np.isnan(found["x_max"].isel(point=1).values[foreign]).all()


def add_study(name, axes):
    """Add a study of surge to a paper, with its dataset, and build the database again."""
    path = Path("config/studies/plain.yaml")
    yaml = YAML()
    tree = yaml.load(path)
    about = {"scene": "scenes/surge.yaml", "set": workspace.PRESCRIBED, "caption": name, "axes": axes}
    tree["studies"][name] = json.loads(json.dumps(about))
    yaml.dump(tree, path)
    workspace.simulate("plain", name)
    workspace.built()


@pytest.mark.parametrize("unit, size", [("mm", 1e-3), ("ft", 0.3048), ("km", 1e3), ("m", 1.0)])
@pytest.mark.parametrize("first", ["plain/surge", "plain/other"])
def test_axes_in_several_units_have_the_unit_of_the_first(mine, unit, size, first):
    values = [round(metres / size, 9) for metres in (1.25, 2.0)]
    add_study("other", {"amplitude": {**workspace.AMPLITUDES, "unit": unit, "values": values}})
    chosen = [int(p) for study in ("plain/surge", "plain/other") for p in keys(study)["point"]]
    chosen = chosen if first == "plain/surge" else chosen[::-1]
    found = dataset_of(chosen)["amplitude"]
    in_metres = found.values * (1.0 if first == "plain/surge" else size)
    for metres, point in zip(in_metres, chosen, strict=True):
        asked = "select value from parameters where point = ? and path = 'platform.surge.amplitude'"
        assert metres == pytest.approx(query(asked, [point])["value"].item(), rel=1e-9)
    assert found.attrs["units"] == ("m" if first == "plain/surge" else unit)


def test_axes_of_one_name_and_several_dimensions_are_refused(mine):
    path = "platform.surge.period"
    add_study("other", {"amplitude": {"path": path, "unit": "s", "values": [9.5, 11.0]}})
    chosen = [int(keys(study)["point"][0]) for study in ("plain/surge", "plain/other")]
    with pytest.raises(InputError, match="plain/other: amplitude: the unit is 's', but 'm' in another study"):
        dataset_of(chosen)


def test_every_variable_of_selected_points_has_a_name_and_a_unit(here):
    points = [int(keys(study)["point"][0]) for study in ("plain/meshes", "plain/surge")]
    for chosen in (points, points[:1]):
        for name, of in dataset_of(chosen).variables.items():
            assert "long_name" in of.attrs, name
            assert ("units" in of.attrs) == (of.dtype.kind in "fiu"), name


def test_a_point_asked_for_twice_comes_twice(here):
    point = int(keys("plain/surge")["point"][1])
    found = dataset_of([point, point])
    assert found.sizes["point"] == 2
    np.testing.assert_array_equal(found["x"].values[0], found["x"].values[1])


def test_a_study_without_axes_has_its_point_too(here):
    found = dataset_of(keys("plain/one")["point"])
    np.testing.assert_array_equal(found["x"].values[0], dataset("plain/one")["x"].values)


@pytest.mark.parametrize("points", [[], [10**9], [1, 10**9]])
def test_points_that_are_not_there_are_told(here, points):
    with pytest.raises(InputError, match="no point"):
        dataset_of(points)


def test_a_dataset_that_is_gone_is_told(mine):
    (workspace.RESULTS / "plain/surge.nc").unlink()
    with pytest.raises(InputError, match=r"plain/surge\.nc"):
        dataset_of(keys("plain/surge")["point"])


def test_a_point_opens_as_its_scene_is_simulated(here):
    key = keys("plain/surge")["key"][4]
    found = open_point(key)
    about = store.about(key)
    anew = simulate(SceneFile(about["source"], about["scene"]))
    assert {*found.data_vars} <= {*anew.data_vars}
    for name in ("x", "z", "effective_tension", "bending_moment", "x_max"):
        np.testing.assert_array_equal(found[name].values, anew[name].values)
        assert found[name].attrs == anew[name].attrs
    provenance = json.loads(found.attrs["provenance"])
    assert provenance["engine"] == about["engine"]
    assert provenance["scene"]["platform"]["surge"]["period"] == "12.0 s"


def test_a_point_says_what_its_study_left_out_and_the_rest_is_simulated_again(mine):
    key = keys("plain/sampled")["key"][2]
    found, whole = open_point(key), open_point(key, whole=True)
    left_out = json.loads(found.attrs["left_out"])
    assert {"z_max", "effective_tension", "x_absmax"} <= {*left_out}
    assert {"x", "bending_moment_max"} <= {*found.data_vars}
    assert not {*left_out} & {*found.variables}
    about = store.about(key)
    anew = simulate(SceneFile(about["source"], about["scene"]))
    assert {*whole.data_vars} == {*anew.data_vars}
    assert json.loads(whole.attrs["left_out"]) == []
    for name in ("x", "z", "effective_tension", "bending_moment_max"):
        np.testing.assert_array_equal(whole[name].values, anew[name].values)
    np.testing.assert_array_equal(found["bending_moment_max"], whole["bending_moment_max"])
    assert open_point(key).identical(found)


@pytest.mark.parametrize("whole", [False, True])
@pytest.mark.parametrize("name", ["surge", "sampled", "meshes"])
def test_a_point_has_the_origins_and_the_errors_of_its_study(here, name, whole):
    study = dataset(f"plain/{name}")
    for place, key in enumerate(keys(f"plain/{name}")["key"]):
        indices = np.unravel_index(place, study["point_key"].shape)
        at = dict(zip(study["point_key"].dims, map(int, indices), strict=True))
        found = open_point(key, whole)
        of_point, of_study = scene_file_of(found, {}), scene_file_of(study, at)
        assert of_point.assumed == of_study.assumed
        statuses = [{p: o.status for p, o in f.origins.items()} for f in (of_point, of_study)]
        assert statuses[0] == statuses[1]
        own = study.isel(at)
        for quantity in ("displacement", "moment", "tension"):
            error = own.get(f"error_{quantity}", np.nan)
            estimate = json.loads(found.attrs["error_estimate"]).get(quantity, np.nan)
            np.testing.assert_array_equal(estimate, error)


@pytest.mark.parametrize("seed", range(3))
def test_a_point_with_another_table_than_its_scene_has_now_is_refused(mine, monkeypatch, seed):
    """Else its dataset would hold a table that it was not simulated with."""
    table = Path("config/scenes/current.csv")
    draw = np.random.default_rng(seed)
    speeds = draw.uniform(0.1, 0.9, (2, 2)).round(3).tolist()
    texts = [f"elevation (m), speed (m/s)\n-9000, {low}\n9000, {high}\n" for high, low in speeds]
    table.write_text(texts[0])
    add_study("other", {"flow": {"measured": {"current": {"profile": {"file": "current.csv"}}}}})
    key = keys("plain/other")["key"][0]
    before = open_point(key)
    assert json.loads(before.attrs["provenance"])["tables"] == {"current.csv": texts[0]}
    table.write_text(texts[1])
    with pytest.raises(InputError, match="was simulated with other tables than the present"):
        open_point(key)
    table.write_text(texts[0])
    assert open_point(key).identical(before)
    with monkeypatch.context() as edited:  # an engine that came later reads the points of the former one
        edited.setattr(store, "engine_digest", lambda: "another version of the engine")
        edited.setattr("riserstudy.files.digests.engine_digest", lambda: "another version of the engine")
        assert open_point(key).identical(before)
        table.write_text(texts[1])
        with pytest.raises(
            InputError, match=r"other tables than the present .*, or by another version of the engine"
        ):
            open_point(key)


def test_another_engine_does_not_tell_the_rest_of_a_point(mine, monkeypatch):
    key = keys("plain/sampled")["key"][2]
    monkeypatch.setattr(store, "engine_digest", lambda: "another version of the engine")
    with pytest.raises(InputError, match="another version of the engine"):
        open_point(key, whole=True)


@pytest.mark.parametrize("damage", ["gone", "flipped"])
def test_a_point_that_is_gone_or_damaged_is_told(mine, damage):
    key = keys("plain/surge")["key"][0]
    (held,) = [held for held in store.everything() if held.key == key]
    content = bytearray(held.path.read_bytes())
    content[len(content) // 2] ^= 1
    held.path.write_bytes(content)
    if damage == "gone":
        held.path.unlink()
    with pytest.raises(InputError, match="does not contain the complete results"):
        open_point(key)


def test_no_such_point_is_told_whatever_is_asked_for(here):
    for key in ("", "ab", "../../../etc/passwd", "'; drop"):
        with pytest.raises(InputError, match="does not contain the complete results"):
            open_point(key)
