"""A riser whose top is at an offset: the deck of its tensioners is above the top, in the model and back."""

import numpy as np
import pytest
import yaml
from drawn_decks import drawn, file_of, there_and_back
from test_scenes_come_back import silent

from riserstudy.export.orcaflex import write_deck

LINK = "Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionzRelativeTo"


@pytest.fixture(params=range(20))
def at_an_offset(request):
    tree = drawn(request.param)
    offset = float(np.random.default_rng(request.param).uniform(-12.0, 12.0))
    tree["top"]["offset"] = f"{offset} m"
    return file_of(tree), offset


def test_a_scene_at_an_offset_comes_back(at_an_offset, tmp_path):
    file, offset = at_an_offset
    back, left = there_and_back(file, tmp_path)
    assert back.resolved().top.offset == pytest.approx(offset)
    assert silent(file, back, left) == []


def test_deck_points_lie_around_the_vertical_through_the_top(at_an_offset):
    file, offset = at_an_offset
    links = yaml.safe_load(write_deck(file).text.lstrip("\ufeff")).get("Links", [])
    if file.resolved().top.tensioners is None:
        pytest.skip("no cylinders")
    points = np.array([link[LINK][0][1:3] for link in links], float)
    assert points.mean(axis=0) == pytest.approx((offset, 0.0), abs=1e-6)
