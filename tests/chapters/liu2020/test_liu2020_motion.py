"""What is derived and graded in the chapter on Liu et al. 2020."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from riserstudy import load_scene
from riserstudy.chapters.liu2020.claims import WITHOUT, baselines, waves_on_the_riser
from riserstudy.chapters.liu2020.derived import motion as liu2020_motion
from riserstudy.chapters.liu2020.derived.motion import lag_at, rao_readings, section, storm
from riserstudy.dataset.variables import attributes, density
from riserstudy.study.read import read_study

CONFIG = Path(__file__).parents[3] / "config"
SYSTEM = CONFIG / "scenes/liu2020/system.yaml"
DEPTHS = (100.0, 200.0, 300.0, 400.0)


def travelling(speed, periods):
    """A wave that runs down from the ring at 533 m with no loss (m); time over two of the longest."""
    nodes = np.arange(0.0, 534.0, 6.5)
    s = xr.DataArray(nodes, dims="s", coords={"s": nodes})
    time = np.arange(0.0, 2.0 * max(periods) + 0.01, 0.025)
    t = xr.DataArray(time, dims="time", coords={"time": time})
    period = xr.DataArray(list(periods), dims="roll_period", coords={"roll_period": list(periods)})
    return np.cos(2.0 * np.pi / period * (t - (533.0 - s) / speed))


@pytest.mark.parametrize("down", [1, -1])
def test_a_lag_of_more_than_half_a_turn_from_depth_to_depth_is_told_whole(down):
    """At 31.9 m/s a wave of 5 s lags by 226 degrees every 100 m, which read as -134 at the depths alone."""
    periods = (5.0, 10.0)
    lag = lag_at(DEPTHS, travelling(31.9 * down, periods), "roll_period")
    for period in periods:
        exact = down * 2.0 * np.pi * np.array(DEPTHS) / (31.9 * period)
        assert period > 5.0 or np.diff(exact)[0] * down > np.pi
        # depths lie between nodes, cubic interpolation over 1/24 of a wave
        np.testing.assert_allclose(lag.sel(roll_period=period), exact, rtol=1e-4)


def test_what_is_derived_from_a_sea_has_units_and_names():
    time = np.arange(2048) * 0.5
    axes = {"tensioner_model": ["gas law"], "time": time, "s": [0.0, 533.0]}
    wave = np.cos(0.6 * time)[None, :, None] * np.array([1.0, 3.0])
    names = ("x", "effective_tension", "bending_moment")
    run = xr.Dataset({name: (tuple(axes), wave) for name in names}, axes)
    run = run.assign({n: run["x"].isel(s=1) for n in ("stroke", "ufj_angle", "lfj_angle")})
    found = storm(run)
    for name, values in found.data_vars.items():
        assert values.attrs["units"], name
        assert values.attrs["long_name"], name
    assert found["bending_moment_spectrum"].attrs["units"] == "N2 m2 Hz-1"
    assert found["x_deviation"].attrs == {
        "units": "m",
        "long_name": "standard deviation of lateral position",
    }
    # the density over frequency is the variance; Hann's window leaves a little of the mean
    over = found["x_spectrum"].integrate("frequency")
    np.testing.assert_allclose(over, found["x_deviation"] ** 2, rtol=0.02)


@pytest.mark.parametrize(
    "unit, squared", [("m", "m2 Hz-1"), ("m s-2", "m2 s-4 Hz-1"), ("1", "Hz-1")]
)
def test_a_spectral_density_is_the_square_over_hertz(unit, squared):
    assert density(unit) == squared


def test_names_that_only_end_alike_are_not_taken_for_statistics():
    assert attributes("nothing_spectrum") == {}


def test_the_stress_of_a_sample_is_that_of_the_last_wave_of_its_own_period(monkeypatch):
    """Bending of a known swing beside it, whose record begins with a jump before the last wave."""
    time = np.arange(0.0, 30.01, 0.25)
    periods, sizes = np.array([6.0, 25.0]), {"surge": 4e3, "pitch": 1e3}
    moment = np.stack(
        [
            [size * np.cos(2.0 * np.pi / period * time) for size in sizes.values()]
            for period in periods
        ]
    )
    moment[:, :, 0] = 1e6
    s = [0.0, 533.0, 545.0]
    along = np.array(
        [0.5, 1.0, 7.0]
    )  # above the ring stands the joint, whose stress does not count
    dims = ("sample", "motion", "time", "s")
    runs = xr.Dataset(
        {
            "bending_moment": (dims, moment[..., None] * along),
            "effective_tension": (dims, np.full((2, 2, len(time), 3), 2e6)),
            "assumed_platform_response_wave_period": ("sample", [f"{p} s" for p in periods]),
            "point_key": (("sample", "motion"), np.zeros((2, 2))),
        },
        {"sample": [0, 1], "motion": list(sizes), "time": time, "s": s},
    )
    scene = load_scene(SYSTEM).scene()
    monkeypatch.setattr(liu2020_motion, "scenes_of", lambda _: iter([({}, scene)]))
    found = rao_readings(runs)
    modulus = section(scene)[1]
    for motion, size in sizes.items():
        swing = found["stress_amplitude"].sel(motion=motion)
        # a quarter of a second of 6 s misses 1 % of the lowest
        np.testing.assert_allclose(swing, size / modulus, rtol=0.01)
    np.testing.assert_allclose(found["stress_share"].sel(motion="surge"), 0.8, rtol=1e-9)


def test_what_waves_add_on_the_riser_is_told_over_the_platform_alone():
    stress = xr.DataArray(
        [[2.0, 4.0], [6.0, 2.0], [6.0, 2.0], [6.3, 2.0]],
        {
            "waves": [
                "on the platform alone",
                "none above the mean level",
                "constant above the mean level",
                "stretched to the surface",
            ],
            "wave_period": [6.0, 20.0],
        },
    )
    told = waves_on_the_riser(stress.to_dataset(name="stress_amplitude"))
    assert told == pytest.approx(
        {"least": 0.5, "least_at": 20.0, "most": 3.15, "most_at": 6.0, "above": 5.0}
    )


def readings(**true):
    """Statics and surge of ten samples, in which so many make each claim true with each baseline."""
    models = ["gas law", *WITHOUT]
    sample = np.arange(10)

    def over(claim):
        counts = [0, *true[claim]]
        return xr.DataArray(
            [np.where(sample < count, 1.0, -1.0) for count in counts],
            {"tensioner_model": models, "sample": sample},
        )

    gas = over("Q2")["tensioner_model"] == "gas law"
    speeds = xr.DataArray([0.2, 1.0], dims="surface_speed", coords={"surface_speed": [0.2, 1.0]})
    depth = xr.DataArray([1.0, 1.0], dims="depth", coords={"depth": [100.0, 200.0]})
    static = xr.Dataset({"largest_displacement": speeds * xr.where(gas, 2.0, 2.0 + over("Q2"))})
    surge = xr.Dataset(
        {
            "displacement_amplitude": depth * xr.where(gas, 2.0, 2.0 + over("Q8")),
            "displacement_lag": depth * xr.where(gas, 2.0, 2.0 - over("Q9")),
        }
    )
    return static, surge


def test_which_claim_is_true_under_which_baseline_is_computed():
    told = baselines(*readings(Q2=(10, 4, 10), Q8=(3, 10, 10), Q9=(0, 10, 5)))
    assert told["shares"] == (
        "Q2 constant 100 %, vertical force at the ring 40 %, riser's top on the platform 100 %; "
        "Q8 constant 30 %, vertical force at the ring 100 %, riser's top on the platform 100 %; "
        "Q9 constant 0 %, vertical force at the ring 100 %, riser's top on the platform 50 %"
    )
    assert told["both"] == "riser's top on the platform"


def test_no_baseline_is_named_where_none_makes_both_true():
    assert baselines(*readings(Q2=(9, 10, 0), Q8=(10, 9, 10), Q9=(10, 10, 10)))["both"] == "none"


@pytest.mark.parametrize("name", ["rao_open", "roll_open", "surge_open"])
def test_what_is_left_open_keeps_the_riser_in_the_plane(name):
    """In space moments are sizes, and half the swing of a size is not an amplitude."""
    samples = read_study(CONFIG, "liu2020", name, "standard", None)
    others = (0,) * (len(samples.axes) - 1)
    assert len(samples.axes["sample"]) >= 256
    spatial = {
        samples.grid.file((k, *others)).scene().spatial for k in range(len(samples.axes["sample"]))
    }
    assert spatial == {""}
