"""Every number and claim of the report has a reason, and its share an interval or the reason why not."""

import re
from dataclasses import fields

import numpy as np
import pytest

from riserstudy.grading.words_by_reading import summary_by_reading
from riserstudy.records.graded import Grounds, Premise, Reading, Share
from riserstudy.report.claims import Claim

PLAIN = dict.fromkeys(field.name for field in fields(Claim)) | {
    "unit": "",
    "decided_by": "",
    "sentences": [],
    "results": [],
    "options": [],
    "grounds": Grounds(),
}


def claim(**about):
    return Claim(**(PLAIN | about))


@pytest.mark.parametrize("verdict", ["holds", "fails", "calibrated"])
def test_a_claim_without_samples_has_a_reason(verdict):
    assert claim(verdict=verdict).why.endswith(".")


def test_a_premise_that_no_sample_meets_is_the_reason():
    grounds = Grounds(because="too few samples", premise=Premise(0, 200))
    found = claim(verdict="depends", kind="claim", decided_by="too few samples", grounds=grounds)
    assert found.why == "0 samples are too few for the verdict “holds”, which requires at least 59."


def test_interpretations_are_the_reason_where_they_answer_differently():
    share = Share(1, 1)
    readings = [Reading({"flow": "a"}, "true", share), Reading({"flow": "b"}, "false", Share(0, 1))]
    found = claim(verdict="depends", kind="claim", decided_by="flow", grounds=Grounds(readings=readings))
    assert found.why == (
        "Flow. The claim is true with the interpretation “a”. The claim is false with the interpretation “b”."
    )
    assert found.by_reading == [("“a”", "true"), ("“b”", "false")]


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
    definite, _, rest = text.partition("With the other")
    numbers = [int(digits) for digits in re.findall(r"\d+", definite)]
    assert bool(rest) == ("depends" in answers and len(set(answers)) > 1)
    if len(set(answers)) == 1:
        assert f"all {len(answers)} interpretations" in text
        return
    first, total, *rest_of = numbers
    parts = [first, *rest_of]
    assert total == len(answers)
    assert sum(parts) == total - np.count_nonzero(answers == "depends")
