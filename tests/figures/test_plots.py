"""Plots that fit any grid: what they show, of datasets with known numbers."""

import csv
import io
import json
import re

import numpy as np
import pytest
import xarray as xr
from drawn_whole import assert_whole
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import QuadMesh
from matplotlib.colors import to_hex
from some_seeds import seeds

from riserstudy.errors import InputError
from riserstudy.figures import draw_plot
from riserstudy.figures.figure_text import csv_table
from riserstudy.study.figures import NEEDS, FigureModel
from riserstudy.study.read import default_figures
from riserstudy.study.study_model import StudyModel

UNIT = re.compile(r"\((m|s|kN|kN m|deg|ft)\)|utilisation")
TIME, S = np.linspace(0.0, 10.0, 41), np.linspace(0.0, 100.0, 11)
AXES = {
    "heave_amplitude": ([1.0, 2.0, 4.0], {"units": "m", "long_name": "heave amplitude"}),
    "tug": ([3.0, 6.0], {"units": "ft", "long_name": "tug"}),  # no variable of ours
    "reading": (["wide", "narrow"], {}),
}


def grid(*axes, moving=True):
    """Bending moments and stroke that grow with the place in the grid."""
    shape = tuple(len(AXES[axis][0]) for axis in axes)
    size = 1.0 + np.arange(np.prod(shape, dtype=int)).reshape(shape)
    wave = np.sin(TIME)[:, None] * np.sin(np.pi * S / 100.0)
    moment = 1e3 * np.multiply.outer(size, wave if moving else wave[5])
    dims = ("time", "s") if moving else ("s",)
    data = {"bending_moment": ((*axes, *dims), moment), "point_key": (axes, size.astype(str))}
    if moving:
        data["bending_moment_max"] = ((*axes, "s_node"), moment.max(axis=-2))
        data["bending_moment_min"] = ((*axes, "s_node"), moment.min(axis=-2))
        data["stroke"] = ((*axes, "time"), np.multiply.outer(size, np.cos(TIME)))
    use = 0.1 * size[..., None] * [1.0, 0.5, np.nan] + [0.0, 0.2, 0.0]
    data["use_of_limit"] = ((*axes, "limit"), use)
    coords = {axis: (axis, *AXES[axis]) for axis in axes} | {"s": S}
    coords["limit"] = ["drilling: largest ufj_angle", "connected: largest stroke", "drilling: a"]
    coords |= {"time": TIME, "s_node": S} if moving else {}
    return xr.Dataset(data, coords, {"title": "a grid"})


def drawn(plot, dataset, of=None):
    model = FigureModel(caption="c", reads=["r"], plot=plot, of=of)
    figure = draw_plot(model, dataset)
    figure.set_dpi(40)  # to be quick
    FigureCanvasAgg(figure).draw()
    return figure


#: those of any grid; hours of a record have tests of their own
OF_GRIDS = sorted(set(NEEDS) - {"workable hours"})
GRIDS = [(), ("reading",), ("tug", "reading"), ("heave_amplitude", "tug", "reading")]


@pytest.mark.long
@pytest.mark.parametrize("axes", GRIDS, ids="-".join)
@pytest.mark.parametrize("plot", OF_GRIDS)
def test_every_plot_fits_every_grid_that_has_axes_enough(plot, axes):
    if len(axes) < NEEDS[plot]:
        return
    figure = drawn(plot, grid(*axes))
    for ax in figure.axes:
        assert ax.lines or ax.collections
        if ax.get_label() != "<colorbar>":
            assert ax.get_xlabel() or len(ax.get_shared_x_axes().get_siblings(ax)) > 1
        for text in (ax.get_xlabel(), ax.get_ylabel()):
            assert not text or UNIT.search(text) or text == "reading", text
    assert_whole(figure)


def test_lines_are_the_extremes_in_units_one_reads():
    figure = drawn("lines", grid("heave_amplitude"), ["bending_moment"])
    (ax,) = figure.axes
    size = abs(np.sin(TIME)).max()  # of a moment either sign counts
    np.testing.assert_allclose(ax.lines[0].get_ydata(), size * np.array([1.0, 2.0, 3.0]))  # kN m
    assert ax.get_xlabel() == "heave amplitude (m)"
    assert ax.get_ylabel() == "largest size of bending moment\n(kN m)"
    (ax,) = drawn("lines", grid("heave_amplitude"), ["stroke"]).axes
    largest, smallest = (line.get_ydata() for line in ax.lines[:2])
    assert (largest > smallest).all()


