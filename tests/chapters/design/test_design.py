"""Envelopes, windows and what figures say of them, of datasets whose answer is known."""

import numpy as np
import pytest
import xarray as xr

from chapters.design.derived.seas import _added, allowances
from chapters.design.figures.operability import operability_drilling
from chapters.design.figures.recoil import recoil_failures, recoil_systems
from chapters.design.figures.tension import heaviest
from riserstudy.dataset.limits import coordinates
from riserstudy.design.envelopes import envelopes
from riserstudy.scene.limits import Limit

MOVING = ("lfj_angle", "ufj_angle", "joint_stroke")
LIMITS = [
    Limit(output=output, mode=mode, **{side: value})
    for output, mode, side, value in (
        ("lfj_angle", "drilling", "mean", "2 deg"),
        ("joint_stroke", "drilling", "largest", "3 m"),
        ("joint_stroke", "connected", "largest", "5 m"),
    )
]


def offsets(values):
    """Offsets over two currents, in a mud."""
    return xr.DataArray(
        np.asarray(values, float)[None],
        dims=("mud_weight", "surface_speed", "limit", "offset_side"),
        coords={
            "mud_weight": [1440.0],
            "surface_speed": [0.0, 1.0],
            "offset_side": ["low", "high"],
            **coordinates(LIMITS),
        },
    )


NARROW = offsets(
    [[[-40.0, 40.0], [-60.0, 30.0], [-np.inf, np.inf]], [[10.0, 50.0], [-60.0, 5.0], [-90.0, np.inf]]]
)


def test_an_envelope_is_what_all_limits_of_its_mode_leave_and_names_what_governs():
    found = envelopes(NARROW).squeeze("mud_weight", drop=True)
    drilling = found.sel(operation="drilling", surface_speed=0.0)
    assert drilling["envelope_offset"].values.tolist() == [-40.0, 30.0]
    assert drilling["governing_limit_name"].values.tolist() == ["mean lfj_angle", "largest joint_stroke"]
    connected = found.sel(operation="connected", surface_speed=1.0)
    assert connected["envelope_offset"].values.tolist() == [-90.0, np.inf]
    assert connected["governing_limit_name"].values.tolist() == ["largest joint_stroke", "none"]


def test_limits_that_exclude_each_other_leave_nothing():
    found = envelopes(NARROW).sel(operation="drilling", surface_speed=1.0)
    assert np.isnan(found["envelope_offset"]).all()
    assert (found["governing_limit_name"] == "none").all()


def test_a_limit_that_no_offset_keeps_leaves_nothing():
    never = offsets(np.where(np.isinf(NARROW.values[0]), np.nan, NARROW.values[0]))
    found = envelopes(never).sel(operation="connected")
    assert np.isnan(found["envelope_offset"]).sel(surface_speed=0.0).all()


def test_the_chart_says_where_drilling_goes_on():
    dataset = xr.Dataset({"offset_of_limit": NARROW}, attrs={"reach": 240.0})
    title = operability_drilling(dataset.merge(envelopes(NARROW))).get_suptitle()
    assert title == "At 0 m/s of current, offsets from −40 to 30 m allow drilling in this mud"


@pytest.mark.parametrize(
    "still, title",
    [
        (-40.0, "Offsets from 10 to 30 m allow drilling in every current"),
        (20.0, "Strongest current: offsets from 10 to 30 m allow drilling in this mud"),
    ],
)
def test_the_chart_names_no_current_where_all_allow_its_offsets(still, title):
    """The second current is the stronger one; its offsets are allowed in still water, or not all are."""
    limits = offsets(
        [[[still, 40.0], [-60.0, 50.0], [-np.inf, np.inf]], [[10.0, 50.0], [-60.0, 30.0], [-90.0, np.inf]]]
    )
    dataset = xr.Dataset({"offset_of_limit": limits}, attrs={"reach": 240.0})
    assert operability_drilling(dataset.merge(envelopes(limits))).get_suptitle() == title


def test_the_chart_says_on_which_side_offsets_are_without_a_limit():
    one_side = offsets(np.where(NARROW.values[0] < 0.0, -np.inf, NARROW.values[0]))
    dataset = xr.Dataset({"offset_of_limit": one_side}, attrs={"reach": 240.0})
    title = operability_drilling(dataset.merge(envelopes(one_side))).get_suptitle()
    assert title == "At 0 m/s of current, offsets below 30 m allow drilling in this mud"


def test_the_heaviest_mud_is_where_the_gap_closes():
    gap = xr.Dataset(
        {"setting_gap": ("mud_weight", [1e6, 0.5e6, -0.5e6])}, {"mud_weight": [1000.0, 1400.0, 1800.0]}
    )
    assert heaviest(gap) == pytest.approx(1600.0)
    assert heaviest(gap.isel(mud_weight=[0, 1])) is None


