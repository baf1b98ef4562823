"""Counts in messages: one has no plural, and large numbers are plain digits, for a program to read."""

import pytest

from riserstudy.records.words import counted


@pytest.mark.parametrize(
    "count, words",
    [(0, "0 rows"), (1, "1 row"), (2, "2 rows"), (26280, "26280 rows"), (10**7, "10000000 rows")],
)
def test_a_count_has_its_noun(count, words):
    assert counted(count, "row") == words
