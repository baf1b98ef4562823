"""A platform's response as a scene says it: by a table, in its own waves or those of the scene."""

from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene, simulate
from riserstudy.errors import InputError

ROOT = Path(__file__).parents[2]
SCENE = ROOT / "config/scenes/liu2020/heave.yaml"
TABLE = {"file": "../../platforms/medium.csv"}
WAVE = {"height": "3 m", "period": "12 s"}
RESPONSE = {
    "operators": TABLE,
    "phases": "lead",
    "motions": ["heave"],
    "wave": WAVE,
    "ramp": "36 s",
}


def loaded(**changes):
    response = {k: v for k, v in (RESPONSE | changes).items() if v is not None}
    short = {"duration": "120 s", "output": {"start": "96 s", "interval": "0.25 s"}}
    return load_scene(
        SCENE,
        **{"platform": {"response": response}, "analysis": short},
    )


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


@pytest.mark.parametrize(
    "lines, field, reason",
    [
        ([HEADING.replace("heave", "lift"), "5,1,0", "9,1,0"], "line 1", "heave, heave_phase"),
        ([HEADING.replace("period", "wave"), "5,1,0", "9,1,0"], "line 1", "period"),
        ([HEADING + ",heave (m/m)", "5,1,0,1", "9,1,0,1"], "line 1", "period"),
        ([HEADING, "5,1", "9,1,0"], "line 2", "allowed are 3"),
        ([HEADING, "5,much,0", "9,1,0"], "line 2", "numbers"),
        (["period (s),heave (m/m)", "5,1", "9,1"], "platform.response.operators[0]", "go together"),
        ([HEADING, "9,1,0", "5,1,0"], "platform.response", "rise"),
        ([HEADING, "5,-1,0", "9,1,0"], "platform.response.operators[0].heave", "greater"),
        ([HEADING.replace("(s)", "(m)"), "5,1,0", "9,1,0"], "platform.response", "dimension"),
    ],
)
def test_tables_that_cannot_be_meant_are_refused(tmp_path, lines, field, reason):
    with pytest.raises(InputError) as refusal:
        loaded(operators=write(tmp_path / "table.csv", lines))
    assert field in str(refusal.value)
    assert reason in str(refusal.value)


def test_a_response_without_wave_is_refused():
    with pytest.raises(InputError, match="needs a wave"):
        loaded(wave=None)


def test_a_wave_beyond_the_table_is_refused():
    with pytest.raises(InputError, match="outside the operators"):
        simulate(loaded(wave={"height": "1 m", "period": "80 s"}))
