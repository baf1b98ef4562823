"""Numbers of Mao's chapter from risers whose shape, moment and motion are known."""

import json

import numpy as np
import pytest
import xarray as xr
from mao import CONFIG, PAPER, WORD

from chapters.mao_hangoff.claims import towed as claims
from chapters.mao_hangoff.claims.further import moments_vary, top_end_decides, upper_half_moves_faster
from chapters.mao_hangoff.claims.heave import amplitude_grows_with_depth, level_rises, one_frequency
from chapters.mao_hangoff.derived import towed as derived_towed
from chapters.mao_hangoff.derived.limits import speed_limits, tension_limits
from chapters.mao_hangoff.derived.towed import towed
from chapters.mao_hangoff.runs import at_nodes_of_paper, misses_of_print
from riserstudy.scene.load import read_scene

STEADY = read_scene(CONFIG / "scenes" / PAPER / "steady.yaml").tree
SPEEDS = np.array([0.5, 1.0, 2.0, 3.0, 4.0, 5.0])  # knots
LENGTHS = np.array([600.0, 1200.0])
STIFFNESS = 8800.0 * 180.0 / np.pi  # N m/rad
LIMITS = {"joint_angle": "9 deg", "clearance": "4 m", "keel": "25 m", "yield_stress": "500 MPa",
          "share_of_yield": 0.6}  # fmt: skip
AXES = ("riser_length", "lmrp_mass", "current_speed", "platform_speed")


def steady(angle, away, tension, moment=0.0):
    """Risers of two lengths; angle (deg) of the joint, distance at the keel (m), tension and moment by speed.

    The riser between keel and joint is straight, and nodes above a riser's top have no value.
    """
    s = np.array([0.0, 300.0, 575.0, 590.0, 600.0, 1175.0, 1190.0, 1200.0])
    shape = (2, 1, 2, len(SPEEDS), len(s))
    x, pull, bent = (np.full(shape, np.nan) for _ in range(3))
    for k, length in enumerate(LENGTHS):
        there = s <= length
        below = (length - s[there]) / 25.0
        x[k, 0, :, :, there] = (7.0 - below[:, None] * away(SPEEDS))[:, None]
        pull[k, 0, :, :, there] = -tension(SPEEDS)
        bent[k, 0, :, :, there] = moment
        bent[k, 0, :, :, s == length] = -np.deg2rad(angle(SPEEDS)) * STIFFNESS
    coords = {"riser_length": LENGTHS, "lmrp_mass": [140.0], "current_speed": [0.0, 1.0],
              "platform_speed": SPEEDS, "s": s}  # fmt: skip
    dims = (*AXES, "s")
    data = {"x": (dims, x), "effective_tension": (dims, pull), "bending_moment": (dims, bent)}
    return xr.Dataset(data, coords, {"scene": json.dumps(STEADY)})


def little(speeds):
    return 1e-9 * speeds


def test_each_limit_of_speed_is_met_where_its_quantity_reaches_it():
    """Linear in speed: 9 deg at 3.3 kn, 4 m at 2.6 kn, and 300 MPa at 4.4 kn."""
    area = np.pi / 4.0 * (0.5334**2 - 0.4826**2)
    runs = {
        "joint angle": (3.3, steady(lambda v: 9.0 * v / 3.3, little, little)),
        "clearance": (2.6, steady(little, lambda v: -4.0 * v / 2.6, little)),
        "stress": (4.4, steady(little, little, lambda v: 300e6 * area * v / 4.4)),
    }
    for k, (name, (speed, run)) in enumerate(runs.items()):
        found = speed_limits(run, **LIMITS)
        assert list(found["limit"].values) == list(runs)
        np.testing.assert_allclose(found["speed_limit"], speed, rtol=1e-6, err_msg=name)
        assert (found["governing_limit"] == k).all()
        faster = found["speed_through_water"].sel(current_speed=1.0)
        # a nautical mile is a minute of arc of 1852 m
        np.testing.assert_allclose(faster, speed + 3600.0 / 1852.0, rtol=1e-6)


