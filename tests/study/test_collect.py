"""Runs become one dataset over the axes of their grid, whatever meshes they are on."""

import hashlib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.result import Result
from riserstudy.dataset.variables import attributes
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.study.axes import Numbers
from riserstudy.study.collect import _named, dataset_of, laid_on
from riserstudy.study.grid import Grid, Point
from riserstudy.study.simulate_points import has_error_estimate, lacks
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel

CONFIG = Path(__file__).parents[2] / "config"
TIME, LENGTH = np.array([0.0, 1.0, 2.0]), 533.0
GAINS = np.array([[3.0, 1.0], [4.0, 2.0]])
FACTS = {"wall_seconds": 0.1, "elements": 4, "smallest_tension": 1.0, "warnings": [], "effects": {}}


def grid():
    """Two amplitudes by two periods."""
    axes = {
        "surge_amplitude": Numbers(path="platform.surge.amplitude", unit="m", values=[1.0, 2.0]),
        "surge_period": Numbers(path="platform.surge.period", unit="s", values=[9.0, 10.0]),
    }
    model = StudyModel(scene="scenes/bench/s2c.yaml", caption="a grid", axes=axes)
    return Study("bench", "grid", model, CONFIG, "standard")


def run(gain, nodes):
    """A run whose displacement is gain (1 + t) s."""
    s = np.linspace(0.0, LENGTH, nodes)
    x = gain * np.outer(1.0 + TIME, s)
    arrays = {"time": TIME, "s": s, "s_node": s, "x": x, "x_max": x[-1]}
    return Result(arrays, FACTS)


def test_a_vibration_is_kept_of_the_points_that_have_one():
    study, results = grid(), [run(gain, 5) for gain in GAINS.ravel()]
    assert "vibration_rms" not in dataset_of(study, results)
    for k, result in enumerate(results[:3]):
        results[k] = Result(result.arrays, FACTS | {"vibration_rms": 0.1 * k})
    kept = dataset_of(study, results)["vibration_rms"]
    np.testing.assert_array_equal(kept, [[0.0, 0.1], [0.2, np.nan]])
    assert kept.attrs["units"] == "m"


def test_numbers_are_put_at_every_path_of_their_axis():
    axis = Numbers(path=["wave.period", "platform.heave.period"], unit="s", values=[9.0])
    assert axis.overrides(9.0) == {"wave.period": "9.0 s", "platform.heave.period": "9.0 s"}


@pytest.mark.parametrize(
    "factor, offset, text", [(2.5, None, "10.0 m"), (0.5, 3.0, "5.0 m"), (None, -1.0, "3.0 m")]
)
def test_a_number_is_multiplied_before_it_is_shifted(factor, offset, text):
    axis = Numbers(path="top.offset", unit="m", factor=factor, offset=offset, values=[4.0])
    assert axis.overrides(4.0) == {"top.offset": text}


@pytest.mark.parametrize("seed", range(4))
def test_between_nodes_a_parabola_stays_one_and_tension_is_straight(seed):
    """Above the top there is no value; at a node, even if it is rounded, there is the node's own."""
    draw = np.random.default_rng(seed)
    s = np.concatenate([[0.0], np.sort(draw.uniform(20.0, 480.0, 6)), [500.0]])
    a, b, c = draw.uniform(-1.0, 1.0, 3)
    pull = draw.uniform(1e6, 2e6, 8)
    arrays = {"s_node": s, "x_max": a + b * s + c * 1e-3 * s**2, "effective_tension_max": pull}
    nodes = np.sort(np.concatenate([draw.uniform(0.0, 500.0, 30), s + 4e-7, [510.0, 533.0]]))
    laid = laid_on(Result(arrays, FACTS), nodes).arrays
    below = nodes < 500.5
    assert np.isnan(laid["x_max"][~below]).all()
    parabola = a + b * nodes + c * 1e-3 * nodes**2
    np.testing.assert_allclose(laid["x_max"][below], parabola[below], rtol=1e-5, atol=1e-5)
    np.testing.assert_allclose(
        laid["effective_tension_max"][below], np.interp(nodes, s, pull)[below], rtol=1e-6
    )
    at_nodes = np.isin(nodes, s + 4e-7)
    for name in ("x_max", "effective_tension_max"):
        np.testing.assert_array_equal(laid[name][at_nodes], arrays[name])


