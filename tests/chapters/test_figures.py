"""Every figure draws from its datasets, in whole, with units on its axes."""

import base64
import io
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from drawn_whole import assert_whole
from figure_rules import assert_one_finding, assert_readable, assert_units
from matplotlib.figure import Figure
from PIL import Image
from ruamel.yaml import YAML

from riserstudy.chapters import checks_of
from riserstudy.chapters.derive import derive
from riserstudy.chapters.draw import draw
from riserstudy.figures import save
from riserstudy.grading.grade import errata, grade
from riserstudy.grading.printed import with_printed
from riserstudy.grading.published import read_published
from riserstudy.grading.rows import ErratumRow, Row, table
from riserstudy.grading.rows import row_of as graded_row
from riserstudy.report.pictures import picture_of
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.models import StudyFile
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

pytestmark = pytest.mark.long

CONFIG = Path(__file__).parents[2] / "config"


class Small(NamedTuple):
    """A paper in small: axes with few points, what else its studies set; the rest is as in preview.

    ``coarser``: how many times fewer segments and longer steps prescribed meshes have.
    """

    axes: dict[str, Any]
    settings: dict[str, dict[str, Any]]
    accuracy: str = "1 %"
    coarser: int = 1


FEW = {"preview": 4, "standard": 128, "reference": 256}
PAPERS = {
    "chang2020": Small(
        {"heave_period": [2.0, 2.63, 5.0], "sample": FEW},
        {
            "period_sweep": {"analysis.duration": "40 s", "analysis.output.start": "30 s"},
            "from_rest": {"analysis.step": "0.01 s"},
        },
    ),
    "design": Small(
        {
            "mud_weight": [1100.0, 1800.0],
            "surface_speed": [0.0, 1.6],
            "significant_height": [2.0, 6.0],
            "sample": FEW,
            "phase": [0.0, 180.0],
        },
        {
            "rests": {"analysis.mesh.elements": 120},  # which others are derived from
            "varied": {"analysis.mesh.elements": 120},
            "seas": {"analysis.duration": "300 s"},
            "wellhead": {"analysis.duration": "60 s"},
            "wellhead_mesh": {"analysis.duration": "60 s"},
        },
        "2 %",
        coarser=2,
    ),
    "liu2017": Small(
        {
            "sample": FEW,
            "offset": [0.0, 100.0, 400.0],
            "surface_speed": [-1.0, 0.0, 1.0],
            "gain": [60.0, 65.9, 72.0],
            "hull_drag": [100.0, 500.0, 1000.0],
            "wave_phase": [0.0, 90.0],
        },
        {
            name: {"analysis.mesh.elements": 428, "analysis.step": "0.05 s"}
            for name in ("ref_0", "ref_180", "sat_0", "sat_180")
        },
        coarser=2,
    ),
    "liu2020": Small(
        {"sample": FEW, "wave_period": [10.0, 15.0], "roll_period": [5.0, 10.0, 20.0]},
        {
            "sea": {"analysis.duration": "900 s"},
            "statics_calibrated": {"analysis.accuracy": "1 %"},
            "surge_case": {"analysis.output.interval": "0.5 s"},
        },
        coarser=2,
    ),
    "fem_riser": Small({"sample": FEW}, {}, "5 %", coarser=4),
}
GRADED = [paper for paper in PAPERS if (CONFIG / f"published/{paper}.yaml").exists()]
FIGURES = [(paper, name) for paper in PAPERS for name in read_studies(CONFIG, paper).figures]


def small(paper, name, model):
    """A study with few points."""
    axes = dict(model.axes)
    for axis, values in PAPERS[paper].axes.items():
        if axis in axes:
            field = "count" if axis == "sample" else "preview"
            axes[axis] = axes[axis].replaced(**{field: values})
    settings = model.set | PAPERS[paper].settings.get(name, {})
    update = {"axes": axes, "set": settings, "preview": model.preview}
    return model.replaced(**coarsened(update, PAPERS[paper].coarser))


