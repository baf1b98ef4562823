"""Numbers derived from runs of Liu et al. 2020, on histories and shapes whose answer is known."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.liu2020.derived import codes, motion, statics
from chapters.liu2020.derived.heave import heave, heave_readings
from chapters.liu2020.second_methods import beamlike
from riserstudy import load_scene

SCENES = Path(__file__).parents[3] / "config/scenes/liu2020"
RINGS = {"from the lower flex joint to the ring": 533.0, "from the lower to the upper flex joint": 510.5}
PERIODS = np.array([6.0, 15.0])
MODELS = ["gas law", "linear"]


def swinging(sizes, means, late):
    """Over time (s) and period: tension at the lower and the upper end; the lower end is late by so much."""
    time = np.arange(60.0, 150.01, 0.05)
    turn = 2.0 * np.pi * time / PERIODS[:, None]
    ends = [
        mean + size * np.cos(turn - lag) for mean, size, lag in zip(means, sizes, (late, 0.0), strict=True)
    ]
    return time, np.stack(ends, axis=-1)


@pytest.mark.parametrize("late", [-0.4, 0.0, 1.1])
def test_axial_forces_are_told_of_both_ends_and_the_lower_lags(late):
    time, both = swinging((2e5, 3e5), (1e6, 2e6), late)
    both[:, : len(time) // 2] += 5e6  # transient before the last period
    tension = xr.DataArray(
        np.stack([both, both + (both - both[:, -1:].mean()) * 0.5])[:, None],
        {"tensioner_model": MODELS, "heave_amplitude": [2.0], "heave_period": PERIODS, "time": time,
         "s": [0.0, 533.0]},
    )  # fmt: skip
    found = heave(tension.to_dataset(name="effective_tension")).isel(heave_amplitude=0)
    assert found["axial_force_amplitude"].values == pytest.approx(2e5, rel=1e-3)
    assert found["axial_force_amplitude_top"].values == pytest.approx(3e5, rel=1e-3)
    assert found["axial_force_amplitude_linear"].values == pytest.approx(3e5, rel=1e-3)
    assert found["axial_force_lag"].values == pytest.approx(late, abs=1e-6)
    assert found["settling"].values == pytest.approx(0.0, abs=1e-3)


def test_each_sample_has_the_upper_force_at_its_own_ring():
    time, both = swinging((2e5, 3e5), (1e6, 2e6), 0.3)
    s = [0.0, 510.5, 533.0]
    # over sample, period, time, s: the ring's tension is at another station in each sample
    wrong = np.full_like(both[..., 1], 7e6)
    rows = {533.0: [both[..., 0], wrong, both[..., 1]], 510.5: [both[..., 0], both[..., 1], wrong]}
    runs = xr.Dataset(
        {
            "effective_tension": (
                ("sample", "heave_period", "time", "s"),
                np.stack([np.stack(rows[ring], axis=-1) for ring in RINGS.values()]),
            ),
            "assumed_printed_length": ("sample", list(RINGS)),
        },
        {"sample": [0, 1], "heave_period": PERIODS, "time": time, "s": s},
    )
    found = heave_readings(runs)
    assert found["axial_force_amplitude"].values == pytest.approx(2e5, rel=1e-3)
    assert found["axial_force_amplitude_top"].values == pytest.approx(3e5, rel=1e-3)
    assert found["axial_force_lag"].values == pytest.approx(0.3, abs=1e-6)
    assert "assumed_printed_length" in found


def test_the_settling_of_a_growing_force_is_its_growth_in_a_period():
    time, both = swinging((2e5, 3e5), (0.0, 0.0), 0.0)
    growth = 1.1 ** (time / 6.0)
    tension = xr.DataArray(
        np.stack([both * growth[:, None]] * 2)[:, None, :1],
        {"tensioner_model": MODELS, "heave_amplitude": [2.0], "heave_period": PERIODS[:1], "time": time,
         "s": [0.0, 533.0]},
    )  # fmt: skip
    found = heave(tension.to_dataset(name="effective_tension"))
    assert found["settling"].values == pytest.approx(0.1, rel=1e-6)


def test_inclined_cylinders_pull_by_the_vertical_leg_of_their_triangle():
    """Upright, the sum of all cylinders; at 45 degrees would be left the root of a half."""
    force = xr.DataArray([[1.0, 2.0, 4.0]], dims=("gas", "cylinder")).to_dataset(
        name="tensioner_force_static"
    )
    found = statics.tension_readings(force)["top_tension"].isel(gas=0)
    assert float(found.sel(inclination=0.0)) == 7.0
    for angle in statics.INCLINATIONS:
        across = 7.0 * np.sin(np.deg2rad(angle))
        assert float(found.sel(inclination=angle)) ** 2 + across**2 == pytest.approx(49.0)


def test_static_extremes_are_those_below_the_ring_of_each_sample(monkeypatch):
    """Moments that name their node; above the ring are the joint's displacement and moment."""
    s = np.array([0.0, 440.0, 460.0, 480.0, 510.5, 533.0, 545.0])
    moment = np.array([90.0, -50.0, 10.0, 20.0, -30.0, 60.0, 70.0])
    x = np.array([0.0, -4.0, 3.0, 2.0, 5.0, 6.0, 9.0])
    force = xr.DataArray([[3.0, 1.0]], dims=("tensioner_model", "counted"))
    monkeypatch.setattr(statics, "_force", lambda runs: force)
    runs = xr.Dataset(
        {
            "bending_moment_static": (("sample", "tensioner_model", "s_node"), np.tile(moment, (2, 1, 1))),
            "x_static": (("sample", "tensioner_model", "s_node"), np.tile(x, (2, 1, 1))),
            "largest_bending_moment": (("sample", "tensioner_model"), [[90.0], [90.0]]),
            "largest_bending_moment_s": (("sample", "tensioner_model"), [[0.0], [0.0]]),
            "assumed_printed_length": ("sample", list(RINGS)),
        },
        {"sample": [0, 1], "tensioner_model": ["gas law"], "s_node": s},
    )
    found = statics.statics_readings(runs).isel(tensioner_model=0)
    # 60 m below 533 m: 480 to 533 m; 60 m below 510.5 m: 460 to 510.5 m, without 450.5 m and below
    assert found["largest_bending_moment_near_ring"].values.tolist() == [60.0, 30.0]
    assert found["largest_displacement"].values.tolist() == [6.0, 5.0]


