"""When rows of a record have too many other intervals: by a plain count of the gaps that are made here."""

import re

import numpy as np
import pytest

from riserstudy.errors import InputError
from riserstudy.study.spacing import check_spacing

START = np.datetime64("2001-03-01T00:00", "m")


def record(gaps):
    """Times of rows with so many minutes between them."""
    return START + np.concatenate([[0], np.cumsum(gaps)]).astype("timedelta64[m]")


def refused(gaps):
    """What is said against a record with these gaps (min); empty if it is allowed."""
    try:
        check_spacing("record.csv", record(gaps))
    except InputError as error:
        return str(error)
    return ""


def with_parts(rows, parts):
    """Gaps of an hour in so many rows, with parts (number of gaps, minutes) between them."""
    pieces = np.array_split(np.full(rows, 60), len(parts) + 1)
    gaps = [pieces[0]]
    for (number, minutes), piece in zip(parts, pieces[1:], strict=True):
        gaps += [np.full(number, minutes), piece]
    return np.concatenate(gaps)


@pytest.mark.parametrize("seed", range(30))
def test_parts_of_more_than_a_hundredth_of_time_or_rows_are_refused(seed):
    """A longer interval reaches a hundredth of the time first, a shorter one a hundredth of the rows."""
    draw = np.random.default_rng(seed)
    minutes = int(draw.choice([5, 10, 20, 30, 40, 84, 90, 120, 180, 360]))
    number = int(draw.integers(8, 60))
    of_rows, of_time = number * 99, number * 99 * minutes / 60.0  # usual rows at a share of a hundredth
    edge = max(of_rows, of_time)
    for factor, expected in ((0.96, True), (1.04, False)):
        gaps = with_parts(round(factor * edge), [(number, minutes)])
        assert bool(refused(gaps)) == expected, (minutes, number, factor)
        # a long time without rows is neither recorded time nor another interval
        where = np.cumsum(draw.integers(10, 60, 5))
        assert bool(refused(np.insert(gaps, where, draw.integers(5_000, 500_000, 5)))) == expected


@pytest.mark.parametrize("seed", range(20))
def test_a_part_has_eight_equal_gaps_that_differ_by_more_than_a_quarter(seed):
    draw = np.random.default_rng(seed)
    minutes = int(draw.choice([20, 30, 47, 77, 90, 240]))
    rows = int(draw.choice([8, 12, draw.integers(9, 300)]))
    for number, expected in ((7, False), (8, True)):
        assert bool(refused(with_parts(rows, [(number, minutes)]))) == expected
    for alike in (49, 55, 65, 74):
        assert refused(with_parts(rows + 20, [(20, alike)])) == ""
    apart = [(1, minutes if k % 2 else 2 * minutes) for k in range(30)]  # unequal: they are at random
    assert refused(np.concatenate([np.full(200, 60), [m for _, m in apart], np.full(200, 60)])) == ""


@pytest.mark.parametrize("seed", range(20))
def test_the_error_names_the_longest_part_the_commonest_interval_and_both_shares(seed):
    draw = np.random.default_rng(seed)
    kinds = draw.permutation([15, 30, 120, 240, 360])[: int(draw.integers(1, 4))]
    parts = [(int(draw.integers(30, 90)), int(minutes)) for minutes in kinds]
    most = max(number for number, _ in parts)
    gaps = with_parts(int(draw.integers(most + 10, 200)), parts)
    said = refused(gaps)
    hours = [number * minutes / 60.0 for number, minutes in parts]
    worst = int(np.argmax(hours))
    time = record(gaps)
    first = np.flatnonzero(gaps == parts[worst][1])[0]
    last = first + parts[worst][0]
    day = [str(time[k]).replace("T", " ") for k in (first, last)]
    assert f"are {parts[worst][1] / 60.0:g} h apart from {day[0]} to {day[1]}, and most rows 1 h;" in said
    words = re.search(r"interval are ([\d.]+) % of the time and ([\d.]+) % of the rows", said)
    shares = [float(number) for number in words.groups()]
    rows = sum(number for number, _ in parts)
    assert shares[0] == pytest.approx(100.0 * sum(hours) / (gaps.sum() / 60.0), rel=0.06)
    assert shares[1] == pytest.approx(100.0 * rows / len(gaps), rel=0.06)
    assert f"keep only rows that are {max(1.0, parts[worst][1] / 60.0):g} h apart" in said
