"""Motions by points that do not cover a run: what is warned of, and what the platform does."""

import json

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy import simulate
from riserstudy.errors import InputError
from riserstudy.model.platform_motion import displacement
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.scene.motion_records import uncovered

PARTS = ("whole", "late", "early", "apart", "gap", "stays")


def recorded(seed, part):
    """A rig in plane or space whose heave and surge are records, with times and values of the heave (m)."""
    draw = np.random.default_rng(seed)
    tree = moving(seed, spatial=seed % 2 == 1, conductor=seed % 3 == 2)
    duration = tree["analysis"]["duration"]
    tree["analysis"]["mesh"] = {"elements": 8}
    times = np.linspace(0.0, duration * (1.0 + 1e-9), 60)
    values = draw.uniform(0.3, 1.5) * np.sin(2.0 * np.pi * times / duration * draw.uniform(2.0, 4.0))
    keep = {
        "late": times > draw.uniform(0.2, 0.5) * duration,
        "early": times < draw.uniform(0.5, 0.8) * duration,
        "gap": abs(times / duration - 0.5) > draw.uniform(0.07, 0.2),
    }.get(part, times > -1.0)
    if part == "stays":
        times, values = times[:30], np.r_[values[:29], values[28]]
        keep = keep[:30]
    times, values = times[keep] + (2.0 * duration if part == "apart" else 0.0), values[keep]
    points = [
        {"time": f"{t!r} s", "value": f"{v!r} m"}
        for t, v in zip(times.tolist(), values.tolist(), strict=True)
    ]
    tree["platform"] |= {"heave": {"points": points}}
    return SceneFile("scene.yaml", written(tree)), times, values


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("part", PARTS)
def test_what_a_record_does_not_cover_is_warned_of(seed, part):
    file, *_ = recorded(seed, part)
    said = sentences(uncovered(file.resolved()))
    words = {"late": "begin at", "early": "end at", "apart": "outside", "gap": "bridges the gap"}
    assert len(said) == (part in words)
    assert all(one.startswith("platform.heave: ") and words[part] in one for one in said)
    still = file.with_values({"analysis": {"mesh": {"elements": 8}}}, "test")
    assert uncovered(still.resolved()) == []


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("part", ["late", "early", "apart"])
def test_the_platform_keeps_the_value_of_the_point_at_the_end(seed, part):
    file, times, values = recorded(seed, part)
    platform = {"surge": None, "sway": None, "pitch": None, "roll": None}
    one = simulate(file.with_values({f"platform.{k}": v for k, v in platform.items()}, "test"))
    top = one["z"].isel(s=-1)
    time, moved = one["time"].values, top.values - top.values[0] + values[0]
    before, after = time <= times[0], time >= times[-1]
    if part != "early":
        np.testing.assert_allclose(moved[before], values[0], atol=1e-6)
    else:
        shift = np.interp(0.0, times, values) - values[0]
        np.testing.assert_allclose(moved[after] + shift, values[-1], atol=1e-6)
    assert any("platform.heave" in text for text in json.loads(one.attrs["warnings"]))


@pytest.mark.parametrize("seed", range(6))
def test_records_without_sway_roll_and_yaw_leave_a_riser_in_its_plane(seed):
    """The columns of zeros of a table of six motions are no reason to simulate the riser in space."""
    tree = moving(seed, spatial=False)
    tree["analysis"]["mesh"] = {"elements": 8}
    still = SceneFile("scene.yaml", written(tree))
    times = np.linspace(0.0, tree["analysis"]["duration"], 9).tolist()

    def recorded(value, unit):
        return {"points": [{"time": f"{t!r} s", "value": f"{value!r} {unit}"} for t in times]}

    columns = {"sway": "m", "roll": "rad", "yaw": "rad"}
    zeros = {f"platform.{name}": recorded(0.0, unit) for name, unit in columns.items()}
    file = still.with_values(zeros, "test")
    assert not file.resolved().spatial
    one, other = (simulate(of, progress=False) for of in (still, file))
    assert set(one.data_vars) == set(other.data_vars)
    for name in ("x", "z", "effective_tension", "bending_moment", "ufj_angle", "lfj_angle"):
        np.testing.assert_array_equal(other[name], one[name])
    for name, unit in columns.items():
        moved = still.with_values({f"platform.{name}": recorded(1e-3, unit)}, "test")
        assert moved.resolved().spatial == f"platform.{name}"


def uneven(seed, spatial):
    """A rig that is held after a fast shift, by few points at uneven times, and the values of these (m)."""
    draw = np.random.default_rng(seed)
    tree = moving(seed, spatial=spatial, conductor=False)
    start = np.cumsum(draw.uniform(2.0, 10.0, int(draw.integers(3, 8))))
    times = np.r_[0.0, start, start[-1] + 10.0 ** draw.uniform(0.5, 2.8)]
    values = np.r_[0.0, draw.uniform(0.0, 5.0, len(start) - 1), [5.0, 5.0]]
    points = [
        {"time": f"{t!r} s", "value": f"{v!r} m"}
        for t, v in zip(times.tolist(), values.tolist(), strict=True)
    ]
    tree["platform"] |= {"sway" if spatial else "surge": {"points": points}}
    tree["analysis"]["duration"] = float(times[-1])
    return SceneFile("scene.yaml", written(tree)), values


def resolved_or_refused(file):
    """The scene, or why it is refused."""
    try:
        return file.resolved()
    except InputError as error:
        return str(error)


@pytest.mark.long
@pytest.mark.parametrize("spatial", [False, True])
def test_a_platform_stays_near_the_points_of_its_motion(spatial):
    """Through 0, 5, 5 and 5 m at 0, 10, 20 and 600 s, a spline reaches -1000 m."""
    refused, noted = 0, 0
    for seed in range(60):
        file, values = uneven(seed, spatial)
        scene = resolved_or_refused(file)
        if isinstance(scene, str):
            assert "the spline through the points exceeds" in scene
            refused += 1
            continue
        moved = displacement(scene, np.linspace(0.0, scene.analysis.duration, 2000))[:, int(spatial)]
        moved -= getattr(scene.platform.position, "sway" if spatial else "surge") or 0.0
        beyond = max(moved.max() - values.max(), values.min() - moved.min()) / np.ptp(values)
        assert beyond <= 0.5
        said = [one for one in sentences(uncovered(scene)) if "the spline through its points exceeds" in one]
        assert bool(said) == (beyond > 0.25) or abs(beyond - 0.25) < 1e-3
        noted += len(said)
    assert refused > 10
    assert 0 < noted < 40


@pytest.mark.parametrize("seed", range(20))
def test_a_record_with_four_points_in_a_period_is_taken_without_a_warning(seed):
    """Of one frequency, or of a sea whose shortest waves have four points in their period."""
    draw = np.random.default_rng(seed)
    times = np.arange(0.0, 120.0, 1.0)
    frequency = draw.uniform(0.05, 0.25, 1 if seed % 2 else 20)
    phase = draw.uniform(0.0, 6.3, len(frequency))
    values = np.sin(2.0 * np.pi * np.outer(times, frequency) + phase).sum(axis=1)
    points = [
        {"time": f"{t!r} s", "value": f"{v!r} m"}
        for t, v in zip(times.tolist(), values.tolist(), strict=True)
    ]
    tree = moving(seed, spatial=False, conductor=False)
    tree["platform"] |= {"heave": {"points": points}}
    tree["analysis"]["duration"] = 119.0
    assert uncovered(SceneFile("scene.yaml", written(tree)).resolved()) == []