@pytest.mark.parametrize("count", [1, 4])
def test_the_force_of_one_cylinder_is_the_mean_of_those_that_there_are(count, monkeypatch):
    """The ring is the node at the sections' end, not the joint's top above it."""
    scene = load_scene(SCENES / "system.yaml").resolved()
    ring = sum(section.total_length for section in scene.riser)
    s = [0.0, ring - 10.0, ring, ring + 12.0]
    seen = []
    monkeypatch.setattr(statics, "scenes_of", lambda _: iter([({"tensioner_model": "gas law"}, scene)]))
    monkeypatch.setattr(statics, "pushed_back", lambda _, pull, x, z: seen.append((x, z)) or pull.sum())
    pull = np.full((1, 6), np.nan)
    pull[0, :count] = 10.0
    runs = xr.Dataset(
        {
            "x_static": (("tensioner_model", "s_node"), [[0.0, 1.0, 2.0, 9.0]]),
            "z_static": (("tensioner_model", "s_node"), [[0.0, 3.0, 4.0, 8.0]]),
            "tensioner_force_static": (("tensioner_model", "cylinder"), pull),
            "point_key": ("tensioner_model", ["k"]),
        },
        {"tensioner_model": ["gas law"], "s_node": s},
    )
    found = statics.dat_force(runs)["horizontal_force"]
    assert found.sel(counted="all cylinders").item() == 10.0 * count
    assert found.sel(counted="one cylinder").item() == pytest.approx(10.0)
    assert [values.tolist() for values in seen[0]] == [[1.0, 2.0], [3.0, 4.0]]


