"""What figures of the chapter on Liu et al. 2020 state, on drawn data."""

import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_hex

from chapters.liu2020.figures import heave, motion, static_shapes, statics, waves
from chapters.liu2020.figures.colours import ALL, NAMES, OF_CALIBRATION, ONE, VERTICAL
from riserstudy.figures.figure_text import headline
from riserstudy.study.read import read_studies

CONFIG = Path(__file__).parents[3] / "config"
SPEEDS = [0.2, 0.6, 1.0]
PRINTED = (337.0, 3166.0, 8765.0)
NODES = np.linspace(0.0, 557.0, 120)  # the telescopic joint above 533 m


def moments(draw):
    """Moments that decay from the ring, those of a vertical force by far the largest (N m)."""
    axes = {
        "calibration": [ALL, ONE],
        "tensioner_model": list(NAMES),
        "surface_speed": SPEEDS,
        "s_node": NODES,
    }
    at_ring = draw.uniform(5e3, 60e3, (2, len(NAMES), 1, 1))
    at_ring[:, list(NAMES).index(VERTICAL)] *= draw.uniform(4.0, 30.0)
    depth = np.maximum(533.0 - NODES, 0.0)
    decay = np.exp(-depth / draw.uniform(20.0, 80.0))
    lower = draw.uniform(0.0, 1e4) * np.exp(-NODES / 10.0)
    speed = np.square(SPEEDS)[:, None]
    return xr.DataArray(speed * (lower - at_ring * decay), axes, tuple(axes))


def tuned(curves):
    """What is derived from static runs, as far as the figure reads it."""
    near = curves.sel(s_node=(curves["s_node"] <= 533.0) & (curves["s_node"] >= 413.0))
    return xr.Dataset({"largest_bending_moment_near_ring": abs(near).max("s_node")})


@pytest.mark.parametrize("seed", range(20))
def test_the_moments_of_a_vertical_force_are_drawn_whole_and_compared(seed):
    curves = moments(np.random.default_rng(seed))
    runs = xr.Dataset({"bending_moment_static": curves})
    figure = static_shapes.fig12(runs, tuned(curves))
    ratios = tuned(curves)["largest_bending_moment_near_ring"]
    ratios = ratios.sel(tensioner_model=VERTICAL) / ratios.sel(tensioner_model="gas law")
    said = [float(n) for n in re.findall(r"\d+", headline(figure))]
    assert said == [round(float(ratios.min())), round(float(ratios.max()))]
    for ax in figure.axes:
        low, high = ax.get_xlim()
        for line in ax.get_lines():
            values = line.get_xdata()
            assert low < values.min() <= values.max() < high
    for left, right, calibration in zip(figure.axes[::2], figure.axes[1::2], [ALL, ONE], strict=True):
        (text,) = (t.get_text() for t in left.texts if t.get_text())
        ratio = float(ratios.sel(calibration=calibration, surface_speed=1.0))
        assert f"{ratio:.0f} times" in text
        assert NAMES[VERTICAL] not in {line.get_label() for line in right.get_lines()}


@pytest.mark.parametrize("seed", range(8))
def test_the_title_of_forces_states_the_least_of_the_largest_errors(seed):
    draw = np.random.default_rng(seed)
    axes = {"counted": ["all cylinders", "one cylinder"], "surface_speed": SPEEDS}
    shapes = list(statics.OF_PROFILE)
    errors = draw.uniform(-0.9, 3.0, (len(shapes), 2, 3))
    small = draw.uniform(-0.2, 0.2, (2, 3))
    assumed = xr.DataArray(
        PRINTED * (1.0 + errors), {"current_profile": shapes, **axes}, ("current_profile", *axes)
    )
    calibrated = xr.DataArray(
        PRINTED * (1.0 + small),
        {"calibration": [ALL, ONE], "surface_speed": SPEEDS},
        ("calibration", "surface_speed"),
    )
    sets = (xr.Dataset({"horizontal_force": of}) for of in (assumed, calibrated))
    title = headline(statics.dat_force(*sets, *PRINTED))
    said, off = map(float, re.findall(r"(\d+) %", title))
    least = 100.0 * min(max(abs(e)) for e in errors.reshape(-1, 3))
    assert said <= least < said + 1.0  # "or more" is not rounded up
    assert off == pytest.approx(100.0 * abs(small).max(), abs=0.5)


