"""The riser that moves on the first screen."""

import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from riserstudy.report.moving_riser import HEIGHT, WIDTH, moving_riser
from riserstudy.scene.load import read_scene

CONFIG = Path(__file__).parents[2] / "config"
SCENE = read_scene(CONFIG / "scenes/liu2017/ref_0.yaml").resolved()
NUMBER = re.compile(r"-?[\d.]+")


def motion(top, foot, title="a <run>"):
    """A straight riser whose ends travel so far (m) in a minute."""
    time, along = np.linspace(0.0, 60.0, 90), np.linspace(0.0, 1.0, 40)
    start = np.linspace(0.0, 1.0, 90)[:, None]
    x = start * (foot + (top - foot) * along)
    z = np.tile(1000.0 * along, (90, 1))
    return SimpleNamespace(title=title, scene=SCENE, time=time, x=x, z=z, platform=None)


def test_the_run_whose_top_travels_farthest_over_a_foot_that_stands_is_shown():
    paper, shown = moving_riser(
        [("a", motion(20.0, 0.0)), ("b", motion(90.0, 0.0)), ("c", motion(500.0, 400.0))]
    )
    assert paper == "b"
    assert shown.seconds == 60.0
    assert "a &lt;run&gt;" in shown.svg


def test_without_such_a_run_nothing_is_shown():
    assert moving_riser([("towed", motion(500.0, 500.0))]) is None


@pytest.mark.parametrize("top", [-300.0, 0.5, 40.0])
def test_every_frame_lies_within_the_picture(top):
    _, shown = moving_riser([("a", motion(top, 0.0))])
    frames = re.search(r'values="([^"]*)"', shown.svg)[1].split(";")
    assert len(frames) > 10
    places = [np.array([float(n) for n in NUMBER.findall(frame)]).reshape(-1, 2) for frame in frames]
    assert len({len(place) for place in places}) == 1  # else a browser would not move it
    x, y = np.concatenate(places).T
    assert (x >= 0.0).all()
    assert (x <= WIDTH).all()
    assert (y >= 0.0).all()
    assert (y <= HEIGHT).all()


@pytest.mark.parametrize("top", [-300.0, 40.0])
def test_the_name_of_the_platform_is_within_the_picture_at_the_end(top):
    """With 9 units a letter, which is more than any font takes."""
    _, shown = moving_riser([("a", motion(top, 0.0))])
    end = float(re.search(r"translate\((-?[\d.]+)", shown.svg)[1])
    offset, to_the_left = re.search(
        r'<text x="(-?\d+)" y="-8"( text-anchor="end")?>platform', shown.svg
    ).groups()
    far = end + float(offset) + (-1.0 if to_the_left else 1.0) * 9.0 * len("platform")
    assert 0.0 <= far <= WIDTH