def test_extremes_are_those_of_runs_as_they_are_where_a_study_tells_them():
    runs = grid("heave_amplitude")
    told = ["bending_moment max", "bending_moment min", "stroke max"]
    over = ("heave_amplitude", "statistic")
    runs["value_of_statistic"] = (over, [[1e3, -3e3, 7.0], [2e3, -1e3, 8.0], [0.0, 0.0, 9.0]])
    runs = runs.assign_coords(statistic=told)
    (ax,) = drawn("lines", runs, ["bending_moment"]).axes
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), [3.0, 2.0, 0.0])  # kN m
    (ax,) = drawn("lines", runs, ["stroke"]).axes
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), [7.0, 8.0, 9.0])


def test_a_heat_map_shows_the_extreme_that_matters():
    figure = drawn("heat map", grid("heave_amplitude", "tug"), ["bending_moment"])
    shown = figure.axes[0].collections[0].get_array().reshape(2, 3)
    size = abs(np.sin(TIME)).max()
    np.testing.assert_allclose(shown, size * np.array([[1, 3, 5], [2, 4, 6]]))
    assert figure.axes[0].get_xlabel() == "heave amplitude (m)"
    assert figure.axes[0].get_ylabel() == "tug (ft)"


def test_utilisation_is_the_largest_of_all_limits_and_names_the_one_that_governs():
    """Of sizes 1 to 6 the limits use 0.1 n and 0.05 n + 0.2: the second governs up to the fourth."""
    figure = drawn("utilisation", grid("heave_amplitude", "tug"))
    use, governing = (ax.collections[0].get_array().reshape(2, 3) for ax in figure.axes[:2])
    np.testing.assert_allclose(use, [[0.25, 0.35, 0.5], [0.3, 0.4, 0.6]])
    np.testing.assert_array_equal(governing[:, [0, 2]], [[1, 0], [1, 0]])
    assert figure.get_suptitle().startswith("0 of 6 points exceed a limit; at ")
    (legend,) = figure.legends
    assert {text.get_text() for text in legend.get_texts()} == {
        "drilling: largest UFJ angle", "connected: largest stroke",
    }  # fmt: skip


@pytest.mark.parametrize("seed", seeds(12, few=5))
@pytest.mark.parametrize("axes", [("tug",), ("heave_amplitude", "tug")], ids="-".join)
def test_utilisation_counts_the_points_of_which_nobody_knows_whether_they_exceed_a_limit(axes, seed):
    """A limit whose error is larger than its margin has a utilisation below 1, and is not evaluated."""
    draw, found = np.random.default_rng(seed), grid(*axes)
    shape = found["use_of_limit"].shape
    use, unknown = draw.uniform(0.0, 1.3, shape), draw.random(shape) < draw.choice([0.0, 0.2, 0.6])
    use[unknown & (draw.random(shape) < 0.5)] = np.nan
    found["use_of_limit"].values[:] = use
    words = np.where(use > 1.0, "exceeded", np.where(unknown, "not evaluated", "within"))
    found["verdict_of_limit"] = (found["use_of_limit"].dims, words)
    points = [[str(word) for word in row] for row in words.reshape(-1, shape[-1])]
    open_points = [row for row in points if "not evaluated" in row and "exceeded" not in row]
    title = drawn("utilisation", found).get_suptitle().replace("\n", " ")
    if not np.isnan(use).all():
        assert title.startswith(f"{sum('exceeded' in row for row in points)} of {len(points)} points exceed")
        told = f"; at {len(open_points)}, a limit is not evaluated; "
        assert (told in title) == bool(open_points)
        assert ("not evaluated" in title) == bool(open_points)


@pytest.mark.parametrize("seed", range(8))
def test_no_two_limits_that_govern_have_the_same_colour(seed):
    draw, found = (
        np.random.default_rng(seed),
        grid("heave_amplitude", "tug").drop_vars(["use_of_limit", "limit"]),
    )
    count = int(draw.integers(8, 30))
    use = draw.uniform(0.0, 1.0, (*found["point_key"].shape, count))
    found["use_of_limit"] = ((*found["point_key"].dims, "limit"), use)
    found = found.assign_coords(limit=[f"drilling: limit {k}" for k in range(count)])
    figure = drawn("utilisation", found)
    (legend,) = figure.legends
    entries = zip(legend.get_texts(), legend.get_lines(), strict=True)
    named = {text.get_text(): line.get_color() for text, line in entries}
    governing = set(use.argmax(-1).ravel().tolist())
    assert set(named) == {f"drilling: limit {k}" for k in governing}
    assert len({to_hex(colour) for colour in named.values()}) == len(named)
    shown = figure.axes[1].collections[0]
    painted = shown.cmap(shown.norm(shown.get_array().ravel()))
    drawn_in = found["use_of_limit"].transpose("tug", "heave_amplitude", "limit")
    if shown.get_array().shape != drawn_in.shape[:2]:
        drawn_in = drawn_in.transpose("heave_amplitude", "tug", "limit")
    expected = [named[f"drilling: limit {k}"] for k in drawn_in.values.argmax(-1).ravel()]
    assert [to_hex(colour) for colour in painted] == [to_hex(colour) for colour in expected]


