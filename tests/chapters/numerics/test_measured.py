"""Energy over time, tiers, long runs and random scenes: measured in small, told as they come out."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.numerics.figures.stable_step import answer
from chapters.numerics.measured import random_scenes as module_of_random_scenes
from chapters.numerics.measured import tiers as module_of_tiers
from chapters.numerics.measured.energy import energy
from chapters.numerics.measured.long_runs import long_runs
from chapters.numerics.measured.long_runs import wanted as references_of_long_runs
from chapters.numerics.measured.papers_settings import papers_settings
from chapters.numerics.measured.random_scenes import draw as drawn
from chapters.numerics.measured.random_scenes import random_scenes
from chapters.numerics.measured.tiers import tiers
from chapters.numerics.reference import store
from chapters.numerics.report.section import section
from riserstudy.chapters.draw import draw
from riserstudy.errors import InputError
from riserstudy.study.measured import Setting
from riserstudy.study.read import read_studies

CONFIG = Path(__file__).parents[3] / "config"
MEASURED = read_studies(CONFIG, "numerics").measured
CHANG = "chang2020 heave"


def only(study, field, *names, **update):
    """The study with some of its cases."""
    some = {name: getattr(study, field)[name] for name in names}
    return study.replaced(**{field: some}, **update)


def with_references(folder, name, wanted, study):
    """A configuration folder with the references of a study that is not that of the repository."""
    (folder / "scenes").symlink_to(CONFIG / "scenes")
    for one in wanted(study, folder):
        store.write(folder, name, one.compute())
    return folder


def test_energy_is_accounted_for_by_every_method():
    study = only(MEASURED["energy"], "cases", "surge", instants={"preview": 2})
    found = energy(study, Setting(CONFIG, "preview"))
    assert (found["message"] == "").all()
    assert (abs(found["unexplained"]) < 1e-3 * found["exchanged"]).all()
    assert (found["dissipated"] > 0.0).all()
    assert draw("numerics", "energy", {"energy": found}).axes


def test_less_spectral_radius_dissipates_more():
    study = only(MEASURED["energy"], "cases", "undamped for 1000 s", instants={"preview": 1})
    lost = energy(study, Setting(CONFIG, "preview"))["numerical"].isel(case=0, instant=0)
    assert float(lost.sel({"method": "gen.-alpha 0.8"})) > 0.0
    whole, none = (abs(float(lost.sel({"method": f"gen.-alpha {r}"}))) for r in (0.8, 1))
    assert none < 1e-3 * whole


def test_finer_tiers_estimate_smaller_errors(monkeypatch):
    # references are recomputed in a test of theirs
    monkeypatch.setattr(module_of_tiers, "with_recomputed", lambda dataset, *_: dataset)
    study = only(MEASURED["tiers"], "scenes", "Chang 2020, heave of 5 m")
    found = tiers(study, Setting(CONFIG, "reference")).isel(scene=0)
    assert (np.diff(found["estimated"]) < 0.0).all()
    assert float(found["estimated"].sel(tier="reference")) <= 5e-4
    assert (found["error"] < found["estimated"]).any("quantity").all()
    assert (np.diff(found["error"].max("quantity")) < 0.0).all()
    for some in (found, found.isel(tier=[0])):
        assert draw("numerics", "tiers", {"tiers": some.expand_dims("scene")}).axes


@pytest.mark.long
def test_a_papers_own_setting_is_drawn_beside_ours(tmp_path):
    case = MEASURED["long_runs"].cases["46 hours"]
    cut = {"analysis.duration": "10 s", "analysis.output": {"interval": "0.5 s"}}
    case = case.replaced(elements=[100], graded=1, steps=[0.5], set=cut, preview=None)
    study = MEASURED["long_runs"].replaced(cases={"46 hours": case})
    config = with_references(tmp_path, "long_runs", references_of_long_runs, study)
    found = long_runs(study, Setting(config, "standard", 2))
    theirs = MEASURED["papers_settings"].cases["46 hours"]
    theirs = theirs.replaced(own=theirs.own.replaced(step=0.01), set=cut)
    study = MEASURED["papers_settings"].replaced(cases={"46 hours": theirs})
    of_paper = papers_settings(study, Setting(config, "standard"))
    none = papers_settings(study, Setting(config, "preview"))
    none.to_netcdf(tmp_path / "none.nc")
    with xr.open_dataset(tmp_path / "none.nc") as none:
        assert none.sizes["run"] == 0
        shortened = found.assign(published_seconds=found["published_seconds"].where(False))
        figure = draw("numerics", "long_runs", {"long_runs": shortened, "papers_settings": none})
        assert not any("paper" in text.get_text() for text in figure.legends[0].get_texts())
        assert "46" not in figure.axes[0].get_title(loc="left")
    both = {"long_runs": found, "papers_settings": of_paper}
    labels = found["mesh"].values.tolist()
    assert of_paper["method"].values.tolist() == ["the paper's own"]
    assert len(labels) == 2 * len(case.methods)
    for rows in both.values():
        assert (rows["wall_seconds"] > 0.0).all()
        assert (rows["error_moment"] < 1.0).all()
    figure = draw("numerics", "long_runs", both)
    assert any("paper" in text.get_text() for text in figure.legends[0].get_texts())
    said = figure.get_suptitle()
    assert said == "0 of 1 long simulations reach a moment error below 1 %"
    for mesh, words in (
        ("graded", "In long simulations, only graded meshes reach a moment error below 1 %"),
        ("even", "1 of 1 long simulations reach a moment error below 1 %"),
    ):
        good = [row for row, label in enumerate(labels) if label == mesh]
        met = found.copy(deep=True)
        met["error_moment"][:] = 0.5
        met["error_moment"][good[0]] = 0.005
        assert draw("numerics", "long_runs", both | {"long_runs": met}).get_suptitle() == words
    assert " run of the long simulation “46 hours” " in section({"long_runs": found}).sentences[0]


def key_of_random_scenes(found):
    """All that the figure's key says."""
    figure = draw("numerics", "random_scenes", {"random_scenes": found})
    return " ".join(text.get_text() for text in figure.legends[0].get_texts())