@pytest.mark.parametrize("seed", range(12))
def test_the_title_of_end_stops_compares_runs_without_contact(seed):
    """Tension is negative before a stop acts if it is so in heave below the last run without contact."""
    draw = np.random.default_rng(seed)
    amplitudes = np.arange(6.0, 8.6, 0.25)
    zero, contact = draw.uniform(6.2, 8.3, 2)
    axes = {"stop_stiffness": [1e7, 3e7], "heave_amplitude": amplitudes, "time": [0.0, 1.0]}
    sign = np.array([1.0, -1.0])
    size = 7.5 + amplitudes - contact
    stroke = xr.DataArray(np.stack([np.outer(size, sign)] * 2)[..., None], {**axes, "cylinder": [0]})
    tension = 1e6 * np.stack([np.ones_like(amplitudes), zero - amplitudes], axis=-1)
    tension = xr.DataArray(np.stack([tension] * 2)[..., None], {**axes, "s": [0.0]})
    figure = heave.heave_limit(xr.Dataset({"tensioner_stroke": stroke, "effective_tension": tension}))
    without = amplitudes[amplitudes < contact]
    title = headline(figure)
    assert f"negative at {zero:.1f} m" in title
    assert ("before a stop acts" in title) == (zero <= without.max())
    for ax in figure.axes:
        (band,) = (patch for patch in ax.patches if patch.get_width() == 0.25)
        assert band.get_x() == without.max()


@pytest.mark.parametrize("seed", range(8))
def test_the_title_of_the_currents_is_that_of_their_depths(seed):
    draw = np.random.default_rng(seed)
    scales = dict(zip([ALL, ONE], draw.uniform(20.0, 300.0, 2), strict=True))
    depth = np.linspace(0.0, 533.0, 1067)
    shapes = {name: np.exp(-depth / 100.0) for name in statics.OF_PROFILE}
    shapes |= {f"calibrated: {name}": np.exp(-depth / scale) for name, scale in scales.items()}
    share = xr.DataArray(
        list(shapes.values()), {"current_profile": list(shapes), "depth": depth}, ("current_profile", "depth")
    )
    title = headline(statics.fig09(xr.Dataset({"current_share": share})))
    apart = max(scales.values()) / min(scales.values())
    if abs(apart - 2.0) > 0.1:
        assert ("a shallow and a deep one" in title) == (apart > 2.0)


@pytest.mark.parametrize("seed", range(8))
def test_a_moment_is_said_to_decrease_with_period_where_its_resonances_do(seed):
    draw = np.random.default_rng(seed)
    periods = np.arange(5.0, 20.01, 0.25)
    count = int(draw.integers(2, 6))
    at = np.linspace(6.0, 18.0, count)
    heights = draw.uniform(20e3, 100e3, count)
    if seed % 2:
        heights = np.sort(heights)[::-1]
    curve = 1e3 + sum(h * np.exp(-(((periods - t) / 0.6) ** 2)) for h, t in zip(heights, at, strict=True))
    roll = xr.DataArray(
        [0.5 * curve, curve],
        {"roll_amplitude": [2.0, 4.0], "roll_period": periods},
        ("roll_amplitude", "roll_period"),
    )
    title = headline(motion.fig20(xr.Dataset({"largest_bending_moment": roll}), 32.8))
    assert f"{motion.COUNTS[count]} resonances" in title
    assert ("decreases" in title) == bool((np.diff(heights) < 0.0).all())