@pytest.mark.parametrize("nodes", [(9, 9, 9, 9), (9, 5, 9, 5), (5, 9, 17, 9)])
def test_every_run_stands_at_its_place_on_the_finest_mesh(nodes):
    runs = [run(gain, count) for gain, count in zip(GAINS.ravel(), nodes, strict=True)]
    dataset = dataset_of(grid(), runs)
    assert dataset["x"].dims == ("surge_amplitude", "surge_period", "time", "s")
    assert dataset.sizes["s"] == dataset.sizes["s_node"] == max(nodes)
    expected = GAINS[:, :, None, None] * np.outer(1.0 + TIME, dataset["s"].values)
    # displacements to 7 km; a spline through a straight line errs by rounding
    np.testing.assert_allclose(dataset["x"].values, expected, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(dataset["x_max"].values, expected[:, :, -1], rtol=1e-12, atol=1e-9)
    assert dataset["elements"].shape == GAINS.shape


def test_a_file_keeps_ten_digits_of_large_histories_and_all_of_anything_else(tmp_path):
    rng = np.random.default_rng(3)
    large = rng.standard_normal(2000) * 10.0 ** rng.integers(-9, 9, 2000)
    dataset = xr.Dataset({"large": ("time", large), "small": ("k", large[:100])})
    dataset["x_max"] = ("n", large)  # as in a study of few points, where it is small
    write_dataset(dataset, tmp_path / "a.nc")
    found = xr.load_dataset(tmp_path / "a.nc")
    np.testing.assert_allclose(found["large"], large, rtol=1e-9)
    np.testing.assert_array_equal(found["small"], large[:100])
    np.testing.assert_array_equal(found["x_max"], large)
    assert (found["large"] != large).any()


def test_numbers_of_few_digits_are_stored_as_they_are(tmp_path):
    """As a derived dataset may have them: the library rounds them to seven digits at most."""
    short = np.random.default_rng(4).standard_normal(2000).astype("f4")
    write_dataset(xr.Dataset({"short": ("time", short)}), tmp_path / "a.nc")
    found = xr.load_dataset(tmp_path / "a.nc")["short"]
    np.testing.assert_array_equal(found, short)
    assert found.dtype == short.dtype


def a_study_of(lengths, seed, tier="standard"):
    """Shape of a study, and its points with keys that are drawn, as those of a version of the engine."""
    grid = Grid(None, [[{}] * length for length in lengths], "")
    keys = (hashlib.sha256(bytes([seed, *index])).hexdigest() for index in np.ndindex(*lengths))
    points = [Point(index, key) for index, key in zip(np.ndindex(*lengths), keys, strict=True)]
    model = SimpleNamespace(modes=None)
    ends = {points[0].key, points[-1].key}
    return SimpleNamespace(grid=grid, model=model, estimates=True, tier=tier, end_keys=ends), points


def test_errors_are_estimated_at_few_points_all_and_of_others_at_some_whatever_their_keys():
    for seed in range(100):
        for lengths in [(4, 4), (1,), (17,), (4, 5), (3, 3, 3)]:
            for tier in ("preview", "standard"):
                study, points = a_study_of(lengths, seed, tier)
                told = [has_error_estimate(study, point) for point in points]
                assert sum(told) >= min(2, len(points))
                assert told[0]
                assert told[-1]
                if len(points) <= 16 and tier == "standard":
                    assert all(told)


def test_a_preview_estimates_few_errors_of_small_studies():
    few = [
        sum(has_error_estimate(study, point) for point in points)
        for study, points in (a_study_of((16,), seed, "preview") for seed in range(100))
    ]
    assert 2.0 < sum(few) / len(few) < 6.0


def test_one_point_in_eight_tells_its_error_and_is_lacking_without_it():
    many, points = a_study_of((200,), 0)
    told = [has_error_estimate(many, point) for point in points]
    assert 10 < sum(told) < 45
    silent, telling = Result({}, {}), Result({}, {"error_estimate": {}})
    for point, tells in zip(points, told, strict=True):
        assert lacks(many, point, None)
        assert lacks(many, point, silent) == tells
        assert not lacks(many, point, telling)


@pytest.mark.parametrize("name", ["case", "riser_drag", "operation", "floor"])
def test_words_of_an_own_axis_are_not_those_of_a_chapter(name):
    assert "comment" in attributes("case")
    plain = {"long_name": name.replace("_", " ")}
    assert _named(name, {"a": {}}, "own") == plain
    assert (_named(name, {"a": {}}, "liu2017") == plain) == (name != "riser_drag")


@pytest.mark.parametrize(
    "name, unit, expected",
    [
        ("floor", "m", "floor"),
        ("offset", "ft", "offset of the platform from the well"),
        ("units", "1", "number of working tensioner units"),
    ],
)
def test_numbers_of_an_own_axis_are_named_where_their_unit_is_of_the_kind(name, unit, expected):
    axis = Numbers(path="a", unit=unit, values=[1.0])
    assert _named(name, axis, "own")["long_name"] == expected


@pytest.mark.parametrize("seed", range(6))
def test_runs_with_outputs_at_several_intervals_stand_at_their_places_in_any_order(seed):
    rng = np.random.default_rng(seed)
    amplitudes = [float(k) for k in range(1, 10)]
    axes = {"surge_amplitude": Numbers(path="platform.surge.amplitude", unit="m", values=amplitudes)}
    model = StudyModel(scene="scenes/bench/s2c.yaml", caption="a grid", axes=axes)
    study = Study("bench", "grid", model, CONFIG, "standard")
    s, results = np.linspace(0.0, LENGTH, 5), []
    for gain, interval in zip(rng.random(9), rng.choice([0.5, 1.0, 2.0, 4.0], 9), strict=True):
        time = np.arange(0.0, 8.5, interval)
        x = gain * np.outer(1.0 + time, s)
        results.append(Result({"time": time, "s": s, "s_node": s, "x": x, "x_max": x[-1]}, FACTS))
    rng.shuffle(results)
    found = dataset_of(study, results)
    for amplitude, result in zip(amplitudes, results, strict=True):
        point = found.sel(surge_amplitude=amplitude)
        np.testing.assert_array_equal(point["x_max"], result.arrays["x_max"])
        np.testing.assert_array_equal(point["x"].sel(time=result.arrays["time"]), result.arrays["x"])
        assert np.isfinite(point["x"]).all("s").sum() == len(result.arrays["time"])
