"""Schematics: to scale, of every scene, with what is there and nothing else, and readable."""

import re
import shutil
from functools import cache
from itertools import combinations
from math import hypot
from pathlib import Path

import numpy as np
import pytest
from drawn_words import labels, words
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.text import Annotation, Text

from riserstudy.errors import InputError
from riserstudy.figures.figure_text import headline
from riserstudy.jobs.figure import from_scene
from riserstudy.scene.load import load_scene
from riserstudy.schematic import schematic
from riserstudy.schematic.geometry import Geometry, labelled
from riserstudy.schematic.labels import LOAD, spread
from riserstudy.study.read import read_studies

CONFIG = Path(__file__).parents[2] / "config"
SCENES = sorted((CONFIG / "scenes").glob("*/*.yaml"))
PAPERS = ("chang2020", "liu2020", "mao_hangoff", "fem_riser", "liu2017")
SHOWN = [(paper, name) for paper in PAPERS for name in read_studies(CONFIG, paper).schematics]
FORCES = ("weight ", "tension ", "force ", "line load ")
#: how many figures each paper printed
PRINTED = {"chang2020": 14, "liu2020": 24, "mao_hangoff": 14, "fem_riser": 8, "liu2017": 7}


@cache
def drawn(paper, name):
    """A schematic of a paper, laid out."""
    figure = from_scene(CONFIG, paper, name)
    FigureCanvasAgg(figure).draw()
    return figure


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_every_scene_can_be_drawn(path):
    figure = schematic(load_scene(path).resolved())
    assert len(figure.axes) in (3, 4)
    assert "lower end:" in words(figure)


@pytest.mark.parametrize("paper, name", SHOWN)
def test_a_schematic_is_headed_by_the_title_of_its_scene(paper, name):
    scene = read_studies(CONFIG, paper).schematics[name].file(CONFIG).resolved()
    assert headline(drawn(paper, name)) == scene.title


@pytest.mark.parametrize("paper, name", SHOWN)
def test_a_metre_is_as_long_in_both_directions(paper, name):
    for ax in drawn(paper, name).axes:
        (x0, z0), (x1, z1) = ax.transData.transform([(0.0, 0.0), (1.0, 1.0)])
        assert x1 - x0 == pytest.approx(z1 - z0, rel=1e-9)


@pytest.mark.parametrize("paper, name", SHOWN)
def test_labels_neither_touch_nor_leave_the_figure(paper, name):
    figure = drawn(paper, name)
    renderer = FigureCanvasAgg(figure).get_renderer()
    boxes = {t.get_text(): super(Annotation, t).get_window_extent(renderer) for t in labels(figure)}
    for (one, first), (other, second) in combinations(boxes.items(), 2):
        assert not first.overlaps(second), (one, other)
    width, height = figure.get_size_inches() * figure.dpi
    legends = [legend.get_window_extent(renderer) for legend in figure.legends]
    for text, box in boxes.items():
        assert not any(box.overlaps(legend) for legend in legends), text
        assert box.x0 >= 0.0, text
        assert box.x1 <= width, text
        assert box.y0 >= 0.0, text
        assert box.y1 <= height, text


@pytest.mark.parametrize("paper, name", SHOWN)
def test_text_of_a_schematic_is_not_below_6_points_on_a_page_of_180_mm(paper, name):
    figure = drawn(paper, name)
    shrunk = min(1.0, 180.0 / (25.4 * figure.get_size_inches()[0]))
    for text in figure.findobj(Text):
        if text.get_visible() and text.get_text().strip():
            assert shrunk * text.get_fontsize() >= 6.0, text.get_text()


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_arrows_of_loads_are_in_their_panels(path):
    assert_forces_are_shown(schematic(load_scene(path).resolved()))


@pytest.mark.parametrize("paper, name", SHOWN)
def test_arrows_of_loads_are_in_the_panels_of_every_chapter(paper, name):
    assert_forces_are_shown(drawn(paper, name))


