"""Operators of motions that a symmetric hull does not make, and waves that a file gives twice."""

import cmath
import math

import numpy as np
import pytest
import xarray as xr
from random_rigs import rig, written

from riserstudy import simulate
from riserstudy.errors import InputError
from riserstudy.importers.capytaine import from_capytaine
from riserstudy.importers.operators import write_table
from riserstudy.importers.wamit import from_wamit
from riserstudy.scene.load import SceneFile

MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
PERIODS = (6.0, 9.0, 12.0, 16.0)


def drawn(seed, still):
    """Complex operators by motion and period, zero or rounding for the motions at rest."""
    draw = np.random.default_rng(seed)
    values = {}
    for name in MOTIONS:
        for period in PERIODS:
            size = draw.uniform(0.1, 0.9) * (0.01 if name in MOTIONS[3:] else 1.0)
            size = draw.choice([0.0, 1e-14]) if name in still else size
            values[name, period] = cmath.rect(size, draw.uniform(-math.pi, math.pi))
    return values


def wamit(path, values, newline="\n", mark=""):
    lines = [
        f"{period:.6E} 0.0 {k + 1} {abs(v):.6E} {math.degrees(cmath.phase(v)):.6E} {v.real:.6E} {v.imag:.6E}"
        for (name, period), v in values.items()
        for k in [MOTIONS.index(name)]
    ]
    path.write_bytes((mark + newline.join(lines) + newline).encode())
    return from_wamit(path, 1.0, "period")


def capytaine(path, values, periods=PERIODS, headings=(0.0,)):
    table = np.array([[[values[name, p] for name in MOTIONS] for p in periods] for _ in headings])
    coordinates = {
        "complex": ["re", "im"],
        "wave_direction": np.radians(headings),
        "period": np.array(periods),
        "radiating_dof": [name.capitalize() for name in MOTIONS],
    }
    parts = np.stack([table.real, table.imag])
    xr.Dataset({"RAO": xr.DataArray(parts, coordinates, tuple(coordinates))}).to_netcdf(path)
    return from_capytaine(path)


@pytest.mark.parametrize("code", ["wamit", "capytaine"])
@pytest.mark.parametrize("seed", range(6))
def test_a_hull_in_head_seas_leaves_a_rig_in_its_plane(tmp_path, seed, code):
    """A rig in the plane has the same signed results as with the motions in the plane only."""
    values = drawn(seed, ("sway", "roll", "yaw"))
    make = {"wamit": wamit, "capytaine": capytaine}[code]
    found = make(tmp_path / ("hull.4" if code == "wamit" else "hull.nc"), values)
    assert {line for line in found.left_out if "zero in all waves" in line} == {
        f"{name}: zero in all waves" for name in ("sway", "roll", "yaw")
    }
    write_table(found, tmp_path / "rao.csv")
    tree = written(rig(seed, spatial=False, conductor=False))
    wave = {"height": "2 m", "period": "9 s"}
    response = {"operators": {"file": "rao.csv"}, "phases": found.phases, "headings": "towards", "wave": wave}
    tree["platform"]["response"] = response | {"ramp": "9 s"}
    tree["analysis"] = {"duration": "9 s", "step": "0.3 s", "mesh": {"elements": 15}}
    tree["analysis"]["output"] = {"interval": "0.9 s"}
    file = SceneFile(str(tmp_path / "scene.yaml"), tree)
    three = {"platform.response.motions": ["surge", "heave", "pitch"]}
    run, plane = (simulate(one, progress=False) for one in (file, file.with_values(three, "test")))
    assert "y" not in run
    assert run["ufj_angle"].values == pytest.approx(plane["ufj_angle"].values, abs=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_a_motion_that_is_not_zero_in_one_wave_stays(tmp_path, seed):
    draw = np.random.default_rng(seed)
    values = drawn(seed, ("sway", "roll", "yaw"))
    name = str(draw.choice(["sway", "roll", "yaw"]))
    values[name, PERIODS[draw.integers(4)]] = 1e-3
    columns = capytaine(tmp_path / "hull.nc", values).columns
    assert f"{name}_phase (deg)" in columns
    assert len(columns) == 2 + 2 * 4


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("what", ["period", "heading"])
def test_a_wave_that_a_dataset_gives_twice_is_refused(tmp_path, seed, what):
    values = drawn(seed, ())
    periods = (*PERIODS, PERIODS[seed]) if what == "period" else PERIODS
    with pytest.raises(InputError, match="occurs twice"):
        capytaine(tmp_path / "hull.nc", values, periods, (0.0, 0.0) if what == "heading" else (0.0,))


@pytest.mark.parametrize("seed", range(4))
def test_line_ends_and_marks_of_windows_change_nothing(tmp_path, seed):
    values = drawn(seed, ())
    plain = wamit(tmp_path / "a.4", values)
    for newline in ("\r\n", "\r"):
        assert wamit(tmp_path / "b.4", values, newline, "\ufeff") == plain
    write_table(plain, tmp_path / "rao.csv")
    tree = written(rig(seed, spatial=True, conductor=False))
    response = {"operators": {"file": "rao.csv"}, "phases": "lead", "headings": "towards"}
    tree["platform"]["response"] = response | {"wave": {"height": "2 m", "period": "9 s"}}
    text = (tmp_path / "rao.csv").read_text()
    scenes = []
    for newline, mark in (("\n", ""), ("\r\n", "\ufeff"), ("\r", "")):
        (tmp_path / "rao.csv").write_bytes((mark + text.replace("\n", newline)).encode())
        scenes.append(SceneFile(str(tmp_path / f"{len(scenes)}.yaml"), tree).resolved())
    assert scenes[0] == scenes[1] == scenes[2]