def test_bending_adds_to_the_stress_by_the_section_modulus():
    outer, inner = 0.2667, 0.2413
    modulus = np.pi * (outer**4 - inner**4) / (4.0 * outer)
    run = steady(little, little, little, moment=0.5 * 300e6 * modulus)
    used = speed_limits(run, **LIMITS)["use_of_limit"].sel(limit="stress")
    np.testing.assert_allclose(used, 0.5, rtol=1e-6)


def test_without_a_limit_the_fastest_speed_of_the_grid_is_told_and_nothing_governs():
    found = speed_limits(steady(little, little, little), **LIMITS)
    assert (found["speed_limit"] == 5.0).all()
    assert (found["governing_limit"] == -1.0).all()


def test_the_range_of_tension_is_that_at_the_top_of_each_riser():
    s = np.array([0.0, 300.0, 600.0, 1200.0])
    dims = ("mode", "riser_length", "heave_amplitude", "s_node")
    high = np.broadcast_to(np.array([1.0, 2.0, 3.0, 4.0]), (2, 2, 2, 4)).copy()
    low = np.broadcast_to(np.array([0.9, 1.5, 2.4, 3.1]), (2, 2, 2, 4)).copy()
    for values in (high, low):
        values[:, 0, :, 3] = np.nan
    runs = xr.Dataset(
        {"effective_tension_max": (dims, high), "effective_tension_min": (dims, low)},
        {"mode": ["soft", "hard"], "riser_length": LENGTHS, "heave_amplitude": [1.0, 2.0], "s_node": s},
    )
    runs["effective_tension_static"] = runs["effective_tension_max"]
    lost = runs.sel(mode="hard", drop=True)
    found = tension_limits(runs, lost)
    for length, expected in zip(LENGTHS, (0.6, 0.9), strict=True):
        assert found["tension_range"].sel(riser_length=length).values == pytest.approx(expected)
    assert found["smallest_tension"].values == pytest.approx(0.9)
    assert found["heave_that_loses_tension"].isnull().all()


def towing(**more):
    """Nodes at 0, 600 and 1200 m: x of the top grows by 1 m/s, the LMRP trails by a third of its way."""
    time = np.arange(0.0, 201.0, 10.0)
    x = np.stack([time * share for share in (2.0 / 3.0, 0.8, 1.0)], axis=1)
    y = np.stack([0.2 * time, 0.15 * time, 0.1 * time], axis=1)
    z = np.stack([-1200.0 + 0.01 * time, -600.0 + 0.0 * time, 0.0 * time], axis=1)
    moment = np.outer(time, [0.0, -2e3, 1e3])
    dims = ("time", "s")
    data = {
        name: (dims, values) for name, values in (("x", x), ("y", y), ("z", z), ("bending_moment", moment))
    }
    data |= {"z_static": ("s_node", [-1201.0, -600.0, 0.0]), "ufj_angle": ("time", 0.0 * time)}
    s = [0.0, 600.0, 1200.0]
    return xr.Dataset(data | more, {"time": time, "s": s, "s_node": s})


def test_a_towed_riser_is_told_from_its_top_and_rises_from_its_rest():
    found = towed(towing(), "base")
    time = found["time"].values
    np.testing.assert_allclose(found["lmrp_displacement"], -time / 3.0)
    np.testing.assert_allclose(found["displacement_along"].sel(s=600.0), -0.2 * time)
    np.testing.assert_allclose(found["lmrp_displacement_cross"], 0.1 * time)
    np.testing.assert_allclose(found["lmrp_rise"], 1.0 + 0.01 * time)
    assert found["bending_moment_size"].values.tolist() == [0.0, 260e3, 130e3]


