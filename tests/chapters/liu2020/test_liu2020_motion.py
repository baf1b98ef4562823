"""What is derived and graded in the chapter on Liu et al. 2020."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.liu2020.below_ring import at_depths, first_at, on_riser, ring_of
from chapters.liu2020.claims import system as claims
from chapters.liu2020.claims.errata import baselines, waves_on_the_riser
from chapters.liu2020.claims.system import WITHOUT
from chapters.liu2020.derived import motion as liu2020_motion
from chapters.liu2020.derived.motion import lag_at, rao_readings, section, storm
from chapters.liu2020.periods import beats, settling
from riserstudy import load_scene
from riserstudy.dataset.variables import attributes, density
from riserstudy.grading.words_of_size_file import read_words
from riserstudy.study.read import read_study

CONFIG = Path(__file__).parents[3] / "config"
WORD = read_words(CONFIG).word
BY = (WORD("smaller"), WORD("lags"))
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
    assert found["x_deviation"].attrs == {"units": "m", "long_name": "standard deviation of lateral position"}
    # the density over frequency is the variance; Hann's window leaves a little of the mean
    over = found["x_spectrum"].integrate("frequency")
    np.testing.assert_allclose(over, found["x_deviation"] ** 2, rtol=0.02)


@pytest.mark.parametrize("unit, squared", [("m", "m2 Hz-1"), ("m s-2", "m2 s-4 Hz-1"), ("1", "Hz-1")])
def test_a_spectral_density_is_the_square_over_hertz(unit, squared):
    assert density(unit) == squared


def test_names_that_only_end_alike_are_not_taken_for_statistics():
    assert attributes("nothing_spectrum") == {}


def test_the_stress_of_a_sample_is_that_of_the_last_wave_below_its_own_ring(monkeypatch):
    """Bending of a known swing beside it, whose record begins with a jump before the last wave."""
    time = np.arange(0.0, 30.01, 0.25)
    periods, sizes = np.array([6.0, 25.0]), {"surge": 4e3, "pitch": 1e3}
    turns = 2.0 * np.pi * time / periods[:, None]
    moment = np.stack([size * np.cos(turns) for size in sizes.values()])
    moment[..., 0] = 1e6
    s = [0.0, 510.5, 533.0, 545.0]
    # above the ring stands the joint, whose stress does not count; one ring is lower
    along = np.array([0.5, 1.0, 3.0, 7.0])
    dims = ("sample", "motion", "wave_period", "time", "s")
    both = np.broadcast_to((moment[..., None] * along), (2, 2, 2, len(time), 4))
    runs = xr.Dataset(
        {
            "bending_moment": (dims, both),
            "effective_tension": (dims, np.full(both.shape, 2e6)),
            "assumed_printed_length": (
                "sample",
                ["from the lower flex joint to the ring", "from the lower to the upper flex joint"],
            ),
            "point_key": (dims[:3], np.zeros((2, 2, 2))),
        },
        {"sample": [0, 1], "motion": list(sizes), "wave_period": periods, "time": time, "s": s},
    )
    scene = load_scene(SYSTEM).resolved()
    monkeypatch.setattr(liu2020_motion, "scenes_of", lambda _: iter([({}, scene)]))
    found = rao_readings(runs)
    modulus = section(scene)[1]
    for sample, at_ring in ((0, 3.0), (1, 1.0)):
        for motion, size in sizes.items():
            swing = found["stress_amplitude"].sel(motion=motion, sample=sample)
            # a quarter of a second of 6 s misses 1 % of the lowest
            np.testing.assert_allclose(swing, at_ring * size / modulus, rtol=0.01)
    np.testing.assert_allclose(found["stress_share"].sel(motion="surge"), 0.8, rtol=1e-9)


def test_the_ring_of_a_sample_is_where_its_length_puts_it():
    """Values that tell their own arclength, at depths below either ring."""
    s = np.array([110.5, 133.0, 410.5, 433.0, 510.5, 533.0])
    values = xr.DataArray(np.tile(s, (2, 1)), dims=("sample", "s"), coords={"s": s})
    read = ["from the lower to the upper flex joint", "from the lower flex joint to the ring"]
    runs = xr.Dataset({"x": values, "assumed_printed_length": ("sample", read)})
    found = at_depths(runs["x"], ring_of(runs), (100.0, 400.0))
    np.testing.assert_array_equal(found, [[410.5, 110.5], [433.0, 133.0]])
    assert np.isnan(on_riser(runs["x"], ring_of(runs))).sum("s").values.tolist() == [1, 0]
    with pytest.raises(KeyError):
        at_depths(runs["x"], ring_of(runs), (200.0,))


def test_arrivals_of_a_wave_that_runs_down_are_its_way_over_its_speed():
    time = np.arange(0.0, 60.0, 0.05)
    depth = xr.DataArray(np.array(DEPTHS), dims="depth", coords={"depth": list(DEPTHS)})
    t = xr.DataArray(time, dims="time", coords={"time": time})
    late = t - depth / 31.9
    wave = xr.where(late > 0.0, (1.0 + depth / 100.0) * np.sin(0.4 * late), 0.0)
    begun = first_at(wave, 0.05)
    np.testing.assert_allclose(begun.diff("depth"), 100.0 / 31.9, atol=0.051)
    down = claims.travels_down(begun.to_dataset(name="arrival"))
    assert bool(down.true)
    assert float(down.value) == pytest.approx(300.0 / 31.9, abs=0.051)
    up = begun.assign_coords(depth=[400.0, 300.0, 200.0, 100.0])
    assert not bool(claims.travels_down(up.to_dataset(name="arrival")).true)


def test_a_moment_that_falls_over_one_grid_of_periods_may_rise_within_it():
    periods = [5.0, 6.0, 8.0, 10.0, 12.0, 20.0]
    moment = xr.DataArray([[9.0, 9.5, 8.0, 6.0, 7.0, 1.0]], {"roll_amplitude": [4.0], "roll_period": periods})
    found = claims.falls_with_period(moment.to_dataset(name="largest_bending_moment"), WORD("decreases"))
    shares = dict(zip(found.true["grid"].values, found.true.values, strict=True))
    assert shares == {"5, 10, 20 s": True, "6, 12, 20 s": True, "5, 8, 12, 20 s": True}
    assert float(found.value.sel(grid="5, 8, 12, 20 s")) == pytest.approx(8.0 / 9.0)
    rising = moment.assign_coords(roll_period=periods[::-1]).sortby("roll_period")
    found = claims.falls_with_period(rising.to_dataset(name="largest_bending_moment"), WORD("decreases"))
    assert not bool(found.true.any())


def test_surge_is_largest_by_peak_and_by_mean_share():
    def judged(**stress):
        table = xr.DataArray(
            list(stress.values()), {"motion": list(stress), "wave_period": [5.0, 10.0, 20.0]}
        )
        runs = {"stress_amplitude": table, "stress_share": table / table.sum("motion")}
        return bool(claims.surge_largest(xr.Dataset(runs), WORD("larger"), WORD("non-negligible")).true)

    assert judged(surge=[9.0, 2.0, 5.0], heave=[0.0, 1.0, 3.0], pitch=[1.0, 3.0, 1.0])
    assert not judged(surge=[9.0, 2.0, 5.0], heave=[0.0, 1.0, 10.0], pitch=[1.0, 3.0, 1.0])
    assert not judged(surge=[9.0, 2.0, 5.0], heave=[0.0, 0.0, 0.1], pitch=[1.0, 3.0, 1.0])
    assert not judged(surge=[9.0, 1.0, 1.0], heave=[1.0, 3.0, 3.0], pitch=[1.0, 1.0, 1.0])


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
    assert told == pytest.approx({"least": 0.5, "least_at": 20.0, "most": 3.15, "most_at": 6.0, "above": 5.0})


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
    told = baselines(*readings(Q2=(10, 4, 0, 10), Q8=(3, 10, 10, 10), Q9=(0, 10, 1, 5)), *BY)
    ring, joint = "“vertical force at the ring”", "“232 t carried to the upper flex joint”"
    top, some = "“riser's top on the platform”", "of the samples with these definitions."
    assert told["shares"] == (
        f"Claim Q2 is true only with the definitions “constant”, {ring} and {top}, "
        f"in 100 %, 40 % and 100 % {some} "
        f"Claim Q8 is true with the definitions “constant”, {ring}, {joint} and {top}, "
        f"in 30 %, 100 %, 100 % and 100 % {some} "
        f"Claim Q9 is true only with the definitions {ring}, {joint} and {top}, "
        f"in 100 %, 10 % and 50 % {some}"
    )
    assert told["both"] == f"With {top}, both Q2 and Q8 are true in at least 95 % of the samples."


def test_no_baseline_is_named_where_none_makes_both_true():
    told = baselines(*readings(Q2=(9, 10, 10, 0), Q8=(10, 9, 0, 10), Q9=(10, 10, 10, 10)), *BY)
    assert told["both"] == "No definition makes both Q2 and Q8 true in at least 95 % of the samples."


@pytest.mark.parametrize("seed", range(8))
def test_flexible_tensioners_are_compared_with_stiff_ones(seed):
    draw = np.random.default_rng(seed)
    behind = draw.uniform(-0.01, 0.3, (6, 4))  # rad, over sample and depth
    lag = draw.uniform(0.0, 2.0 * np.pi, behind.shape)
    later = WORD("lags")
    surge, stiff = (
        xr.Dataset(
            {"displacement_lag": (("tensioner_model", "sample", "depth"), values[None])}
        ).assign_coords(tensioner_model=[model])
        for model, values in (("gas law", lag + behind), ("stiff", lag))
    )
    found = claims.flexibility_makes_the_lag(surge, stiff, later)
    assert found.value.values == pytest.approx(np.rad2deg(behind.min(axis=1)))
    assert found.true.values.tolist() == (behind >= later.bound).all(axis=1).tolist()


@pytest.mark.parametrize("seed", range(8))
def test_a_simple_model_is_judged_by_each_definition(seed):
    """The gas law's largest displacement and moment are 1; those of the definitions are drawn."""
    draw = np.random.default_rng(seed)
    others = draw.uniform(0.96, 1.0, (2, len(WITHOUT)))
    names = ("largest_displacement", "largest_bending_moment")
    models = ["gas law", *WITHOUT]
    dims, larger = ("tensioner_model", "surface_speed"), WORD("larger")
    values = {name: (dims, np.array([[1.0], *row[:, None]])) for name, row in zip(names, others, strict=True)}
    found = claims.simple_model_differs(xr.Dataset(values, {"tensioner_model": models}), larger)
    assert found.value.values == pytest.approx(1.0 - others.min(axis=0))
    assert found.true.values.tolist() == (1.0 - others.min(axis=0) >= larger.bound).tolist()