@pytest.mark.parametrize("bottom", ["0 m", "-100 m"])
def test_the_beam_of_other_methods_is_the_riser_of_the_scene(bottom):
    """Pulled by 1.5 times its weight, it keeps a third of the tension at its foot; the current is a ramp."""
    levels = {"bottom.elevation": bottom, "water.seabed": bottom}
    levels["water.surface"] = f"{533 + float(bottom.split()[0])} m"
    scene = load_scene(SCENES / "check_riser.yaml", **levels).resolved()
    beam = beamlike(scene)
    low, high = beam.pull(np.array([0.0, 533.0]))
    assert high == pytest.approx(853235.8)
    assert low / high == pytest.approx(1.0 / 3.0, rel=1e-6)
    s = np.linspace(0.0, 533.0, 11)
    np.testing.assert_allclose(beam.current(s), 0.8 * s / 533.0, atol=1e-12)
    # force of 0.8 m/s on a metre, from the dynamic pressure of 328 Pa
    assert beam.drag * 0.8**2 == pytest.approx(328.0 * 1.2 * 0.324)
    outer, inner = 0.162, 0.1455
    assert beam.stiffness == pytest.approx(206e9 * np.pi / 4.0 * (outer**4 - inner**4))
    assert beam.spring == 0.0
    joint = {"bottom.rotation": {"stiffness": "27 kN*m/deg"}}
    sprung = beamlike(load_scene(SCENES / "check_riser.yaml", **joint).resolved())
    assert sprung.spring == pytest.approx(27e3 * 180.0 / np.pi)


def bow(s):
    """A displacement that is no mirror image of itself (m)."""
    return -2.0 * np.sin(np.pi * s / 533.0) * s / 533.0


def test_methods_that_differ_at_one_depth_are_apart_by_this(monkeypatch):
    """By a tenth of a metre at half the length; depths count from the top."""
    s = np.linspace(0.0, 533.0, 41)
    runs = xr.Dataset(
        {"x_static": (("surface_speed", "s_node"), [bow(s)]), "point_key": ("surface_speed", ["k"])},
        {"surface_speed": [0.8], "s_node": s},
    )
    scene = load_scene(SCENES / "check_riser.yaml").resolved()
    monkeypatch.setattr(codes, "scenes_of", lambda _: iter([({"surface_speed": 0.8}, scene)]))
    monkeypatch.setattr(codes, "by_hermite_elements", lambda beam, at: bow(at))
    monkeypatch.setattr(codes, "by_collocation", lambda beam, at: bow(at) + 0.1 * (abs(at - 266.5) < 1.0))
    found = codes.codes(runs)
    largest = abs(bow(np.linspace(0.0, 533.0, 2001))).max()
    assert float(found["codes_apart"]) == pytest.approx(0.1 / largest, rel=1e-3)
    exact = bow(533.0 - found["depth"].values)
    for code, within in (("Hermite elements", 1e-12), ("lumped masses", 1e-4)):
        np.testing.assert_allclose(found["displacement"].sel(code=code), exact, atol=within)


def test_assumed_currents_are_shares_of_their_surface_speed_by_depth(monkeypatch):
    """A ramp of 0.8 m/s, and a calibrated parabola of 1 m/s; the surface is at 40 m."""
    lower = {"bottom.elevation": "-493 m", "water.seabed": "-493 m", "water.surface": "40 m"}
    ramp = load_scene(SCENES / "check_riser.yaml", **lower).resolved()
    bowl = {"shape": "power", "power": 2, "surface_speed": "1 m/s"}
    parabola = load_scene(SCENES / "check_riser.yaml", **lower, **{"current.profile": bowl}).resolved()
    places = iter([[({"current_profile": "ramp"}, ramp)], [({"calibration": "fit"}, parabola)]])
    monkeypatch.setattr(codes, "scenes_of", lambda _: iter(next(places)))
    checked = xr.Dataset({"x": (("contents", "s_node"), np.zeros((1, 3)))}, {"s_node": [0.0, 9.0, 533.0]})
    tuned = xr.Dataset(coords={"tensioner_model": ["gas law"], "surface_speed": [1.0]})
    found = codes.current_profiles(checked, tuned)["current_share"]
    left = 1.0 - found["depth"] / 533.0
    np.testing.assert_allclose(found.sel(current_profile="ramp"), left, atol=1e-9)
    np.testing.assert_allclose(found.sel(current_profile="calibrated: fit"), left**2, atol=1e-3)


