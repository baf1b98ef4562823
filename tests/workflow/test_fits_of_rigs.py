"""Fits of inputs of rigs: they find the input that gives the number, and state their doubts."""

import numpy as np
import pytest
from random_rigs import rig, written
from ruamel.yaml import YAML

from riserstudy.errors import InputError
from riserstudy.grading.models import Item
from riserstudy.inputs.validate import check
from riserstudy.jobs import calibration
from riserstudy.study.models import StudyFile
from riserstudy.study.study import Study

STIFFNESS = "bottom.rotation.stiffness"


def largest(runs, output, factor=1.0, unit=None):
    """The check: the largest magnitude of an output, as a number or with its unit."""
    found = factor * abs(runs[output]).max()
    return found.assign_attrs(units=unit) if unit else found


@pytest.fixture
def study_of(tmp_path, monkeypatch):
    """A study of a rig, some of whose values are calibrated, and a number that an input gives there."""
    monkeypatch.setattr(calibration, "checks_of", lambda paper: lambda name: largest)
    (tmp_path / "scenes").mkdir()

    def made(seed, sets, spatial, elements=24, **analysis):
        tree = written(rig(seed, spatial=spatial, conductor=False))
        tree["analysis"] = {"mesh": {"elements": elements}} | analysis
        writer = YAML(typ="safe", pure=True)
        with (tmp_path / "scenes/rig.yaml").open("w") as file:
            writer.dump(tree, file)
        speed = float(tree["current"]["profile"]["surface_speed"].split()[0])
        axis = {"path": "current.profile.surface_speed", "unit": "m/s", "values": [speed]}
        one = {"scene": "scenes/rig.yaml", "caption": "a fit", "set": sets, "axes": {"speed": axis}}
        file = check(StudyFile, {"paper": "fitted", "studies": {"fit": one}}, "fitted.yaml")
        return Study("fitted", "fit", file.studies["fit"], tmp_path, "standard")

    return made


def wrapped(start, low, high):
    return {"calibrated": start, "to": "fitted/N1", "range": [low, high]}


def number(value, **more):
    about = {"id": "N1", "figure": "1", "kind": "number", "statement": "a number", "published": value}
    about |= {"rounding": 1e-4 * abs(value), "check": "largest", "reads": {"runs": "fit"}}
    return Item.model_validate(about | {"with": {"output": "lfj_angle"}} | more)


def fitted(lines, path):
    return float(next(line for line in lines if line.startswith(path)).split(": ")[1].split()[0])


def given_as(monkeypatch, function, coarse=0.0):
    """Numbers as a function of the fitted values instead of runs; finer runs have a quarter of the error."""

    def values_of(study, items, derived, finer=False):
        values = [float(str(study.base.tree["bottom"]["rotation"]["stiffness"]).split()[0])]
        values.append(float(study.base.tree["riser"][0]["added_mass"]["coefficient"]))
        off = coarse * (0.25 if finer else 1.0)
        return {item.id: function(*values) * (1.0 + off) for item in items}

    monkeypatch.setattr(calibration, "values_of", values_of)


def told(study, items, capsys):
    """The lines that a fit prints."""
    calibration.calibrate(study, items, {}, 200)
    return capsys.readouterr().out.splitlines()


def stiffness(start, low, high):
    return {STIFFNESS: wrapped(*(f"{value!r} MN*m/rad" for value in (start, low, high)))}


@pytest.mark.parametrize("wide", [20.0, 1e-3])
@pytest.mark.parametrize("seed", range(8))
def test_a_fit_finds_the_value_from_any_start_in_any_range(study_of, monkeypatch, capsys, seed, wide):
    draw = np.random.default_rng(seed)
    hidden, low = float(draw.uniform(21.0, 30.0)), float(draw.uniform(0.1, 0.9)) * wide
    start = float(draw.uniform(hidden - low, hidden + wide - low))
    given_as(monkeypatch, lambda value, _: 3.0 + value**1.5)
    study = study_of(seed, stiffness(start, hidden - low, hidden + wide - low), False)
    lines = told(study, [number(3.0 + hidden**1.5)], capsys)
    assert fitted(lines, STIFFNESS) == pytest.approx(hidden, abs=2e-3 * wide)
    assert not any("warning" in line for line in lines)