@pytest.mark.parametrize("name", ["heave_open", "rao_open", "roll_open", "statics_open", "surge_open"])
def test_every_sample_pulls_the_printed_tension(name):
    """As cylinders that lean: six by 8.8 degrees at most (229 t), seven by 7.6 (233 t) to 10 degrees."""
    samples = read_study(CONFIG, "liu2020", name, "standard", None)
    others = (0,) * (len(samples.axes) - 1)
    for k in range(0, len(samples.axes["sample"]), 16):
        scene = samples.grid.file((k, *others)).resolved()
        rig = scene.top.tensioners
        gas, where = rig.two_chamber_gas, rig.arrangement
        assert gas.high.pressure - gas.low.pressure == pytest.approx(1.93e6)
        pistons = gas.pistons.mass * (1 if gas.pistons.counted == "once" else rig.count) * 9.81
        ring = scene.bottom.elevation + scene.riser[0].total_length
        lean = np.hypot(where.deck_elevation - ring, where.deck_radius - where.ring_radius)
        # gauge pressures stand against the atmosphere, which the rod does not see
        outside = 0.0 if gas.high.pressure < 2.1e6 else 101325.0
        areas = (gas.high.pressure - outside) * gas.high.area - (gas.low.pressure - outside) * gas.low.area
        pull = (rig.count * areas - pistons) * (where.deck_elevation - ring) / lean
        assert 229.0 < pull / 9810.0 < 233.2, (k, rig.count)


