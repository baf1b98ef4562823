"""A point run anew from its dataset alone."""

import shutil

import numpy as np
import pytest
import xarray as xr
from short_study import lay_out, simulated

from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.errors import InputError
from riserstudy.scene.load import read_scene
from riserstudy.simulation import prescribed_run
from riserstudy.simulation.simulate import simulate
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.models import StudyFile
from riserstudy.study.repeat_point import rerun
from riserstudy.study.study import Study


@pytest.fixture(scope="module")
def dataset(tmp_path_factory):
    """A dataset whose scene and tables are gone."""
    folder = tmp_path_factory.mktemp("rerun") / "study"
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RISERSTUDY_CACHE", "")
        lay_out(folder)
        patch.chdir(folder)
        write_dataset(simulated("heave"), folder.parent / "heave.nc")
    shutil.rmtree(folder)
    return xr.load_dataset(folder.parent / "heave.nc", decode_times=False)


@pytest.mark.parametrize("amplitude", ["1", "2.0"])
def test_the_same_numbers_come_from_the_dataset_alone(dataset, amplitude):
    found = rerun(dataset, {"surge_amplitude": amplitude})
    assert found.place == {"surge_amplitude": float(amplitude)}
    assert found.engines[0] == found.engines[1]
    assert {"x", "bending_moment", "effective_tension_max", "smallest_tension"} <= {*found.changes}
    # stored by kernels that were compiled apart from these, sums may round otherwise; errors and residuals
    # are differences of numbers that are nearly the same
    changed = {name: change for name, change in found.changes.items() if change > 1e-9}
    assert changed.keys() <= {"error_tension", "unexplained_energy"}
    assert all(change < 1e-5 for change in changed.values())


def test_all_of_the_run_is_there(dataset):
    found = rerun(dataset.drop_vars("x"), {"surge_amplitude": "1"})
    assert "x" not in found.changes
    kept = dataset["x"].sel(surge_amplitude=1.0)
    np.testing.assert_allclose(found.run["x"], kept, rtol=1e-9, atol=1e-9)
    assert found.run.attrs["source"] == dataset.attrs["scene_file"]
    assert "300, 1.1" in found.run.attrs["provenance"]


def test_another_scene_or_another_table_is_seen(dataset):
    for name, old, new in (
        ("scene", '"mass": "700 kg/m"', '"mass": "800 kg/m"'),
        ("tables", "300, 1.1", "300, 1.2"),
    ):
        assert old in dataset.attrs[name]
        other = dataset.assign_attrs({name: dataset.attrs[name].replace(old, new)})
        found = rerun(other, {"surge_amplitude": "1"})
        assert found.changes["x"] > 1e-3


def test_a_value_that_was_changed_is_seen(dataset):
    other = dataset.copy(deep=True)
    other["x"].values[0, 10, 5] += 1e-6
    assert 1e-9 < rerun(other, {"surge_amplitude": "1"}).changes["x"] < 1e-5
    other["x"].values[0, 10, 5] = np.nan
    assert rerun(other, {"surge_amplitude": "1"}).changes["x"] == np.inf


def test_a_single_run_is_run_anew(tmp_path):
    lay_out(tmp_path / "study")
    scene = read_scene(tmp_path / "study/config/scenes/riser.yaml")
    one = simulate(scene.with_values({"analysis.duration": "2 s"}, "test"))
    shutil.rmtree(tmp_path / "study")
    found = rerun(one, {})
    assert found.place == {}
    assert max(found.changes.values()) == 0.0


def test_a_run_without_a_coarser_one_is_run_anew(tmp_path, monkeypatch):
    monkeypatch.setattr(prescribed_run, "_coarser", lambda *_: [])  # as if it failed
    lay_out(tmp_path)
    model = {"scene": "scenes/riser.yaml", "caption": "c", "set": {"analysis.duration": "2 s"}}
    file = StudyFile.model_validate({"paper": "own", "studies": {"one": model | {"axes": {}}}})
    study = Study("own", "one", file.studies["one"], tmp_path / "config", "standard")
    one = dataset_of(study, results_of(study, 1, lambda _: None)[0])
    assert "the error is not estimated" in one["warnings"].item()
    assert (one["error_estimated"].item(), one["error_moment"].isnull().item()) == (0, True)
    assert one.attrs["errors_estimated"].startswith("0 of 1")
    for dataset in (one, one.drop_vars("warning_records")):  # which earlier versions did not write
        assert max(rerun(dataset, {}).changes.values()) == 0.0


@pytest.mark.parametrize(
    "at, said",
    [
        ({}, "surge_amplitude=VALUE with one of 1.0, 2.0"),
        ({"surge_amplitude": "3"}, "the axis has no value 3; use one of 1.0, 2.0"),
        ({"surge_amplitude": "two"}, "the axis has no value two; use one of 1.0, 2.0"),
        ({"heave": "1"}, "no axis of this name; use one of surge_amplitude"),
    ],
)
def test_a_point_that_is_not_there_is_refused(dataset, at, said):
    with pytest.raises(InputError, match=said):
        rerun(dataset, at)


def test_a_dataset_that_was_not_simulated_is_refused():
    with pytest.raises(InputError, match="contains no scene"):
        rerun(xr.Dataset({"x": 1.0}), {})