def test_utilisation_tells_of_what_is_exceeded_and_of_what_nobody_evaluated():
    beyond = grid("heave_amplitude", "tug")
    beyond["use_of_limit"] = 4.0 * beyond["use_of_limit"]
    assert "5 of 6 points exceed" in drawn("utilisation", beyond).get_suptitle()
    beyond["use_of_limit"] = np.inf * beyond["use_of_limit"]
    assert "6 of 6 points exceed" in drawn("utilisation", beyond).get_suptitle()
    beyond["use_of_limit"] = np.nan * beyond["use_of_limit"]
    assert drawn("utilisation", beyond).get_suptitle() == "no limit is evaluated at any point"
    with pytest.raises(InputError, match="no utilisations"):
        drawn("utilisation", beyond.drop_vars("use_of_limit"))


def test_utilisation_over_one_axis_is_a_line_a_limit():
    (ax,) = drawn("utilisation", grid("heave_amplitude")).axes
    np.testing.assert_allclose(ax.lines[0].get_ydata(), [0.1, 0.2, 0.3])
    np.testing.assert_allclose(ax.lines[1].get_ydata(), [0.25, 0.3, 0.35])


def test_an_envelope_lies_along_the_riser():
    figure = drawn("envelope", grid("heave_amplitude"), ["bending_moment"])
    (ax,) = figure.axes
    assert len(ax.lines) == 6
    np.testing.assert_allclose(ax.lines[0].get_ydata(), S)
    np.testing.assert_allclose(ax.lines[4].get_xdata(), 3 * np.sin(TIME).max() * np.sin(np.pi * S / 100))


def test_a_time_series_is_that_of_the_place_that_varies_most():
    figure = drawn("time series", grid("heave_amplitude"), ["bending_moment"])
    (ax,) = figure.axes
    np.testing.assert_allclose(ax.lines[1].get_ydata(), 2.0 * np.sin(TIME))
    assert "at s = 50" in ax.get_ylabel()


def test_large_grids_are_shown_by_a_few_points():
    figure = drawn("envelope", grid("heave_amplitude", "tug", "reading"), ["bending_moment"])
    assert len(figure.axes[0].lines) == 2 * 7
    words = [text.get_text() for text in figure.legends[0].texts]
    assert words[0] == "heave amplitude 1 m, tug 3 ft, wide"
    assert words[-1] == "heave amplitude 4 m, tug 6 ft, narrow"


@pytest.mark.parametrize("plot", sorted(set(OF_GRIDS) - {"utilisation"}))  # which shows all limits
def test_what_is_not_there_is_said(plot):
    with pytest.raises(InputError, match=r"no 'colour'.*use one of bending_moment"):
        drawn(plot, grid("heave_amplitude", "tug"), ["colour"])


def test_a_study_file_without_figures_gets_those_that_fit():
    axis = {"unit": "m", "values": [1, 2]}
    studies = {
        name: StudyModel(scene="s", caption="c", axes={a: axis | {"path": a} for a in axes})
        for name, axes in {"none": "", "one": "a", "two": "ab"}.items()
    }
    found = default_figures(studies, {"none": False, "one": True, "two": True}, set())
    assert list(found) == [
        *("none_envelope", "one_lines", "one_envelope", "one_time_series"),
        *("two_heat_map", "two_envelope", "two_time_series"),
    ]
    assert found["two_heat_map"].reads == ["two"]


def angles(low, high, limits=()):
    """An angle of runs at rest over three axes, from a lowest to a highest value."""
    axes = ("heave_amplitude", "tug", "reading")
    found = grid(*axes).drop_vars(["bending_moment", "bending_moment_max", "bending_moment_min"])
    shape = found["point_key"].shape
    values = np.linspace(low, high, int(np.prod(shape))).reshape(shape)
    found["lfj_angle"] = (axes, np.radians(values))
    rows = [
        {"output": "lfj_angle", "at": "", "side": "largest", "allowable": np.radians(level)}
        for level in limits
    ]
    return found.assign_attrs(limits=json.dumps(rows))