def test_misses_of_printed_numbers_are_relative_and_a_ratio_cancels_a_common_scale():
    runs = xr.concat([towing(), towing().assign(x=2.0 * towing()["x"])], "lmrp_mass")
    runs = runs.assign_coords(lmrp_mass=[140.0, 120.0])
    heavy = 130.0 / 3.0
    found = misses_of_print(runs, heavy / 1.1, 2.0 * heavy / 1.1, 260.0 / 0.9)
    assert float(found["x_heavy"]) == pytest.approx(0.1)
    assert float(found["x_light"]) == pytest.approx(0.1)
    assert float(found["moment"]) == pytest.approx(0.1)
    assert float(found["ratio"]) == pytest.approx(0.0, abs=1e-12)


def test_fifty_elements_of_the_paper_have_fifty_one_nodes_from_end_to_end():
    s = np.linspace(0.0, 1200.0, 97)
    found = at_nodes_of_paper(xr.DataArray(3.0 * s, {"s": s}, "s"))
    np.testing.assert_allclose(found, np.arange(51) * 72.0)


def test_the_upper_half_that_moves_twice_as_far_is_faster():
    time = np.arange(0.0, 201.0, 10.0)
    s = np.array([0.0, 300.0, 600.0 - 1e-6, 600.0 + 1e-6, 900.0, 1200.0])
    share = np.where(s > 600.0, 2.0, 1.0)
    runs = xr.Dataset({"x": (("time", "s"), np.outer(time, share))}, {"time": time, "s": s})
    found = upper_half_moves_faster(runs, WORD("faster"))
    assert float(found.value) == pytest.approx(2.0)
    assert bool(found.true)
    runs["x"] = (("time", "s"), np.outer(time, 3.0 - share))
    assert not bool(upper_half_moves_faster(runs, WORD("faster")).true)


def test_moments_vary_by_their_range_at_the_times_of_full_speed():
    """At 100 and 500 m below the joint: from 60 to 100 and from 20 to 50; before 70 s all is zero."""
    time = np.arange(0.0, 201.0, 10.0)
    s = np.array([0.0, 700.0, 1100.0, 1200.0])
    late = np.clip((time - 70.0) / 60.0, 0.0, 1.0)
    size = np.stack([9.0 + 0.0 * late, 20.0 + 30.0 * late, -60.0 - 40.0 * late, 9.0 + 0.0 * late], axis=1)
    size[time < 70.0] = 0.0
    size[time > 130.0] = 1e4
    size[time == 90.0] = 1e4  # no time of Fig 9c, so samples do not have it
    runs = xr.Dataset({"bending_moment": (("time", "s"), size)}, {"time": time, "s": s})
    found = moments_vary(runs, [100.0, 500.0], WORD("evident"))
    assert float(found.value) == pytest.approx(0.4)
    assert float(
        moments_vary(runs.sel(time=[70.0, 100.0, 130.0]), [100.0, 500.0], WORD("evident")).value
    ) == (pytest.approx(0.4))


@pytest.mark.parametrize("seed", range(8))
def test_a_stiff_top_end_is_judged_by_the_moment(seed):
    """By factors of the moment with a top end that turns freely, with the published stiffness and clamped."""
    published, clamped = np.random.default_rng(seed).uniform(0.9, 1.3, 2)
    variants = ["base", "joint clamped", "joint free"]
    shape = np.array([0.2, -1.0, 0.5])
    size = np.array([published, clamped, 1.0])[:, None, None] * shape
    runs = xr.Dataset(
        {"bending_moment": (("variant", "time", "s"), size)},
        {"variant": variants, "time": [130.0], "s": [0.0, 1.0, 2.0]},
    )
    found = top_end_decides(runs, WORD("larger"))
    for name, factor in (("as published", published), ("clamped", clamped)):
        assert float(found.value.sel(top_end=name)) == pytest.approx(factor)
        assert bool(found.true.sel(top_end=name)) == (1.0 - 1.0 / factor >= WORD("larger").bound)