@pytest.mark.parametrize("ratio", [0.5, 0.9, 1.1, 2.0])
def test_the_moment_of_the_start_is_compared_with_that_of_the_steady_state(ratio):
    time, s = np.arange(0.0, 200.1, 0.5), np.linspace(0.0, 533.0, 40)
    size = np.where(time < 100.0, ratio, 1.0)
    values = 1e4 * size[:, None] * np.cos(0.6 * time)[:, None] * np.sin(np.pi * s / 533.0)
    run = xr.DataArray(
        values[None], {"tensioner_model": ["gas law"], "time": time, "s": s}, ("tensioner_model", "time", "s")
    )
    title = headline(motion.fig19(xr.Dataset({"bending_moment": run}), 32.8))
    assert ("larger" in title) == (ratio > 1.0)
    assert ("smaller" in title) == (ratio < 1.0)


def test_elevations_in_titles_are_those_of_the_scenes():
    file = read_studies(CONFIG, "liu2020")
    found = {name: of["platform.centre_of_rotation.elevation"] for name, of in file.readings[
        "reference"
    ].items() if of}  # fmt: skip
    scene = file.schematics["fig01"].file(CONFIG).resolved()
    found["at the sea surface"] = f"{scene.platform.centre_of_rotation.elevation:g} m"
    for name in ("fig23", "fig24"):
        said = file.figures[name].settings["elevations"]
        assert {key: f"{value:g} m" for key, value in said.items()} == found


def test_depths_and_drag_in_names_of_calibrated_currents_are_those_of_the_study():
    study = read_studies(CONFIG, "liu2020").studies["statics_calibrated"]
    base, other = study.set, study.axes["calibration"][ONE]
    scales = {ALL: base["current.profile"]["scale"], ONE: other["current.profile.scale"]}
    drags = {ALL: base["riser[0].drag.coefficient"], ONE: other["riser[0].drag.coefficient"]["calibrated"]}
    for name in (ALL, ONE):
        depth, drag = scales[name], f"{drags[name]:.3g}"
        assert statics.CALIBRATED[name].startswith(f"depth scale {depth}, drag coefficient {drag},")
        assert f"exponential {depth}, drag coefficient {drag}" in static_shapes.CALIBRATIONS[name]
        assert to_hex(OF_CALIBRATION[name]) == statics.OF_PROFILE[f"exponential {depth}"]


def test_the_sea_state_in_the_key_is_that_of_the_study():
    sea = read_studies(CONFIG, "liu2020").studies["sea"].set["platform.response"]["wave"]
    assert f"height {sea['significant_height']}, peak period {sea['peak_period']}" in waves.SEA


@pytest.mark.parametrize("seed", range(8))
def test_the_title_of_shares_names_the_periods_at_which_another_motion_leads(seed):
    draw = np.random.default_rng(seed)
    periods = np.arange(5.0, 30.1, 0.5)
    count = int(draw.integers(1, 4))
    at = np.linspace(8.0, 26.0, count) + draw.uniform(-0.4, 0.4, count)
    pitch = np.full((2, periods.size), 0.2)
    for k, middle in enumerate(at):
        pitch[k % 2, abs(periods - middle) < 1.0] = 0.7
    axes = {"motion": ["heave", "surge", "pitch"], "reference": ["low", "high"], "wave_period": periods}
    heave = np.full_like(pitch, 0.05)
    share = xr.DataArray(np.stack([heave, 0.95 - pitch, pitch]), axes, tuple(axes))
    title = waves._largest_share(share)
    assert title.startswith("Surge has the largest share")
    said = [float(n) for n in re.findall(r"\d+", title)]
    if count < 3:
        assert said == pytest.approx(at, abs=1.0)
    else:
        assert not said


@pytest.mark.parametrize("down", [True, False])
@pytest.mark.parametrize("speed", [15.0, 31.9, 80.0])
def test_surge_is_said_to_travel_down_only_where_it_begins_later_deeper(down, speed):
    depth, time = np.linspace(0.0, 533.0, 120), np.arange(0.0, 60.0, 0.25)
    away = depth if down else depth[-1] - depth
    pulse = np.exp(-(((time[:, None] - 8.0 - away / speed) / 2.0) ** 2))
    x = xr.DataArray(pulse, {"time": time, "depth": depth}, ("time", "depth"))
    assert motion._travels_down(x) == down
