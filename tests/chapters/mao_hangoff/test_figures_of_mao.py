"""Figures and grades of Mao's chapter, from few and coarse runs."""

import re
from functools import cache

import numpy as np
import pytest
import xarray as xr
from colours_of_chapters import base_of
from drawn_whole import assert_whole
from figure_rules import assert_one_finding, assert_readable, assert_units
from mao import CONFIG, FILE, PAPER, WEIGHTS, WORD
from matplotlib.colors import to_hex, to_rgb
from matplotlib.lines import Line2D

from chapters.mao_hangoff.claims.towed import loads_small_at_the_lmrp
from chapters.mao_hangoff.derived.towed import end_loads, reference_masses
from riserstudy.chapters import checks_of
from riserstudy.chapters.derive import derive
from riserstudy.chapters.draw import draw
from riserstudy.figures.figure_text import headline
from riserstudy.grading.grade import errata, grade
from riserstudy.grading.printed import with_printed
from riserstudy.grading.published import read_published
from riserstudy.grading.rows import ErratumRow, table
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.study import Study

pytestmark = pytest.mark.long


@pytest.mark.long
def test_loads_are_those_of_the_slip_at_both_ends(datasets):
    """Against 1 m/s at 1 m/s the joint meets 2 m/s; C_D 1.2 and 0.7, no current at the LMRP."""
    readings = datasets["readings"]
    base = {name: readings[name].values[0] for name in ("riser_weight", "flow", "current_profile")}
    loads = end_loads(readings).sel(base)
    assert loads["load_at_joint"].values == pytest.approx(-0.5 * 1025.0 * 1.2 * 0.5334 * 4.0, rel=1e-6)
    x = readings["x"].sel(base).isel(s=0)
    speed = (x.sel(time=130.0) - x.sel(time=120.0)) / 10.0
    there = -0.5 * 1025.0 * 0.7 * 0.5334 * speed**2
    np.testing.assert_allclose(loads["load_at_lmrp"], there, rtol=1e-9)
    found = loads_small_at_the_lmrp(loads, WORD("considerable"))
    assert bool(found.true) == (float(found.value) < 0.75)


def test_the_case_without_open_inputs_stands_beside_the_printed_numbers(datasets):
    runs = datasets["hangoff_ref"]
    both = reference_masses(runs)
    for mass, name in ((140.0, "hangoff_ref"), (120.0, "hangoff_ref_120t")):
        xr.testing.assert_equal(
            both["x"].sel(lmrp_mass=mass, drop=True), runs["x"].sel(variant=name, drop=True)
        )


FEW = {name: dict(list(labels.items())[:2]) for name, labels in FILE.readings.items()}
COARSE = {"analysis.accuracy": None, "analysis.mesh": {"elements": 20}, "analysis.step": "0.5 s"}
STATIC = ("steady", "pe_pipe")


def little(name, model):
    axes = dict(model.axes)
    if "sample" in axes:
        axes["sample"] = axes["sample"].replaced(count={"preview": 2})
    if name == "variants":
        return model
    settings = {"analysis.mesh": {"elements": 20}} if name in STATIC else COARSE
    return model.replaced(axes=axes, set=model.set | settings, preview={})


@pytest.fixture(scope="module")
def datasets():
    made = {}
    for name, model in FILE.studies.items():
        readings = FEW | {"track": FILE.readings["track"]}
        if name == "readings":  # errata tell every flow
            readings |= {"flow": FILE.readings["flow"]}
        study = Study(PAPER, name, little(name, model), CONFIG, "preview", "5 %", readings)
        made[name] = dataset_of(study, results_of(study, 1, lambda text: None)[0])
    for name, how in FILE.derived.items():
        sources = {source: made[source] for source in how.reads}
        made[name] = derive(PAPER, name, sources, with_printed(how.settings, CONFIG, PAPER))
    return made