@pytest.mark.parametrize("seed", range(12))
def test_a_large_relative_speed_is_that_of_the_fastest_current(seed, monkeypatch):
    """At 0 deg in 3 m/s all of displacement, moment and rise must exceed those at 90 deg by the word."""
    draw = np.random.default_rng(seed)
    factors = draw.uniform(1.2, 2.0, 3)
    by_track = np.ones((3, 4))
    by_track[:, :2] = draw.uniform(0.1, 9.0, (3, 2))  # slower currents do not count
    by_track[:, 2] = factors
    x = -by_track[0][:, None, None] * np.outer([0.0, 130.0], [1.0, 0.0])
    tracks = ["0 deg, 2 m/s", "0 deg, 2.5 m/s", "0 deg, 3 m/s", "90 deg"]
    runs = xr.Dataset(
        {
            "x": (("track", "time", "s"), x),
            "largest_bending_moment": ("track", by_track[1]),
            "rise": ("track", by_track[2]),
        },
        {"track": tracks, "time": [0.0, 130.0], "s": [0.0, 1000.0]},
    )
    monkeypatch.setattr(claims, "largest_rise", lambda of: of["rise"])
    found = claims.all_rise_with_relative_speed(runs, WORD("significant"))
    assert float(found.value) == pytest.approx(factors[0])
    assert bool(found.true) == bool((1.0 - 1.0 / factors >= WORD("significant").bound).all())


def heaving(drift, sizes, other=0.0):
    """Elevations over 200 s at 0, 100 and 400 m below the joint: period of 10 s, drift, another period."""
    t = np.arange(0.0, 200.5, 0.5)
    swing = np.sin(2.0 * np.pi * t / 10.0) + other * np.sin(2.0 * np.pi * t / 2.5)
    z = np.stack([size * swing + drift * t for size in sizes], axis=1)
    runs = xr.Dataset({"z": (("time", "s"), z[:, ::-1])}, {"time": t, "s": [800.0, 1100.0, 1200.0]})
    return runs.assign_attrs(scene=json.dumps({"platform": {"heave": {"period": "10 s"}}}))


def test_a_level_rises_by_its_drift_in_a_minute():
    found = level_rises(heaving(0.02, (2.0, 2.0, 2.0)), 100.0)
    assert float(found.value) == pytest.approx(1.2)
    assert bool(found.true)
    assert not bool(level_rises(heaving(-0.02, (2.0, 2.0, 2.0)), 100.0).true)


def test_the_amplitude_at_the_deepest_is_compared_with_that_at_the_first():
    found = amplitude_grows_with_depth(heaving(0.0, (1.0, 2.0, 3.0)), [0.0, 100.0, 400.0], WORD("increases"))
    assert float(found.value) == pytest.approx(3.0)
    assert bool(found.true)


@pytest.mark.parametrize("other, true", [(0.0, True), (0.3, True), (0.4, False)])
def test_one_frequency_has_nine_tenths_of_the_motion(other, true):
    """Of the mean square of both, 1 / (1 + b^2)."""
    found = one_frequency(heaving(0.0, (1.0, 2.0, 3.0), other), [0.0, 100.0, 400.0])
    assert float(found.value) == pytest.approx(1.0 / (1.0 + other**2), rel=2e-3)
    assert bool(found.true) == true


def test_profiles_of_the_current_fall_from_one_at_the_surface(monkeypatch):
    """The layer of the steady scene: full down to 100 m, none from 300 m on, without the platform."""
    layer = STEADY["current"]["profile"]["sum"][1]
    steady_scene = read_scene(CONFIG / "scenes" / PAPER / "steady.yaml")
    scene = steady_scene.with_values({"current.profile": layer}, "test").resolved()
    monkeypatch.setattr(derived_towed, "scenes_of", lambda _: iter([({"current_profile": "layer"}, scene)]))
    axes = {name: ["one"] for name in ("riser_weight", "flow")} | {"lmrp_mass": [140.0]}
    found = derived_towed.current_profiles(xr.Dataset(coords=axes))["current_share"].isel(current_profile=0)
    assert found.sel(below_surface=[0.0, 50.0, 95.0]).values == pytest.approx([1.0, 1.0, 1.0])
    assert found.sel(below_surface=[305.0, 900.0, 1800.0]).values == pytest.approx([0.0, 0.0, 0.0])
    assert 0.0 < found.sel(below_surface=250.0) < found.sel(below_surface=150.0) < 1.0
