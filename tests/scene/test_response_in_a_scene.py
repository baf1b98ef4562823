"""A platform's response as a scene says it: by a table, in its own waves or those of the scene."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene, simulate
from riserstudy.errors import InputError
from riserstudy.model.rao import operator

ROOT = Path(__file__).parents[2]
SCENE = ROOT / "config/scenes/liu2020/heave.yaml"
SYSTEM = ROOT / "config/scenes/liu2020/system.yaml"
TABLE = {"file": "../../platforms/medium.csv"}
WAVE = {"height": "3 m", "period": "12 s"}
RESPONSE = {"operators": TABLE, "phases": "lead", "motions": ["heave"], "wave": WAVE, "ramp": "36 s"}


def loaded(**changes):
    response = {k: v for k, v in (RESPONSE | changes).items() if v is not None}
    short = {"duration": "120 s", "output": {"start": "96 s", "interval": "0.25 s"}}
    return load_scene(SCENE, **{"platform": {"response": response}, "analysis": short})


def test_a_table_gives_the_motion_that_the_same_harmonic_gives():
    rows = (ROOT / "config/platforms/medium.csv").read_text().splitlines()
    twelve = next(row for row in rows if row.startswith("12,")).split(",")
    size, phase = float(twelve[3]), float(twelve[4])
    harmonic = {
        "amplitude": f"{1.5 * size} m",
        "period": "12 s",
        "phase": f"{phase + 90.0} deg",
        "ramp": "36 s",
    }
    one = simulate(loaded())
    other = simulate(loaded().with_values({"platform": {"heave": harmonic}}, "test"))
    np.testing.assert_allclose(one["stroke"], other["stroke"], atol=1e-9)
    assert float(one["stroke"].max()) == pytest.approx(1.5 * size, rel=0.02)


def test_a_table_in_lag_mirrors_the_phases():
    one, other = simulate(loaded()), simulate(loaded(phases="lag"))
    assert float(abs(one["stroke"] - other["stroke"]).max()) > 0.01


def write(path, lines):
    path.write_text("\n".join(lines) + "\n")
    return {"file": str(path)}


HEADING = "period (s),heave (m/m),heave_phase (deg)"
FREQUENCY = HEADING.replace("period (s)", "frequency (Hz)")


@pytest.mark.parametrize(
    "lines, field, reason",
    [
        ([HEADING.replace("heave", "lift"), "5,1,0", "9,1,0"], "line 1", "heave, heave_phase"),
        ([HEADING.replace("period", "wave"), "5,1,0", "9,1,0"], "line 1", "period"),
        ([HEADING + ",heave (m/m)", "5,1,0,1", "9,1,0,1"], "line 1", "period"),
        ([HEADING, "5,1", "9,1,0"], "line 2", "differs from the number of columns, 3"),
        ([HEADING, "5,much,0", "9,1,0"], "line 2", "numbers"),
        (["period (s),heave (m/m)", "5,1", "9,1"], "table.csv: line 2", "only one of heave and heave_phase"),
        ([HEADING, "9,1,0", "5,1,0", "9,1,0"], "platform.response", "a period occurs twice"),
        ([HEADING, "5,-1,0", "9,1,0"], "table.csv: line 2: heave", "greater"),
        ([HEADING, "5,1,0", "0,1,0"], "table.csv: line 3: period", "greater"),
        ([HEADING.replace("(s)", "(m)"), "5,1,0", "9,1,0"], "table.csv: line 2: period", "dimension"),
        ([HEADING.replace("(s)", "(Hz)"), "5,1,0", "9,1,0"], "table.csv: line 2: period", "dimension"),
        ([FREQUENCY.replace("Hz", "s"), "5,1,0", "9,1,0"], "table.csv: line 2: frequency", "dimension"),
        ([FREQUENCY.replace("Hz", "1/s"), "5,1,0", "9,1,0"], "table.csv: line 2: frequency", "rad"),
        ([FREQUENCY, "0.2,1,0", "0.2,1,0"], "platform.response", "a frequency occurs twice"),
        (
            [FREQUENCY + ",period (s)", "0.1,1,0,10", "0.2,1,0,5"],
            "line 1",
            "'period' and 'frequency' exclude each other",
        ),
        ([HEADING + ",heading (m)", "5,1,0,0", "9,1,0,0"], "table.csv: line 2: heading", "dimension"),
        ([HEADING + ",heading (deg)", "5,1,0,0", "9,1,0,0"], "platform.response", "'towards' or 'from'"),
    ],
)
def test_tables_that_cannot_be_meant_are_refused(tmp_path, lines, field, reason):
    with pytest.raises(InputError) as refusal:
        loaded(operators=write(tmp_path / "table.csv", lines))
    assert field in str(refusal.value)
    assert reason in str(refusal.value)


def test_headings_without_a_heading_are_refused(tmp_path):
    table = write(tmp_path / "table.csv", [HEADING, "5,1,0", "9,1,0"])
    with pytest.raises(InputError, match="the operators have no headings"):
        loaded(operators=table, headings="from")


@pytest.mark.parametrize("unit, factor", [("Hz", 1.0), ("rad/s", 2.0 * math.pi)])
@pytest.mark.parametrize("headings, turn", [("towards", 0.0), ("from", 180.0)])
@pytest.mark.parametrize("phases, sign", [("lead", 1.0), ("lag", -1.0)])
def test_a_table_says_the_same_in_every_convention(tmp_path, unit, factor, headings, turn, phases, sign):
    """Written in one convention, read, and asked at its own lines: what it was written from."""
    random = np.random.default_rng(7)
    periods, towards = np.array([20.0, 12.0, 5.0]), np.array([0.0, 90.0, 180.0, 270.0])
    r = random.normal(size=(4, 3)) + 1j * random.normal(size=(4, 3))
    lines = [f"frequency ({unit}),heading (deg),pitch (deg/m),pitch_phase (deg)"]
    for h, row in zip(towards, r, strict=True):
        for period, value in zip(periods, row, strict=True):
            size, phase = math.degrees(abs(value)), sign * math.degrees(np.angle(value))
            lines.append(f"{factor / period},{h + turn},{size},{phase}")
    platform = {
        "response": {
            "operators": write(tmp_path / "table.csv", lines),
            "phases": phases,
            "headings": headings,
            "wave": WAVE,
        },
        "centre_of_rotation": {"elevation": "540 m"},
    }
    response = load_scene(SYSTEM, platform=platform).resolved().platform.response
    for h, row in zip(towards, r, strict=True):
        found = operator(response, "pitch", 2.0 * math.pi / periods, math.radians(h))
        np.testing.assert_allclose(found, row, rtol=1e-9)


def test_a_response_without_wave_is_refused():
    with pytest.raises(InputError, match="requires a wave"):
        loaded(wave=None)


def test_a_wave_beyond_the_table_is_refused():
    with pytest.raises(InputError, match="outside the periods of the operators"):
        simulate(loaded(wave={"height": "1 m", "period": "80 s"}))


def test_a_sea_beyond_the_table_is_told_once():
    storm = {
        "significant_height": "1 m", "peak_period": "6 s", "peak_enhancement": 1.0,
        "components": 40, "seed": 1,
    }  # fmt: skip
    found = simulate(loaded(wave=storm, beyond="zero"))
    told = [line for line in json.loads(found.attrs["warnings"]) if "operators" in line]
    assert len(told) == 1
    assert "of 40 wave components" in told[0]
    assert "cause no motion" in told[0]