def coarsened(settings, by):
    """Settings of studies with fewer segments, of which at least 12 stay, and longer steps."""
    found = {}
    for name, value in settings.items():
        match name.rpartition(".")[2], value:
            case _, dict():
                found[name] = coarsened(value, by)
            case "elements", _:
                found[name] = max(value // by, min(value, 12))
            case "step", _:
                number, unit = value.split()
                found[name] = f"{float(number) * by} {unit}"
            case _:
                found[name] = value
    return found


@cache
def datasets_of(paper):
    """All datasets of a paper, simulated on few points."""
    file: StudyFile = read_studies(CONFIG, paper)
    made = {}
    for name, model in file.studies.items():
        study = Study(
            paper, name, small(paper, name, model), CONFIG, "preview", PAPERS[paper].accuracy, file.readings
        )
        results, _ = results_of(study, 1, lambda text: None)
        made[name] = dataset_of(study, results)
    for name, how in file.derived.items():
        sources = {source: made[source] for source in how.reads}
        made[name] = derive(paper, name, sources, with_printed(how.settings, CONFIG, paper))
    return made


@cache
def drawn(paper, name):
    """A figure."""
    model = read_studies(CONFIG, paper).figures[name]
    sources = {source: datasets_of(paper)[source] for source in model.reads}
    return draw(paper, name, sources, with_printed(model.settings, CONFIG, paper))


@pytest.fixture(scope="module")
def datasets():
    """All datasets of Chang et al."""
    return datasets_of("chang2020")


@pytest.mark.parametrize("paper, name", FIGURES)
def test_every_panel_shows_something_with_units(paper, name):
    assert_units(drawn(paper, name))


@pytest.mark.parametrize("paper, name", FIGURES)
def test_a_title_states_one_finding_in_few_words(paper, name):
    words, numbers = (12, 2) if paper in GRADED else (14, 5)
    assert_one_finding(drawn(paper, name), words, numbers)


@pytest.mark.parametrize("paper, name", [(p, n) for p, n in FIGURES if p in GRADED])
def test_text_is_not_below_6_points_on_a_page_of_180_mm(paper, name):
    assert_readable(drawn(paper, name))


@pytest.mark.parametrize("paper, name", FIGURES)
def test_nothing_is_cut_off(paper, name):
    assert_whole(drawn(paper, name))


@pytest.mark.parametrize("paper", GRADED)
def test_every_paper_is_graded_from_its_datasets(paper):
    file = read_published(CONFIG, paper, datasets_of(paper))
    rows = [graded_row(of) for of in grade(file, datasets_of(paper), checks_of(paper))]
    assert [row.id for row in rows] == [item.id for item in file.items]
    for row in rows:
        assert (row.verdict == "depends") == bool(row.depends_on)
    assert "{" not in table(errata(file, datasets_of(paper), checks_of(paper)), ErratumRow)
    assert table(rows, Row).count("\n") == len(rows) + 1


def test_figures_are_written_whole(tmp_path):
    save(drawn("chang2020", "fig14"), *(tmp_path / f"a.{kind}" for kind in ("png", "pdf", "csv")))
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")
    assert {path.name for path in tmp_path.iterdir()} == {"a.png", "a.pdf", "a.csv"}


def test_a_figure_says_what_is_seen_and_gives_its_values(tmp_path):
    figure = Figure()
    ax = figure.subplots()
    ax.plot([0.0, 1.0, 2.0], [3.0, np.nan, 5.0], label="measured")
    ax.set_title("Tension falls when the platform sinks")
    ax.set_xlabel("time (s)")
    ax.set_ylabel("tension (N)")
    save(figure, tmp_path / "a.png", tmp_path / "a.csv")
    with Image.open(tmp_path / "a.png") as image:
        assert image.text["Title"] == "Tension falls when the platform sinks"
        assert image.text["Description"].endswith("tension (N) over time (s): measured.")
    rows = (tmp_path / "a.csv").read_text().splitlines()
    assert rows[0] == "panel,x,y,series,x_value,y_value,colour_value"
    title = "Tension falls when the platform sinks,time (s),tension (N),measured"
    assert rows[1:] == [f"{title},0,3,", f"{title},1,,", f"{title},2,5,"]


@pytest.mark.parametrize("lines", [0, 1, 3])
def test_a_page_shows_all_of_a_figure_but_its_title(tmp_path, lines):
    figure = Figure(layout="constrained")
    ax = figure.subplots()
    ax.plot([0.0, 1.0], [0.0, 1.0], color="#ff0000")
    ax.set_title("(a) panel", loc="left")
    if lines:
        figure.suptitle("\n".join(["finding"] * lines), color="#0000ff")
    save(figure, tmp_path / "a.png")
    with Image.open(tmp_path / "a.png") as image:
        whole = np.asarray(image.convert("RGB")).astype(int)
    shown = picture_of(tmp_path / "a.png")
    data = base64.b64decode(shown.address.partition(",")[2])
    with Image.open(io.BytesIO(data)) as image:
        page = np.asarray(image.convert("RGB")).astype(int)
    assert page.shape[0] == shown.height

    def ink(pixels, channel):
        others = [k for k in range(3) if k != channel]
        return int(((pixels[..., channel] > 150) & (pixels[..., others].max(axis=-1) < 100)).sum())

    assert (ink(whole, 2) > 0) == (lines > 0)
    assert ink(page, 2) == 0  # nothing of the title
    assert ink(page, 0) == pytest.approx(ink(whole, 0), rel=0.02)  # all of the curve
    assert (page.min(axis=-1) < 128).sum() > 0.9 * ((whole.min(axis=-1) < 128).sum() - ink(whole, 2))


def test_the_shares_of_samples_are_those_on_the_side_of_the_claim():
    figure = drawn("liu2020", "baselines")
    readings = datasets_of("liu2020")["statics_readings"]["largest_displacement"]
    moved = readings.sel(surface_speed=1.0)
    further = moved > moved.sel(tensioner_model="gas law")
    rows = [t.get_text().replace("\n", " ") for t in figure.axes[0].get_yticklabels()]
    said = [text.get_text() for text in figure.axes[0].texts]
    name = "vertical force at the ring"
    share = 100.0 * float(further.sel(tensioner_model=name).mean())
    assert said[rows.index(name)] == f"{share:.0f} %"


def test_all_figures_of_the_paper_that_show_results_are_drawn():
    printed = {f"fig{k:02d}" for k in (5, 6, 8, 9, 10, 11, 12, 13, 14)}
    assert printed <= {name for paper, name in FIGURES if paper == "chang2020"}


def test_what_must_come_out_whatever_the_numbers(datasets):
    """Two percentages cannot be one, a gas law is convex: in every sample, few as they are here."""
    file = read_published(CONFIG, "chang2020", datasets)
    cases = {of.id: of.cases for of in grade(file, datasets, checks_of("chang2020"))}
    table = datasets["reductions"]["reduction"]
    np.testing.assert_allclose(table.sel(quantity="heave"), table.sel(quantity="tension"), atol=1e-9)
    assert all(case.met for claim in ("A3", "A4") for case in cases[claim])


def test_the_asymmetry_dataset_is_as_promised(datasets):
    index = datasets["asymmetry"]["asymmetry_index"]
    assert set(index.dims) == {"reading", "tensioner_model", "heave_amplitude"}
    assert set(index["reading"].values) == {"steady", "from_rest", "quasi_static"}
    assert datasets["asymmetry"]["heave_amplitude"].attrs["units"] == "m"
    assert datasets["asymmetry"].sel(heave_amplitude=5).sizes["reading"] == 3


def test_preview_grids_hold_what_figures_and_checks_need():
    """Amplitudes of the text: 2.5, 3, 5, 10 m and the assumed 1 m."""
    file = YAML(typ="safe").load(CONFIG / "studies" / "chang2020.yaml")
    for study in file["studies"].values():
        axis = study["axes"].get("heave_amplitude", {})
        if "preview" in axis:
            assert set(axis["preview"]) >= {1, 2.5, 3, 5, 10}


def test_the_heave_dataset_is_as_promised():
    found = datasets_of("liu2020")["heave"]
    force = found["axial_force_amplitude"]
    assert force.dims == ("heave_amplitude", "heave_period")
    assert force.attrs["units"] == "N"
    assert force.sizes == found["axial_force_amplitude_linear"].sizes
    assert float(found["settling"].max()) < 0.005


def test_the_roll_dataset_is_as_promised():
    found = datasets_of("liu2020")["roll"]["largest_bending_moment"]
    assert found.dims == ("roll_amplitude", "roll_period")
    assert found.attrs["units"] == "N m"
    # the number that the centre of rotation is tuned to, at the accuracy of a preview
    assert float(found.sel(roll_amplitude=4, roll_period=10)) == pytest.approx(32.8e3, rel=0.02)


def test_shares_of_stress_sum_to_one():
    share = datasets_of("liu2020")["rao"]["stress_share"]
    assert set(share["motion"].values) == {"surge", "heave", "pitch"}
    assert np.allclose(share.sum("motion"), 1.0)
