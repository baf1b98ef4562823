"""Sealed predictions are what they were, and what the engine still says."""

import csv
import hashlib
import importlib.util
import re
from pathlib import Path

import pytest

from riserstudy.scene.load import read_scene
from riserstudy.simulation.refine import run

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "config/predictions"
PAGE = (ROOT / "docs/predictions.md").read_text("utf-8")


def script():
    where = ROOT / "workflow/scripts/predict_vibration.py"
    spec = importlib.util.spec_from_file_location("predict_vibration", where)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def rows():
    with (FOLDER / "stepped_current.csv").open(encoding="utf-8") as file:
        return list(csv.reader(file))


#: tables of predictions, by their section of the page
SECTIONS = {
    "stepped_current": "Model riser in a stepped current",
    "kept_back_years": "Years kept back",
    "hindcast_years": "Years of a hindcast",
}


def section(name):
    return PAGE.partition(f"## {SECTIONS[name]}\n")[2].partition("\n## ")[0]


@pytest.mark.parametrize("name", SECTIONS)
def test_the_table_is_the_sealed_one(name):
    [seal] = re.findall(r"Seal: `sha256 ([0-9a-f]{64})`", section(name))
    assert hashlib.sha256((FOLDER / f"{name}.csv").read_bytes()).hexdigest() == seal
    changes = [ROOT / "CHANGELOG.md", *(ROOT / "changelog.d").glob("predictions*.md")]
    assert any(seal in path.read_text("utf-8") for path in changes)


def test_each_table_has_a_section_and_a_row_of_the_page():
    opened = {path.stem for path in FOLDER.glob("*_opened.csv")}
    assert {path.stem for path in FOLDER.glob("*.csv")} - opened == {*SECTIONS}
    for title in SECTIONS.values():
        assert f"(#{title.lower().replace(' ', '-')})" in PAGE


def test_the_page_shows_the_sealed_speeds():
    text = section("stepped_current")
    shown = re.findall(r"^\| ([0-9.]+) \| ([0-9]+) \| ([0-9.]+) \|", text, re.MULTILINE)
    sealed = rows()[1:]
    assert len(shown) == len(sealed)
    for (speed, mode, frequency), row in zip(shown, sealed, strict=True):
        assert float(speed) == float(row[0])
        assert mode == row[1]
        assert float(frequency) == pytest.approx(float(row[2]), abs=0.006)


def test_the_page_shows_the_sealed_years():
    with (FOLDER / "kept_back_years.csv").open(encoding="utf-8") as file:
        sealed = [tuple(row) for row in csv.reader(file)][1:]
    line = r"^\| ([0-9.]+ m) \| (\d) \| ([0-9.]+) \| ([0-9.]+) to ([0-9.]+) \|"
    shown = re.findall(line, section("kept_back_years"), re.MULTILINE)
    assert [(f"hs <= {limit}", *rest) for limit, *rest in shown] == sealed


def test_the_page_tells_what_came_of_the_years():
    with (FOLDER / "kept_back_years_opened.csv").open(encoding="utf-8") as file:
        came = list(csv.DictReader(file))
    for one in came:
        inside = float(one["low"]) <= float(one["came"]) <= float(one["high"])
        assert (one["inside"] == "yes") == inside
    outside = {years: [o for o in came if o["years"] == years and o["inside"] == "no"] for years in "15"}
    singles = sum(one["years"] == "1" for one in came)
    first = PAGE.partition("|---|")[2].splitlines()[1]
    assert f"{len(outside['5'])} of 5 five-year means" in first
    assert f"{len(outside['1'])} of {singles} values of single years" in first
    calmer = sum(float(o["came"]) > float(o["high"]) for part in outside.values() for o in part)
    assert f"In {calmer} of the {sum(map(len, outside.values()))} cases" in " ".join(PAGE.split())


def test_the_page_shows_the_sealed_years_of_the_hindcast():
    with (FOLDER / "hindcast_years.csv").open(encoding="utf-8") as file:
        sealed = [row for row in csv.DictReader(file) if row["known"] == row["years"] == "5"]
    line = r"^\| (height|wind) of ([0-9.]+ m(?:/s)?) \| ([0-9.]+) \| ([0-9.]+) to ([0-9.]+) \|"
    shown = re.findall(line, section("hindcast_years"), re.MULTILINE)
    names = {"height": "hs", "wind": "wind_speed"}
    assert [(f"{names[kind]} <= {limit}", *rest) for kind, limit, *rest in shown] == [
        (row["limit"], row["share"], row["low"], row["high"]) for row in sealed
    ]


def test_the_page_tells_what_came_of_the_hindcast():
    with (FOLDER / "hindcast_years.csv").open(encoding="utf-8") as file:
        sealed = list(csv.reader(file))[1:]
    with (FOLDER / "hindcast_years_opened.csv").open(encoding="utf-8") as file:
        came = list(csv.DictReader(file))
    assert [[*one.values()][:6] for one in came] == sealed
    for one in came:
        inside = float(one["low"]) <= float(one["came"]) <= float(one["high"])
        assert (one["inside"] == "yes") == inside
    held = sum(one["inside"] == "yes" for one in came)
    share = f"{held / len(came):.0%}".replace("%", " %")
    assert f"{held} of {len(came)} observed shares of hours ({share})" in PAGE
    outside = [one for one in came if one["inside"] == "no"]
    assert {one["known"] for one in outside} == {"3"}
    assert all(float(one["came"]) > float(one["high"]) for one in outside)
    assert sum(one["years"] == "5" for one in outside) == 4


@pytest.mark.long
@pytest.mark.parametrize("k", [1, 4])
def test_the_engine_still_predicts_it(k):
    """With another seed, within 10 % of what was sealed with an error of 5 %."""
    made, row = script(), rows()[k]
    file = made.at_speed(read_scene(FOLDER / "stepped_current.yaml"), float(row[0]))
    found = made.predicted(run(file.with_values({"riser[0].viv.seed": 9}, "test").resolved()), 0.028)
    assert found[0] == int(row[1])
    for value, sealed in zip(found[1:4], map(float, row[2:5]), strict=True):
        assert value == pytest.approx(sealed, rel=0.1)
