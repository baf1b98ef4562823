"""Statistics of irregular seas against closed forms: Rayleigh's peaks, Gumbel's maxima, a followed sea."""

import csv
import json
import math

import numpy as np
import pytest
import xarray as xr
from random_rigs import moving, written
from scipy.interpolate import CubicSpline
from scipy.stats import gumbel_r

from riserstudy import load_scene, simulate, sweep
from riserstudy.cli import main
from riserstudy.dataset.further_seas import fitted
from riserstudy.dataset.statistics import gumbel, peaks, record_statistics
from riserstudy.dataset.statistics_tables import _histories, _sizes
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.study.demand_in_sea import demand

TIME = np.arange(0.0, 200_000.0, 0.5)
PERIOD, DEVIATION, MEAN = 10.0, 2.0, 5.0


@pytest.fixture(scope="module")
def narrow():
    """A narrow-banded Gaussian process: 200 components within 5 % of one frequency.

    Its envelope forgets itself in 1 / 0.01 Hz: 2000 peaks are independent, which leaves 1 % to chance in the
    deviation and 2 % in extremes.
    """
    random = np.random.default_rng(7)
    count = 200
    w = 2.0 * math.pi / PERIOD * random.uniform(0.95, 1.05, count)
    phase = random.uniform(0.0, 2.0 * math.pi, count)
    waves = sum(np.cos(a * TIME + b) for a, b in zip(w, phase, strict=True))
    return MEAN + DEVIATION * math.sqrt(2.0 / count) * waves


@pytest.mark.long
def test_peaks_of_a_narrow_band_are_rayleigh_distributed(narrow):
    found = peaks(narrow - MEAN)
    assert found.mean() == pytest.approx(DEVIATION * math.sqrt(math.pi / 2.0), rel=0.03)
    assert (found**2).mean() == pytest.approx(2.0 * DEVIATION**2, rel=0.06)
    assert len(found) == pytest.approx(TIME[-1] / PERIOD, rel=0.01)


@pytest.mark.long
@pytest.mark.parametrize("hours", [1.0, 3.0, 10.0])
def test_the_most_probable_maximum_of_a_narrow_band_is_rayleighs(narrow, hours):
    told = record_statistics(TIME, narrow, hours * 3600.0)
    count = hours * 3600.0 / PERIOD
    expected = DEVIATION * math.sqrt(2.0 * math.log(count))
    assert told.mean == pytest.approx(MEAN, abs=0.02)
    assert told.deviation == pytest.approx(DEVIATION, rel=0.03)  # three errors
    assert told.period == pytest.approx(PERIOD, rel=0.01)
    assert told.most_probable_largest - MEAN == pytest.approx(expected, rel=0.06)
    assert MEAN - told.most_probable_smallest == pytest.approx(expected, rel=0.06)


def in_a_sea(draw, duration):
    """A Gaussian process of deviation 1 with a JONSWAP spectrum up to five times its peak, and its times."""
    peak = 0.7
    w = np.linspace(0.3, 5.0 * peak, 600)
    width = np.where(w <= peak, 0.07, 0.09) * peak
    spectrum = w**-5 * np.exp(-1.25 * (w / peak) ** -4) * 3.3 ** np.exp(-(((w - peak) / width) ** 2) / 2)
    w = w + (w[1] - w[0]) * draw.uniform(-0.5, 0.5, len(w))
    size = np.sqrt(spectrum / (spectrum.sum() / 2.0)) * np.exp(2j * math.pi * draw.uniform(size=len(w)))
    time = np.arange(0.0, duration, 0.5)
    values = np.zeros(len(time))
    for a, b in zip(size, w, strict=True):
        values += abs(a) * np.cos(b * time + np.angle(a)) / math.sqrt(2.0)
    return time, values / values.std()