@pytest.fixture(scope="module")
def drawn(datasets):
    """Figures by name, each drawn once."""

    @cache
    def of(name):
        model = FILE.figures[name]
        settings = with_printed(model.settings, CONFIG, PAPER)
        return draw(PAPER, name, {key: datasets[key] for key in model.reads}, settings)

    return of


def test_a_reading_of_the_weight_has_one_colour_in_both_figures(drawn):
    colours = []
    for name in ("readings", "open_choices"):
        figure = drawn(name)
        lines = figure.axes[0].get_lines()
        named = {line: str(line.get_label()).removeprefix("weight: ") for line in lines}
        weights = {line: re.split(r"; | \(", name)[0] for line, name in named.items()}
        colours.append({n: line.get_color() for line, n in weights.items() if n in WEIGHTS})
    both = colours[0].keys() & colours[1].keys()
    assert both
    assert {name: colours[0][name] for name in both} == {name: colours[1][name] for name in both}


@pytest.mark.parametrize("name", FILE.figures)
def test_a_figure_has_units_a_short_title_and_readable_text(drawn, name):
    figure = drawn(name)
    if name != "fig08":  # of whose profiles few are simulated here, so that panels are empty
        assert_units(figure)
    assert_one_finding(figure)
    assert_readable(figure)


@pytest.mark.parametrize("name", FILE.figures)
def test_a_figure_has_the_colours_of_its_chapter_only(drawn, name):
    figure = drawn(name)
    for line in figure.findobj(Line2D):
        assert base_of(PAPER, line.get_color()), to_hex(line.get_color())


@pytest.mark.parametrize("name", FILE.figures)
def test_lines_are_the_darker_the_larger_their_number(drawn, name):
    """Those of one panel whose names differ by their first number alone, and that have a colour."""
    named = {}
    for ax in drawn(name).axes:
        for line in ax.get_lines():
            label = str(line.get_label())
            number = re.search(r"\d+(\.\d+)?", label)
            base = base_of(PAPER, line.get_color())
            if number and not label.startswith("_") and base != "neutral":
                rest = label[: number.start()], base
                named.setdefault((ax, rest), {})[float(number[0])] = line.get_color()
    for of_one in named.values():
        light = [np.dot((0.2126, 0.7152, 0.0722), to_rgb(of_one[n])) for n in sorted(of_one)]
        assert (np.diff(light) < 0.0).all(), of_one
    ordered = {"fig04", "fig07", "fig08", "fig09", "fig11", "fig12", "fig13", "fig14"}
    assert (name not in ordered) or max(map(len, named.values())) >= 2


def test_dash_dotted_lines_of_tracks_are_in_the_key(drawn):
    figure = drawn("fig13")
    lines = [line for line in figure.axes[0].get_lines() if line.get_linestyle() == "-."]
    shown = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
    assert len(lines) > 1
    assert [line.get_label() for line in lines if line.get_label() in shown]


def test_the_limit_that_governs_everywhere_is_named_with_its_value(datasets):
    """As the study file has it; where several govern, a key names them."""
    made = datasets["speed_limits"]
    alone = made.assign(governing_limit=xr.zeros_like(made["governing_limit"]))
    for angle, words in (("9 deg", "9° (assumed)"), ("5.5 deg", "5.5° (assumed)")):
        alone.attrs["settings"] = made.attrs["settings"].replace('"9 deg"', f'"{angle}"')
        figure = draw(PAPER, "speed_limits", {"speed_limits": alone}, {})
        (text,) = figure.axes[0].texts
        assert text.get_text().endswith(words)
        assert not figure.legends
    several = alone.copy(deep=True)
    several["governing_limit"][0, 0, 0] = 1.0
    figure = draw(PAPER, "speed_limits", {"speed_limits": several}, {})
    assert not figure.axes[0].texts
    (key,) = figure.legends
    assert [t.get_text() for t in key.get_texts()] == ["joint angle governs", "clearance governs"]


