"""Plots of one run: what they show of a run with known numbers, and what they refuse."""

import json

import numpy as np
import pytest
import xarray as xr
from drawn_whole import assert_whole
from matplotlib.backends.backend_agg import FigureCanvasAgg

from riserstudy.errors import InputError, SimulationError
from riserstudy.figures.figure_text import headline
from riserstudy.figures.run import draw

TIME, S = np.linspace(0.0, 10.0, 41), np.linspace(0.0, 100.0, 11)
WAVE = np.sin(0.5 * np.pi * TIME)[:, None] * np.sin(np.pi * S / 100.0)
LIMITS = [
    {"output": "bending_moment", "at": "", "allowable": 6e3},
    {"output": "bending_moment", "at": "pup", "allowable": 1e3},
]


def run(moving=True):
    """A riser whose moment swings about -3 kN m by 2 kN m in its middle, and its x by 2 m."""
    rest = -3e3 * np.sin(np.pi * S / 100.0)
    moment, x = rest + 2e3 * WAVE, 2.0 * WAVE
    data = {
        "bending_moment_static": ("s_node", rest),
        "x_static": ("s_node", 0.0 * S),
        "z_static": ("s_node", S - 50.0),
    }
    if not moving:
        data["bending_moment"] = ("s", rest)
        return xr.Dataset(data, {"s": S, "s_node": S}, {"title": "swing"})
    for name, values in (("bending_moment", moment), ("x", x)):
        data[name] = (("time", "s"), values)
        data[f"{name}_max"] = ("s_node", values.max(axis=0))
        data[f"{name}_min"] = ("s_node", values.min(axis=0))
    data["z"] = (("time", "s"), np.broadcast_to(S - 50.0, x.shape))
    said = {"title": "swing", "limits": json.dumps(LIMITS)}
    return xr.Dataset(data, {"time": TIME, "s": S, "s_node": S}, said)


def lines(ax):
    return {line.get_label(): line for line in ax.lines}


def test_tension_is_that_of_the_riser_without_its_telescopic_joint():
    pulled = run()
    for end in ("static", "max", "min"):
        pulled[f"effective_tension_{end}"] = ("s_node", np.append(np.full(10, 1e6), 0.0))
    (ax,) = draw("range", pulled, ["effective_tension"]).axes
    assert lines(ax)["at rest"].get_xdata()[-1] == 0.0
    pulled["joint_stroke_static"] = 0.1
    (ax,) = draw("range", pulled, ["effective_tension"]).axes
    np.testing.assert_array_equal(lines(ax)["at rest"].get_xdata(), np.full(10, 1e3))


@pytest.mark.parametrize("kind", ["range", "time-series", "shape"])
@pytest.mark.parametrize("title", [300 * "a", "-" + 300 * "b", "", "one two " * 60])
def test_any_title_is_laid_out_over_a_plot(kind, title):
    figure = draw(kind, run().assign_attrs(title=title))
    FigureCanvasAgg(figure).draw()
    there = figure.get_suptitle()
    assert "".join(there.split()).startswith("".join(title.split()))
    assert max(map(len, there.splitlines())) <= 15 * figure.get_size_inches()[0]


def test_a_range_graph_has_extremes_rest_limits_and_the_largest_size():
    figure = draw("range", run(), ["bending_moment"])
    (ax,) = figure.axes
    high, low = (line.get_xdata() for line in ax.lines[:2])
    middle = 5
    assert (high[middle], low[middle]) == (pytest.approx(-1.0), pytest.approx(-5.0))  # kN m
    assert lines(ax)["at rest"].get_xdata()[middle] == pytest.approx(-3.0)
    allowables = [line.get_xdata()[0] for line in ax.lines if line.get_linestyle() == "--"]
    assert allowables == [6.0, -6.0]  # either sign, and none of one section alone
    assert ax.get_title() == "largest -5 kN m,\nat s = 50 m"
    assert ax.get_xlabel() == "bending moment (kN m)"
    assert headline(figure) == "swing: ranges over time, along the riser"


def test_a_run_at_rest_is_one_line():
    (ax,) = draw("range", run(moving=False), ["bending_moment"]).axes
    assert len(ax.lines) == 1
    assert ax.lines[0].get_xdata().min() == pytest.approx(-3.0)
    assert len(draw("shape", run(moving=False)).axes[0].lines) == 1


def test_a_shape_is_drawn_where_it_is_furthest_to_either_side():
    (ax,) = draw("shape", run()).axes
    furthest = [line for label, line in lines(ax).items() if "at s = 50 m" in label]
    assert [line.get_xdata()[5] for line in furthest] == [pytest.approx(2.0), pytest.approx(-2.0)]
    assert lines(ax)["at rest"].get_ydata()[0] == -50.0


