"""Envelopes of modes in seas and currents, against loops over limits whose offsets are drawn."""

import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from riserstudy import load_scene
from riserstudy.dataset.limits import labels
from riserstudy.design import envelope as module
from riserstudy.design.envelopes import envelopes
from riserstudy.design.operability import Offsets
from riserstudy.design.sea_allowances import Allowance
from riserstudy.study.in_sea import Sea

SCENE = Path(__file__).parents[2] / "config/scenes/design/riser.yaml"
LIMITS = [
    {"output": "ufj_angle", "mode": "drilling", "mean": "2 deg"},
    {"output": "lfj_angle", "mode": "connected", "largest": "4 deg"},
    {"output": "ufj_angle", "mode": "connected", "largest": "5 deg"},
    {"output": "lfj_angle", "mode": "drilling", "mean": "2 deg"},
    {"output": "x", "mode": "drilling", "largest": "2 m"},
]
SEAS = [Sea(2.0, 8.0), Sea(5.0, 11.0)]
CURRENTS = [0.0, 0.5, 1.25]


def drawn(draw):
    """Offsets of a limit: some are not reached on a side, met nowhere, met elsewhere, or not evaluated."""
    kind = draw.random()
    if kind < 0.1:
        return Offsets(math.nan, math.nan, "something")
    if kind < 0.2:
        return Offsets(math.nan, math.nan)
    low, high = draw.uniform(-60.0, 20.0), draw.uniform(0.0, 60.0)
    low, high = min(low, high), max(low, high)
    low, high = (end if draw.random() < 0.8 else side * math.inf for end, side in ((low, -1), (high, 1)))
    return Offsets(low, high, "", draw.uniform(61.0, 99.0) if draw.random() < 0.2 else math.nan)


@pytest.mark.parametrize("seed", range(30))
def test_a_mode_has_the_offsets_that_all_of_its_limits_allow(seed, monkeypatch):
    draw = np.random.default_rng(seed)
    limits = [LIMITS[k] for k in draw.permutation(len(LIMITS))]
    file = load_scene(SCENE).with_values({"limits": limits}, "test")
    offsets = [[[drawn(draw) for _ in limits] for _ in SEAS] for _ in CURRENTS]
    left = iter(offsets)
    monkeypatch.setattr(module, "_each", lambda *_: next(left))
    monkeypatch.setattr(module, "allowances", lambda *_: [Allowance(0.0)] * len(limits))
    found = module.envelope(file, 100.0, CURRENTS, SEAS, 5)
    names = labels(file.resolved().limits)
    rows = iter(found.table.rows)
    for mode in dict.fromkeys(limit["mode"] for limit in limits):
        for n, sea in enumerate(SEAS):
            for c, speed in enumerate(CURRENTS):
                own = [(name.partition(": ")[2], offsets[c][n][k]) for k, name in enumerate(names)
                       if limits[k]["mode"] == mode]  # fmt: skip
                cells = dict(zip(found.table.columns, next(rows), strict=True))
                assert (cells["mode"], cells["current"]) == (mode, speed)
                assert cells["sea"] == f"{sea.height:g} m, {sea.period:g} s"
                _check(cells, own)
    assert not list(rows)
    assert found.missing == {
        name: "something"
        for k, name in enumerate(names)
        if any(of_sea[k].missing for of_speed in offsets for of_sea in of_speed)
    }


def _check(cells, own):
    """The cells of a row are those of limits, (name, offsets) each."""
    known = [(name, one) for name, one in own if not one.missing]
    low = max(((one.low, name) for name, one in known if one.low == one.low), default=(-math.inf, ""))
    high = min(((one.high, name) for name, one in known if one.high == one.high), default=(math.inf, ""))
    met = known and all(one.low == one.low for _, one in known) and low[0] <= high[0]
    for (end, name), offset, limit in ((low, "from", "limit at from"), (high, "to", "limit at to")):
        reached = met and math.isfinite(end)
        assert cells[offset] == (end if reached else None)
        assert cells[limit] == (name if reached else "not reached" if met else "")
    lost = [name for name, one in own if one.missing]
    also = [(name, one.also) for name, one in own if one.also == one.also]
    notes = [f"not evaluated: {', '.join(lost)}"] * bool(lost)
    notes += [f"{name} is met at other offsets, too, such as {also:.4g} m" for name, also in also]
    if known and not met:
        notes.insert(0, "the offsets of the limits do not overlap" if also else "no offset meets all limits")
    assert cells["note"] == "; ".join(notes)


@pytest.mark.parametrize("seed", range(20))
def test_envelopes_of_a_study_are_those_of_each_of_its_points(seed):
    """Modes together, a further dimension, and limits that are met nowhere."""
    draw = np.random.default_rng(seed)
    modes = [str(mode) for mode in draw.choice(["drilling", "connected"], 5)]
    names = [f"{mode}: largest x at {k}: the top" for k, mode in enumerate(modes)]
    of = np.array([[[*drawn(draw)[:2]] for _ in names] for _ in CURRENTS])
    limits = xr.DataArray(
        of,
        dims=("current", "limit", "offset_side"),
        coords={
            "limit": names,
            "mode_of_limit": ("limit", modes),
            "side_of_limit": ("limit", ["largest"] * len(modes)),
            "output_of_limit": ("limit", [f"x at {k}: the top" for k in range(len(modes))]),
            "offset_side": ["low", "high"],
        },
    )
    found = envelopes(limits)
    for mode in dict.fromkeys(modes):
        mine = [k for k, one in enumerate(modes) if one == mode]
        for c in range(len(CURRENTS)):
            ends = [max(of[c, mine, 0]), min(of[c, mine, 1])]
            met = not np.isnan(of[c, mine]).any() and ends[0] <= ends[1]
            here = found.sel(operation=mode).isel(current=c)
            for side, end in zip(("low", "high"), ends, strict=True):
                value = float(here["envelope_offset"].sel(offset_side=side))
                assert value == (end if met else pytest.approx(math.nan, nan_ok=True))
                k = mine[int(np.argmax(of[c, mine, 0]) if side == "low" else np.argmin(of[c, mine, 1]))]
                name = str(here["governing_limit_name"].sel(offset_side=side).item())
                assert name == (f"largest x at {k}: the top" if met and math.isfinite(end) else "none")
