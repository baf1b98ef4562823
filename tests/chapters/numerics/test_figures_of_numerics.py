"""Figures of the numerics chapter, of datasets whose answer is known: whole, in words, nothing hidden."""

import numpy as np
import pytest
import xarray as xr
from drawn_whole import assert_whole
from figure_rules import assert_readable
from matplotlib.backends.backend_agg import FigureCanvasAgg

from chapters.numerics.figures.accuracy import accuracy
from chapters.numerics.figures.cost import cost
from chapters.numerics.figures.energy import energy
from chapters.numerics.figures.random_scenes import random_scenes
from chapters.numerics.figures.scenes import NAMES, family_in_words, in_one_line
from chapters.numerics.figures.stable_step import stable_step
from chapters.numerics.figures.tiers import tiers
from riserstudy.figures.figure_text import headline

SCENES = ["S2", "Liu 2020 roll of 4 deg in 10 s"]


def of_tiers(ratio):
    """Two scenes in two tiers, the second of which takes ``ratio`` times as long."""
    seconds = np.array([[0.1, 0.2], [0.1 * ratio, 0.2 * ratio]])
    return xr.Dataset(
        {
            "wall_seconds": (("tier", "scene"), seconds),
            "estimated": (("tier", "scene"), np.full((2, 2), 0.005)),
            "error": (("tier", "scene", "quantity"), np.full((2, 2, 1), 0.001)),
        },
        {"tier": ["preview", "standard"], "scene": ["Liu 2020, roll of 4 deg", "riser in waves"]},
    )


@pytest.mark.parametrize(
    "ratio, words",
    [
        (0.99, "Standard takes about as long as preview"),
        (1.04, "Standard takes about as long as preview"),
        (2.5, "Standard takes 2.5 times as long as preview"),
        (0.5, "Standard takes 0.5 times as long as preview"),
    ],
)
def test_equal_times_of_tiers_have_no_factor(ratio, words):
    figure = tiers(of_tiers(ratio))
    assert headline(figure) == words
    assert figure.axes[1].get_title(loc="left") == "(b) errors; peaks within 0.1 %"


def test_unequal_ratios_of_times_are_a_range():
    found = of_tiers(1.0)
    found["wall_seconds"][1, 0] *= 0.7
    found["wall_seconds"][1, 1] *= 2.4
    assert headline(tiers(found)) == "Standard takes 0.7 to 2.4 times as long as preview"


def test_tiers_that_coincide_are_both_seen_in_a_whole_figure():
    figure = tiers(of_tiers(1.0))
    assert_whole(figure)
    first, second = (line.get_ydata() for line in figure.axes[0].lines)
    assert (np.asarray(first) < np.asarray(second)).all()
    assert figure.axes[0].get_yticklabels()[0].get_text() == "Liu 2020, roll of 4°"


def test_titles_of_the_panels_on_accuracy_do_not_cross_their_letters():
    runs = {"error_displacement": 0.01, "error_moment": 0.01, "error_tension": 0.01, "wall_seconds": 0.1}
    dims = ("scene", "method", "mesh_level")
    values = {name: (dims, np.full((2, 1, 2), value)) for name, value in runs.items()}
    figure = accuracy(xr.Dataset(values, {"scene": SCENES, "method": ["ESDIRK4"]}))
    for ax, letter, scene in zip(figure.axes, "ab", SCENES, strict=True):
        assert ax.get_title() == ""
        assert ax.get_title(loc="left").startswith(f"({letter}) {in_one_line(scene)}:")
    assert_whole(figure)


def of_two_methods(seconds, errors):
    """One scene, two runs each by ESDIRK4 and Radau: times (s) and errors, (method, run)."""
    dims = ("scene", "method", "mesh_level")
    values = {f"error_{name}": (dims, [errors]) for name in ("displacement", "moment", "tension")}
    values["wall_seconds"] = (dims, [seconds])
    return xr.Dataset(values, {"scene": SCENES[:1], "method": ["ESDIRK4", "Radau"]})


def test_a_method_that_is_much_slower_at_equal_error_is_named_and_does_not_stretch_the_axes():
    errors = [[0.02, 0.0005], [0.03, 0.001]]
    (slow,) = accuracy(of_two_methods([[1.0, 2.0], [7.5, 40.0]], errors)).axes
    assert [text.get_text() for text in slow.texts] == ["Radau: at least 7 times\nthe time at equal error"]
    assert slow.get_xlim()[1] < 7.5
    (best,) = accuracy(of_two_methods([[1.0, 2.0], [7.5, 40.0]], [[0.02, 0.001], [0.03, 0.0005]])).axes
    assert best.get_xlim()[1] > 40.0  # the only one with so small an error
    (near,) = accuracy(of_two_methods([[1.0, 2.0], [3.0, 4.0]], errors)).axes
    assert not near.texts
    assert near.get_title(loc="left").endswith("all drawn methods reach 0.2 % within 4 s")


