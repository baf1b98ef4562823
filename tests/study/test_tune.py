"""Tuning: what it finds holds at points it never saw, is the same every time, and is refused in one line."""

import os
from datetime import date

import pytest
import short_study

from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.validate import check
from riserstudy.model.mesh import prescribed
from riserstudy.simulation.error_estimate import controlled, difference
from riserstudy.simulation.run import single
from riserstudy.study.corners import corners, others
from riserstudy.study.models import StudyFile
from riserstudy.study.setting import Setting, own_setting
from riserstudy.study.study import Study
from riserstudy.study.tune import FREE, Tuned, tune

STUDIES = """\
# A remark at the head.
paper: tuned
studies:
  surge:
    scene: scenes/riser.yaml   # a remark at the end of a line
    caption: surge of a short riser
    axes:
      amplitude: {path: platform.surge.amplitude, unit: m, values: [0.5, 1, 1.5]}
      period: {path: platform.surge.period, unit: s, values: {start: 8, stop: 14, step: 2}}
      end:
        free: {}
        on a joint: {bottom.rotation: {stiffness: 40 kN*m/deg}}
  sampled:
    scene: scenes/riser.yaml
    caption: a short riser over its unspecified inputs
    set:
      analysis: {duration: 30 s, output: {interval: 0.5 s, stations: [100 m]}, accuracy: 2 %}
      riser[0].mass: {assumed: 700 kg/m, range: [600 kg/m, 900 kg/m], because: "a range"}
      top.tension: {assumed: 2000 kN, range: [1500 kN, 2500 kN], because: "a range"}
    axes:
      sample: {count: {preview: 8, standard: 16, reference: 16}, seed: 3}
      period: {path: platform.surge.period, unit: s, values: [9, 12]}
  rest:
    scene: scenes/riser.yaml
    caption: at rest
    set: {analysis: {}, platform: null, top.x: held}
    axes:
      tension: {path: top.tension, unit: kN, values: {start: 1500, stop: 2500, step: 50}}
  stepped:
    scene: scenes/riser.yaml
    caption: its axes are steps
    axes:
      steps: {path: analysis.step, unit: s, values: {start: 0.01, stop: 0.2, step: 0.01}}
      mass: {path: "riser[0].mass", unit: kg/m, values: [600, 700, 800]}
  damped:
    scene: scenes/riser.yaml
    caption: its axes are spectral radii
    set: {analysis.method: {rho_inf: 0.8}}
    axes:
      radius: {path: analysis.method.rho_inf, unit: "1", values: {start: 0, stop: 1, step: 0.05}}
      mass: {path: "riser[0].mass", unit: kg/m, values: [600, 700, 800]}
  newmark:
    scene: scenes/riser.yaml
    caption: the method of a paper
    set: {analysis.method: {beta: 0.25, gamma: 0.5}}
    axes:
      mass: {path: "riser[0].mass", unit: kg/m, values: {start: 600, stop: 900, step: 10}}
  few:
    scene: scenes/riser.yaml
    caption: few points
    axes:
      mass: {path: "riser[0].mass", unit: kg/m, values: [600, 700, 800]}
"""


@pytest.fixture
def file(tmp_path):
    """A study file beside its scene."""
    (tmp_path / "scenes").mkdir()
    (tmp_path / "studies").mkdir()
    (tmp_path / "scenes/riser.yaml").write_text(short_study.SCENE)
    (tmp_path / "scenes/current.csv").write_text(short_study.CURRENT)
    path = tmp_path / "studies/tuned.yaml"
    path.write_text(STUDIES)
    return path


def study_of(file, name):
    """A study of the file."""
    model = check(StudyFile, read_yaml(file), file).studies[name]
    return Study("tuned", name, model, file.parent.parent, "standard")


def true_error(study, setting, index):
    """Error of a setting at a point, by segments and steps a quarter as long."""
    scene = study.grid.file(index).with_values(FREE | setting.values, "test").resolved()
    coarse = single(scene, prescribed(scene, setting.elements), setting.step)
    fine = single(scene, prescribed(scene, 4 * setting.elements), setting.step / 4)
    return controlled(difference(coarse, fine))


@pytest.mark.long
@pytest.mark.parametrize("name, accuracy", [("surge", "1 %"), ("sampled", None)])
def test_true_errors_at_points_that_were_not_tuned_on_stay_below_the_request(file, name, accuracy):
    study = study_of(file, name)
    found = tune(study, accuracy, 4, 1)
    held_out = others(study, found.points + found.checked, 6, 7)
    assert held_out
    limit = 0.01 if accuracy else 0.02
    for index in held_out:
        assert max(true_error(study, found.setting, index).values()) <= limit
    assert found.work < 0.7  # of what requests cost: else tuning is of no use


