"""What fem_riser measures and how its claims are judged, on curves whose answer is known."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.fem_riser import claims as checks
from chapters.fem_riser.along import amplitude_at, angles, drift_rate, place, stress_factor, without_drift
from riserstudy.grading.words_of_size_file import read_words
from riserstudy.model.sea import current_table, profile
from riserstudy.scene.load import read_scene
from riserstudy.scene.units import to_si
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

CONFIG = Path(__file__).parents[3] / "config"
CHANGE = read_words(CONFIG).word("increases")
BASE = "config/scenes/fem_riser/base.yaml"


@pytest.fixture(scope="module")
def base(request):
    return read_scene(request.config.rootpath / BASE)


@pytest.mark.parametrize("reading, left, held", [("R1", 0.3, 0.3), ("R2", 0.7, 0.7), ("R3", 0.7, 1.0)])
def test_a_buoyant_factor_gives_weight_and_tension_in_each_reading(base, reading, left, held):
    scene = base.with_values({"buoyancy.reading": reading}, "test").resolved()
    outer, inner = 0.25 * np.pi * 0.5334**2, 0.25 * np.pi * 0.4826**2
    inside = 1200.0 * inner * 9.81
    dry = 7850.0 * (outer - inner) * 9.81 + inside
    section = scene.riser[0]
    assert section.submerged_weight + inside == pytest.approx(left * dry, rel=1e-12)
    assert scene.top.tension == pytest.approx(held * 1.3 * dry * 2000.0, rel=1e-12)


def test_the_drift_carries_water_across_the_wind_and_none_along_it(base):
    """Ekman's transport tau / (rho f), by depth integrals; at the surface both parts are alike."""
    drift = base.resolved().current.profile.sum[1]
    strength = drift.wind_speed / np.sqrt(np.sin(drift.latitude))
    surface, depth = drift.surface_factor * strength, drift.depth_factor * strength
    z = np.linspace(-12.0 * depth, 0.0, 400_001)
    parts = {
        name: profile(drift.replaced(component=name), (z[0], 0.0), z)
        for name in ("along the wind", "across the wind", "magnitude")
    }
    carried = {name: np.trapezoid(speed, z) for name, speed in parts.items()}
    assert carried["across the wind"] == pytest.approx(surface * depth / (np.pi * np.sqrt(2.0)))
    assert abs(carried["along the wind"]) < 1e-6 * carried["across the wind"]
    sides = [parts["along the wind"], parts["across the wind"]]
    np.testing.assert_allclose(np.hypot(*sides), parts["magnitude"], rtol=1e-12)
    assert sides[0][-1] == pytest.approx(sides[1][-1]) == pytest.approx(surface / np.sqrt(2.0))
    # below the surface the drift turns away from the wind: it is soon against it
    below = z > -0.5 * depth
    assert sides[0][below].min() < 0.0 < sides[1][below].min()


def test_the_current_is_tide_and_drift(base):
    scene = base.resolved()
    z, speed = current_table(scene.current, scene.water)
    drift = profile(scene.current.profile.sum[1], (0.0, 2000.0), z)
    np.testing.assert_allclose(speed, 0.75 * (z / 2000.0) ** 0.142857 + drift, atol=1e-12)


def test_every_assumed_number_that_is_drawn_on_has_a_range_or_says_where_it_is_varied(base):
    """What Table 1 would give: a range, options, a reading of the study file, or a study's own axis."""
    varied_elsewhere = {
        "riser[0].outer_diameter", "riser[0].drag.diameter", "riser[0].added_mass.diameter",
        "buoyancy.factor", "buoyancy.tension_ratio", "buoyancy.reading",
    }  # fmt: skip
    words = {"top.x", "top.z", "current.profile.sum[0].shape", "wave.above_mean_level"}
    fixed = {
        path
        for path, origin in base.origins.items()
        if origin.status == "assumed" and not (origin.range or origin.options)
    }
    assert fixed == varied_elsewhere | words


def test_an_amplitude_is_found_beside_a_drift_and_on_few_times():
    t = 261.0 + 3.1 * np.arange(13)
    x = xr.DataArray(40.0 + 0.02 * t + 0.3 * np.sin(2.0 * np.pi * t / 8.0 + 1.0), coords={"time": t})
    assert float(amplitude_at(x, 8.0)) == pytest.approx(0.3, rel=1e-9)


def test_a_drift_is_told_from_the_wave_and_taken_off():
    t = 261.0 + 0.5 * np.arange(79)
    wave = 0.3 * np.sin(2.0 * np.pi * t / 8.0 + 1.0)
    x = xr.DataArray(40.0 + 0.02 * t + wave, coords={"time": t})
    assert float(drift_rate(x, 8.0)) == pytest.approx(0.02, rel=1e-9)
    np.testing.assert_allclose(without_drift(x, 8.0), 40.0 + 0.02 * t[-1] + wave, rtol=1e-12)