@pytest.mark.parametrize("low, high", [(-3.0, 5.0), (-6.0, 1.0)])
def test_colours_of_a_quantity_with_a_sign_are_about_zero_and_alike_in_all_panels(low, high):
    figure = drawn("heat map", angles(low, high), ["lfj_angle"])
    meshes = [m for ax in figure.axes for m in ax.collections if isinstance(m, QuadMesh)]
    maps = {(m.get_cmap().name, *m.get_clim()) for m in meshes if m.get_label() != "bar"}
    assert len(maps) == 1
    name, least, most = maps.pop()
    assert name == "RdBu_r"
    assert -least == most == pytest.approx(max(-low, high))


def test_colours_of_a_quantity_of_one_sign_fill_its_range():
    figure = drawn("heat map", angles(1.0, 5.0), ["lfj_angle"])
    mesh = figure.axes[0].collections[0]
    assert (mesh.get_cmap().name, *mesh.get_clim()) == ("viridis", pytest.approx(1.0), pytest.approx(5.0))


def test_a_heat_map_marks_where_its_limit_is():
    inside, beyond = (drawn("heat map", angles(-3.0, 5.0, [level]), ["lfj_angle"]) for level in (2.0, 9.0))

    def marks(figure):
        return [line.get_ydata()[0] for ax in figure.axes for line in ax.get_lines()]

    assert set(np.round(marks(inside), 9)) == {-2.0, 2.0}
    assert marks(beyond) == []


def cells_of(figure):
    """Values of heat maps by panel and place, as the table of the figure has them."""
    rows = list(csv.DictReader(io.StringIO(csv_table(figure))))
    cells = [row for row in rows if row["colour_value"]]
    return {(r["panel"], r["x_value"], r["y_value"]): r["colour_value"] for r in cells}


@pytest.mark.parametrize("plot", ["heat map", "utilisation"])
@pytest.mark.parametrize("seed", range(6))
def test_a_map_does_not_depend_on_the_order_of_its_axes(seed, plot):
    draw = np.random.default_rng(seed)
    ordered = grid("heave_amplitude", "tug")
    axes = ("heave_amplitude", "tug")
    uneven = {axis: draw.uniform(-5.0, 9.0, ordered.sizes[axis]).round(2) for axis in axes}
    ordered = ordered.assign_coords(
        {axis: (axis, np.sort(values), ordered[axis].attrs) for axis, values in uneven.items()}
    )
    mixed = ordered
    for axis in uneven:
        mixed = mixed.isel({axis: draw.permutation(ordered.sizes[axis])})
    of = ["bending_moment"] if plot == "heat map" else None
    cells, again = cells_of(drawn(plot, ordered, of)), cells_of(drawn(plot, mixed, of))
    assert cells == again
    assert {(x, y) for _, x, y in cells} == {
        (f"{x:g}", f"{y:g}") for x in uneven["heave_amplitude"] for y in uneven["tug"]
    }


@pytest.mark.parametrize("plot", ["heat map", "utilisation"])
@pytest.mark.parametrize("seed", range(4))
def test_the_table_of_a_map_has_the_words_of_its_axes(seed, plot):
    draw = np.random.default_rng(seed)
    words = [f"case {k}" for k in draw.permutation(5)[: draw.integers(2, 5)]]
    numbers = np.sort(draw.uniform(-5.0, 9.0, 3).round(2))
    dataset = xr.concat([grid("heave_amplitude", "reading").isel(reading=0)] * len(words), "reading")
    dataset = dataset.assign_coords(reading=words, heave_amplitude=numbers)
    of = ["bending_moment"] if plot == "heat map" else None
    places = {(x, y) for _, x, y in cells_of(drawn(plot, dataset, of))}
    assert places == {(f"{x:g}", word) for x in numbers for word in words}


@pytest.mark.parametrize("seed", range(4))
def test_the_table_of_lines_over_words_has_the_words(seed):
    draw = np.random.default_rng(seed)
    words = [f"case {k}" for k in draw.permutation(5)[: draw.integers(2, 5)]]
    dataset = xr.concat([grid("reading").isel(reading=0)] * len(words), "reading")
    figure = drawn("lines", dataset.assign_coords(reading=words), ["stroke"])
    rows = list(csv.DictReader(io.StringIO(csv_table(figure))))
    assert [row["x_value"] for row in rows] == [*words, *words]  # largest and smallest