@pytest.mark.long
@pytest.mark.parametrize("duration", [1800.0, 10800.0])
@pytest.mark.parametrize("power, allowed", [(1.0, 0.03), (2.0, 0.06)])
def test_small_peaks_of_a_sea_do_not_move_the_most_probable_maximum(duration, power, allowed):
    """Of a broad band, and of a drag that grows with its square: by Rayleigh's, on the mean of 12 seas."""
    draw = np.random.default_rng(3)
    ratios = []
    for _ in range(12):
        time, sea = in_a_sea(draw, duration)
        told = record_statistics(time, sea * np.abs(sea) ** (power - 1.0), 10800.0)
        expected = (2.0 * math.log(10800.0 / told.period)) ** (0.5 * power)
        ratios += [told.most_probable_largest / expected, -told.most_probable_smallest / expected]
    chance = np.std(ratios) / math.sqrt(len(ratios))
    assert np.mean(ratios) == pytest.approx(1.0, abs=allowed + 2.0 * chance)


def test_a_record_without_peaks_enough_tells_no_extreme(narrow):
    few = record_statistics(TIME[:200], narrow[:200], 3600.0)
    assert math.isnan(few.most_probable_largest)
    assert few.largest == narrow[:200].max()
    still = record_statistics(TIME[:200], np.ones(200), 3600.0)
    assert (still.mean, still.deviation) == (1.0, 0.0)
    assert math.isnan(still.period)


@pytest.mark.parametrize("count", [10, 1000])
def test_gumbel_finds_the_distribution_that_samples_are_from(count):
    found = [gumbel(gumbel_r.rvs(30.0, 2.0, count, random_state=k)) for k in range(40)]
    modes = np.array([one.mode for one in found])
    # the mean of 40 has an error of a sixth of one's; maximum likelihood is biased by 1/n
    assert modes.mean() == pytest.approx(30.0, abs=4.0 * found[0].mode_error / math.sqrt(40.0))
    told = np.mean([one.mode_error for one in found])
    assert modes.std() == pytest.approx(told, rel=0.35)  # four errors of a deviation of 40
    shares = gumbel_r.cdf([one.fractile for one in found], 30.0, 2.0)  # of further samples below it
    assert shares.mean() == pytest.approx(0.9, abs=4.0 * shares.std() / math.sqrt(40.0))


def test_gumbel_solves_the_equations_of_maximum_likelihood():
    values = np.array([21.0, 23.5, 22.2, 25.1, 20.4, 22.9])
    ((mode,), (scale,)) = fitted(values[None])
    weights = np.exp(-values / scale)
    assert scale == pytest.approx(values.mean() - np.average(values, weights=weights))
    assert mode == pytest.approx(-scale * math.log(weights.mean()))
    assert (mode, scale) == pytest.approx(gumbel_r.fit(values))


@pytest.mark.parametrize("seed", range(12))
def test_a_regular_motion_has_its_own_period_and_extremes(seed):
    """Whatever part of a period the record begins and ends with, and however long the exposure."""
    draw = np.random.default_rng(seed)
    period, size, mean = draw.uniform(5.0, 20.0), draw.uniform(0.1, 10.0), draw.normal(0.0, 5.0)
    cycles, exposure = draw.uniform(3.0, 40.0), draw.uniform(1.0, 100.0) * 3600.0
    time = np.arange(0.0, cycles * period, period / 200.0)
    values = mean + size * np.sin(2.0 * math.pi * (time / period + draw.uniform()))
    told = record_statistics(time, values, exposure)
    assert told.period == pytest.approx(period, rel=0.02 / (cycles - 2.0))
    for extreme, sign in ((told.most_probable_largest, 1.0), (told.most_probable_smallest, -1.0)):
        if cycles > 13.0:
            assert extreme == pytest.approx(mean + sign * size, abs=2e-3 * size)


@pytest.mark.parametrize("seed", range(4))
def test_two_upcrossings_are_enough_for_a_period(seed):
    draw = np.random.default_rng(seed)
    period, cycles = draw.uniform(5.0, 20.0), draw.uniform(2.1, 2.9)
    time = np.arange(0.0, cycles * period, period / 200.0)
    values = np.sin(2.0 * math.pi * (time / period + draw.uniform()))
    assert record_statistics(time, values, 3600.0).period == pytest.approx(period, rel=0.02)
    few = time < 0.9 * period
    assert math.isnan(record_statistics(time[few], values[few], 3600.0).period)


