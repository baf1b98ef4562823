"""Figures of limits that no offset reaches, of offsets about zero, and of an LMRP that never lifts off."""

import numpy as np
import pytest
import xarray as xr

from chapters.design.derived import sensitivity
from chapters.design.figures.operability import operability_connected
from chapters.design.figures.recoil import recoil_failures, recoil_window
from chapters.design.figures.tension import tension_window
from riserstudy.dataset.limits import coordinates
from riserstudy.design import operability
from riserstudy.design.envelopes import envelopes
from riserstudy.design.operability import Offsets
from riserstudy.errors import SimulationError
from riserstudy.scene.limits import Limit

LIMITS = [
    Limit(output=output, mode="connected", **{side: value})
    for output, side, value in (
        ("lfj_angle", "largest", "9 deg"),
        ("ufj_angle", "largest", "9 deg"),
        ("von_mises_stress", "largest", "370 MPa"),
    )
]
WORDS = ("largest LFJ angle", "largest UFJ angle", "largest von Mises stress")


def chart(values):
    """Figure of one mud, for offsets (m) over current, limit and side."""
    limits = xr.DataArray(
        np.asarray(values, float)[None],
        dims=("mud_weight", "surface_speed", "limit", "offset_side"),
        coords={
            "mud_weight": [1440.0],
            "surface_speed": np.linspace(0.0, 1.6, len(values)),
            "offset_side": ["low", "high"],
            **coordinates(LIMITS),
        },
    )
    data = xr.Dataset({"offset_of_limit": limits}, attrs={"reach": 240.0})
    return operability_connected(data.merge(envelopes(limits)))


@pytest.mark.parametrize("seed", range(20))
def test_a_line_is_strong_where_it_bounds_the_shaded_area_and_nowhere_else(seed):
    """Some sides have no limit within the search; limits far outside bound nothing."""
    draw = np.random.default_rng(seed)
    ends = np.sort(draw.uniform(20.0, 100.0, (4, 3, 2)), axis=1)
    ends[draw.random((4, 3, 2)) < 0.4] = np.inf
    ends[0, :, draw.integers(2)] = np.inf  # in one current, no limit bounds this side
    values = ends * [-1.0, 1.0]
    nearest = np.abs(values).min(axis=1, keepdims=True)
    bounds = ((np.abs(values) == nearest) & np.isfinite(values)).any(axis=(0, 2))
    (ax, *_) = chart(values).axes
    for k, words in enumerate(WORDS):
        drawn = [line for line in ax.lines if line.get_label() == words]
        assert bool(drawn) == np.isfinite(values[:, k]).any()
        assert all((line.get_linewidth() > 1.0) == bounds[k] for line in drawn)


@pytest.mark.parametrize("seed", range(30))
def test_offsets_of_the_title_are_numbers_without_a_negative_zero(seed):
    draw = np.random.default_rng(seed)
    low, high = -draw.uniform(0.0, 1.5), draw.uniform(0.001, 40.0)
    title = chart([[[low, high], [-90.0, 90.0], [-99.0, 99.0]]]).get_suptitle()
    words = title.split("offsets from ")[1].split(" m allow")[0].split(" to ")
    named = [float(word.replace("−", "-")) for word in words]
    assert low <= named[0] <= named[1] <= high
    assert words[0].strip("0.") != "−"


def outcomes(draw, axes, sizes):
    """Random clearances (m), some of an LMRP that never lifts off, and verdicts that agree with them."""
    clear = draw.uniform(-0.5, 3.0, sizes)
    clear[draw.random(sizes) < 0.15] = np.nan
    down = (~(clear > 1e-6)).any(axis=0).astype(int)
    return xr.Dataset(
        {"clearance_min": (("phase", *axes), clear), "recoil_verdict": (axes, down)},
        {"phase": np.arange(sizes[0]) * 90.0},
    )


