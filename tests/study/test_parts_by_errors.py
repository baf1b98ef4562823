"""A study in parts has the verdicts of the whole, whichever parts have the largest errors; progress."""

import numpy as np
import pytest
import short_study
import xarray as xr

from riserstudy.study import write_study

STUDY = """\
paper: parts
studies:
  rest:
    scene: scenes/riser.yaml
    caption: many tensions against limits that errors decide
    set: {analysis: {mesh: {elements: 5}}, platform: null, top.x: held}
    limits:
      - {output: lfj_angle, largest: 0.4 deg, mode: drilling}
      - {output: lfj_angle, largest: 0.5 deg, mode: connected}
      - {output: lfj_angle, largest: 0.6 deg, mode: disconnect}
    axes:
      tension: {path: top.tension, unit: kN, values: {start: 1500, stop: 2480, step: 70}}
      end:
        free: {}
        on a joint: {bottom.rotation: {stiffness: 40 kN*m/deg}}
"""
NAMES = ("displacement", "moment", "tension", "angle", "shear")


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A study of thirty points at rest, in a store of its own."""
    folder = tmp_path_factory.mktemp("parts")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RISERSTUDY_CACHE", str(folder / "cache"))
        yield short_study.studies_in(folder, "parts", STUDY)("rest")


@pytest.mark.parametrize("seed", range(4))
def test_verdicts_of_parts_are_those_of_the_whole(study, tmp_path, monkeypatch, seed):
    """Errors are drawn: known of some points only; every second time, one has the largest of all."""
    draw = np.random.default_rng(seed)
    known = [point.key for point in study.plan if draw.random() < 0.4]
    errors = {key: dict(zip(NAMES, draw.uniform(0.01, 0.1, 5).tolist(), strict=True)) for key in known}
    if seed % 2:
        errors[known[draw.integers(len(known))]] = dict.fromkeys(NAMES, float(draw.uniform(0.11, 0.3)))
    results_of = write_study.results_of

    def drawn(of, *given):
        results, more = results_of(of, *given)
        for point, result in zip(of.plan, results, strict=True):
            result.facts["error_estimate"] = errors.get(point.key, {})
        return results, more

    monkeypatch.setattr(write_study, "results_of", drawn)
    write_study.write_study(study, tmp_path / "whole.nc", 1, lambda _: None)
    monkeypatch.setattr(write_study, "AT_ONCE", int(draw.integers(2, 28)))
    write_study.write_study(study, tmp_path / "parts.nc", 1, lambda _: None)
    with xr.open_dataset(tmp_path / "whole.nc") as whole, xr.open_dataset(tmp_path / "parts.nc") as parts:
        xr.testing.assert_identical(whole, parts)
        assert len(np.unique(whole["verdict_of_limit"])) > 1
    assert {path.name for path in tmp_path.iterdir()} == {"whole.nc", "parts.nc"}


@pytest.mark.long
@pytest.mark.parametrize("at_once", [7, 11, 29, 30, 500])
def test_progress_counts_all_points_of_a_study_in_parts(study, tmp_path, monkeypatch, at_once):
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path / "empty"))
    monkeypatch.setattr(write_study, "AT_ONCE", at_once)
    counts, told = [], []
    write_study.write_study(study, tmp_path / "parts.nc", 1, told.append, lambda *of: counts.append(of))
    done = [done for done, _ in counts]  # at the beginning of each part, too
    assert done == sorted(done)
    assert set(done) == {*range(31)}
    assert {total for _, total in counts} == {30}
    assert len(told) == -(-15 // max(1, at_once // 2))  # two points for each tension
