"""Tables and points of a current: what cannot be read is refused, and depths mean what elevations do."""

from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene
from riserstudy.errors import InputError
from riserstudy.model.sea import current_table, current_velocity

SURGE = Path(__file__).parents[2] / "config/scenes/bench/s2.yaml"

TABLES = {
    "no such file": (None, "No such file"),
    "empty": ("", "line 1: the table is empty"),
    "other columns": ("height (m), speed (m/s)\n0, 1\n1, 2\n", "depth (unit), speed (unit)"),
    "no units": ("elevation, speed\n0, 1\n1, 2\n", "elevation (unit) or depth (unit), speed (unit)"),
    "depth and elevation": ("depth (m), elevation (m), speed (m/s)\n0, 1, 1\n1, 0, 2\n", "line 1"),
    "depths that fall": ("depth (m), speed (m/s)\n1, 1\n0, 2\n", "depths do not increase"),
    "elevations that fall": ("elevation (m), speed (m/s)\n1, 1\n0, 2\n", "the elevations do not increase"),
    "a depth in the air": ("depth (m), speed (m/s)\n-1, 1\n0, 2\n", "line 2: depth"),
    "a word": ("elevation (m), speed (m/s)\n0, fast\n", "line 2"),
    "a missing value": ("elevation (m), speed (m/s)\n0, 1\n1\n", "line 3"),
    "a wrong unit": ("elevation (m), speed (kg)\n0, 1\n1, 2\n", "current.csv: line 2: speed"),
    "NaN": ("elevation (m), speed (m/s)\n0, nan\n1, 2\n", "nan"),
    "one line": ("elevation (m), speed (m/s)\n0, 1\n", "at least 2"),
}


@pytest.mark.parametrize("case", TABLES)
def test_a_table_that_cannot_be_read_is_refused(case, tmp_path):
    text, problem = TABLES[case]
    scene = tmp_path / "s2.yaml"
    scene.write_text(SURGE.read_text())
    if text is not None:
        (tmp_path / "current.csv").write_text(text)
    with pytest.raises(InputError) as refusal:
        load_scene(scene, **{"current": {"profile": {"file": "current.csv"}, "beyond": "hold"}})
    assert problem in str(refusal.value)


def test_a_table_takes_the_place_of_points(tmp_path):
    scene = tmp_path / "s2.yaml"
    scene.write_text(SURGE.read_text())
    (tmp_path / "current.csv").write_text("elevation (ft), speed (knot)\n0, 0\n1000, 2\n")
    found = load_scene(
        scene, **{"current": {"profile": {"file": "current.csv"}, "beyond": "hold"}}
    ).resolved()
    assert found.current.profile[1].elevation == pytest.approx(304.8)
    assert found.current.profile[1].speed == pytest.approx(2 * 1852 / 3600)


LEVELS = {"water.surface": "533 m", "water.seabed": "0 m"}


def test_depths_and_elevations_tell_the_same_current(tmp_path):
    (tmp_path / "up.csv").write_text("elevation (m), speed (m/s)\n100, 0.1\n433, 0.4\n533, 1\n")
    (tmp_path / "down.csv").write_text(
        "depth (m), speed (knot)\n0, 1.9438445\n100, 0.7775378\n433, 0.1943844\n"
    )
    tables = []
    for name in ("up", "down"):
        profile = {"file": str(tmp_path / f"{name}.csv")}
        scene = load_scene(SURGE, **LEVELS, current={"profile": profile, "beyond": "hold"}).resolved()
        tables.append(np.array(current_table(scene.current, scene.water)))
    np.testing.assert_allclose(tables[1], tables[0], rtol=1e-6)


@pytest.mark.parametrize("seed", range(6))
def test_a_jump_by_depth_has_the_water_above_first_and_one_by_elevation_the_water_below(seed):
    draw = np.random.default_rng(seed)
    lower, upper = np.sort(draw.uniform(10.0, 500.0, 2)).tolist()
    speeds = draw.uniform(0.1, 2.0, 6).tolist()
    bearings = draw.uniform(0.0, 360.0, 6).tolist() if seed % 2 else [None] * 6
    heights = [0.0, lower, lower, upper, upper, 533.0]
    rising = [
        {"speed": f"{speed!r} m/s"} | ({"direction": f"{bearing!r} deg"} if bearing else {})
        for speed, bearing in zip(speeds, bearings, strict=True)
    ]
    by_elevation = [{"elevation": f"{z!r} m"} | p for z, p in zip(heights, rising, strict=True)]
    by_depth = [{"depth": f"{533.0 - z!r} m"} | p for z, p in zip(heights, rising, strict=True)]
    for profile in (by_elevation, by_depth[::-1]):
        scene = load_scene(SURGE, **LEVELS, current={"profile": profile, "beyond": "hold"})
        of = scene.resolved()
        z, velocity = current_velocity(of.current, of.water)
        speed = np.hypot(*velocity)
        for level, below in ((lower, 1), (upper, 3)):
            at = np.interp([level - 1e-6, level + 1e-6], z, speed)
            np.testing.assert_allclose(at, speeds[below : below + 2], rtol=1e-5)


@pytest.mark.parametrize(
    "points, levels, reason",
    [
        ([{"depth": "0 m"}, {"depth": "9 m"}], {}, "depths require the elevation of the water surface"),
        ([{"depth": "0 m"}, {"elevation": "9 m"}], LEVELS, "in every line"),
        (
            [{"depth": "0 m", "elevation": "533 m"}, {"depth": "9 m"}],
            LEVELS,
            "elevation or depth is required",
        ),
        ([{}, {"depth": "9 m"}], LEVELS, "elevation or depth is required"),
    ],
)
def test_points_of_a_current_that_cannot_be_meant_are_refused(points, levels, reason):
    profile = [point | {"speed": "1 m/s"} for point in points]
    water = {"density": "1025 kg/m^3", **{k.removeprefix("water."): v for k, v in levels.items()}}
    with pytest.raises(InputError, match=reason) as refusal:
        load_scene(SURGE, water=water, current={"profile": profile})
    assert "current" in str(refusal.value)
