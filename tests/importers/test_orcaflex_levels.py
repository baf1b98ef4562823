"""Lines along the riser end where its sections do, however many lengths their elevations are summed from."""

import random
from itertools import accumulate, pairwise

import pytest

from riserstudy.importers.orcaflex.string import DECIMALS, Piece, _cut


def pieces_of(lengths, bottom):
    """Pieces whose ends are rounded one after the other, as those of a deck."""
    ends = [*accumulate(lengths, lambda low, length: round(low + length, DECIMALS), initial=bottom)]
    return [Piece(f"{k}", None, "", low, high, False) for k, (low, high) in enumerate(pairwise(ends))]


@pytest.mark.parametrize("seed", range(20))
def test_a_level_at_the_end_of_a_piece_cuts_nothing(seed):
    draw = random.Random(seed)
    lengths = [draw.uniform(3.0, 27.0) / 3.0 for _ in range(60)]
    places = sorted(draw.sample(range(1, 60), 4))
    levels = [round(-1500.0 + sum(lengths[:k]), DECIMALS) for k in places]
    found = _cut(pieces_of(lengths, -1500.0), levels[1:], levels[0])
    assert len(found) == 60
    assert [found[k].low for k in places] == levels == [found[k - 1].high for k in places]


def test_a_level_within_a_piece_cuts_it():
    found = _cut(pieces_of([10.0, 10.0], -20.0), [-14.0], -5.0)
    assert [(piece.low, piece.high) for piece in found] == [
        (-20.0, -14.0), (-14.0, -10.0), (-10.0, -5.0), (-5.0, 0.0)
    ]  # fmt: skip
