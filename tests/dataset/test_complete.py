"""What CF asks of datasets, whoever made them."""

import sys
from importlib import import_module

import netCDF4
import numpy as np
import pytest
import xarray as xr
from short_study import lay_out, simulated

from riserstudy.chapters.derive import derive
from riserstudy.dataset.complete import complete
from riserstudy.dataset.variables import cf_unit
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.study.new import TEMPLATE


def faults(path):
    """What a checker of the conventions would find."""
    with netCDF4.Dataset(path) as dataset:
        for name in ("Conventions", "title", "history"):
            if not getattr(dataset, name, ""):
                yield name
        for name, variable in dataset.variables.items():
            attributes = variable.ncattrs()
            numbers = variable.dtype is not str and variable.dtype.kind in "fiu"
            if not name.replace("_", "").isalnum() or not name[0].isalpha():
                yield f"name {name}"
            if "long_name" not in attributes:
                yield f"long name of {name}"
            if numbers and "units" not in attributes:
                yield f"unit of {name}"
            if name in dataset.dimensions and "_FillValue" in attributes:
                yield f"fill value of {name}"


def test_a_simulated_and_a_derived_dataset_have_all_of_it(tmp_path, monkeypatch):
    lay_out(tmp_path / "study")
    chapter = TEMPLATE / "chapters/example/derived.py"
    (tmp_path / "study/chapters/example/derived.py").write_text(chapter.read_text("utf-8"), "utf-8")
    monkeypatch.chdir(tmp_path / "study")
    monkeypatch.syspath_prepend(tmp_path / "study")
    source = simulated("heave")
    write_dataset(source, tmp_path / "a.nc")
    assert list(faults(tmp_path / "a.nc")) == []
    swing = derive("example", "tension_swing", {"heave": source})
    write_dataset(swing, tmp_path / "b.nc")
    assert list(faults(tmp_path / "b.nc")) == []


def test_what_was_said_stays_and_units_have_one_spelling():
    told = {"units": "m/s", "long_name": "speed of the ship"}
    dataset = xr.Dataset(
        {"speed": ("t", [1.0], told), "turn": ("t", [2.0], {"units": "deg"}), "count": ("t", [3])}
    )
    found = complete(dataset)
    assert found["speed"].attrs == {"units": "m s-1", "long_name": "speed of the ship"}
    assert found["turn"].attrs == {"units": "degree", "long_name": "turn"}
    assert found["count"].attrs == {"units": "1", "long_name": "count"}
    assert dataset["count"].attrs == {}


@pytest.mark.parametrize("unit", ["m s-1", "kN s2 m-2", "1", "degree", "N2 m2 Hz-1", "rad m-1"])
def test_a_unit_that_is_spelt_so_stays(unit):
    assert cf_unit(unit) == unit


def test_axes_are_written_without_a_fill_value(tmp_path):
    dataset = xr.Dataset({"a": ("x", np.arange(3.0))}, {"x": [0.0, 1.0, 2.0]})
    write_dataset(dataset.assign_attrs(title="t", history="h"), tmp_path / "c.nc")
    assert list(faults(tmp_path / "c.nc")) == []


def test_a_library_that_xarray_has_found_is_found_again_after_it_was_kept_away():
    from xarray.namedarray.utils import module_available

    from riserstudy.dataset.without import without

    name = "scipy.odr"
    assert module_available(name)
    assert name not in sys.modules
    with without(name):
        assert not module_available(name)
    assert module_available(name)


def shares(heave):
    """What a chapter derives without a word on units."""
    force = heave["force"]
    most = abs(force).max()
    return heave[["force"]].assign(share=force / most, swing=force - most)


@pytest.mark.parametrize("seed", range(5))
def test_a_derived_variable_that_the_chapter_names_has_the_unit_of_the_chapter(tmp_path, monkeypatch, seed):
    """xarray hands the attributes of operands on: a share of a tension was written as a tension in N."""
    lay_out(tmp_path / "study")
    named = "share: {units: '1', long_name: share of the tension}\nswing: {units: N, long_name: swing}\n"
    (tmp_path / "study/chapters/example/variables.yaml").write_text(named, "utf-8")
    monkeypatch.chdir(tmp_path / "study")
    monkeypatch.setattr(import_module("riserstudy.chapters.derive"), "function_of", lambda *_: shares)
    force = np.random.default_rng(seed).uniform(1.0, 9.0, 4)
    about = {"units": "N", "long_name": "tension at a place", "comment": "of the source"}
    source = xr.Dataset({"force": ("x", force, about)}, attrs={"origins": "{}"})
    write_dataset(derive("example", "shares", {"heave": source}), tmp_path / "d.nc")
    with xr.open_dataset(tmp_path / "d.nc") as found:
        told = {name: (found[name].units, found[name].long_name) for name in ("force", "share", "swing")}
    assert told == {
        "force": ("N", "tension at a place"),
        "share": ("1", "share of the tension"),
        "swing": ("N", "swing"),
    }
    assert "comment" not in found["share"].attrs