@pytest.mark.parametrize("kind", ["range", "time-series", "shape"])
def test_nothing_is_clipped(kind):
    assert_whole(draw(kind, run()))


@pytest.mark.parametrize(
    "kind, moving, of, said",
    [
        ("time-series", False, None, "analysis.duration"),
        ("shape", True, ["bending_moment"], "shows positions only"),
        ("range", True, ["colour"], "no 'colour'"),
    ],
)
def test_what_cannot_be_shown_is_said(kind, moving, of, said):
    with pytest.raises(InputError, match=said):
        draw(kind, run(moving), of)


def test_a_riser_that_moves_along_itself_has_no_shape():
    with pytest.raises(InputError, match="motion is axial only"):
        draw("shape", run().drop_vars(["x", "x_max", "x_min", "x_static"]))


def test_the_command_draws_a_point_of_a_study(tmp_path, commands):
    points = [run(), run()]
    points[1]["bending_moment"] = 2.0 * points[1]["bending_moment"]
    grid = xr.concat(points, xr.DataArray([1.0, 5.0], dims="heave", name="heave"))
    grid["point_key"] = ("heave", ["a", "b"])
    grid.to_netcdf(tmp_path / "grid.nc")

    plot, out = ("plot", tmp_path / "grid.nc", "-o"), tmp_path / "out.png"
    assert commands(*plot, out, "--at", "heave=5", "--kind", "time-series")[0] == 0
    assert out.read_bytes().startswith(b"\x89PNG")
    code, _, said = commands(*plot, out)
    assert code == 2
    assert "with one of 1.0, 5.0" in said
    assert commands(*plot, tmp_path / "out.doc", "--at", "heave=5")[0] == 2
    assert not (tmp_path / "out.doc").exists()


@pytest.mark.parametrize(
    "words",
    [
        ["plot", "--kind", "range"],
        ["plot", "--kind", "time-series"],
        ["plot", "--kind", "shape"],
        ["statistics"],
        ["compare"],
    ],
)
def test_of_a_point_that_failed_nothing_is_made(words, tmp_path, commands):
    grid = run().expand_dims(at=["well", "lost"]).assign(point_key=("at", ["a", "b"]))
    failed = grid.where(grid["at"] == "well").assign(point_key=("at", ["a", "b"]))
    why = "no static equilibrium was found"
    failed.assign(failure=("at", ["", why])).to_netcdf(tmp_path / "grid.nc")
    (tmp_path / "other.csv").write_text("time (s), x at 0 m (m)\n0, 0\n1, 1\n2, 0\n3, 1\n")
    other = [tmp_path / "other.csv"] if words == ["compare"] else []
    target = tmp_path / ("made.csv" if words == ["statistics"] else "made.png")
    call = [words[0], tmp_path / "grid.nc", *other, *words[1:], "--at", "at=lost"]
    code, _, said = commands(*call, "-o", target)
    assert code == SimulationError.exit_code
    assert f"this point has no results: {why}" in said
    assert not target.exists()


def test_a_range_graph_of_magnitudes_alone_says_so():
    moment = run()["bending_moment_max"]
    only = xr.Dataset({"bending_moment_absmax": abs(moment), "ufj_angle": ("time", TIME)})
    (ax,) = draw("range", only.assign_coords(run().coords)).axes
    assert "at rest" not in ax.figure.get_suptitle()
    assert draw("time-series", only.assign_coords(run().coords)).axes
    assert f"largest {1e-3 * float(abs(moment).max()):.4g}" in ax.get_title()


@pytest.mark.parametrize(
    "of", [["bending_moment", "von_mises_stress"], ["bending_moment", "x", "x", "x", "x"]]
)
def test_a_range_graph_leaves_out_nothing_that_is_asked_for(of):
    with pytest.raises(InputError, match=r"von_mises_stress|5 quantities"):
        draw("range", run(), of)


def test_a_shape_without_elevations_is_refused():
    run = xr.Dataset({"x": (("time", "s"), np.ones((3, 4)))}, {"time": range(3), "s": range(4)})
    with pytest.raises(InputError, match="z: elevations are missing"):
        draw("shape", run)


@pytest.mark.parametrize("kept", [[], LIMITS[:1]])
def test_a_limit_whose_allowable_is_on_an_axis_has_no_line(kept):
    free = {"output": "bending_moment", "at": "", "allowable": None}
    one, other = (run().assign_attrs(limits=json.dumps(rows)) for rows in ([*kept, free], kept))
    found, expected = (len(draw("range", of, ["bending_moment"]).axes[0].lines) for of in (one, other))
    assert found == expected
