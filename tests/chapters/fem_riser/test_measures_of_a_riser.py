"""Measures of a riser whose curve is known, and the water under a wave by its conservation laws."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import brentq

from chapters.fem_riser.along import measures
from chapters.fem_riser.derived import BEAM, LUMPED, lumped_trends, reading_trends, rest, sample_error, water
from riserstudy.scene.load import read_scene

BASE = Path(__file__).parents[3] / "config/scenes/fem_riser/base.yaml"
TREE = read_scene(BASE).tree
LENGTH, PERIOD = 2000.0, 8.0  # m, s, of the scene
SIZES = ("deflection", "vibration", "stress", "angle")


def bent(offset, level, rate, swing, moments=(2e5, -5e5)):
    """A parabola between the wellhead and an offset top, that grows, swings, and bends most at two nodes."""
    s = np.linspace(0.0, LENGTH, 201)
    t = 260.0 + np.arange(0.0, 5 * PERIOD, 1.0)  # whole periods
    part = 4.0 * s * (LENGTH - s) / LENGTH**2
    size = level + rate * t + swing * np.cos(2.0 * np.pi * t / PERIOD)
    x = offset * s / LENGTH + part * size[:, None]
    moment = np.zeros_like(x)
    moment[:, 10], moment[:, 190] = moments  # at 5 and 95 % of the length
    data = {"x": (("time", "s"), x)}
    for name, values in (("x", x), ("bending_moment", moment)):
        data |= {f"{name}_{side}": ("s_node", getattr(values, side)(axis=0)) for side in ("max", "min")}
    return xr.Dataset(data, {"time": t, "s": s, "s_node": s}, {"scene": json.dumps(TREE)}), size


@pytest.mark.parametrize("seed", range(4))
def test_measures_of_a_parabola_are_its_own(seed):
    draw = np.random.default_rng(seed)
    offset, level, swing = draw.uniform(-20.0, 20.0), draw.uniform(40.0, 80.0), draw.uniform(0.1, 1.0)
    rate = draw.choice([-1.0, 1.0]) * draw.uniform(0.01, 0.05)
    runs, size = bent(offset, level, rate, swing)
    found = {name: float(values) for name, values in measures(runs).items()}
    assert found["deflection_from_line"] == pytest.approx(size.max())
    # a parabola over a line is highest beside the middle, by the line's share of its slope
    high = size.max()
    highest = high + 0.5 * offset + offset**2 / (16.0 * high)
    # the nearest node is at most half a segment from it
    assert 0.0 <= highest - found["deflection"] <= 4.0 * high * 0.0025**2 + 1e-9
    assert found["deflection_place"] == pytest.approx(0.5 + offset / (8.0 * high), abs=0.0051)
    assert found["deflection_from_line_place"] == pytest.approx(0.5, abs=0.0026)  # whatever the line
    assert found["vibration"] == pytest.approx(swing)
    assert found["drift"] == pytest.approx(35.0 * abs(rate) / size.mean())
    steepest = max(abs(offset + sign * 4.0 * high * 0.995) for sign in (1.0, -1.0)) / LENGTH
    assert found["angle"] == pytest.approx(np.arctan(steepest))
    assert found["angle_from_bottom"] == pytest.approx(0.0025)
    assert found["angle_from_top"] == pytest.approx(0.0025)


@pytest.mark.parametrize("moments", [(2e5, -5e5), (-5e5, 2e5), (5e5, -2e5)])
def test_the_stress_is_that_of_the_largest_moment_and_has_a_place_in_either_half(moments):
    found = measures(bent(0.0, 50.0, 0.0, 0.5, moments)[0])
    outer, inner = 0.5 * 0.5334, 0.5 * 0.4826
    second = np.pi * (outer**4 - inner**4) / 4.0
    assert float(found["stress"]) == pytest.approx(5e5 * outer / second)
    assert float(found["stress_from_bottom"]) == pytest.approx(0.05)
    assert float(found["stress_from_top"]) == pytest.approx(0.05)


def test_a_run_s_own_extremes_count_more_than_those_at_common_nodes():
    """Nodes of another mesh miss the peak between them."""
    runs, size = bent(0.0, 50.0, 0.02, 0.5)
    few = runs.isel(s_node=slice(0, None, 8))  # without the middle
    few["value_of_statistic"] = ("statistic", [size.max(), 0.0])
    few = few.assign_coords(statistic=["x max", "x min"])
    assert float(few["x_max"].max()) < size.max() - 0.01
    assert float(measures(few)["deflection"]) == pytest.approx(size.max())


def test_the_error_of_a_sample_is_relative_to_the_finer_run():
    fine, coarse = (bent(0.0, level, 0.0, 0.5)[0].expand_dims(sample=[3]) for level in (50.0, 51.0))
    coarse = xr.concat([coarse, fine.assign_coords(sample=[4])], "sample").expand_dims(solver=[BEAM])
    found = sample_error(fine, coarse)
    assert found["sample"].values.tolist() == [3]
    assert float(found["deflection"][0]) == pytest.approx(1.0 / 50.5)
    assert float(found["vibration"][0]) == pytest.approx(0.0, abs=1e-9)


def test_measures_keep_their_axis_and_have_units():
    found = rest(bent(5.0, 50.0, 0.0, 0.5)[0].expand_dims(case=["soft"]))
    assert found["stress_by_case"].dims == ("case",)
    assert found["stress_by_case"].attrs["units"] == "Pa"


def over(name, levels):
    """Runs over an axis, each with its own deflection (m)."""
    runs = [bent(0.0, level, 0.0, 0.5)[0] for level in levels.values()]
    return xr.concat(runs, xr.DataArray(list(levels), dims=name, name=name), combine_attrs="override")


def test_the_share_that_blocks_carry_is_what_the_left_weight_lacks():
    """30 % left is a factor of 0.7 in R4, whose deflection stands beside those of other interpretations."""
    others = over("buoyant_factor", {0.3: 40.0, 0.7: 50.0}).expand_dims(reading=["R1"])
    found = reading_trends(others, over("weight_left", {0.7: 60.0, 0.3: 70.0}))["deflection_by_factor"]
    for reading, factor, level in (
        ("R1", 0.3, 40.0),
        ("R1", 0.7, 50.0),
        ("R4", 0.3, 60.0),
        ("R4", 0.7, 70.0),
    ):
        assert found.sel(reading=reading, buoyant_factor=factor).item() == pytest.approx(level + 0.5)


def test_lengths_of_a_trend_are_those_of_the_scenes_and_other_axes_their_own():
    studies = {}
    for length in (500, 1000, 1500):
        tree = TREE | {"riser": [TREE["riser"][0] | {"length": f"{length} m"}]}
        runs = over("solver", {BEAM: 10.0, LUMPED: 0.02 * length})
        studies[f"length_{length}"] = runs.assign_attrs(scene=json.dumps(tree))
    for name in ("tension_ratio", "buoyant_factor"):
        both = [over(name, {1.1: 1.0, 1.3: 1.0}), over(name, {1.1: 30.0, 1.3: 40.0})]
        studies[name] = xr.concat(both, xr.Variable("solver", [BEAM, LUMPED]), combine_attrs="override")
    found = lumped_trends(**studies)
    assert found["length"].values.tolist() == [500.0, 1000.0, 1500.0]
    assert found["deflection_by_length"].values == pytest.approx([10.5, 20.5, 30.5])
    assert found["deflection_by_ratio"].values == pytest.approx([30.5, 40.5])
    assert found["vibration_by_factor"].values == pytest.approx([0.5, 0.5])


def of_wave(period, **wave):
    tree = TREE | {"wave": TREE["wave"] | {"period": f"{period} s"} | wave}
    return water(xr.Dataset(attrs={"scene": json.dumps(tree)}))


@pytest.mark.parametrize("period", [8.0, 40.0, 70.0])
@pytest.mark.parametrize("phase", [0.0, 0.9])
def test_water_under_a_wave_is_conserved_and_accelerates_as_its_speed_changes(period, phase):
    """Of 8 m in 2000 m: the flow through a section is the elevation times the speed of the wave."""
    found = of_wave(period, **({"phase": f"{phase} rad"} if phase else {}))
    w, height, g = 2.0 * np.pi / period, 2000.0, 9.81
    k = brentq(lambda k: g * k * np.tanh(k * height) - w**2, 1e-9, 1.0)
    speed, time = found["wave_velocity"], found["time"].values
    elevation = 4.0 * np.cos(phase - w * time)
    np.testing.assert_allclose(speed.integrate("below_surface"), elevation * w / k, atol=4e-3 * 4.0 * w / k)
    # at the surface pressure is hydrostatic: a g k / w; at the bed a w / sinh(k h)
    np.testing.assert_allclose(speed.isel(below_surface=0), elevation * g * k / w, atol=1e-9)
    assert float(found["below_surface"][-1]) == height
    at_bed = elevation * w / np.sinh(k * height)
    np.testing.assert_allclose(speed.isel(below_surface=-1), at_bed, atol=1e-9)
    change = np.gradient(speed.values, time, axis=0)[1:-1]
    acceleration = found["wave_acceleration"].values
    np.testing.assert_allclose(change, acceleration[1:-1], atol=1e-2 * np.abs(acceleration).max())


def test_an_amplitude_is_half_a_height():
    wave = {name: value for name, value in TREE["wave"].items() if name != "height"}
    tree = TREE | {"wave": wave | {"amplitude": "4 m"}}
    by_amplitude = water(xr.Dataset(attrs={"scene": json.dumps(tree)}))
    xr.testing.assert_allclose(by_amplitude, of_wave(8.0))


def test_the_current_is_largest_at_the_surface_and_leaves_only_the_drift_s_rest_at_the_bed():
    """Tide of 0.75 m/s, and along the wind the surface speed of Ekman's drift over the root of two."""
    found = of_wave(8.0)["water_speed"]
    drift = 0.0127 / np.sqrt(np.sin(np.deg2rad(20.0))) * 20.0 / np.sqrt(2.0)
    assert float(found[0]) == pytest.approx(0.75 + drift, rel=1e-6)
    assert abs(float(found[-1])) < 1e-6


def test_water_is_the_same_whatever_elevations_are_measured_from():
    lower = {"water": TREE["water"] | {"seabed": "-700 m", "surface": "1300 m"}}
    lower["bottom"] = TREE["bottom"] | {"elevation": "-700 m"}
    found = water(xr.Dataset(attrs={"scene": json.dumps(TREE | lower)}))
    xr.testing.assert_allclose(found, of_wave(8.0), atol=1e-12)