@pytest.mark.parametrize("seed", range(8))
def test_a_cell_with_contact_at_any_phase_states_no_clearance(seed):
    draw = np.random.default_rng(seed)
    window = outcomes(draw, ("heave_amplitude", "mud_weight", "gas_pressure"), (4, 3, 2, 5))
    window["setting"] = (("mud_weight", "gas_pressure"), np.tile(np.linspace(3e6, 5e6, 5), (2, 1)))
    window = window.assign_coords(
        heave_amplitude=[0.5, 1.0, 2.0], mud_weight=[1100.0, 1500.0], gas_pressure=np.linspace(50.0, 78.0, 5)
    )
    failures = outcomes(draw, ("units", "valve_left_open", "gas_pressure"), (4, 2, 3, 5)).assign_coords(
        units=[6, 5], valve_left_open=[0.05, 0.3, 1.0], gas_pressure=np.linspace(50.0, 78.0, 5)
    )
    for figure, of, panel, across in (
        (recoil_window(window, 0.95), window, "mud_weight", "heave_amplitude"),
        (recoil_failures(failures), failures, "units", "valve_left_open"),
    ):
        for ax, value in zip(figure.axes, of[panel].values, strict=True):
            verdict = of["recoil_verdict"].sel({panel: value}).transpose("gas_pressure", across).values
            assert len(ax.texts) == verdict.size
            for text in ax.texts:
                column, row = map(int, text.get_position())
                assert (text.get_text() == "0.0") == bool(verdict[row, column])


def test_a_limit_that_is_not_evaluated_is_not_a_window_without_room(monkeypatch):
    monkeypatch.setattr(operability, "AtRest", lambda scene, reach: scene)
    found = [Offsets(np.nan, np.nan, "a static equilibrium"), Offsets(-1.0, 1.0)]
    monkeypatch.setattr(operability, "offsets_at", lambda *_: found)
    scene = type("Scene", (), {"limits": []})()
    with pytest.raises(SimulationError, match="a static equilibrium"):
        sensitivity._room(scene, {"reach": "100 m", "allowances": {}})


@pytest.mark.parametrize("seed", range(12))
def test_open_diamonds_are_settings_below_a_known_floor(seed):
    """Disconnects of muds outside of the window's have no floor to be below."""
    draw = np.random.default_rng(seed)
    muds, tested = np.array([1200.0, 1400.0, 1600.0]), np.array([1100.0, 1300.0, 1500.0, 1700.0])
    over, floors = ("mud_weight", "failed_units"), draw.uniform(2e6, 5e6, (3, 1, 2))
    window = xr.Dataset(
        {
            "setting_floor": ((*over, "floor"), floors),
            "setting_floor_engine": ((*over, "floor"), floors),
            "setting_ceiling": (over, np.full((3, 1), 6e6)),
            "setting_gap": (over, 6e6 - floors.max(axis=2)),
        },
        {"mud_weight": muds, "failed_units": [0], "floor": ["minimum tension", "LMRP lift-off"]},
    )
    settings, safe = draw.uniform(1e6, 6e6, (4, 3)), draw.random((4, 3)) < 0.7
    ends = (("heave_amplitude", "mud_weight"), np.full((1, 4), 3e6))
    outcome = xr.Dataset(
        {
            "recoil_minimum": ends,
            "recoil_maximum": ends,
            "setting": (("mud_weight", "gas_pressure"), settings),
            "recoil_verdict": (("heave_amplitude", "mud_weight", "gas_pressure"), (~safe).astype(int)[None]),
        },
        {"heave_amplitude": [0.5], "mud_weight": tested, "gas_pressure": [50.0, 60.0, 70.0]},
    )
    (ax,) = tension_window(window, outcome, 1.0).axes
    governs = floors[:, 0].max(axis=1)
    middle = {1300.0: 0.5 * (governs[0] + governs[1]), 1500.0: 0.5 * (governs[1] + governs[2])}
    for filled in (True, False):
        wanted = {
            (mud, round(one / 1e6, 9))
            for mud, row, good in zip(tested, settings, safe, strict=True)
            for one, fine in zip(row, good, strict=True)
            if fine and (one >= middle.get(mud, 0.0)) == filled
        }
        lines = [line for line in ax.lines if line.get_marker() == "D"]
        lines = [line for line in lines if (line.get_markerfacecolor() != "white") == filled]
        points = [point for line in lines for point in line.get_xydata().tolist()]
        assert {(mud, round(one, 9)) for mud, one in points if np.isfinite(one)} == wanted