@pytest.mark.parametrize("seed", range(8))
def test_every_value_that_fits_is_printed(study_of, monkeypatch, capsys, seed):
    """Roots of a cubic that are a tenth of the range apart, or more, against those of numpy."""
    draw = np.random.default_rng(seed)
    roots = np.sort(np.array([2.0, 6.0, 9.0])[: int(draw.integers(1, 4))] + draw.uniform(-0.7, 0.7))
    curve = np.polynomial.Polynomial.fromroots(roots)
    given_as(monkeypatch, lambda value, _: 5.0 + float(curve(value)))
    lines = told(
        study_of(seed, stiffness(float(draw.uniform(1.0, 10.0)), 0.5, 10.5), False), [number(5.0)], capsys
    )
    values = [fitted(lines, STIFFNESS)]
    values += [float(line.split(": ")[-1].split()[0]) for line in lines if "equally well" in line]
    assert np.sort(values) == pytest.approx(roots, abs=0.01)


@pytest.mark.parametrize("seed", range(4))
def test_the_error_of_a_coarse_mesh_is_stated_as_a_change_of_the_fitted_value(
    study_of, monkeypatch, capsys, seed
):
    """The value that fits the finer runs is known here."""
    draw = np.random.default_rng(seed)
    hidden, coarse = float(draw.uniform(4.0, 7.0)), float(draw.uniform(0.02, 0.06))
    given_as(monkeypatch, lambda value, _: value**0.7, coarse)
    study = study_of(seed, stiffness(5.0, 1.0, 10.0), False)
    lines = told(study, [number(hidden**0.7)], capsys)
    there = hidden / (1.0 + 0.25 * coarse) ** (1.0 / 0.7)
    change = next(line for line in lines if "change the fitted value" in line)
    stated = float(change.split("about ")[1].split()[0])
    # printed with two digits (5 %), and linearised
    assert stated == pytest.approx(abs(there - fitted(lines, STIFFNESS)), rel=0.06)
    assert any("too coarse" in line for line in lines)


@pytest.mark.parametrize("seed", range(3))
def test_a_value_at_the_end_of_its_range_or_without_effect_is_named(study_of, monkeypatch, capsys, seed):
    hidden = float(np.random.default_rng(seed).choice([2.0, 9.0]))
    given_as(monkeypatch, lambda value, _: value)
    sets = stiffness(5.0, 4.0, 6.0) | {"riser[0].added_mass.coefficient": wrapped(1.0, 0.5, 1.5)}
    lines = told(study_of(seed, sets, False), [number(hidden)], capsys)
    assert fitted(lines, STIFFNESS) == pytest.approx(min(max(hidden, 4.0), 6.0))
    assert any(f"{STIFFNESS} is at the end of its range" in line for line in lines)
    assert any("added_mass.coefficient has no effect on the numbers" in line for line in lines)


@pytest.mark.parametrize(
    "value, said",
    [
        (wrapped("5 MN*m/rad", "1000 kN*m/rad", "9 MN*m/rad"), "in one unit"),
        (wrapped("5 MN*m/rad", 1, 9), "in one unit"),
        (wrapped("50 MN*m/rad", "1 MN*m/rad", "9 MN*m/rad"), "within a range"),
        (wrapped("5 MN*m/rad", "9 MN*m/rad", "1 MN*m/rad"), "within a range"),
    ],
)
def test_a_range_in_another_unit_or_without_its_value_is_refused(study_of, value, said):
    with pytest.raises(InputError, match=said):
        calibration.free_values(study_of(0, {STIFFNESS: value}, False))


@pytest.mark.parametrize(
    "more, said",
    [
        ({"reads": {"runs": "fit", "more": "another"}}, "reads several datasets, another, fit"),
        ({"unit": "deg", "with": {"output": "lfj_angle", "unit": "rad"}}, "N1.unit"),
        ({"value": 0.0, "rounding": 0.1}, "other than 0"),
    ],
)
def test_a_number_that_the_study_does_not_give_is_not_fitted(study_of, more, said):
    study = study_of(0, {STIFFNESS: wrapped("5 MN*m/rad", "1 MN*m/rad", "9 MN*m/rad")}, False)
    item = number(**{"value": 0.01} | more)
    with pytest.raises(InputError, match=said):
        calibration.calibrate(study, [item], {}, 5)


def test_a_number_that_is_not_published_is_refused_although_another_is():
    with pytest.raises(InputError, match="no number N99"):
        calibration.fit_study(calibration.CONFIG, "mao_hangoff/nearest", ["N1", "N99"], "standard", 1)
