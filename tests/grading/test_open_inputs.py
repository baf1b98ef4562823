"""Claims about models that are no risers: the grader alone, and three examples of it."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.special import ellipk

from riserstudy.errors import InputError
from riserstudy.grading import ClaimsFile, above, claim, grade_claims, read_claims, row_of
from riserstudy.grading.open_inputs import sampled
from riserstudy.records.graded import Grounds

pytestmark = pytest.mark.long

EXAMPLES = Path(__file__).parents[2] / "examples/grading"
NAMES = ("pendulum", "heat_fin", "predator_prey")
ALONE = """
import sys
sys.path.insert(0, sys.argv[1])
import riserstudy.grading as grading
from predator_prey import CHECKS, FILE
[getattr(grading, name) for name in grading.__all__]
assert len(grading.grade_claims(grading.read_claims(FILE), CHECKS)) == 4
print(*sorted(sys.modules))
"""


@pytest.fixture(scope="module")
def examples():
    sys.path.insert(0, str(EXAMPLES))
    yield {name: __import__(name) for name in NAMES}
    sys.path.remove(str(EXAMPLES))


@pytest.fixture(scope="module")
def graded(examples):
    return {
        one.id: one
        for module in examples.values()
        for one in grade_claims(read_claims(module.FILE), module.CHECKS)
    }


def test_the_grader_loads_neither_scenes_nor_the_simulator():
    done = subprocess.run(
        [sys.executable, "-c", ALONE, str(EXAMPLES)], capture_output=True, text=True, check=True
    )
    loaded = done.stdout.split()
    ours = {name.split(".")[1] for name in loaded if name.startswith("riserstudy.")}
    assert "grading" in ours
    assert not ours & {"scene", "solve", "effects", "model", "simulation", "study", "chapters"}
    assert not {"numba", "snakemake"} & set(loaded)


@pytest.mark.long
@pytest.mark.parametrize(
    "name, verdict, decided_by",
    [
        ("P1", "reproduced", []),
        ("P2", "depends", ["amplitude"]),
        ("P3", "holds", []),
        ("P4", "fails", []),
        ("P5", "not comparable", []),
        ("F1", "holds", []),
        ("F2", "depends", ["length", "conductivity"]),
        ("F3", "fails", []),
        ("V1", "holds", []),
        ("V2", "depends", ["feeding", "start"]),
        ("V3", "holds", []),
        ("V4", "depends", ["start"]),
    ],
)
def test_verdicts_of_the_examples_and_what_decides_them(graded, name, verdict, decided_by):
    found = graded[name]
    assert found.verdict == verdict
    assert {one.input for one in found.grounds.decided_by} == {*decided_by}


def test_a_row_of_what_cannot_be_compared_says_why(graded):
    row = row_of(graded["P5"])
    assert row.simulated is None
    assert "half a period" in row.note
    assert Grounds.from_json(row.grounds) == graded["P5"].grounds


# the examples' own numbers, by closed forms


@pytest.mark.parametrize("degrees", [1.0, 30.0, 80.0, 120.0])
def test_the_period_of_the_pendulum_is_the_elliptic_integral(examples, degrees):
    inputs = {"length": 0.994, "gravity": 9.81, "amplitude": degrees, "air": "none"}
    exact = 4.0 * np.sqrt(0.994 / 9.81) * ellipk(np.sin(np.radians(degrees) / 2.0) ** 2)
    period, height = examples["pendulum"].period_and_return(inputs)
    assert period == pytest.approx(exact, rel=1e-6)
    assert height == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("length", [10.0, 40.0, 120.0])
def test_the_heat_of_the_fin_is_that_of_the_differential_equation(examples, length):
    h, k, t = 100.0, 16.0, 2e-3
    inputs = {"thickness": 2.0, "length": length, "transfer": h, "conductivity": k}
    m = np.sqrt(2.0 * h / (k * t))
    tip, slope = h / (m * k), np.tanh(m * 1e-3 * length)
    exact = k * t * m * (slope + tip) / (1.0 + tip * slope)
    # 400 cells, error of second order
    assert examples["heat_fin"].heat(inputs) == pytest.approx(exact, rel=1e-4)


def test_prey_are_in_balance_on_average_and_small_cycles_are_harmonic(examples):
    inputs = {"growth": 0.8, "decay": 0.5, "start": 1.01, "feeding": "in proportion"}
    length, lag, mean = examples["predator_prey"].first_cycle(inputs)
    harmonic = 2.0 * np.pi / np.sqrt(0.8 * 0.5)
    assert (length, lag) == pytest.approx((harmonic, harmonic / 4.0), rel=1e-2)
    # Volterra: whatever the size of the cycle
    wide = examples["predator_prey"].first_cycle({**inputs, "start": 2.0})
    assert (mean, wide[2]) == pytest.approx((1.0, 1.0), rel=1e-6)


# any model


def file(**fields):
    inputs = {
        "x": {"assumed": 0.5, "range": [0.0, 1.0], "because": "not given"},
        "y": {"assumed": 0.5, "range": [0.0, 1.0], "because": "not given"},
        "sort": {"assumed": "a", "options": ["a", "b"], "because": "not given"},
    }
    item = {"id": "C", "kind": "claim", "statement": "x is small", "check": "small"}
    return ClaimsFile.model_validate(
        {"study": "any", "inputs": inputs, "samples": 128, "seed": 0, "items": [item], **fields}
    )


@pytest.mark.parametrize("seed", range(8))
def test_the_share_is_that_of_the_samples_and_what_decides_is_what_the_check_reads(seed):
    rng = np.random.default_rng(seed)
    name, bound = rng.choice(["x", "y"]), rng.uniform(0.2, 0.8)
    one = file(seed=int(seed))
    (found,) = grade_claims(one, {"small": lambda i: claim(i[name], bound - i[name])})
    share = np.mean(sampled(one)[name] < bound)
    assert found.grounds.share.met / 128 == share
    assert share == pytest.approx(bound, abs=2.0 / 128)  # Sobol points are even
    assert [by.input for by in found.grounds.decided_by] == [name]
    margins = [case.margin for case in found.cases if case.judged]
    assert sum(m > 0.0 for m in margins) == found.grounds.share.met


@pytest.mark.parametrize("option, share", [("a", 1.0), ("b", 0.0)])
def test_shares_by_option_are_told(option, share):
    checks = {"small": lambda i: claim(0.0, 1.0 if i["sort"] == "a" else -1.0)}
    (found,) = grade_claims(file(), checks)
    assert found.grounds.decided_by[0].by_option[option] == share


def test_samples_in_which_nothing_is_found_are_left_out_and_counted():
    (found,) = grade_claims(file(), {"small": lambda i: claim(np.nan if i["x"] > 0.9 else i["x"], 1.0)})
    assert found.grounds.missing.cases == np.sum(sampled(file())["x"] > 0.9)


def test_a_fitted_input_gives_no_better_verdict_than_calibrated():
    number = {
        "id": "N",
        "kind": "number",
        "statement": "1",
        "published": 1.0,
        "rounding": 0.1,
        "check": "one",
    }
    inputs = {"x": {"calibrated": 1.0, "to": "N"}}
    (found,) = grade_claims(file(inputs=inputs, items=[number]), {"one": lambda i: i["x"]})
    assert found.verdict == "calibrated"


def test_with_nothing_open_one_case_is_judged():
    (found,) = grade_claims(
        file(inputs={"x": {"given": 2.0}}), {"small": lambda i: claim(2.0, above(2.0, 1.0))}
    )
    assert (found.verdict, found.grounds.share) == ("holds", None)


@pytest.mark.parametrize(
    "answer, said",
    [
        (lambda i: 1.0, "returns 1.0"),
        (lambda i: None, "returns None"),
        (lambda i: True, "returns True"),
        (lambda: claim(1.0, 1.0), "takes 0 positional arguments|too many positional"),
        (lambda i, other: claim(1.0, 1.0), "missing a required argument: 'other'"),
    ],
)
def test_a_check_that_answers_something_else_is_refused(answer, said):
    with pytest.raises(InputError, match=said):
        grade_claims(file(), {"small": answer})


@pytest.mark.parametrize("answer", [True, "1", [1.0], 1j, np.ones(2)])
def test_what_is_no_number_is_no_answer(answer):
    number = {"id": "N", "kind": "number", "statement": "1", "published": 1.0, "rounding": 0.1}
    with pytest.raises(InputError, match="return a number"):
        grade_claims(file(items=[number | {"check": "one"}]), {"one": lambda i: answer})


@pytest.mark.parametrize("kind", [int, float, np.int64, np.float32])
def test_a_number_of_any_kind_is_one(kind):
    number = {"id": "N", "kind": "number", "statement": "1", "published": 1.0, "rounding": 0.1}
    (found,) = grade_claims(file(items=[number | {"check": "one"}]), {"one": lambda i: kind(1)})
    assert found.verdict == "reproduced"


@pytest.mark.parametrize("margin", [np.ones(3), [1.0, -1.0], np.ones((1, 1))])
def test_a_margin_is_one_number(margin):
    with pytest.raises(ValueError, match="return one number"):
        claim(1.0, margin)


@pytest.mark.parametrize("seed", range(6))
def test_a_check_that_changes_its_inputs_changes_no_other_answer(seed):
    rng = np.random.default_rng(seed)
    bound = rng.uniform(0.2, 0.8)

    def spoils(inputs):
        found = claim(inputs["x"], bound - inputs["x"])
        inputs["x"] = 99.0
        inputs.clear()
        return found

    item = {"kind": "claim", "statement": "x is small", "check": "small"}
    both = file(seed=seed, items=[item | {"id": "A"}, item | {"id": "B"}])
    shares = {one.grounds.share.met for one in grade_claims(both, {"small": spoils})}
    assert shares == {np.sum(sampled(both)["x"] < bound)}


def test_a_margin_that_is_not_known_is_no_answer():
    """Neither true nor false: counted as missing, in whichever samples it is."""
    unknown = lambda i: claim(1.0, np.nan if i["x"] > 0.9 else 1.0)  # noqa: E731
    (found,) = grade_claims(file(), {"small": unknown})
    assert found.grounds.missing.cases == np.sum(sampled(file())["x"] > 0.9)


def test_a_check_that_is_not_there_is_refused():
    with pytest.raises(InputError, match="no check function 'small'"):
        grade_claims(file(), {})


@pytest.mark.parametrize(
    "line, said",
    [
        ("x: {assumed: 2, range: [0, 1], because: so}", "is outside the range"),
        ("x: {assumed: c, options: [a, b], because: so}", "not one of the options"),
        ("x: {assumed: a, options: [a, b, a], because: so}", "an option occurs twice"),
        ("x: {assumed: 1, range: [0, .inf], because: so}", "finite number"),
        ("x: {given: .nan}", "finite number"),
        ("x: {assumed: 1, because: so}", "range or options is required"),
        ("x: {calibrated: 1, to: N}", "no number 'N'"),
        ("x: {assumed: 1, range: [0, 2]}", "because"),
    ],
)
def test_a_file_that_cannot_be_meant_is_refused_in_one_line(tmp_path, line, said):
    path = tmp_path / "claims.yaml"
    path.write_text(
        f"study: any\ninputs:\n  {line}\nsamples: 8\nseed: 1\n"
        "items:\n  - {id: C, kind: claim, statement: so, check: so}\n"
    )
    with pytest.raises(InputError, match=said):
        read_claims(path)
