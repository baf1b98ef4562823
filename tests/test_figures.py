"""Every figure draws from its datasets, in whole, with units on its axes."""

import re
from pathlib import Path

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from ruamel.yaml import YAML

from riserstudy.derived import derive
from riserstudy.figures import draw, save
from riserstudy.gather import dataset_of, results_of
from riserstudy.published.grading import ErratumRow, Row, errata, grade, table
from riserstudy.published.models import read_published
from riserstudy.study import Study, StudyFile, read_studies

CONFIG = Path(__file__).parents[1] / "config"
PAPER = "chang2020"
FIGURES = list(read_studies(CONFIG, PAPER).figures)
#: axes in small; the others are as in preview
SMALL = {
    "heave_period": [2.0, 2.63, 5.0],
    "sample": {"preview": 4, "standard": 128, "reference": 256},
}
SETTINGS = {"period_sweep": {"analysis.duration": "40 s", "analysis.output.start": "30 s"}}
UNIT = re.compile(r"\((m|s|MN|MN/m|-|%)\)")


def small(name, model):
    """A study with few points."""
    axes = dict(model.axes)
    for axis, values in SMALL.items():
        if axis in axes:
            field = "count" if axis == "sample" else "preview"
            axes[axis] = axes[axis].model_copy(update={field: values})
    settings = model.set | SETTINGS.get(name, {})
    if name == "from_rest":
        settings |= {"analysis.step": "0.01 s"}
    return model.model_copy(update={"axes": axes, "set": settings})


@pytest.fixture(scope="module")
def datasets():
    """All datasets of the paper, simulated on few points."""
    file: StudyFile = read_studies(CONFIG, PAPER)
    made = {}
    for name, model in file.studies.items():
        study = Study(PAPER, name, small(name, model), CONFIG, "preview")
        results, _ = results_of(study, 1, lambda text: None)
        made[name] = dataset_of(study, results)
    for name, sources in file.derived.items():
        made[name] = derive(PAPER, name, {source: made[source] for source in sources})
    return made


@pytest.fixture(scope="module")
def drawn(datasets):
    """All figures."""
    file = read_studies(CONFIG, PAPER)
    return {
        name: draw(PAPER, name, {source: datasets[source] for source in figure.reads})
        for name, figure in file.figures.items()
    }


@pytest.mark.parametrize("name", FIGURES)
def test_every_panel_shows_something_with_units(drawn, name):
    figure = drawn[name]
    labels = [figure.get_supxlabel(), figure.get_supylabel()]
    for ax in figure.axes:
        assert ax.lines or ax.patches or ax.collections
        assert ax.get_ylabel() or figure.get_supylabel() or ax.get_shared_y_axes().get_siblings(ax)
        labels += [ax.get_xlabel(), ax.get_ylabel()]
    written = [label for label in labels if label]
    assert written
    for label in written:
        assert UNIT.search(label), label


@pytest.mark.parametrize("name", FIGURES)
def test_nothing_is_cut_off(drawn, name):
    figure = drawn[name]
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    inside = figure.get_tightbbox(canvas.get_renderer())
    width, height = figure.get_size_inches()
    assert inside.x0 >= -0.01
    assert inside.y0 >= -0.01
    assert inside.x1 <= width + 0.01
    assert inside.y1 <= height + 0.01


def test_figures_are_written_whole(drawn, tmp_path):
    save(drawn["fig14"], tmp_path / "a.png", tmp_path / "a.pdf")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")
    assert {path.name for path in tmp_path.iterdir()} == {"a.png", "a.pdf"}


def test_all_figures_of_the_paper_that_show_results_are_drawn():
    assert {f"fig{k:02d}" for k in (5, 6, 8, 9, 10, 11, 12, 13, 14)} <= set(FIGURES)


def test_the_paper_is_graded_from_its_datasets(datasets):
    file = read_published(CONFIG, PAPER, datasets)
    rows = {row.id: row for row in grade(file, datasets)}
    assert list(rows) == [item.id for item in file.items]
    # What must come out whatever the numbers: two percentages cannot be one, a gas law is convex.
    assert rows["A13"].verdict == "fails"
    assert rows["A3"].verdict == rows["A4"].verdict == "holds"
    for row in rows.values():
        assert (row.verdict == "depends") == bool(row.depends_on)
    assert "{" not in table(errata(file, datasets), ErratumRow)
    assert table(rows.values(), Row).count("\n") == len(rows) + 1


def test_the_asymmetry_dataset_is_as_promised(datasets):
    index = datasets["asymmetry"]["asymmetry_index"]
    assert set(index.dims) == {"reading", "tensioner_model", "heave_amplitude"}
    assert set(index["reading"].values) == {"steady", "from_rest", "quasi_static"}
    assert datasets["asymmetry"]["heave_amplitude"].attrs["units"] == "m"
    assert datasets["asymmetry"].sel(heave_amplitude=5).sizes["reading"] == 3


def test_preview_grids_hold_what_figures_and_checks_need():
    """Amplitudes of the text: 2.5, 3, 5, 10 m and the assumed 1 m."""
    file = YAML(typ="safe").load(CONFIG / "studies" / f"{PAPER}.yaml")
    for study in file["studies"].values():
        axis = study["axes"].get("heave_amplitude", {})
        if "preview" in axis:
            assert set(axis["preview"]) >= {1, 2.5, 3, 5, 10}