@pytest.mark.parametrize("seed", range(4))
def test_the_mode_is_the_demand_of_so_many_runs_and_has_its_error(seed):
    """In -ln(0.9) times the duration of a run, nine in ten largest values do not exceed the mode."""
    values = np.random.default_rng(seed).gumbel(8.0, 1.5, 400)
    found, same = gumbel(values), demand(values, "largest", -math.log(0.9))
    assert same.value == pytest.approx(found.mode)
    assert same.deviation == pytest.approx(found.mode_error, rel=0.02)


HEIGHT, PEAK = 6.0, 12.0
#: a top that hangs on a constant tension, under a platform that follows the sea: stroke is the sea's surface
FOLLOWED = {
    "title": "followed",
    "riser": [
        {"name": "string", "length": "100 m", "axial_stiffness": "1e12 N", "mass": "100 kg/m",
         "structural_damping": {"ratio": 0.05, "at_period": "1 s"}}
    ],
    "bottom": {"hold": "wellhead", "elevation": "0 m"},
    "top": {"z": "free", "tension": "1 MN"},
    "platform": {
        "response": {
            "operators": [
                {"period": f"{period} s", "heave": "1 m/m", "heave_phase": "0 deg"}
                for period in (1.0, 40.0)
            ],
            "phases": "lead",
            "wave": {
                "significant_height": f"{HEIGHT} m", "peak_period": f"{PEAK} s",
                "peak_enhancement": 3.3, "components": 300, "seed": 1,
            },
        }
    },
    "analysis": {
        "duration": "3600 s", "output": {"interval": "0.5 s"}, "mesh": {"elements": 1},
        "step": "0.5 s",
    },
}  # fmt: skip


@pytest.fixture(scope="module")
def seeds(tmp_path_factory):
    """The followed sea in eight seeds."""
    scene = tmp_path_factory.mktemp("sea") / "followed.yaml"
    scene.write_text(json.dumps(FOLLOWED))
    axis = {"platform.response.wave.seed": list(range(1, 9))}
    found = sweep(scene, axis, keep=["stroke"], progress=False, cores=1)
    found = found.rename(platform_response_wave_seed="seed")
    found.to_netcdf(scene.with_suffix(".nc"))
    return scene.with_suffix(".nc")


def table(monkeypatch, *words):
    monkeypatch.setattr("sys.argv", ["riserstudy", "statistics", *map(str, words)])
    try:
        main()
    except SystemExit as ended:
        return ended.code
    with words[words.index("-o") + 1].open() as file:
        return list(csv.DictReader(file))


@pytest.mark.long
def test_extremes_of_a_long_exposure_say_that_they_rest_on_a_short_record(
    seeds, tmp_path, monkeypatch, capsys
):
    out = tmp_path / "out.csv"
    table(monkeypatch, seeds, "-o", out, "--at", "seed=3", "--exposure", "3 h")
    assert "are estimated from a record" not in capsys.readouterr().err
    table(monkeypatch, seeds, "-o", out, "--at", "seed=3", "--exposure", "1000 h")
    assert "extremes of 3.6e+06 s are estimated from a record" in capsys.readouterr().err


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    "ramp, start, output, warned",
    [(None, 0, 0, False), (600, 0, 0, True), (600, 599, 0, True), (600, 600, 0, False), (600, 0, 700, False)],
)
def test_times_in_ramps_are_warned_of(tmp_path, monkeypatch, capsys, ramp, start, output, warned, seed):
    """With all of a ramp of half of the record, the deviation is some 20 % too small."""
    scene, run, out = (tmp_path / name for name in ("followed.yaml", "run.nc", "out.csv"))
    scene.write_text(json.dumps(FOLLOWED))
    changed = {"analysis.duration": "1200 s", "platform.response.wave.seed": seed}
    changed |= {"platform.response.ramp": f"{ramp} s"} if ramp else {}
    changed |= {"analysis.output.start": f"{output} s"} if output else {}
    simulate(load_scene(scene, **changed), progress=False).to_netcdf(run)
    rows = table(monkeypatch, run, "-o", out, "--start", f"{start} s")
    row = next(row for row in rows if row["output"] == "stroke")
    assert ("ramps end at 600 s" in capsys.readouterr().err) == warned
    if warned and start == 0:
        assert float(row["standard deviation"]) < 0.93 * HEIGHT / 4.0


