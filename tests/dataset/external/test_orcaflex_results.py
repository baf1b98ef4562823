"""Time histories and range graphs in OrcaFlex's words, of runs that are known in closed form."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.comparison import compared, difference
from riserstudy.errors import InputError

LENGTH = 300.0
TIME, S = np.arange(0.0, 60.0, 0.5), np.linspace(0.0, LENGTH, 13)


def tension(time, s):
    """In kN."""
    return 1e3 + s + 50.0 * np.sin(0.6 * time)


def moment(time, s):
    """In kN m, of either sign."""
    return 80.0 * np.sin(0.6 * time) * np.cos(s / 40.0)


def run():
    grid = (TIME[:, None], S[None, :])
    te, m = tension(*grid), moment(*grid)
    ranges = {
        f"{name}_{side}": ("s_node", 1e3 * getattr(values, side)(axis=0), {"units": unit})
        for name, values, unit in (("effective_tension", te, "N"), ("bending_moment", m, "N m"))
        for side in ("min", "max")
    }
    data = {
        "effective_tension": (("time", "s"), 1e3 * te, {"units": "N"}),
        "bending_moment": (("time", "s"), 1e3 * m, {"units": "N m"}),
        "z": (("time", "s"), -LENGTH + S + 0.0 * TIME[:, None], {"units": "m"}),
    }
    return xr.Dataset(data | ranges, {"time": TIME, "s": S, "s_node": S})


def write(path, headings, *columns, above=(), mark="\t"):
    rows = [[f"{v:.9g}" for v in row] for row in zip(*columns, strict=True)]
    lines = [*above, mark.join(headings), *(mark.join(row) for row in rows)]
    path.write_text("\r\n".join(lines), newline="")
    return path


@pytest.mark.parametrize("mark", ["\t", ","])
@pytest.mark.parametrize("end", ["top", "bottom", "250 m down"])
def test_a_range_graph_is_over_arc_length_from_end_a(tmp_path, mark, end):
    arc = np.linspace(0.0, 200.0, 9)
    s = {"top": LENGTH - arc, "bottom": arc, "250 m down": 250.0 - arc}[end]
    extremes = [getattr(tension(TIME[:, None], s), side)(axis=0) for side in ("min", "max")]
    headings = ["Arc Length (m)", "Effective Tension (kN) Minimum", "Effective Tension (kN) Maximum"]
    found = compared(run(), write(tmp_path / "r.txt", headings, arc, *extremes, mark=mark), end_a=end)
    assert [pair.name for pair in found.pairs] == ["effective_tension_min", "effective_tension_max"]
    for pair in found.pairs:
        # digits that are written
        assert difference(pair).rms < 1e-2
        assert np.all(np.diff(pair.along) > 0.0)


def test_the_variable_of_a_range_graph_may_stand_above_it(tmp_path):
    above = ["Range Graph", "Bend Moment (kN.m)"]
    sizes = np.abs(moment(TIME[:, None], S))
    path = write(tmp_path / "r.txt", ["Arc length (m)", "Minimum", "Maximum"], S,
                 0.0 * S, sizes.max(axis=0), above=above)  # fmt: skip
    found = compared(run(), path, end_a="bottom")
    assert all(difference(pair).rms < 1e-2 for pair in found.pairs)
    assert all("the file has magnitudes" in pair.notes[0] for pair in found.pairs)


@pytest.mark.parametrize(
    "place, end, s",
    [
        ("", None, None),
        (" at End A", "top", LENGTH),
        (" at End B", "top", 0.0),
        (", arc length 40 m", "top", 260.0),
        (" at arc length 40", "bottom", 40.0),
    ],
)
def test_a_time_history_is_where_its_heading_says(tmp_path, place, end, s):
    heading = f"Riser Effective tension (kN){place}"
    values = tension(TIME, 100.0 if s is None else s)
    path = write(tmp_path / "t.txt", ["Time (s)", heading], TIME, values)
    if s is None:
        with pytest.raises(InputError, match="give the place"):
            compared(run(), path)
        found = compared(run(), path, called={heading: "effective_tension at 100 m (kN)"})
    else:
        found = compared(run(), path, end_a=end)
    assert difference(found.pairs[0]).rms < 10.0


def test_a_bend_moment_has_no_sign(tmp_path):
    values = np.abs(moment(TIME, 0.0))
    path = write(tmp_path / "t.txt", ["Time (s)", "Bend moment (kN.m) at End B"], TIME, values)
    (pair,) = compared(run(), path, end_a="top").pairs
    assert difference(pair).rms < 1e-2
    assert np.ptp(pair.theirs) > 7e4


@pytest.mark.parametrize(
    "headings, end, said",
    [
        (["Arc length (m)", "Effective tension (kN) Max"], None, "which end is end A"),
        (["Arc length (m)", "Effective tension (kN) Max"], "middle", "not a place on the riser"),
        (["Arc length (m)", "Effective tension (kN) Max"], "400 m down", "not a place on the riser"),
        (["Arc length (m)", "Effective tension (kN) Mean"], "top", "no means or standard deviations along"),
        (["Arc length (m)", "x bend moment (kN.m) Max"], "top", "instead of one component"),
        (["Arc length (m)", "Maximum"], "top", "is not a heading with a unit"),
        (["Time (s)", "Effective tension (kN) at End A"], None, "which end is end A"),
        (["Time (s)", "Effective tension (kN) at Touchdown"], "top", "is not a place on a line"),
        (["Time (s)", "End force (kN) at End A"], "top", "defines this quantity differently"),
        (["Time (s)", "Effective tension (kN) at End B"], "250 m down", "a part of the riser"),
        (
            ["Time (s)", "Wall tension (kN) at End A"],
            "top",
            "no scene from which effective tension is computed",
        ),
    ],
)
def test_what_is_not_said_is_not_guessed(tmp_path, headings, end, said):
    path = write(tmp_path / "r.txt", headings, S, S)
    with pytest.raises(InputError) as refused:
        compared(run(), path, end_a=end)
    assert said in str(refused.value)


@pytest.mark.parametrize("axis, heading", [(TIME, "time (s)"), (S, "s (m)")])
def test_a_place_of_end_a_that_no_heading_needs_is_refused(tmp_path, axis, heading):
    name = "effective_tension at 100 m (kN)" if heading == "time (s)" else "effective_tension (kN)"
    path = write(tmp_path / "own.csv", [heading, name], axis, axis, mark=",")
    with pytest.raises(InputError, match="--end-a"):
        compared(run(), path, end_a="top")


def test_columns_named_by_the_user_have_no_end_a(tmp_path):
    path = write(tmp_path / "r.txt", ["Arc length (m)", "Te (kN)"], S, S)
    called = {"Arc length (m)": "s (m)", "Te (kN)": "effective_tension_max (kN)"}
    with pytest.raises(InputError, match="--end-a"):
        compared(run(), path, called=called, end_a="top")
