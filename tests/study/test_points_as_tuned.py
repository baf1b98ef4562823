"""Which points a tuned setting serves: by the nearest that is known, by any excess; what a dataset says."""

from types import SimpleNamespace

import numpy as np
import pytest
import short_study

from riserstudy.dataset.provenance import scene_file_of
from riserstudy.errors import SimulationError
from riserstudy.simulation.refine import run
from riserstudy.simulation.tolerance import allowed_of
from riserstudy.study import settings, store
from riserstudy.study.axes import Numbers
from riserstudy.study.setting import Setting
from riserstudy.study.settings import (
    Settings,
    dataset_tuned,
    exceeds,
    fill_tuned,
    from_plain,
    tuned_for,
    with_setting,
)

STUDY = """\
paper: tuned
studies:
  heavy:
    scene: scenes/riser.yaml
    caption: masses of a short riser
    set: {analysis: {duration: 4 s, output: {interval: 0.5 s}, accuracy: 20 %}}
    settings: tuned
    axes:
      mass: {path: "riser[0].mass", unit: kg/m, values: [600, 700, 800, 900, 1000]}
"""
SETTING = Setting(6, (), 0.25, "generalised-alpha")


@pytest.fixture
def study(tmp_path, monkeypatch):
    """A small study in a store of its own."""
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path / "cache"))
    return short_study.studies_in(tmp_path, "tuned", STUDY)("heavy")