def test_angles_and_places_are_those_of_a_parabola():
    s = np.linspace(0.0, 100.0, 201)
    x = xr.DataArray(s * (100.0 - s) / 500.0, coords={"s": s}).expand_dims(time=[0.0])
    slope = angles(xr.Dataset({"x": x})).isel(time=0)
    expected = np.arctan((100.0 - 200.0 * slope["middle"]) / 500.0)
    np.testing.assert_allclose(slope, expected, atol=1e-12)
    share = xr.DataArray(s / 100.0, dims="s")
    assert float(place(x.isel(time=0, drop=True), share, "s", share >= 0.0)) == 0.5


def test_stress_follows_the_diameters_of_each_sample(base):
    runs = xr.Dataset(attrs={"scene": json.dumps(base.tree)})
    plain = 32.0 * 0.5334 / (np.pi * (0.5334**4 - 0.4826**4))
    assert float(stress_factor(runs)) == pytest.approx(plain)
    runs["assumed_riser_0_outer_diameter"] = ("sample", ["0.5334 m", "20 in"])
    found = stress_factor(runs)
    assert float(found[0]) == pytest.approx(plain)
    assert float(found[1]) == pytest.approx(32.0 * 0.508 / (np.pi * (0.508**4 - 0.4826**4)))
    named = xr.Dataset({"assumed_outer_diameter": ("sample", ["0.508 m", "0.5334 m"])}, attrs=runs.attrs)
    np.testing.assert_allclose(stress_factor(named), found[::-1])


def test_both_sizes_of_pipe_meet_the_water_with_their_own_diameter(base):
    for label, sets in read_studies(CONFIG, "fem_riser").readings["outer_diameter"].items():
        section = base.with_values(sets, "test").resolved().riser[0]
        found = {section.outer_diameter, section.drag.diameter, section.added_mass.diameter}
        assert found == {to_si(label, "m")}


def motion(curve):
    t = np.arange(301.0)
    x = curve(t) + 0.1 * np.sin(2.0 * np.pi * t / 8.0)
    return xr.Dataset({"x": (("time", "s"), np.stack([0 * x, x, 0 * x], axis=1))}, {"time": t})


def test_settling_is_told_from_the_mean_over_a_wave():
    """10 (1 - e^(-t/T)) against its mean of 292 to 300 s, around 296 s."""
    scale = 40.0
    found = checks.settling_time(motion(lambda t: 10.0 * (1.0 - np.exp(-t / scale))), 0.005)
    assert float(found) == pytest.approx(-scale * np.log(0.005 + np.exp(-296.0 / scale)), abs=2.0)
    assert bool(checks.periodic_at_last(motion(lambda t: 10.0 * (1.0 - np.exp(-t / 40.0))), 0.005).true)
    assert not bool(checks.periodic_at_last(motion(lambda t: t), 0.005).true)


def test_reciprocating_is_a_swing_back_of_the_mean():
    monotone = checks.reciprocates(motion(lambda t: 10.0 * (1.0 - np.exp(-t / 40.0))), 0.005)
    assert not bool(monotone.true)
    over = checks.reciprocates(
        motion(lambda t: 10.0 * (1.0 - np.exp(-t / 60.0) * np.cos(2.0 * np.pi * t / 120.0))), 0.005
    )
    # extremes where tan w t = -1/(60 w), at 54.1 and 114.1 s; the mean over 8 s takes 0.7 % off
    assert bool(over.true)
    assert float(over.value) == pytest.approx(0.3866 + 0.1422, rel=0.02)


def test_fast_is_told_from_rates():
    found = checks.fast_at_first(motion(lambda t: np.where(t < 16, t, 16.0 + 0.1 * (t - 16.0))), 2.0)
    assert float(found.value) == pytest.approx(10.0, rel=0.01)


def measured(**by_length):
    rows = {f"{name}_by_length": ("length", values) for name, values in by_length.items()}
    return xr.Dataset(rows, {"length": [500.0, 1000.0, 1500.0]})


def test_a_trend_needs_a_difference_and_together_every_claim():
    rows = {
        "vibration": [3.0, 2.0, 1.0], "stress": [3.0, 2.0, 1.0], "deflection": [1.0, 2.0, 3.0],
        "angle": [1.0, 2.0, 3.0], "deflection_from_line_place": [0.5] * 3, "deflection_place": [0.5] * 3,
        "stress_from_bottom": [0.05] * 3, "stress_from_top": [0.01] * 3,
        "angle_from_bottom": [0.0] * 3, "angle_from_top": [0.0] * 3,
    }  # fmt: skip
    assert bool(checks.together(measured(**rows), 0.1, 0.1, CHANGE).true)
    for name, values in (("stress", [3.0, 2.0, 2.99]), ("deflection_from_line_place", [0.3] * 3),
                         ("angle_from_top", [0.2] * 3)):  # fmt: skip
        found = checks.together(measured(**(rows | {name: values})), 0.1, 0.1, CHANGE)
        assert not bool(found.true)
        assert float(found.value) == 5.0