def test_random_scenes_are_the_same_every_time_and_half_are_held_out():
    study = only(MEASURED["random_scenes"], "families", CHANG)
    draws = [list(drawn(CHANG, study.families[CHANG], study, CONFIG, "standard")) for _ in "ab"]
    assert [one.sets for one in draws[0]] == [one.sets for one in draws[1]]
    assert len({str(one.sets) for one in draws[0]}) == study.count["standard"]
    assert sum(one.held_out for one in draws[0]) == study.count["standard"] // 2


def test_a_request_is_judged_by_its_true_error_and_the_cheapest_that_errs_no_more():
    found = random_scenes(only(MEASURED["random_scenes"], "families", CHANG), Setting(CONFIG, "preview", 1))
    assert (found["message"] == "").all()
    assert (found["true"] > 0.0).all()
    there = found.where(found["fixed_elements"] > 0, drop=True)
    assert there.sizes["drawn"] > 0
    assert (there["fixed_error"] <= there["true"]).all()
    assert (there["work_fixed"] <= there["work_asked"]).all()
    assert "above the tolerance" not in key_of_random_scenes(found)
    missed = found.assign(true=found["true"] + 0.02)
    assert "error above the tolerance" in key_of_random_scenes(missed)
    assert (
        section({"random_scenes": found})
        .sentences[0]
        .startswith(
            "2 random scenes were run with a tolerance of 1 %. The engine refused none of the random scenes"
        )
    )


@pytest.mark.parametrize("tier", ["preview", "standard", "reference"])
def test_every_scene_that_may_be_drawn_can_be_meant(tier):
    study = MEASURED["random_scenes"]
    for name, family in study.families.items():
        for one in drawn(name, family, study, CONFIG, tier):
            try:
                one.file.resolved()
            except InputError as error:
                pytest.fail(f"{name}: {error}")


def test_a_request_that_takes_long_is_a_row_that_says_so():
    study = only(MEASURED["random_scenes"], "families", CHANG)
    hasty = study.replaced(patience={"preview": 1e-9})
    found = random_scenes(hasty, Setting(CONFIG, "preview", 1))
    assert (found["message"] != "").all()
    assert not found["is_refused"].any()
    assert found["true"].isnull().all()
    said = section({"random_scenes": found}).sentences[0]
    assert (
        "refused none of the random scenes, and 2 could not be judged, because a run took too long or" in said
    )


def test_a_scene_without_a_usable_reference_is_not_judged_and_the_engine_does_not_refuse_it(monkeypatch):
    def damaged(*_):
        raise store.NotUsed("the reference solution is damaged")

    monkeypatch.setattr(module_of_random_scenes, "read", damaged)
    monkeypatch.setattr(module_of_random_scenes, "with_recomputed", lambda dataset, *_: dataset)
    found = random_scenes(only(MEASURED["random_scenes"], "families", CHANG), Setting(CONFIG, "preview", 1))
    said = section({"random_scenes": found}).sentences[0]
    assert "refused none of the random scenes, and 2 could not be judged" in said


def test_the_figure_of_energy_says_how_far_the_balance_is_off_and_who_dissipates():
    dims = ("case", "method", "instant")
    parts = {
        "exchanged": [[[50.0, 100.0], [50.0, 100.0]]],
        "stored": [[[10.0, -200.0], [10.0, 20.0]]],
        "numerical": [[[0.0, 4.0], [5.0, 1.0]]],  # 2 % of 200, 5 % of 100
        "unexplained": [[[0.0, 0.0], [0.03, -0.01]]],
    }
    found = xr.Dataset(
        {name: (dims, values) for name, values in parts.items()},
        {"case": ["swing"], "method": ["one", "other"]},
    )
    figure = draw("numerics", "energy", {"energy": found})
    assert figure.get_suptitle() == ("Energy residuals are at most 0.03 %; other dissipates up to 5 %")
    marks = [line.get_xdata() for line in figure.axes[0].lines if line.get_label() == "one"]
    assert float(marks[0][0]) == pytest.approx(0.02)


@pytest.mark.parametrize(
    "ends, said",
    [
        ((0.9998, 1.0004), "is as predicted, to 0.6 %"),
        ((1.0, 1.044), "is safe, and as measured in 1 of 2 variants"),
        ((0.97, 1.044), "predicted stable step is up to 3.0 % too long"),
    ],
)
def test_the_title_of_the_stable_step_says_whether_the_prediction_is_safe(ends, said):
    assert answer(xr.DataArray(list(ends), dims="variant")).endswith(said)
