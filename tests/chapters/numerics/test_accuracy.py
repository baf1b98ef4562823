"""Error against time: references that deserve the name, every method a row, errors that fall."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.numerics.attempt import Attempt
from chapters.numerics.figures.cost import answer
from chapters.numerics.measured import accuracy as module
from chapters.numerics.measured.accuracy import Request, accuracy, judged, requests, scene_of
from chapters.numerics.outcome import Outcome
from chapters.numerics.references import Reference, by_run, differences, solved, stored
from riserstudy.chapters.draw import draw
from riserstudy.dataset.result import Result
from riserstudy.study.measured import Setting
from riserstudy.study.read import read_studies

pytestmark = pytest.mark.long

CONFIG = Path(__file__).parents[3] / "config"
STUDY = read_studies(CONFIG, "numerics").measured["accuracy"]
HISTORY = CONFIG.parent / "tests/verification/data/S2c.npz"
SHORT = {"analysis.duration": "20 s"}
LADDER = STUDY.scenes["S2c"].replaced(
    set=STUDY.scenes["S2c"].set | SHORT, elements=[16, 32], steps=[0.4, 0.2, 0.1]
)


@pytest.fixture(scope="module")
def surge():
    """Scene S2c, short, on two meshes by every method."""
    few = {"scenes": {"S2c": LADDER}, "repeats": {"standard": 1}, "requested": {"standard": [0.05]}}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("chapters.numerics.outside.PATIENCE", 60.0)  # as long as it takes
        return accuracy(STUDY.replaced(**few), Setting(CONFIG, "standard"))


def test_every_method_has_a_row_with_an_error_or_a_message(surge):
    for method in surge["method"].values:
        of = surge.sel({"scene": "S2c", "method": method})
        ran = of["error_displacement"].notnull()
        assert bool((ran | (of["message"] != "")).all())
        assert bool(ran.any())


def test_the_stored_reference_and_a_fine_run_of_ours_agree():
    ladder, best = LADDER, stored(HISTORY)
    own = differences(best, scene_of(CONFIG, "S2c", ladder), ladder)["lumped masses, ESDIRK4"]
    assert best.about.startswith("stored: S2c: 80 quintic Hermite elements")
    assert max(own["displacement"], own["tension"]) < 1e-3
    assert own["moment"] < 5e-3  # 64 even segments


def test_our_own_reference_has_converged_where_another_code_says_the_same():
    file = scene_of(CONFIG, "S2c", LADDER)
    met = requests(file, "S2c", [0.01], 60.0)
    assert met[0].result is not None
    kept = solved("S2c", file, LADDER)
    own = Reference("own", by_run(kept.result).errors, kept.error)
    other = stored(HISTORY)
    assert max(own.change.values()) < 2e-3
    # the last halving changed three times what is left of an error of second order
    reached, true = judged(met[0], own), other.errors(met[0].result)
    for name in ("displacement", "moment", "tension"):
        assert abs(reached[f"reached_{name}"] - true[name]) < own.change[name] + 5e-4


def test_semi_implicit_euler_moves_as_verlet_does(surge):
    """From rest they are one recursion of positions; steps that end at the outputs are a little shorter."""
    one, other = (
        surge["error_moment"].sel({"method": m}).isel(step_level=0) for m in ("Verlet", "semi-implicit Euler")
    )
    np.testing.assert_allclose(one, other, rtol=0.05)


def test_radau_at_finer_tolerances_comes_to_the_limit_of_the_lumped_mesh(surge):
    error = surge["error_displacement"].sel({"method": "Radau"}).isel(mesh_level=-1, scene=0)
    verlet = surge["error_displacement"].sel({"method": "Verlet"}).isel(mesh_level=-1, scene=0)
    assert abs(float(error[1] / verlet[0]) - 1.0) < 0.05


def test_at_the_longest_step_the_fourth_order_method_errs_least(surge):
    error = surge["error_displacement"].isel(mesh_level=-1, scene=0, step_level=0)
    second, fourth = (float(error.sel({"method": m})) for m in ("gen.-alpha 0.8", "ESDIRK4"))
    assert fourth < 0.3 * second  # what is left is the mesh's


def test_a_reference_refuses_outputs_that_it_has_not(surge):
    measure = stored(CONFIG / STUDY.scenes["S2c"].stored)
    run = type("Run", (), {"arrays": {"time": np.array([0.0, 0.03])}})
    with pytest.raises(Exception, match="outputs at times"):
        measure.errors(run)


def test_both_figures_are_drawn_from_it(surge):
    for name in ("accuracy", "requested"):
        assert draw("numerics", name, {"accuracy": surge}).axes


def test_the_title_counts_the_scenes_in_which_a_method_is_most_accurate(surge):
    found = surge.copy(deep=True)
    errors = [name for name in found if name.startswith("error_")]
    for name in errors:
        found[name][:] = 0.01
    said = draw("numerics", "accuracy", {"accuracy": found}).get_suptitle()
    assert said == "No method reaches an error of 0.2 %"
    for name in errors:
        found[name].loc[{"method": "ESDIRK4"}] = 0.001
    said = draw("numerics", "accuracy", {"accuracy": found}).get_suptitle()
    assert said == "ESDIRK4 reaches the smallest error in 1 of 1 scenes"


def test_marks_below_the_error_of_the_reference_are_in_the_key_where_they_are_drawn(surge):
    def key(accuracy):
        figure = draw("numerics", "requested", {"accuracy": accuracy})
        return [text.get_text() for text in figure.legends[0].get_texts()]

    halved = surge.copy(deep=True)
    halved["reference_change"][:] = 1e-4
    assert "true error below the error of the reference" not in key(halved)
    halved["reference_change"][:] = 1.0
    assert "true error below the error of the reference" in key(halved)
    halved["reference_change"][:] = np.nan
    assert "true error below the error of the reference" not in key(halved)


def test_every_scene_is_a_line_or_named_as_too_slow(surge):
    given = {"accuracy": surge}
    axes = draw("numerics", "cost", given).axes
    assert "riserstudy" in {text.get_text() for text in axes[1].texts}
    (note,) = (" ".join(text.get_text().split()) for text in axes[2].texts)
    assert note.startswith("no bar: riser in surge, top held (")
    assert any(text.get_text().startswith("riser in surge, top held") for text in axes[0].texts)
    late = surge.copy(deep=True)
    late["request_seconds"][:] = np.nan
    for name, values, words in (
        ("cost", {"accuracy": late}, "no bar: riser in surge, top held (over the time limit)"),
        ("requested", {"accuracy": late}, "no line, over the time limit:\nriser in surge, top held"),
    ):
        texts = [text.get_text() for ax in draw("numerics", name, values).axes for text in ax.texts]
        assert " ".join(words.split()) in {" ".join(text.split()) for text in texts}


def test_the_title_of_cost_has_the_largest_ratio_of_times():
    rows = {"request_scene": ["a", "a", "b", "b"], "requested": [0.01, 0.0005, 0.01, 0.0005]}
    rows["request_seconds"] = [1.0, 3.0, 2.0, 5.0]
    found = answer(xr.Dataset({name: ("request", values) for name, values in rows.items()}))
    assert found == "A tolerance 20 times finer takes up to 3 times as long"


@pytest.mark.parametrize("slow, few", [(0, [(0, 0)]), (1, [(0, 0), (0, 1), (1, 0)])])
def test_what_took_too_long_is_not_tried_with_shorter_steps_or_on_finer_meshes(monkeypatch, slow, few):
    tried = []

    def rung(file, method, ladder, at, budget, repeats, warm):
        tried.append(at)
        late = at == (0, slow)
        return Attempt(None, Outcome.TOO_LONG if late else Outcome.REFUSED, "late" if late else "no", 0.0)

    ladder = STUDY.scenes["S2c"].replaced(elements=[8, 16], steps=[0.8, 0.4])
    one = {"scenes": {"S2c": ladder}, "methods": {"only": STUDY.methods["ESDIRK4"]}}
    monkeypatch.setattr(module, "rung", rung)
    monkeypatch.setattr(module, "reference", lambda *_: stored(HISTORY))
    monkeypatch.setattr(module, "requests", lambda *_: [])
    found = accuracy(STUDY.replaced(**one), Setting(CONFIG, "standard"))
    assert tried == few
    words = "on a coarser mesh, or with a longer time step: late"
    assert str(found["message"].squeeze().values[1, 1]) == words


def test_on_a_mesh_that_shorter_steps_do_not_help_they_are_not_tried(monkeypatch):
    def rung(file, method, ladder, at, budget, repeats, warm):
        tried.append(at)
        return Attempt(Result({}, {"error": ERRORS[at[1]]}), None, "", 0.0)

    ERRORS = (0.3, 0.1, 0.098, 0.097)
    best = Reference("known", lambda run: {"moment": run.facts["error"]})
    ladder = STUDY.scenes["S2c"].replaced(elements=[8], steps=[0.8, 0.4, 0.2, 0.1])
    few = {"scenes": {"S2c": ladder}, "methods": {"only": STUDY.methods["ESDIRK4"]}}
    monkeypatch.setattr(module, "rung", rung)
    monkeypatch.setattr(module, "reference", lambda *_: best)
    monkeypatch.setattr(module, "requests", lambda *_: [])
    monkeypatch.setattr(module, "differences", lambda *_: {})
    monkeypatch.setattr(module, "with_recomputed", lambda dataset, *_: dataset)
    for tier, count in (("standard", 3), ("reference", 4)):
        tried = []
        accuracy(STUDY.replaced(**few), Setting(CONFIG, tier))
        assert len(tried) == count


def test_a_finer_accuracy_is_not_asked_for_after_one_that_took_too_long(monkeypatch):
    def spent(file, name, share, patience):
        refused = {0.05: Outcome.REFUSED, 0.01: Outcome.TOO_LONG}[share]
        return Request({"requested": share, "request_message": refused.name}, None, refused)

    monkeypatch.setattr(module, "spent", spent)
    rows = [one.row for one in requests(None, "any", [0.002, 0.05, 0.01], 1.0)]
    assert [(r["requested"], r["request_message"]) for r in rows] == [
        (0.05, "REFUSED"), (0.01, "TOO_LONG"), (0.002, "TOO_LONG"),
    ]  # fmt: skip
