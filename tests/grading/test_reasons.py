"""Every number and claim has a reason for its verdict, and rows with its results."""

import re
from dataclasses import fields, replace

import numpy as np
import pytest

from riserstudy.grading.reasons import reason, result_rows
from riserstudy.grading.sentences_by_reading import rows_by_reading, summary_by_reading
from riserstudy.records.graded import Grounds, Influence, ItemResult, Outcome, Premise, Reading, Share

PLAIN = dict.fromkeys(field.name for field in fields(ItemResult)) | {"unit": "", "kind": "claim"}


def why(grounds=None, **about):
    """The reason for the verdict on a claim."""
    return reason(ItemResult(**(PLAIN | about)), grounds or Grounds())


@pytest.mark.parametrize("verdict", ["holds", "fails", "calibrated"])
def test_a_claim_without_samples_has_a_reason(verdict):
    assert why(verdict=verdict).endswith(".")


def test_a_premise_that_no_sample_meets_is_the_reason():
    grounds = Grounds(because="too few samples", premise=Premise(0, 200))
    assert (
        why(grounds, verdict="depends")
        == "0 samples are too few for the verdict “holds”, which requires at least 59."
    )


def test_interpretations_are_the_reason_where_they_answer_differently():
    share = Share(1, 1)
    readings = [Reading({"flow": "a"}, "true", share), Reading({"flow": "b"}, "false", Share(0, 1))]
    flow = Influence("flow", "flow")
    grounds = Grounds(readings=readings, because="inputs", decided_by=[flow])
    assert why(grounds, verdict="depends") == (
        "The verdict depends on the input “flow”. "
        "The claim is true with the interpretation “a”. The claim is false with the interpretation “b”."
    )
    assert rows_by_reading("claim", readings) == [("“a”", "true"), ("“b”", "false")]


@pytest.mark.parametrize("name", ["no single input or pair", "flow; drag, and more", ""])
def test_deciding_inputs_are_named_whatever_their_names(name):
    """A user names the inputs: also as the words for no deciding input."""
    grounds = Grounds(because="inputs", decided_by=[Influence("riser[0].drag", name)])
    assert why(grounds, verdict="depends") == f"The verdict depends on the input “{name}”."
    weak = replace(grounds, explained=0.1)
    assert why(weak, verdict="depends") == "No single input or pair of inputs decides the outcome."


@pytest.mark.parametrize("seed", range(20))
def test_a_unit_with_any_name_does_not_make_one_value_a_range(seed):
    draw = np.random.default_rng(seed)
    low, high = draw.integers(1, 4, 2).astype(float)
    outcome = Outcome("Base case", low, high, True)
    ((_, text),) = result_rows("number", "m to deck", Grounds(outcomes=[outcome]), None, None)
    assert text.startswith("The simulated values are " if low != high else "The simulated value is ")


@pytest.mark.parametrize("met, said", [(0, "none of 60 samples"), (59, "59 of 60"), (60, "all 60 samples")])
def test_a_share_of_samples_is_the_reason_and_a_row(met, said):
    grounds = Grounds(share=Share(met, 60, 60))
    assert why(grounds, verdict="holds") == f"The claim is true in {said.removesuffix(' samples')} samples."
    rows = dict(result_rows("claim", "", grounds, 0.25, (-0.5, 0.004)))
    assert rows == {
        "Samples that agree with the paper": f"{met} of 60",
        "Margin of the base case": "+25 %",
        "Margins of 90 % of all cases": "−50 to 0 %",
    }


def test_numbers_are_values_and_not_interpretations():
    share = Share(1, 1)
    readings = [Reading({"speed": speed}, "true", share) for speed in (2.0, 2.5)]
    text = summary_by_reading("claim", [*readings, Reading({"speed": 3.0}, "false", Share(0, 1))])
    assert "interpretation" not in text
    assert "with the values “speed 2” and “speed 2.5”." in text
    assert "with the value “speed 3”." in text


ANSWERS = ["true", "no difference", "false", "depends"]


@pytest.mark.parametrize("seed", range(20))
def test_a_summary_counts_every_interpretation_once(seed):
    draw = np.random.default_rng(seed)
    answers = draw.choice(ANSWERS, int(draw.integers(4, 40)))
    readings = [Reading({"flow": float(k)}, answer, Share(1, 2, 2)) for k, answer in enumerate(answers)]
    text = summary_by_reading("claim", readings)
    definite, *rest = re.split(r"In (?:one|\d+) interpretations? of the paper", text)
    numbers = [int(digits) for digits in re.findall(r"\d+", definite)]
    assert bool(rest) == ("depends" in answers and len(set(answers)) > 1)
    if len(set(answers)) == 1:
        assert f"all {len(answers)} interpretations" in text
        return
    first, total, *rest_of = numbers
    parts = [first, *rest_of]
    assert total == len(answers)
    assert sum(parts) == total - np.count_nonzero(answers == "depends")