def test_an_allowance_is_what_the_sea_adds_to_the_state_at_rest():
    """Five seeds that add alike: nine seas in ten exceed it by nothing."""
    time, seeds, nodes = np.arange(4.0), 5, 3
    swing = 1.0 + np.array([-0.9, 1.0, -1.0, 0.5])  # about 1, at rest; the first output is not at rest
    over = ("significant_height", "seed", "time")
    shaped = np.tile(swing, (1, seeds, 1))
    noise = 1e-6 * np.arange(seeds)[None, :, None]  # a distribution of no width has no fit
    along = np.ones((1, seeds, nodes))
    runs = xr.Dataset(
        {
            "lfj_angle": (over, 0.01 * (shaped + noise)),
            "lfj_angle_static": (over[:2], np.full((1, seeds), 0.01)),
            "ufj_angle": (over, -0.02 * (shaped + noise)),
            "ufj_angle_static": (over[:2], np.full((1, seeds), -0.02)),
            "joint_stroke": (over, shaped + noise),
            "joint_stroke_static": (over[:2], np.ones((1, seeds))),
            "von_mises_stress_max": ((*over[:2], "s_node"), 3e8 * along + 1e2 * noise),
            "von_mises_stress_static": ((*over[:2], "s_node"), 2e8 * along),
            "effective_tension_min": ((*over[:2], "s_node"), 1e6 * along - 1e2 * noise),
            "effective_tension_static": ((*over[:2], "s_node"), 1.5e6 * along),
        },
        {"significant_height": [3.0], "time": time},
    )
    found = allowances(runs).isel(significant_height=0)
    expected = {
        "lfj_angle": 0.01,
        "mean_lfj_angle": 0.002 / 3.0,  # of -0.9, 1, -1 and 0.5, by the trapezoidal rule
        "ufj_angle": 0.02,
        "mean_ufj_angle": 0.004 / 3.0,
        "joint_stroke": 1.0,
        "von_mises_stress": 1e8,
        "effective_tension": 5e5,
    }
    for name, value in expected.items():
        assert float(found[f"{name}_allowance"]) == pytest.approx(value, rel=1e-4)


@pytest.mark.parametrize("seed", range(6))
def test_what_a_sea_adds_to_the_whole_riser_is_never_more_than_to_one_of_its_sections(seed):
    draw = np.random.default_rng(seed)
    s = np.linspace(0.0, 1000.0, 41)
    still = draw.uniform(50.0, 300.0, 41)
    runs = xr.Dataset(
        {
            **{name: ("time", np.zeros(3)) for name in MOVING},
            **{f"{name}_static": 0.0 for name in MOVING},
            "von_mises_stress_static": ("s_node", still),
            "von_mises_stress_max": ("s_node", still + draw.uniform(0.0, 90.0, 41)),
            "effective_tension_static": ("s_node", still),
            "effective_tension_min": ("s_node", still - draw.uniform(0.0, 90.0, 41)),
        },
        {"s_node": s, "time": np.arange(3.0)},
    )
    cut = float(draw.choice(s[1:-1]))
    whole, parts = _added(runs), _added(runs, {"low": (0.0, cut), "up": (cut, 1000.0)})
    for name in ("von_mises_stress", "effective_tension"):
        assert parts[name].dims == ("place",)
        assert float(parts[name].max()) >= float(whole[name])
    one = _added(runs, {"riser": (0.0, 1000.0)})["von_mises_stress"]
    assert float(one.squeeze()) == float(whole["von_mises_stress"])


def outcomes(verdicts):
    """Disconnects at one pressure, by what the valves leave open and how many units pull."""
    verdict = xr.DataArray(
        np.asarray(verdicts)[None],
        dims=("gas_pressure", "valve_left_open", "units"),
        coords={"gas_pressure": [64.0], "valve_left_open": [0.05, 1.0], "units": [6, 5]},
    )
    lift = xr.ones_like(verdict, float).expand_dims(phase=[0.0])
    return xr.Dataset({"recoil_verdict": verdict, "clearance_min": lift})


def test_a_single_pressure_is_a_row_of_cells_that_are_seen():
    figure = recoil_failures(outcomes([[0, 0], [3, 3]]))
    for ax in figure.axes:
        corners = ax.collections[0].get_coordinates()
        assert np.ptp(corners[..., 1]) == pytest.approx(1.0)
        assert np.ptp(corners[..., 0]) == pytest.approx(2.0)


@pytest.mark.parametrize("seed", range(6))
def test_a_dot_marks_each_disconnect_and_the_largest_lifts_are_written(seed):
    """Lifts are zero up to a disconnect and parabolas after it; one riser may stay on the BOP."""
    draw = np.random.default_rng(seed)
    time = np.linspace(0.0, 60.0, 601)
    starts = draw.uniform(10.0, 30.0, 4)
    highest = draw.uniform(1.0, 9.0, 4) * (np.arange(4) < 4 - seed % 2)
    span = 20.0
    after = np.clip((time - starts[:, None]) / span, 0.0, 1.0)
    lift = highest[:, None] * 4.0 * after * (1.0 - after)
    phases = xr.Dataset(
        {"lift": (("phase", "heave_amplitude", "time"), lift[:, None, :])},
        {"phase": [0.0, 90.0, 180.0, 270.0], "heave_amplitude": [2.0], "time": time},
    )
    tensions = xr.Dataset(
        {"lift": (("top_tension", "time"), 2.0 * lift)},
        {"top_tension": 1e3 * np.arange(6.0, 10.0), "time": time},
    )
    liu, mao = recoil_systems(phases, tensions).axes
    dots = [line for line in liu.lines if line.get_marker() == "o"]
    step = time[1]
    seen = sorted(float(dot.get_xdata()[0]) for dot in dots)
    assert seen == pytest.approx(sorted(starts[highest > 0.0]), abs=1.5 * step)
    assert all(
        seen_at - start > 0.0 for seen_at, start in zip(seen, sorted(starts[highest > 0.0]), strict=True)
    )
    for ax, times in ((liu, 1.0), (mao, 2.0)):
        assert f"{times * highest.max():.0f} m" in {text.get_text() for text in ax.texts}


def test_the_key_of_disconnects_names_the_outcomes_that_occur():
    key = recoil_failures(outcomes([[0, 0], [1, 0]])).legends[0]
    said = [text.get_text() for text in key.get_texts()]
    assert said == ["clear of BOP and end stops", "LMRP re-contacts the BOP"]