@pytest.mark.parametrize("seed", range(20))
def test_larger_at_500_m_is_larger_than_at_each_other_length_in_any_order_of_these(seed):
    draw = np.random.default_rng(seed)
    short, *others = draw.uniform(1.0, 1.1, 3) * [draw.choice([1.0, 1.1]), 1.0, 1.0]
    met = all((short - other) / max(short, other) > CHANGE.bound for other in others)
    found = [
        checks.larger_at_the_shortest(measured(stress=[short, *order], vibration=[3.0, 1.0, 2.0]), of, CHANGE)
        for order in (others, others[::-1])
        for of in (["stress"], ["vibration", "stress"])
    ]
    assert {bool(one.true) for one in found} == {met}
    assert float(found[0].value) == pytest.approx(max(others) / short)
    assert not checks.larger_at_the_shortest(measured(stress=[1.0, 0.99, 0.5]), ["stress"], CHANGE).true


def test_the_papers_beam_is_judged_where_lumped_masses_stand_beside_it():
    t = np.arange(301.0)
    x = xr.DataArray(
        np.stack([np.ones((301, 3)), 2.0 * np.ones((301, 3))]),
        {"solver": [checks.LUMPED, checks.BEAM], "time": t},
        ("solver", "time", "s"),
    )
    x[:, 0] = 0.5  # deflection counts from where the riser is at first
    found = checks.middle(xr.Dataset({"x": x}))
    assert (found[1:] == 1.5).all()
    assert found[0] == 0.0


def test_one_case_that_still_drifts_is_enough_against_all_settled():
    rows = {
        "drift_by_length": ("length", [0.0, 0.001, 0.002]),
        "drift_by_ratio": ("tension_ratio", [0.004, 0.001, 0.0]),
        "drift_by_factor": ("buoyant_factor", [0.0, 0.001, 0.006]),
    }
    found = checks.all_settled(xr.Dataset(rows), 0.005)
    assert found.value.values.tolist() == [0.002, 0.006]  # the lengths, and all cases
    assert found.true.values.tolist() == [True, False]
    assert bool(checks.all_settled(xr.Dataset(rows), 0.007).true.all())


def timed(**seconds):
    steps = sorted((float(step[1:].replace("_", ".")) for step in seconds), reverse=True)
    values = [seconds["s" + f"{step:g}".replace(".", "_")] for step in steps]
    moments = [1.0 + step for step in steps]
    return xr.Dataset(
        {
            "solve_seconds": ("time_step", values),
            "x_max": (("time_step", "s_node"), [[0.0, m] for m in moments]),
            "bending_moment_max": (("time_step", "s_node"), [[0.0, 2.0 * m] for m in moments]),
            "bending_moment_min": (("time_step", "s_node"), [[0.0, -1.0] for m in moments]),
        },
        {"time_step": steps},
    )


def test_the_papers_run_is_timed_or_told_by_the_time_of_a_step():
    short = checks.run_time(timed(s0_05=1.5))
    assert short["seconds"] == pytest.approx(150.0)
    assert short["run"].endswith("the run would take an estimated 150 s; this tier does not include it.")
    whole = checks.run_time(timed(s0_05=1.5, s0_0005=120.0))
    assert whole["seconds"] == pytest.approx(120.0)
    assert whole["milliseconds"] == pytest.approx(0.2)
    assert whole["run"] == (
        "With the paper's elements, time steps and integration rule, the run takes 120 s. "
        "Time steps of 0.05 s change the largest deflection and moment by at most 5 %."
    )


def test_a_sample_is_one_sea_and_riser_in_all_studies_and_drifts_by_one_share_of_the_depth():
    studies = read_studies(CONFIG, "fem_riser")
    drawn = {}
    for name, model in studies.studies.items():
        if "sample" in model.axes:
            study = Study("fem_riser", name, model, CONFIG, "standard", None, studies.readings)
            length = study.base.resolved().riser[0].length
            drawn[name] = study.assumed(model.axes["sample"])[:16], length
    assert len(drawn) == 9
    shares, others = [], []
    for samples, length in drawn.values():
        shares.append([to_si(one["top.offset"], "m") / length for one in samples])
        others.append([{k: v for k, v in one.items() if k != "top.offset"} for one in samples])
    assert all(each == others[0] for each in others)
    np.testing.assert_allclose(shares, [shares[0]] * len(shares), rtol=1e-12)
    assert 0.01 < np.abs(shares).max() <= 0.02