def assert_forces_are_shown(figure):
    """An arrow whose head lies outside is not drawn at all; labels of forces stand at one that is."""
    for ax in figure.axes:
        arrows = [t for t in ax.texts if isinstance(t, Annotation) and not t.get_text()]
        forces = [t for t in ax.texts if t.get_text().startswith(FORCES) and t.get_color() == LOAD]
        for label in forces:
            named = [arrow for arrow in arrows if between(label.xy, arrow)]
            assert named, label.get_text()
            assert any(inside(ax, a.xy) and inside(ax, a.xyann) for a in named), label.get_text()


def inside(ax, point):
    """Whether a panel shows a point."""
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    return left <= point[0] <= right and low <= point[1] <= high


def between(point, arrow):
    """Whether a point lies on an arrow."""
    whole = hypot(arrow.xy[0] - arrow.xyann[0], arrow.xy[1] - arrow.xyann[1])
    parts = sum(hypot(point[0] - x, point[1] - z) for x, z in (arrow.xy, arrow.xyann))
    return parts <= 1.001 * whole


@pytest.mark.parametrize("paper, name", SHOWN)
def test_numbers_stand_on_one_line_with_their_units(paper, name):
    for label in labels(drawn(paper, name)):
        assert not re.search(r"\d\n(?!(in|to|of)\b)[^\W\d]{1,2}\b", label.get_text()), label.get_text()
        assert not re.search(r"(=|EI|EA)\n|\n=", label.get_text()), label.get_text()


def test_what_is_there_is_named_and_what_is_not_is_not():
    rig = words(drawn("liu2020", "fig01"))
    for part in ("telescopic joint: 24 m", "6 cylinders", "tension ring", "radius 2.5 m", "current"):
        assert part in rig
    assert "soil" not in rig
    drive_off = words(drawn("liu2017", "fig01"))
    for part in ("soil: p-y curves", "LMRP and BOP: 14 m", "thrusters", "wind 13.8 m/s", "mudline"):
        assert part in drive_off
    assert "tensioners:" not in drive_off
    spring = words(drawn("chang2020", "fig07"))
    assert "heave ±5 m* in 20 s*" in spring
    assert "water" not in spring


@pytest.mark.parametrize("heading, ways", [("0 deg", "surge"), ("30 deg", "surge, sway and yaw")])
def test_a_platform_is_free_in_the_directions_that_are_simulated(heading, ways):
    scene = load_scene(CONFIG / "scenes/liu2017/ref_0.yaml", **{"current.heading": heading})
    said = words(schematic(scene.resolved()))
    assert f"platform: free to {ways}, 40 800 t and 11 800 t of added mass" in said
    assert ("three dimensions" in said) == ("sway" in ways)


@pytest.mark.parametrize("ratio", [1.1, 1.3, 1.5])
def test_a_tension_by_a_buoyant_factor_names_its_ratio_to_the_weight_it_carries(ratio):
    path = CONFIG / "scenes/fem_riser/base.yaml"
    scene = load_scene(path, **{"buoyancy.tension_ratio": ratio}).resolved()
    said = words(schematic(scene))
    assert f"{ratio} times the weight in water of riser and contents" in said
    weight = float(re.search(r"([\d.]+) kN/m in water with contents of 1200 kg/m³", said)[1])
    tension = float(re.search(r"tension ([\d.]+) MN", said)[1])
    assert tension == pytest.approx(1e-3 * ratio * weight * 2000.0, rel=1e-3)


@pytest.mark.parametrize("paper", ["fem_riser", "liu2017"])
def test_water_reaches_the_surface_of_the_wave(paper):
    """The wave is highest above the riser, where the upper end is drawn."""
    scene = read_studies(CONFIG, paper).schematics["fig01"].file(CONFIG).resolved()
    upper = drawn(paper, "fig01").axes[1]
    water = max(upper.collections, key=lambda part: part.get_datalim(upper.transData).width)
    (area,) = water.get_paths()
    crest = scene.water.surface + 0.5 * scene.wave.height
    assert area.vertices[:, 1].max() == pytest.approx(crest, abs=1e-3)