def test_shares_of_energy_are_powers_of_ten():
    over = ("case", "method", "instant")
    part = np.full((1, 2, 1), 1e-5)
    names = ("exchanged", "stored", "numerical", "unexplained")
    values = {name: (over, part if name not in names[:2] else np.ones_like(part)) for name in names}
    figure = energy(xr.Dataset(values, {"case": ["surge"], "method": ["ESDIRK4", "explicit"]}))
    for ax, words in zip(figure.axes, ("numerical dissipation", "energy residual"), strict=True):
        ticks = [label.get_text() for label in ax.get_xticklabels()]
        assert ticks == [f"$10^{{{power}}}$" for power in (-4, -2)]
        assert ax.get_title(loc="left").endswith(words)
    assert_readable(figure)


def test_variants_with_equal_stable_steps_share_a_line():
    ratio = np.array([[1.0, 1.0], [1.0, 1.0], [1.044, np.nan]])
    of = xr.Dataset(
        {
            "measured": (("variant", "mesh"), ratio),
            "predicted": (("variant", "mesh"), np.ones((3, 2))),
            "elements": (("variant", "mesh"), [[10.0, 20.0], [10.0, 20.0], [1.0, np.nan]]),
        },
        {"variant": ["surge", "drag x50", "cylinders"]},
    )
    figure = stable_step(of)
    said = [text.get_text() for text in figure.axes[0].texts]
    assert said == ["surge, drag × 50", "cylinders: measured 4.4 % longer"]
    assert headline(figure).startswith(
        "The predicted stable step is safe, and as measured in 2 of 3 variants"
    )
    assert_readable(figure)


@pytest.mark.parametrize("seed", range(6))
def test_every_difference_of_stable_steps_has_a_mark_in_the_row_of_its_variant(seed):
    draw = np.random.default_rng(seed)
    count = int(draw.integers(2, 9))
    ratio = draw.choice([1.0, 1.0, 1.02, 0.97], (count, 2))
    of = xr.Dataset(
        {
            "measured": (("variant", "mesh"), ratio * np.arange(1.0, count + 1.0)[:, None]),
            "predicted": (("variant", "mesh"), np.outer(np.arange(1.0, count + 1.0), [1.0, 1.0])),
            "elements": (("variant", "mesh"), np.tile([10.0, 20.0], (count, 1))),
        },
        {"variant": [f"variant {k}" for k in range(count)]},
    )
    ax = stable_step(of).axes[1]
    rows = [label.get_text() for label in ax.get_yticklabels()]
    marks = {str(line.get_label()): line for line in ax.lines if not str(line.get_label()).startswith("_")}
    assert [*marks] == rows == [str(name) for name in of["variant"].values]
    for k, line in enumerate(marks.values()):
        assert line.get_xdata() == pytest.approx(100.0 * ratio[k] - 100.0, abs=1e-9)
        assert set(line.get_ydata()) == {k}


def test_random_families_are_named_as_readers_know_their_papers():
    assert family_in_words("liu2020 surge in a current") == "Liu 2020, surge in a current"
    assert family_in_words("fem_riser, sudden wave") == "riser in waves, sudden wave"
    assert family_in_words("vibration in a current") == "vibration in a current"
    assert "_" not in "".join(NAMES.values())


def test_the_name_of_a_scene_that_misses_its_tolerance_covers_no_line_and_is_within_the_panel():
    of = xr.Dataset(
        {
            "true": ("drawn", [0.011, 0.002]),
            "estimated": ("drawn", [0.005, 0.004]),
            "held_out": ("drawn", [True, False]),
            "family": ("drawn", ["liu2020 surge in a current", "liu2020 roll"]),
            "work_asked": ("drawn", [1.0, 1.0]),
            "work_fixed": ("drawn", [0.5, 0.5]),
        },
        attrs={"requested": 0.01},
    )
    figure = random_scenes(of)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    ax = figure.axes[0]
    (name,) = ax.texts
    assert name.get_text() == "Liu 2020,\nsurge in a current"
    box = name.get_window_extent(canvas.get_renderer())
    assert ax.transData.transform((0.01, 0.01))[0] < box.x0
    assert box.x1 < ax.bbox.x1


def test_names_on_cost_end_within_their_panel_and_are_not_below_6_points():
    """The longest name, at a line that ends highest, with a ratio."""
    scenes = [*NAMES][:5]
    tolerances = [0.05, 0.01, 0.002, 0.0005]
    number = len(scenes) * len(tolerances)
    single = np.full((len(scenes), 1, 2), 0.01)
    over = ("scene", "method", "mesh_level")
    errors = {f"error_{q}": (over, single) for q in ("displacement", "moment", "tension")}
    reached = {
        f"reached_{q}": ("request", np.full(number, 0.001)) for q in ("displacement", "moment", "tension")
    }
    of = xr.Dataset(
        errors
        | reached
        | {
            "wall_seconds": (over, 0.1 * np.ones_like(single)),
            "requested": ("request", tolerances * len(scenes)),
            "request_scene": ("request", np.repeat(scenes, len(tolerances))),
            "request_seconds": ("request", np.geomspace(0.01, 1.0, number)),
            "request_last_seconds": ("request", np.geomspace(0.005, 0.5, number)),
        },
        {"scene": scenes, "method": ["ESDIRK4"]},
    )
    figure = cost(of)
    assert_readable(figure)
    ax = figure.axes[0]
    names = [text for text in ax.texts if text.get_text()]
    assert len(names) == len(scenes)
    renderer = FigureCanvasAgg(figure).get_renderer()
    for name in names:
        assert name.get_window_extent(renderer).x1 < ax.bbox.x1, name.get_text()