@pytest.mark.parametrize("seed", range(24))
def test_a_point_without_estimate_is_served_as_the_nearest_with_the_same_labels(seed):
    """Distances are shares of the axes' lengths, by each pair of points."""
    draw = np.random.default_rng(seed)
    numbers, labels = int(draw.integers(1, 4)), int(draw.integers(0, 3))
    axes = [(int(n), Numbers.model_construct()) for n in draw.integers(1, 6, numbers)] + [(3, {})] * labels
    axes = [axes[k] for k in draw.permutation(len(axes))]
    lengths, kinds = np.array([n for n, _ in axes]), [kind for _, kind in axes]
    names = [f"axis {k}" for k in range(len(lengths))]
    study = SimpleNamespace(
        axes={name: range(n) for name, n in zip(names, lengths, strict=True)},
        model=SimpleNamespace(axes=dict(zip(names, kinds, strict=True))),
    )
    places = np.array([*np.ndindex(*lengths)])
    points = [SimpleNamespace(index=tuple(place)) for place in places.tolist()]
    chosen = draw.choice(len(points), max(1, len(points) // 4), replace=False)
    known = {int(k): bool(draw.random() < 0.5) for k in chosen}
    by_request = settings._by_nearest(study, points, known)
    along = np.array([isinstance(kind, Numbers) for kind in kinds])
    shares = (places / np.maximum(lengths - 1, 1))[:, along]
    for k, by in enumerate(by_request):
        alike = [j for j in known if (places[j] == places[k])[~along].all()]
        far = {j: float(np.linalg.norm(shares[j] - shares[k])) for j in alike}
        near = {known[j] for j in alike if far[j] <= min(far.values()) + 1e-9}
        if len(near) == 1:
            assert by == (not near.pop())


@pytest.mark.parametrize("seed", range(10))
def test_any_error_above_its_tolerance_exceeds_it(study, seed):
    draw = np.random.default_rng(seed)
    allowed = allowed_of(study.base.resolved())
    factors = {name: float(draw.choice([0.0, 0.9, 1.0, 1.0, 1.001])) for name in allowed}
    error = {name: factor * allowed[name] for name, factor in factors.items() if factor}
    assert exceeds(study, {"error_estimate": error}) == (max(factors.values()) > 1.0)
    assert not exceeds(study, {})


def test_a_study_with_a_setting_is_the_same_study_on_other_points(study):
    before = [point.key for point in study.plan]
    tuned = with_setting(study, SETTING)
    assert tuned.digest == study.digest
    assert [point.key for point in study.plan] == before
    keys = [point.key for point in tuned.plan]
    assert not {*keys} & {*before}
    assert [point.index for point in tuned.plan] == [point.index for point in study.plan]
    analysis = tuned.grid.file(tuned.plan[0].index).resolved().analysis
    assert (analysis.mesh.elements, analysis.step) == (SETTING.elements, SETTING.step)


@pytest.mark.parametrize("repeated", [0, 2, 5])
def test_progress_counts_each_point_once(study, monkeypatch, repeated):
    """Of points that are equal, one is run. A point that is no longer stored is run again as it was tuned."""
    tuned = with_setting(study, SETTING)

    def attempt(of, points, processes, notify):
        for more in (1, 3, 1):
            notify(more)
        return {}

    monkeypatch.setattr(settings, "attempt", attempt)
    monkeypatch.setattr(settings, "has_error_estimate", lambda *_: True)
    monkeypatch.setattr(settings.store, "about", lambda key: None)
    pairs = [*zip(study.plan, tuned.plan, strict=True)]
    told = []
    points = fill_tuned(study, tuned, pairs + pairs[:repeated], 1, lambda *of: told.append(of))
    assert told == [(1, 5), (4, 5), (5, 5)]
    assert points.by_request == [False] * (5 + repeated)


@pytest.mark.parametrize("seed", range(3))
def test_each_point_of_a_dataset_is_that_of_its_scene_and_key(study, monkeypatch, seed):
    """Some of its points are run with the tolerance, in any order."""
    draw = np.random.default_rng(seed)
    by_request = draw.permutation([True, True, False, False, False])
    monkeypatch.setattr(settings, "_serves", lambda _, __, point: not by_request[point.index[0]])
    found = Settings(SETTING, "", "20 %", 1, 2, 3, 0.5, 0.4)
    told = []
    dataset, results = dataset_tuned(study, found, with_setting(study, SETTING), 1, told.append)
    assert told == ["tuned/heavy: 5 points, 2 of them with the tolerance"]
    assert dataset["by_request"].values.tolist() == by_request.tolist()
    for k, by in enumerate(by_request):
        file = scene_file_of(dataset, {"mass": k})
        again = run(file.resolved())
        held = store.about(str(dataset["point_key"].values[k]))
        for facts in (held["facts"], results[k].facts):
            assert (facts["elements"], facts["step"]) == (again.facts["elements"], again.facts["step"])
        assert (again.facts["elements"] == SETTING.elements) == (not by)
        # compiled and loaded kernels may differ by rounding
        np.testing.assert_allclose(results[k].arrays["x"], again.arrays["x"], rtol=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_settings_tell_the_larger_error_and_which_points_were_checked(study, monkeypatch, seed):
    """Few points are tuned by the quick way, others in full; without a setting, the reason is kept."""
    draw = np.random.default_rng(seed)
    error, held_out, work = (float(x) for x in draw.uniform(0.1, 1.0, 3))
    points, checked = int(draw.integers(1, 9)), int(draw.integers(1, 9))
    layers = (("top", 7.0),) if seed % 2 else ()
    setting = Setting(20, layers, 0.1, "TR-BDF2")
    tuned = SimpleNamespace(setting=setting, accuracy="3 %", points=[()] * points, checked=[()] * checked)
    tuned = SimpleNamespace(**vars(tuned), error=error, held_out=held_out, work=work)
    called = []
    monkeypatch.setattr(settings, "quick_tune", lambda *of: called.append(("quick", of[1])) or tuned)
    monkeypatch.setattr(settings, "tune", lambda *of: called.append((of[2], of[3])) or tuned)
    for count in (1, 2, 3, 8):
        stub = SimpleNamespace(tuned_at=(count, seed), base=study.base)
        found = tuned_for(stub, lambda _: None)
        assert found == Settings(setting, "", "3 %", points, checked, seed, max(error, held_out), work)
        assert called.pop() == (count if count > 1 else "quick", seed)
        plain = {"setting": vars(setting) | {"layers": [list(one) for one in layers]}}
        assert from_plain(vars(found) | plain) == found

    def fails(*_):
        raise SimulationError("no setting suffices")

    monkeypatch.setattr(settings, "quick_tune", fails)
    stub = SimpleNamespace(tuned_at=(1, seed), base=study.base)
    assert tuned_for(stub, lambda _: None) == Settings(
        None, "no setting suffices", "20 %", 1, 0, seed, None, None
    )