def test_parts_lie_where_the_scene_puts_them():
    """Conductor, LMRP and BOP, riser and telescopic joint one above the other, counted from the wellhead."""
    scene = load_scene(CONFIG / "scenes/liu2017/ref_0.yaml").resolved()
    place = Geometry(scene)
    assert [place.at(low)[1] for _, low, _ in place.sections] == pytest.approx([-73.0, 0.0, 14.0])
    assert place.ring == pytest.approx((0.0, 1326.0))
    assert place.top == pytest.approx((0.0, 1341.0))
    assert (place.seabed, place.surface) == (-3.0, 1326.0)


def test_a_slack_riser_sags_with_its_length():
    scene = load_scene(CONFIG / "scenes/bench/s4e.yaml").resolved()
    s, x, z = Geometry(scene).line
    steps = ((x[1:] - x[:-1]) ** 2 + (z[1:] - z[:-1]) ** 2) ** 0.5
    assert steps.sum() == pytest.approx(s[-1], rel=1e-3)
    assert z.min() < min(z[0], z[-1])


@given(st.lists(st.tuples(st.floats(0.0, 5.0), st.floats(0.05, 0.4)), max_size=8))
def test_labels_are_spread_apart_within_their_column(rows):
    rows = sorted(rows, reverse=True)
    heights = [height for _, height in rows]
    places = spread([place for place, _ in rows], heights, 6.0)
    for k in range(len(places) - 1):
        assert places[k] - places[k + 1] >= 0.5 * (heights[k] + heights[k + 1]) - 1e-9
    if places:
        assert places[0] <= 6.0 - 0.5 * heights[0] + 1e-9
        assert places[-1] >= 0.5 * heights[-1] - 1e-9


@pytest.mark.parametrize("paper", PAPERS)
def test_every_printed_figure_is_drawn_or_told_as_left_out(paper):
    file = read_studies(CONFIG, paper)
    drawn_here = {*file.figures, *file.schematics}
    assert not drawn_here & set(file.left_out)
    printed = {f"fig{k:02d}" for k in range(1, PRINTED[paper] + 1)}
    assert printed <= drawn_here | set(file.left_out)
    assert set(file.left_out) <= printed


def test_words_of_a_scene_are_drawn_as_written(tmp_path):
    """A dollar or a bracket is one, and begins neither a formula nor a style."""
    words = r"a [b] [/c] $\frac$ d $"
    said = {"title": words, "riser[0].name": r"$\alpha{$ [/x]"}
    figure = schematic(load_scene(CONFIG / "scenes/bench/s4b.yaml", **said).resolved())
    figure.savefig(tmp_path / "a.png")
    drawn = [text.get_text() for text in figure.findobj(Text)]
    assert words in drawn
    assert any(r"$\alpha{$ [/x]" in text for text in drawn)


def test_a_remark_follows_the_label_of_its_part_and_no_other_is_accepted(tmp_path):
    scene = read_studies(CONFIG, "liu2020").schematics["fig01"].file(CONFIG).resolved()
    bear = [*labelled(scene)]
    assert {"riser[0]", "current", "platform.centre_of_rotation"} <= set(bear)
    said = words(schematic(scene, remarks={path: f"remark {k} of this" for k, path in enumerate(bear)}))
    for k in range(len(bear)):
        assert f"(remark {k} of this)" in said
    shutil.copytree(CONFIG / "studies", tmp_path / "studies")
    shutil.copytree(CONFIG / "scenes", tmp_path / "scenes")
    path = tmp_path / "studies/chang2020.yaml"
    path.write_text(path.read_text("utf-8").replace('"riser[0].l', '"riser[1].l'), "utf-8")
    with pytest.raises(InputError, match=r"schematics\.fig07\.remarks\.riser\[1\]\.len.*riser\[0\]"):
        from_scene(tmp_path, "chang2020", "fig07")


def test_x_is_no_axis_where_nothing_moves_aside():
    for paper, name in SHOWN:
        scene = read_studies(CONFIG, paper).schematics[name].file(CONFIG).resolved()
        names = {ax.get_xlabel() for ax in drawn(paper, name).axes[:3]}
        x = " x" if scene.lateral or scene.spatial else ""
        assert names == {f"horizontal position{x} (m)"}