@pytest.mark.parametrize("interval, coarse", [(0.5, False), (1.5, False), (2.0, True), (5.0, True)])
def test_outputs_that_miss_peaks_are_warned_of(tmp_path, monkeypatch, capsys, interval, coarse):
    """From a fifth of a peak period on, extremes of a record are too small by per cents."""
    run, out = tmp_path / "run.nc", tmp_path / "out.csv"
    scene = tmp_path / "followed.yaml"
    output = {"analysis.output.interval": f"{interval} s"}
    scene.write_text(json.dumps(FOLLOWED))
    simulate(load_scene(scene, **output), progress=False).to_netcdf(run)
    table(monkeypatch, run, "-o", out)
    assert ("miss peaks" in capsys.readouterr().err) == coarse


def test_a_riser_that_follows_a_sea_has_its_statistics(seeds, tmp_path, monkeypatch):
    out = tmp_path / "out.csv"
    (one,) = table(monkeypatch, seeds, "-o", out, "--at", "seed=3", "--exposure", "3 h")
    # Hs is four standard deviations, up to what an hour of 300 waves leaves to chance
    assert float(one["standard deviation"]) == pytest.approx(HEIGHT / 4.0, rel=0.06)
    count = 3.0 * 3600.0 / float(one["mean upcrossing period (s)"])
    expected = HEIGHT / 4.0 * math.sqrt(2.0 * math.log(count))
    assert float(one["most probable largest"]) == pytest.approx(expected, rel=0.15)
    assert 0.6 * PEAK < float(one["mean upcrossing period (s)"]) < PEAK


def test_extremes_over_seeds_are_gumbels(seeds, tmp_path, monkeypatch):
    out = tmp_path / "out.csv"
    (row,) = table(monkeypatch, seeds, "-o", out, "--over", "seed")
    with xr.open_dataset(seeds, decode_times=False) as found:
        seas = found["stroke"].transpose("seed", "time").values
    at = np.arange(0.0, seas.shape[1] - 1.0, 0.02)
    largest = CubicSpline(np.arange(seas.shape[1]), seas, axis=1)(at).max(axis=1)
    assert float(row["most probable largest"]) == pytest.approx(gumbel(largest).mode, rel=1e-3)
    assert (row["seeds"], float(row["largest"])) == ("8", pytest.approx(largest.max(), rel=1e-3))
    # a Gaussian sea's: the mode of an hour, give or take three of its errors
    count = 3600.0 / (0.78 * PEAK)
    expected = HEIGHT / 4.0 * math.sqrt(2.0 * math.log(count))
    allowed = 3.0 * float(row["its standard error"])
    assert float(row["most probable largest"]) == pytest.approx(expected, abs=allowed)


def test_seeds_together_have_the_mean_and_the_variance_of_their_records(seeds, tmp_path, monkeypatch):
    (row,) = table(monkeypatch, seeds, "-o", tmp_path / "all.csv", "--over", "seed")
    out = tmp_path / "one.csv"
    each = [table(monkeypatch, seeds, "-o", out, "--at", f"seed={k}")[0] for k in range(1, 9)]
    mean, deviation = (np.array([float(one[n]) for one in each]) for n in ("mean", "standard deviation"))
    assert float(row["mean"]) == pytest.approx(mean.mean(), rel=1e-3)
    assert float(row["standard deviation"]) ** 2 == pytest.approx((deviation**2).mean(), rel=1e-3)


