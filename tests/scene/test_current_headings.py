"""Where a current flows to, by a heading in either convention."""

import math
from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene
from riserstudy.errors import InputError
from riserstudy.model.mesh import even
from riserstudy.simulation.run import single

SYSTEM = Path(__file__).parents[2] / "config/scenes/liu2020/system.yaml"
TABLE = "depth (m),speed (m/s)\n0,1\n533,0.1\n"


def loaded(folder, table=TABLE, **current):
    (folder / "current.csv").write_text(table)
    profile = {"file": str(folder / "current.csv")}
    return load_scene(SYSTEM, current={"profile": profile} | current, analysis={"mesh": {"elements": 40}})


def shape(file):
    found = single(file.resolved(), even(file.resolved(), 40), None).arrays
    return np.stack([found["x_static"], found["y_static"]])


@pytest.mark.parametrize(
    "heading, headings, towards",
    [(30, None, 30.0), (30, "towards", 30.0), (30, "from", 210.0), (-90, "from", 90.0)],
)
def test_a_current_flows_where_its_convention_says(tmp_path, heading, headings, towards):
    given = {"heading": f"{heading} deg"} | ({"headings": headings} if headings else {})
    current = loaded(tmp_path, **given).resolved().current
    assert current.towards == pytest.approx(math.radians(towards))


def test_from_one_side_is_towards_the_other(tmp_path):
    came = shape(loaded(tmp_path, heading="210 deg", headings="from"))
    went = shape(loaded(tmp_path, heading="30 deg", headings="towards"))
    assert went.max() > 0.1
    assert np.abs(came - went).max() < 1e-9 * went.max()
    other = shape(loaded(tmp_path, heading="210 deg"))
    assert np.abs(came + other).max() < 0.1 * went.max()


def test_columns_stand_in_any_order(tmp_path):
    told = "depth (m),speed (m/s),direction (deg)\n0,1,20\n9,0.5,40\n"
    turned = "direction (deg),speed (m/s),depth (m)\n20,1,0\n40,0.5,9\n"
    currents = [loaded(tmp_path, table, beyond="hold").resolved().current for table in (told, turned)]
    assert currents[0] == currents[1]


@pytest.mark.parametrize(
    "table, current, reason",
    [
        (TABLE, {"headings": "from"}, "no effect on a current without heading"),
        (TABLE, {"headings": "towards"}, "no effect on a current without heading"),
        (TABLE, {"heading": "30 deg", "headings": "to"}, "towards"),
        (TABLE, {"heading": "30 m", "headings": "from"}, "dimension"),
        ("depth (m),speed (m/s),heading (deg)\n0,1,0\n9,0,0\n", {}, "unknown column 'heading'"),
        ("depth (m),depth (ft),speed (m/s)\n0,0,1\n9,30,0\n", {}, "column 'depth' occurs twice"),
        (
            "depth (m),elevation (m),speed (m/s)\n0,0,1\n9,-9,0\n",
            {},
            "'elevation' and 'depth' exclude each other",
        ),
        ("depth (m),direction (deg)\n0,0\n9,30\n", {}, "column 'speed' is missing"),
        ("depth (m),speed (m/s),direction (rad)\n0,1,20\n9,0,0\n", {}, "1146 deg is more than a full turn"),
        (TABLE, {"heading": "40 rad"}, "heading 2292 deg is more than a full turn"),
        ("elevation (m),speed (m/s)\n540,1\n600,0\n", {"beyond": "hold"}, "no point is in the water"),
        ("depth (m),speed\n0,1\n9,0\n", {}, "'speed' is not of the form 'name \\(unit\\)'"),
    ],
)
def test_headings_that_cannot_be_meant_are_refused(tmp_path, table, current, reason):
    with pytest.raises(InputError, match=reason):
        loaded(tmp_path, table, **current)