@pytest.mark.long
def test_the_same_seed_tunes_to_the_same_setting_at_the_same_points(file):
    first, again = (tune(study_of(file, "surge"), "5 %", 4, 5) for _ in range(2))
    assert first == again


@pytest.mark.parametrize("seed", range(5))
def test_points_to_tune_on_reach_all_ends_of_axes_and_samples(file, seed):
    study = study_of(file, "surge")
    points = corners(study, 10, seed)
    ends = {(a, p) for a in (0, 2) for p in (0, 3)} | {(1, 2)}
    assert {point[:2] for point in points} == ends
    assert {point[2] for point in points} == {0, 1}
    sampled = study_of(file, "sampled")
    drawn = sampled.assumed(sampled.model.axes["sample"])
    marked = [drawn[point[0]] for point in corners(sampled, 16, seed)]
    for path in drawn[0]:
        values = sorted(float(one[path].split()[0]) for one in drawn)
        found = {float(one[path].split()[0]) for one in marked}
        assert {values[0], values[-1]} <= found


@pytest.mark.parametrize("seed", range(5))
def test_points_that_a_setting_is_held_against_are_none_that_it_was_tuned_on(file, seed):
    study = study_of(file, "surge")
    points = corners(study, 6, seed)
    assert not set(points) & set(others(study, points, 12, seed))
    assert len(others(study, points, 100, seed)) <= len(study.grid) - len(points)


@pytest.mark.parametrize(
    "name, said",
    [
        ("rest", "only dynamic runs can be tuned"),
        ("stepped", "sets analysis.step, which the tuning itself chooses"),
        ("damped", "sets analysis.method.rho_inf, which the tuning itself chooses"),
        ("few", "3 points, fewer than twice"),
        ("newmark", "cannot be tuned"),
        ("absent", "no study 'absent'"),
    ],
)
def test_a_study_with_nothing_to_tune_is_refused_in_one_line(commands, file, name, said):
    code, out, err = commands("tune", file, name)
    assert (code, out) == (2, "")
    assert said in err
    assert err.count("\n") == 1


@pytest.mark.long
@pytest.mark.parametrize("name", ["surge", "sampled"])
def test_what_is_written_is_what_was_printed_and_leaves_the_rest_of_the_file(commands, file, name):
    code, out, _ = commands("tune", file, name, "--points", "4", "--accuracy", "3 %", "--write")
    assert code == 0
    before = {line.strip() for line in STUDIES.splitlines()}
    text = file.read_text()
    changed = [line for line in before - {line.strip() for line in text.splitlines()} if line]
    assert all("analysis" in line for line in changed)
    study = study_of(file, name)
    setting = own_setting(study.base.resolved())
    assert f"elements: {setting.elements}" in out.splitlines()[0]
    assert out.splitlines()[1] == f"analysis.step: {setting.step:g} s"
    about = study.model.tuned
    assert (about.accuracy, about.on, about.seed) == ("3 %", date.today().isoformat(), 1)
    assert about.error <= 1.0
    for other in ("rest", "few"):
        assert study_of(file, other).model.tuned is None
    assert tune(study, "3 %", 4, 1).setting == setting


EDITS = {
    "axis": ("studies/tuned.yaml", "values: [0.5, 1, 1.5]", "values: [1, 2, 3]"),
    "other name": ("studies/tuned.yaml", "  surge:\n", "  surges:\n"),
    "scene": ("scenes/riser.yaml", "mass: 700 kg/m", "mass: 900 kg/m"),
    "table": ("scenes/current.csv", "300, 1.1", "300, 1.2"),
}


@pytest.mark.parametrize("edit", EDITS)
def test_a_study_that_changes_during_the_tuning_stays_as_edited(commands, file, monkeypatch, edit):
    name, old, new = EDITS[edit]
    found = Tuned("3 %", Setting(40, (), 0.1, "TR-BDF2"), [(0, 0, 0)], [(1, 1, 1)], 0.5, 0.6, 0.7, None)
    path = file.parent.parent / name
    assert old in path.read_text()

    def tune_meanwhile(*_):
        path.write_text(path.read_text().replace(old, new, 1))
        os.utime(path, (1e9, 1e9))
        return found

    monkeypatch.setattr("riserstudy.study.tune.tune", tune_meanwhile)
    code, _, said = commands("tune", file, "surge", "--write")
    assert code == (2 if edit == "other name" else 3)
    assert ("no study 'surge'" if edit == "other name" else "changed during the tuning") in said
    assert "tuned:" not in file.read_text()
    assert new in path.read_text()
