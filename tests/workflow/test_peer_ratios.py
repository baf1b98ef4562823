"""The picture of other simulators shows the table of its page, which agrees with what the report shows."""

import re
from pathlib import Path

import pytest

import peer_ratios
from riserstudy.study.read import read_studies

CONFIG = Path(__file__).parents[2] / "config"
VERSION = re.compile(r" [\d.]+$")
FOUND = peer_ratios.ratios(peer_ratios.PAGE.read_text("utf-8"))


def test_ratios_of_the_page_are_those_of_the_study():
    measured = read_studies(CONFIG, "numerics").measured
    known = {
        ("S2c", simulator, error): times
        for simulator, reached in measured["accuracy"].peers["S2c"].items()
        for error, times in reached
    }
    of_page = {
        ("S2c", VERSION.sub("", one.simulator), float(one.level[:-2]) / 100.0): one.times
        for one in FOUND
        if (one.scene, one.quantity) == ("S2c", "displacement") and one.times is not None
    }
    assert of_page == pytest.approx(known)


def test_every_number_of_the_table_is_a_mark():
    figure = peer_ratios.drawing(FOUND)
    marks = sum(len(line.get_xdata()) for line in figure.axes[0].lines if line.get_marker() != "None")
    assert marks == sum(one.times is not None for one in FOUND) > 30
    assert {one.scene for one in FOUND} == {"S1", "S2c", "S3"}


def test_a_page_without_the_table_is_refused():
    with pytest.raises(LookupError, match="level"):
        peer_ratios.ratios("# no table")
