"""Lists of studies and points have the times, warnings and effects of the datasets."""

import json

import netCDF4
import pytest
import workspace
import xarray as xr

NAMES = ["plain/surge", "plain/meshes", "plain/one", "odd/Order-by_1"]


def rows(commands, *arguments):
    """What a command answers as JSON."""
    code, out, said = commands(*arguments, "--json")
    assert (code, said) == (0, "")
    return json.loads(out)


def read(name):
    """A dataset as xarray alone reads it."""
    with xr.open_dataset(workspace.RESULTS / f"{name}.nc", decode_times=False) as found:
        return found.load()


@pytest.mark.parametrize("warned", [0, 1, 4])
def test_a_study_has_the_sum_of_its_times_and_the_number_of_its_points_with_warnings(mine, commands, warned):
    with netCDF4.Dataset(workspace.RESULTS / "plain/surge.nc", "a") as file:
        texts = file["warnings"][...]
        texts.flat = ["a warning"] * warned + [""] * (texts.size - warned)
        file["warnings"][...] = texts
    workspace.built()
    listed = {row["study"]: row for row in rows(commands, "results")}
    for name in NAMES:
        own = read(name)
        assert listed[name]["simulated (s)"] == pytest.approx(float(own["wall_seconds"].sum()), rel=1e-12)
        assert listed[name]["warned"] == (int((own["warnings"] != "").sum()) or None)
    assert listed["plain/surge"]["warned"] == (warned or None)


@pytest.mark.parametrize("name", NAMES)
def test_a_point_that_is_found_has_the_effects_that_are_on(here, commands, name):
    own = read(name)
    effects = dict(zip(own["point_key"].values.ravel(), own["effects"].values.ravel(), strict=True))
    found = [row for row in rows(commands, "results", "/", name) if row["study"] == name]
    assert len(found) == own["point_key"].size
    for row in found:
        assert {*row["effects"].split(", ")} == {*effects[row["key"]].splitlines()}