@pytest.mark.parametrize("seed", range(4))
def test_magnitudes_in_space_are_not_below_zero(tmp_path, monkeypatch, seed):
    """Angles and moments of a rig in space; of one in a plane they have signs, and so their extremes."""
    smallest = {}
    for spatial in (False, True):
        tree = moving(seed, spatial=spatial)
        tree["analysis"]["duration"] *= 6.0
        scene = SceneFile("rig.yaml", written(tree))
        run, out = tmp_path / f"{spatial}.nc", tmp_path / f"{spatial}.csv"
        simulate(scene, progress=False).to_netcdf(run)
        sums = sweep(scene, {"platform.heave.phase": [0.0]}, keep=["ufj_angle"], progress=False)
        assert _sizes(sums) == _sizes(xr.open_dataset(run))
        rows = table(monkeypatch, run, "-o", out, "--exposure", "3 h")
        of = [r for r in rows if r["output"] in ("bending_moment", "ufj_angle", "lfj_angle")]
        smallest[spatial] = np.array([float(r["most probable smallest"] or "nan") for r in of])
    assert np.nanmin(smallest[False]) < 0.0
    assert np.nanmin(smallest[True]) >= 0.0


@pytest.mark.parametrize(
    "words",
    [
        ["--over", "height"],
        ["--over", "time"],
        ["--over", "seed", "--exposure", "3 h"],
        ["--over", "seed", "--at", "seed=1"],
        ["--at", "seed=3", "--exposure", "3 m"],
        ["--at", "seed=3", "--exposure", "0 s"],
        ["--at", "seed=3", "--exposure", "-3 h"],
        ["--at", "seed=3", "--start", "2 h"],
        [],
    ],
    ids=" ".join,
)
def test_what_cannot_be_told_is_refused(seeds, tmp_path, monkeypatch, words):
    assert table(monkeypatch, seeds, *words, "-o", tmp_path / "out.csv") == 2
    assert not (tmp_path / "out.csv").exists()


def test_an_axis_that_sets_more_than_seeds_is_none_of_seeds(seeds, tmp_path, monkeypatch, capsys):
    """Largest values at several heights are no sample of one distribution."""
    with xr.open_dataset(seeds, decode_times=False) as found:
        other = found.load().rename(seed="height")
    sets = {str(v): {"platform.response.wave.significant_height": f"{v} m"} for v in range(1, 9)}
    other["height"].attrs["sets"] = json.dumps(sets)
    other.to_netcdf(tmp_path / "heights.nc")
    out = tmp_path / "out.csv"
    assert table(monkeypatch, tmp_path / "heights.nc", "--over", "height", "-o", out) == 2
    assert "not only seeds" in capsys.readouterr().err


@pytest.mark.parametrize("value", [0.0, 1e-9, -3.5, 2e6])
@pytest.mark.parametrize("apart", [0.0, 1e-15])
def test_extremes_that_no_seed_changes_are_those_of_all(value, apart):
    found = gumbel(value * (1.0 + apart * np.arange(6)))
    assert (found.mode, found.fractile) == (pytest.approx(value), pytest.approx(value))
    assert (found.scale, found.mode_error) == (0.0, 0.0)


@pytest.mark.parametrize("seed", range(5))
def test_a_start_leaves_two_outputs_or_the_error_names_the_latest_that_does(seed):
    draw = np.random.default_rng(seed)
    time = draw.uniform(0.1, 2.0) * np.arange(draw.integers(3, 40))
    run = xr.Dataset({"stroke": ("time", draw.normal(size=len(time)), {"units": "m"})}, {"time": time})
    for start in (*draw.uniform(0.0, 1.2 * time[-1], 10), time[-2], time[-1]):
        if start <= time[-2]:
            list(_histories(run, start))
        else:
            with pytest.raises(InputError, match=f"give at most {time[-2]:g} s"):
                list(_histories(run, start))