def levels(figure):
    """Heights of the boxes and lines of the upper end, panel (b): cylinders and platform are among them."""
    boxes = [(p.get_y(), p.get_y() + p.get_height()) for p in figure.axes[1].patches if hasattr(p, "get_y")]
    return np.array([edge for box in boxes for edge in box])


def test_standing_cylinders_are_below_the_ring_and_hanging_ones_above():
    scene = load_scene(CONFIG / "scenes/chang2020/heave.yaml").resolved()
    ring = Geometry(scene).ring[1]
    hull = 0.26 * 1.3  # the mass at the ring reaches to both sides of it by less than that (inches)
    standing, hanging = (levels(schematic(scene, standing=way)) for way in (True, False))
    height = np.ptp(schematic(scene).axes[1].get_ylim())
    reach = hull * height / 2.0
    assert (standing < ring - reach).sum() > (standing > ring + reach).sum() == 0
    assert (hanging > ring + reach).sum() > (hanging < ring - reach).sum() == 0


def test_cylinders_that_the_scene_arranges_are_not_made_to_stand(tmp_path):
    shutil.copytree(CONFIG, tmp_path / "config")
    path = tmp_path / "config/studies/liu2020.yaml"
    text = path.read_text("utf-8")
    head, sep, rest = text.partition("schematics:\n  fig01:\n")
    assert sep
    path.write_text(f"{head}{sep}    cylinders: standing\n{rest}", "utf-8")
    with pytest.raises(
        InputError, match=r"schematics\.fig01\.cylinders: .*has an arrangement of its tensioners"
    ):
        from_scene(tmp_path / "config", "liu2020", "fig01")


HULL = to_hex("#dfe5ea")
BODY = to_hex("#c9ced3")


def boxes(ax, colour):
    """Lower and upper edges of the boxes of a colour."""
    found = [p for p in ax.patches if hasattr(p, "get_y") and to_hex(p.get_facecolor()) == colour]
    return [(p.get_y(), p.get_y() + p.get_height()) for p in found]


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_a_platform_is_as_high_above_the_water_in_both_panels(path):
    scene = load_scene(path).resolved()
    whole, upper = schematic(scene).axes[:2]
    edges = [[low for low, _ in boxes(ax, HULL)] for ax in (whole, upper)]
    assert len(edges[0]) == len(edges[1])
    if Geometry(scene).surface is not None:
        assert edges[0] == pytest.approx(edges[1])


@pytest.mark.parametrize("clearance", [10.0, 30.0, 50.0, 90.0, 400.0])
def test_a_hanging_body_ends_above_the_seabed_in_both_panels(clearance):
    path = CONFIG / "scenes/mao_hangoff/evacuation.yaml"
    scene = load_scene(path, **{"water.seabed": f"{-1800.0 - clearance} m"}).resolved()
    for ax in schematic(scene).axes[0::2]:
        ((low, high),) = boxes(ax, BODY)
        assert high == pytest.approx(-1800.0)
        if clearance > 30.0:  # else a body that can be seen is larger
            assert low > -1800.0 - clearance


def test_ends_have_one_scale_with_and_without_a_view_from_above():
    """A symbol has one size in metres in all schematics of a riser that hangs."""
    path = CONFIG / "scenes/mao_hangoff/evacuation.yaml"
    sizes = []
    for turned in ("0 deg", "45 deg"):
        scene = load_scene(path, **{"current.heading": turned}).resolved()
        _, upper, lower = schematic(scene).axes[:3]
        sizes.append(boxes(upper, HULL) + boxes(lower, BODY))
    assert len(schematic(scene).axes) == 4
    np.testing.assert_allclose(sizes[0], sizes[1], rtol=1e-9)


def test_directions_seen_from_above_have_no_scale():
    """A view that shows nothing but headings has neither ticks nor units; one with tensioners has."""
    *_, directions = drawn("mao_hangoff", "fig02").axes
    assert not directions.get_xticks().size
    assert not directions.get_yticks().size
    assert "m" not in directions.get_xlabel() + directions.get_ylabel()
    *_, rig = drawn("liu2020", "fig01").axes
    assert rig.get_xticks().size
    assert rig.get_xlabel() == "horizontal position x (m)"