@pytest.mark.parametrize("seed", range(6))
def test_a_line_of_hang_off_shows_the_worst_length_and_ends_where_no_heave_loses_tension(datasets, seed):
    draws = np.random.default_rng(seed)
    made = datasets["tension_limits"].copy(deep=True)
    lost = made["heave_that_loses_tension"]
    most = float(made["heave_amplitude"].max())
    lost[:] = np.where(draws.random(lost.shape) < 0.5, np.nan, draws.uniform(1.0, most, lost.shape))
    figure = draw(PAPER, "hang_off", {"tension_limits": made}, {})
    ax = figure.axes[2]
    for line, mass in zip(ax.lines, lost["lmrp_mass"].values, strict=False):
        by_period = lost.sel(mode="hard", lmrp_mass=mass).transpose("heave_period", ...).values
        worst = [min((v for v in at.ravel() if v == v), default=None) for at in by_period]
        seen = [None if v != v else v for v in np.asarray(line.get_ydata(), float)]
        assert seen == worst
    assert f"no line: tension stays positive up to {most:g} m" in {text.get_text() for text in ax.texts}


def test_a_heave_that_never_loses_tension_has_no_line(datasets):
    made = datasets["tension_limits"].copy(deep=True)
    made["heave_that_loses_tension"][:] = np.nan
    figure = draw(PAPER, "hang_off", {"tension_limits": made}, {})
    assert not any(np.isfinite(np.asarray(line.get_ydata(), float)).any() for line in figure.axes[2].lines)


@pytest.mark.parametrize(
    "soft, hard, title",
    [
        (None, 3.3, "With {}, only locked risers' tension becomes negative, from 3.3 m heave amplitude"),
        (
            11.0,
            4.0,
            "With the heaviest LMRP, tension becomes negative from 4.0 m if locked, 11 m on tensioners",
        ),
        (11.0, None, "With {}, only tension on tensioners becomes negative, from 11 m amplitude"),
        (None, None, "With {} no riser's tension becomes negative"),
    ],
)
def test_the_title_of_a_hang_off_is_of_the_lmrp_of_the_upper_panels(datasets, soft, hard, title):
    """The first riser with this LMRP is the worst; a lighter LMRP, only in (c) and (d), is worse."""
    made = datasets["tension_limits"].copy(deep=True)
    lost = made["heave_that_loses_tension"]
    lost[:] = np.nan
    lost.loc[{"lmrp_mass": lost["lmrp_mass"][0]}] = 1.0
    heaviest = {"lmrp_mass": lost["lmrp_mass"][-1]}
    for mode, least in (("soft", soft), ("hard", hard)):
        if least is not None:
            lost.loc[{"mode": mode} | heaviest] = least + 1.0
            first = {dim: lost[dim][0] for dim in ("riser_length", "heave_period")}
            lost.loc[{"mode": mode} | heaviest | first] = least
    figure = draw(PAPER, "hang_off", {"tension_limits": made}, {})
    assert headline(figure) == title.format("the 140 t LMRP")
    assert_one_finding(figure)
    assert all(ax.get_title(loc="left").endswith(", 140 t") for ax in figure.axes[:2])


@pytest.mark.parametrize("name", FILE.figures)
def test_every_figure_is_drawn_whole_with_units(drawn, name):
    figure = drawn(name)
    assert_whole(figure)
    for ax in figure.axes:
        for label in (ax.get_xlabel(), ax.get_ylabel()):
            assert not label or label.endswith(")") or " / " in label, label


def test_everything_is_graded(datasets):
    file = read_published(CONFIG, PAPER, datasets)
    cases = {of.id: of.cases for of in grade(file, datasets, checks_of(PAPER))}
    assert list(cases) == [item.id for item in file.items]
    # What must come out whatever the numbers, in every sample: one heave has one frequency.
    assert all(case.met for case in cases["C7"])
    assert "{" not in table(errata(file, datasets, checks_of(PAPER)), ErratumRow)
