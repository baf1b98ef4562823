"""Every number and claim of the report has a reason, and its share an interval or the reason why not."""

from dataclasses import fields

import pytest

from riserstudy.records.graded import Grounds, Reading, Share
from riserstudy.report.claims import Claim

PLAIN = dict.fromkeys(field.name for field in fields(Claim)) | {
    "unit": "",
    "decided_by": "",
    "sentences": [],
    "options": [],
    "grounds": Grounds(),
}


def claim(**about):
    return Claim(**(PLAIN | about))


@pytest.mark.parametrize("verdict", ["holds", "fails", "calibrated"])
def test_a_claim_without_samples_has_a_reason(verdict):
    assert claim(verdict=verdict).why.endswith(".")


def test_interpretations_are_the_reason_where_they_answer_differently():
    share = Share(1, 1)
    readings = [Reading({"flow": "a"}, "true", share), Reading({"flow": "b"}, "false", Share(0, 1))]
    found = claim(verdict="depends", kind="claim", decided_by="flow", grounds=Grounds(readings=readings))
    assert found.why == "Flow. The claim is true with “a”. The claim is false with “b”."
