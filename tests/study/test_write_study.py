"""A big study is joined in parts: the same file as at once, whichever axis is the longest."""

import pytest
import short_study
import xarray as xr

from riserstudy.study import write_study

STUDIES = """\
paper: parts
studies:
  rest:
    scene: scenes/riser.yaml
    caption: at rest, held against limits
    set: {analysis: {mesh: {elements: 6}}, platform: null, top.x: held}
    limits:
      - {output: lfj_angle, largest: 2 deg, mode: drilling}
    axes:
      end:
        free: {}
        on a joint: {bottom.rotation: {stiffness: 40 kN*m/deg}}
      tension: {path: top.tension, unit: kN, values: {start: 1500, stop: 2500, step: 100}}
      mass: {path: "riser[0].mass", unit: kg/m, values: [600, 700]}
  moving:
    scene: scenes/riser.yaml
    caption: histories
    set: {analysis: {duration: 40 s, output: {interval: 0.1 s}, mesh: {elements: 6}, step: 0.2 s}}
    axes:
      amplitude: {path: platform.surge.amplitude, unit: m, values: {start: 0.5, stop: 4, step: 0.5}}
      period: {path: platform.surge.period, unit: s, values: [9, 12]}
  sampled:
    scene: scenes/riser.yaml
    caption: over an unspecified input, with modes
    set:
      analysis: {mesh: {elements: 6}}
      platform: null
      top.x: held
      top.tension: {assumed: 2000 kN, range: [1500 kN, 2500 kN], because: "a range"}
    modes: 3
    axes:
      sample: {count: {preview: 8, standard: 16, reference: 16}, seed: 3}
  allowed:
    scene: scenes/riser.yaml
    caption: against one allowable after the other
    set: {analysis: {mesh: {elements: 6}}, platform: null, top.x: held}
    limits:
      - {output: lfj_angle, largest: 2 deg, mode: drilling}
      - {output: bending_moment, largest: 2 MN*m, mode: connected}
    axes:
      largest: {path: "limits[0].largest", unit: deg, values: {start: 0.5, stop: 4.5, step: 0.25}}
      tension: {path: top.tension, unit: kN, values: {start: 1000, stop: 2500, step: 500}}
  governed:
    scene: scenes/riser.yaml
    caption: many tensions against limits that errors decide
    set: {analysis: {mesh: {elements: 5}}, platform: null, top.x: held}
    limits:
      - {output: lfj_angle, largest: 1.6 deg, mode: drilling}
      - {output: lfj_angle, largest: 1.7 deg, mode: connected}
      - {output: lfj_angle, largest: 1.8 deg, mode: disconnect}
    axes:
      tension: {path: top.tension, unit: kN, values: {start: 1500, stop: 2500, step: 20}}
  meshes:
    scene: scenes/riser.yaml
    caption: points with several meshes
    set: {platform: null, top.x: held}
    axes:
      mesh:
        coarse: {analysis: {mesh: {elements: 6}}}
        fine: {analysis: {mesh: {elements: 12}}}
        finest: {analysis: {mesh: {elements: 24}}}
"""


@pytest.fixture
def study_of(tmp_path, monkeypatch):
    """A study by its name, in a store of its own."""
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path / "cache"))
    return short_study.studies_in(tmp_path, "parts", STUDIES)


@pytest.mark.long
@pytest.mark.parametrize(
    "name, at_once, parts",
    [("rest", 9, 6), ("moving", 5, 4), ("sampled", 5, 4), ("rest", 43, 2), ("governed", 4, 13)],
)
def test_a_study_in_parts_has_the_dataset_of_one_that_is_joined_at_once(
    study_of, tmp_path, monkeypatch, name, at_once, parts
):
    told = []
    write_study.write_study(study_of(name), tmp_path / "whole.nc", 1, told.append)
    assert len(told) == 1
    monkeypatch.setattr(write_study, "AT_ONCE", at_once)
    write_study.write_study(study_of(name), tmp_path / "parts.nc", 1, told.append)
    assert len(told) == 1 + parts
    with (
        xr.open_dataset(tmp_path / "whole.nc", engine="netcdf4") as whole,
        xr.open_dataset(tmp_path / "parts.nc", engine="netcdf4") as in_parts,
    ):
        whole, in_parts = (one.drop_vars(["wall_seconds", "solve_seconds"]) for one in (whole, in_parts))
        xr.testing.assert_identical(whole, in_parts)
        assert [*whole.variables] == [*in_parts.variables]
    assert {path.name for path in tmp_path.glob("*.nc*")} == {"whole.nc", "parts.nc"}
    assert not [*tmp_path.glob(".*.nc*")]


@pytest.mark.long
@pytest.mark.parametrize("name, at_once", [("meshes", 2), ("allowed", 4), ("allowed", 9)])
def test_points_on_several_meshes_or_with_several_allowables_are_joined_at_once(
    study_of, tmp_path, monkeypatch, name, at_once
):
    told = []
    write_study.write_study(study_of(name), tmp_path / "whole.nc", 1, told.append)
    monkeypatch.setattr(write_study, "AT_ONCE", at_once)
    write_study.write_study(study_of(name), tmp_path / "parts.nc", 1, told.append)
    assert any("different meshes or allowables" in line for line in told)
    with (
        xr.open_dataset(tmp_path / "whole.nc", engine="netcdf4") as whole,
        xr.open_dataset(tmp_path / "parts.nc", engine="netcdf4") as in_parts,
    ):
        xr.testing.assert_identical(whole, in_parts)
