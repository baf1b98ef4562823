"""Every number and claim of the report has a reason, and its share an interval or the reason why not."""

import pytest

from riserstudy.records.graded import Grounds
from riserstudy.report.claims import Claim

PLAIN = dict.fromkeys(Claim._fields) | {
    "unit": "",
    "decided_by": "",
    "said": [],
    "options": [],
    "grounds": Grounds(),
}


def claim(**about):
    return Claim(**(PLAIN | about))


@pytest.mark.parametrize("verdict", ["holds", "fails", "calibrated"])
def test_a_claim_without_samples_has_a_reason(verdict):
    assert claim(verdict=verdict).why.endswith(".")


def test_what_was_run_in_full_says_so_in_place_of_an_interval():
    assert claim(met=101, samples=432).complete
    assert not claim(met=101, samples=432, band=(20, 27)).complete
    assert not claim(met=4, samples=8).complete  # too few for an interval, drawn or not