def test_displacements_differ_from_the_gas_law_s_by_their_mean_square():
    """The second model moves 1.5 times as far; the third late by half a turn; a jump before the last wave."""
    time = np.arange(0.0, 60.01, 0.25)
    wave = np.sin(2.0 * np.pi * time / 15.0)
    history = np.stack([wave, 1.5 * wave, -wave])
    history[:, :40] += 9.0
    s = np.linspace(0.0, 533.0, 83)
    models = ["gas law", "far", "late"]
    x = xr.DataArray(
        history[..., None] * (1.0 + s / 533.0), {"tensioner_model": models, "time": time, "s": s}
    )
    found = motion.surge(x.to_dataset(name="x"))
    np.testing.assert_allclose(found["displacement_apart"], [0.0, 0.5, 2.0], rtol=1e-9)
    sizes = found["displacement_amplitude"].sel(tensioner_model="far")
    np.testing.assert_allclose(sizes, 1.5 * (2.0 - np.array(motion.DEPTHS) / 533.0), rtol=2e-3)


@pytest.mark.parametrize("low, settling", [(-5.0, 0.0), (-3.0, 0.25), (-20.0, 0.6)])
def test_moments_under_roll_have_settled_where_both_extremes_are_equal(low, settling):
    runs = xr.Dataset(
        {
            "bending_moment_max": (("roll_period", "s_node"), [[0.0, 5.0, 2.0]]),
            "bending_moment_min": (("roll_period", "s_node"), [[low, -1.0, -2.0]]),
            "largest_bending_moment": ("roll_period", [max(5.0, -low)]),
            "largest_bending_moment_s": ("roll_period", [400.0]),
        },
        {"roll_period": [10.0]},
    )
    assert motion.roll_assumed(runs)["settling"].item() == pytest.approx(settling)


def test_responses_of_platforms_are_drawn_under_their_own_names(monkeypatch):
    """Sizes of complex operators, each motion's from its own."""
    called = []

    def size(response, name, w):
        called.append(name)
        return {"surge": 3.0, "heave": -2.0, "pitch": 1j}[name] * np.ones_like(w)

    class Rig:
        class platform:
            response = object()

    monkeypatch.setattr(motion, "operator", size)
    monkeypatch.setattr(motion, "scenes_of", lambda _: iter([({"platform_unit": "medium"}, Rig)]))
    runs = xr.Dataset(
        {"point_key": (("platform_unit", "reference", "motion", "wave_period"), np.zeros((1, 1, 1, 1)))}
    )
    found = motion.rao_table(runs).sel(platform_unit="medium")
    assert sorted(called) == ["heave", "pitch", "surge"]
    for name, expected in (("surge", 3.0), ("heave", 2.0), ("pitch", 1.0)):
        assert (found[f"rao_{name}"] == expected).all()


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_stress_is_that_of_the_fibre_in_which_tension_and_bending_add(sign, monkeypatch):
    """20 MPa by tension and 30 MPa by bending, in phase or not: one fibre swings by 50 MPa."""
    scene = load_scene(SCENES / "system.yaml").resolved()
    monkeypatch.setattr(motion, "scenes_of", lambda _: iter([({}, scene)]))
    outer, inner = 0.5 * scene.riser[0].outer_diameter, 0.5 * scene.riser[0].inner_diameter
    time = np.arange(0.0, 30.01, 0.05)
    wave = np.cos(2.0 * np.pi * time / PERIODS[:, None])[..., None] * np.array([0.5, 1.0, 9.0])
    tension = 2e6 + 20e6 * np.pi * (outer**2 - inner**2) * wave
    moment = sign * 30e6 * np.pi * (outer**4 - inner**4) / (4.0 * outer) * wave
    dims = ("wave_period", "time", "s")
    runs = xr.Dataset(
        {"effective_tension": (dims, tension), "bending_moment": (dims, moment),
         "point_key": ("wave_period", ["a", "b"])},
        {"wave_period": PERIODS, "time": time, "s": [100.0, 533.0, 545.0]},
    )  # fmt: skip
    found = motion.waves(runs)["stress_amplitude"]
    np.testing.assert_allclose(found, 50e6, rtol=1e-3)