@pytest.mark.parametrize("name", ["rao_open", "roll_open", "surge_open"])
def test_what_is_left_open_keeps_the_riser_in_the_plane(name):
    """In space moments are sizes, and half the swing of a size is not an amplitude."""
    samples = read_study(CONFIG, "liu2020", name, "standard", None)
    others = (0,) * (len(samples.axes) - 1)
    assert len(samples.axes["sample"]) >= 128
    spatial = {samples.grid.file((k, *others)).resolved().spatial for k in range(len(samples.axes["sample"]))}
    assert spatial == {""}


@pytest.mark.parametrize("apart", [0.0, 0.05, 0.2])
def test_beats_are_seen_that_two_periods_side_by_side_do_not_show(apart):
    """A second oscillation of 1/80 Hz less: its beat takes 80 s, the record 100 s."""
    time = np.arange(0.0, 100.01, 0.25)
    periods = xr.DataArray([10.0, 12.5], dims="roll_period")
    periods = periods.assign_coords(roll_period=periods.values)
    t = xr.DataArray(time, dims="time", coords={"time": time})
    slower = 2.0 * np.pi * (1.0 / periods - 1.0 / 80.0)
    history = np.cos(2.0 * np.pi * t / periods) + apart * np.cos(slower * t)
    seen = beats(history, "roll_period")
    whole = 2.0 * apart / (1.0 + apart)  # less what a beat changes within a period
    assert (seen <= whole + 1e-9).all()
    assert (seen >= 0.7 * whole - 1e-9).all()
    # where a beat is at its turn, two periods side by side differ by a fraction of it
    early = [settling(history.sel(time=slice(0.0, end)), "roll_period") for end in range(30, 101, 5)]
    if apart:
        assert (np.min([one.values for one in early], axis=0) < 0.2 * seen.values).all()
