"""Titles, labels and colours of the design figures, of datasets whose answer is known."""

import numpy as np
import pytest
import xarray as xr
from drawn_whole import assert_whole
from matplotlib.backends.backend_agg import FigureCanvasAgg

from chapters.design.figures import operability
from chapters.design.figures.recoil import _answer, _metres, recoil_failures
from chapters.design.figures.seas import operability_in_seas
from chapters.design.figures.sensitivity import sensitivity
from chapters.design.figures.tension import minimum_tension, tension_window
from chapters.design.figures.watch_circles import watch_circles
from chapters.design.figures.wellhead import wellhead_fatigue
from riserstudy.dataset.limits import coordinates
from riserstudy.design.watch_circles import TOO_LATE
from riserstudy.figures.figure_text import headline
from riserstudy.scene.limits import Limit


def extents(figure, texts):
    """Where texts are in a figure (pixels)."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return [text.get_window_extent(canvas.get_renderer()) for text in texts]


def test_titles_of_three_panels_are_beside_each_other_and_whole():
    shape = (5, 3, 3)
    verdict = xr.DataArray(
        np.zeros(shape, int),
        dims=("gas_pressure", "valve_left_open", "units"),
        coords={
            "gas_pressure": [50.0, 57.0, 64.0, 71.0, 78.0],
            "valve_left_open": [0.05, 0.3, 1.0],
            "units": [6, 5, 4],
        },
    )
    lift = xr.ones_like(verdict, float).expand_dims(phase=[0.0])
    figure = recoil_failures(xr.Dataset({"recoil_verdict": verdict, "clearance_min": lift}))
    assert_whole(figure)
    titles = [getattr(ax, "_left_title") for ax in figure.axes]  # noqa: B009
    first, second, third = extents(figure, titles)
    assert first.x1 < second.x0
    assert second.x1 < third.x0


@pytest.mark.parametrize(
    "clearance, text", [(-0.1, "0.0"), (0.0, "0.0"), (0.045, "0.04"), (0.06, "0.1"), (2.34, "2.3")]
)
def test_a_small_clearance_is_no_contact(clearance, text):
    assert _metres(clearance) == text


def test_a_heave_beyond_one_that_no_setting_survives_does_not_count():
    of = xr.Dataset(
        {"recoil_verdict": (("heave_amplitude", "mud_weight", "gas_pressure"), [[[0]], [[1]], [[0]]])},
        {"heave_amplitude": [0.5, 1.0, 2.0]},
    )
    assert _answer(of) == "Up to 0.5 m heave amplitude, a tested tension setting allows a safe disconnect"


def windows(failed):
    """Windows of the setting and disconnects, at one pressure in calm water."""
    over = ("mud_weight", "failed_units")
    one = np.ones((2, len(failed)))
    window = xr.Dataset(
        {
            "setting_floor": ((*over, "floor"), 2e6 * one[..., None]),
            "setting_floor_engine": ((*over, "floor"), 2e6 * one[..., None]),
            "setting_ceiling": (over, 6e6 * one),
            "setting_gap": (over, 4e6 * one),
        },
        {"mud_weight": [1000.0, 2000.0], "failed_units": failed, "floor": ["minimum tension"]},
    )
    at = (("heave_amplitude", "mud_weight"), [[3e6, 3e6]])
    outcome = xr.Dataset(
        {
            "recoil_minimum": at,
            "recoil_maximum": at,
            "setting": (("mud_weight", "gas_pressure"), [[3e6, 4e6], [3e6, 5e6]]),
            "recoil_verdict": (("heave_amplitude", "mud_weight", "gas_pressure"), [[[0, 2], [0, 1]]]),
        },
        {"heave_amplitude": [0.5], "mud_weight": [1000.0, 2000.0], "gas_pressure": [50.0, 60.0]},
    )
    return window, outcome


def test_one_failed_unit_is_one_unit():
    figure = tension_window(*windows([0, 1, 2]), tension_ratio=1.0)
    titles = [ax.get_title(loc="left").partition(";")[0] for ax in figure.axes]
    assert titles == ["(a) no units failed", "(b) 1 unit failed", "(c) 2 units failed"]


def test_settings_that_failed_the_disconnect_are_crosses():
    """Of four tested settings, one of each mud comes down or strokes out."""
    figure = tension_window(*windows([0, 1]), tension_ratio=0.5)
    first, second = ([line for line in ax.lines if line.get_marker() == "x"] for ax in figure.axes)
    (crosses,) = first
    shown = {(x, y) for x, y in crosses.get_xydata().tolist() if np.isfinite(y)}
    assert shown == {(1000.0, 8.0), (2000.0, 10.0)}
    assert not second
    (key,) = figure.legends
    assert crosses.get_label() in [text.get_text() for text in key.get_texts()]


@pytest.mark.parametrize(
    "apart, words",
    [(0.0, "less than 0.00001 %"), (2.3e-5, "less than 0.01 %"), (0.004, "less than 1 %"), (0.02, "2 %")],
)
def test_a_small_difference_of_formula_and_simulation_is_told_by_its_order(apart, words):
    over, needed = "mud_weight", np.array([1e6, 2e6])
    of = xr.Dataset(
        {
            "carrying_tension_along": ((over, "point"), np.stack([0.5 * needed, needed], axis=-1)),
            "carrying_tension": (over, needed),
            "carrying_tension_engine": (over, needed * (1.0 + apart)),
            "governing_elevation": (over, [10.0, 10.0]),
        },
        {over: [1000.0, 2000.0], "elevation": ("point", [100.0, 10.0])},
    )
    figure = minimum_tension(of)
    assert figure.axes[1].get_title(loc="left").endswith(f"differ by {words}")
    assert headline(figure) == "The lower end of the riser governs the minimum top tension"


@pytest.mark.parametrize(
    "low, high, title",
    [
        ([3.0, 3.5], [3.0, 4.0], "The tension setting for a safe disconnect increases with mud density"),
        ([3.0, 2.5], [3.0, 4.0], "Tension settings from 2.5 to 4.0 MN allow a safe disconnect"),
        ([np.nan, 2.5], [np.nan, 4.0], "Tension settings from 2.5 to 4.0 MN allow a safe disconnect"),
        (
            [np.nan, 4.0],
            [np.nan, 4.0],
            "Of the tested tension settings, only 4.0 MN allows a safe disconnect",
        ),
        ([np.nan, np.nan], [np.nan, np.nan], "No tested tension setting allows a safe disconnect"),
    ],
)
def test_safe_settings_are_told_to_increase_only_if_both_ends_do(low, high, title):
    window, outcome = windows([0])
    outcome["recoil_minimum"][:], outcome["recoil_maximum"][:] = 1e6 * np.array(low), 1e6 * np.array(high)
    assert headline(tension_window(window, outcome, tension_ratio=1.0)) == title


def test_a_safe_setting_below_a_floor_is_an_open_diamond():
    """The floor is 2 MN at both densities; settings are 3 MN, or 1 MN at the second."""
    window, outcome = windows([0])
    outcome["setting"][1, 0] = 1e6
    (ax,) = tension_window(window, outcome, tension_ratio=1.0).axes
    shown = {}
    for line in ax.lines:
        if line.get_marker() == "D":
            places = [(x, y) for x, y in line.get_xydata().tolist() if np.isfinite(y)]
            shown[str(line.get_markerfacecolor())] = places
    assert shown.pop("white") == [(2000.0, 1.0)]
    assert list(shown.values()) == [[(1000.0, 3.0)]]


def seas_of(half):
    """Offsets that allow drilling and allowances of two seas, for half widths over (current, mud, sea)."""
    half = np.array(half)
    ends = np.stack([-half, half], axis=-1)
    of = xr.Dataset(
        {
            "envelope_offset": (
                ("operation", "surface_speed", "mud_weight", "significant_height", "offset_side"),
                ends[None],
            )
        },
        {
            "operation": ["drilling"],
            "surface_speed": [0.0, 1.0, 1.6][: len(half)],
            "mud_weight": [1100.0, 1800.0],
            "significant_height": [2.0, 6.0],
            "offset_side": ["low", "high"],
        },
    )
    added = xr.Dataset(
        {"ufj_angle_allowance": ("significant_height", [0.01, 0.02])}, {"significant_height": [2.0, 6.0]}
    )
    return of, added


GONE = np.nan


@pytest.mark.parametrize(
    "half, title",
    [
        (
            [[[50.0, 25.0], [50.0, 45.0]]],
            "Raising H_s from 2 to 6 m reduces the drilling window by 10 to 50 %",
        ),
        (
            [[[50.0, 25.0], [50.0, 45.0]], [[50.0, 10.0], [50.0, 45.0]]],
            "Raising H_s from 2 to 6 m reduces the drilling window by 10 to 80 %",
        ),
        (
            [[[50.0, 25.0], [50.0, 45.0]], [[50.0, 1.0], [50.0, 1.0]], [[50.0, GONE], [50.0, 1.0]]],
            "At H_s = 6 m every mud allows drilling up to 1 m/s of current",
        ),
        ([[[50.0, GONE], [50.0, 45.0]]], "At H_s = 6 m some muds do not allow drilling"),
        ([[[50.0, GONE], [50.0, GONE]]], "At H_s = 6 m no offset allows drilling"),
    ],
)
def test_the_narrowing_by_seas_is_told_for_all_muds_and_currents(half, title):
    """By half at one mud density, by a tenth at the other; to nothing in fast currents."""
    figure = operability_in_seas(*seas_of(half))
    assert headline(figure) == title
    widths = [line.get_linewidth() for line in figure.axes[0].lines[::2][:2]]
    assert widths[0] > widths[1]  # the one below is seen beside the one above


def test_a_limit_has_one_colour_in_all_modes():
    limits = [
        Limit(output=output, mode=mode, **{side: "3 m" if output == "joint_stroke" else "2 deg"})
        for mode, of in (
            ("drilling", ("mean lfj_angle", "largest lfj_angle", "largest joint_stroke")),
            ("connected", ("largest lfj_angle", "largest joint_stroke")),
            ("disconnect", ("largest joint_stroke", "largest lfj_angle")),
        )
        for side, output in map(str.split, of)
    ]
    modes = ["drilling", "connected", "disconnect"]
    ends = np.array([-50.0, 50.0])
    over = ("surface_speed", "mud_weight")
    of = xr.Dataset(
        {
            "offset_of_limit": (
                (*over, "limit", "offset_side"),
                np.broadcast_to(ends, (2, 1, len(limits), 2)),
            ),
            "envelope_offset": ((*over, "operation", "offset_side"), np.broadcast_to(ends, (2, 1, 3, 2))),
        },
        {
            "surface_speed": [0.0, 1.0],
            "mud_weight": [1440.0],
            "operation": modes,
            "offset_side": ["low", "high"],
            **coordinates(limits),
        },
        {"reach": 240.0},
    )
    colours: dict[str, set[str]] = {}
    for mode in modes:
        (ax,) = getattr(operability, f"operability_{mode}")(of).axes
        for line in ax.lines:
            if not str(line.get_label()).startswith("_"):
                colours.setdefault(str(line.get_label()), set()).add(str(line.get_color()))
    assert set(map(len, colours.values())) == {1}
    assert len({min(one) for one in colours.values()}) == len(colours)


def test_ends_of_ranges_are_written_within_their_panel():
    labels = [
        "base",
        "lower joint, 30 kN m/deg",
        "lower joint, 150 kN m/deg",
        "mud, 1200 kg/m³",
        "mud, 1700 kg/m³",
    ]
    values = np.array([80.0, 30.0, 90.0, 84.0, 76.0])
    figure = sensitivity(
        xr.Dataset(
            {"setting_gap": ("varied_input", 1e4 * values), "drilling_room": ("varied_input", values)},
            {"varied_input": labels},
        )
    )
    for ax in figure.axes:
        assert [text.get_text() for text in ax.texts][-1] == "150 kN m/°"
        for extent in extents(figure, ax.texts):
            assert ax.bbox.x0 < extent.x0
            assert extent.x1 < ax.bbox.x1


@pytest.mark.parametrize("count", [3, 4, 5, 9, 64])
def test_the_title_on_fatigue_has_the_share_of_the_input_that_it_names(count):
    """The largest share is as by chance: the next one is named, if samples outnumber the fitted factors."""
    of = xr.Dataset(
        {
            "damage_largest": ("sample", np.geomspace(0.01, 1.0, count)),
            "damage_error": 0.05,
            "share_explained": ("varied_input", [0.3, 0.2, 0.1]),
            "by_chance": ("varied_input", [0.4, 0.1, 0.05]),
        },
        {"varied_input": ["cement", "damping", "platform"]},
    )
    said = headline(wellhead_fatigue(of))
    assert ("The structural damping explains 20 % of the scatter of damage" in said) == (count > 4)
    assert ("explains" in said) == (count > 4)


def test_the_title_on_alarms_states_its_disconnect_time():
    late = np.zeros((2, 1, 3), int)
    late[1] = TOO_LATE
    over = ("surface_speed", "mud_weight", "eds_time")
    of = xr.Dataset(
        {
            "limit_offset": (over[:2], [[100.0], [90.0]]),
            "red_circle_radius": (over, np.full((2, 1, 3), 50.0)),
            "yellow_circle_radius": (over, np.full((2, 1, 3), 20.0)),
            "red_circle_outcome": (over, np.zeros((2, 1, 3), int)),
            "yellow_circle_outcome": (over, late),
        },
        {"surface_speed": [0.0, 1.6], "mud_weight": [1440.0], "eds_time": [30.0, 60.0, 90.0]},
    )
    figure = watch_circles(of)
    assert headline(figure) == "With 60 s to disconnect, the yellow alarm is too late from 1.6 m/s"
    plan = figure.axes[1]
    assert [text.get_text() for text in plan.texts] == ["yellow: 20 m", "red: 50 m", "first limit: 90 m"]
    for circle, radius in zip(plan.lines, (20.0, 50.0, 90.0), strict=False):
        assert np.hypot(*circle.get_data()) == pytest.approx(radius)
