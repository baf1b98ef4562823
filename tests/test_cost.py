"""The cost of ten tasks by version: kept for this version, and shown as it was kept."""

import json
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module", autouse=True)
def benchmarks():
    sys.path.insert(0, str(ROOT / "benchmarks"))
    yield
    sys.path.remove(str(ROOT / "benchmarks"))


@pytest.fixture
def cost():
    import cost

    return cost


@pytest.fixture
def cost_page():
    import cost_page

    return cost_page


def test_every_task_is_kept_for_this_version(cost, cost_page):
    about = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    kept = cost_page.kept()[about["project"]["version"]]["tasks"]
    assert kept.keys() == {task.__name__.removeprefix("time_") for task in cost.TASKS}
    assert len(kept) >= 10
    assert all(task["loops"] > 0.0 for task in kept.values())


def test_the_page_shows_what_is_kept(cost_page):
    assert (ROOT / "docs/cost.md").read_text("utf-8") == cost_page.whole_page()


def test_a_page_has_a_column_for_each_version(cost_page):
    (version, result), *_ = cost_page.kept().items()
    older = {"tasks": {name: task | {"loops": 99.5} for name, task in result["tasks"].items()}}
    rows = cost_page.page({"0.1.0": older, version: result}).splitlines()
    first = next(row for row in rows if row.startswith("| Read and check"))
    assert "| 99.5 |" in first
    assert f"| {result['tasks']['read_scenes']['loops']} |" in first


@pytest.mark.parametrize("name", ["time_deck", "time_read_scenes"])
def test_tasks_can_be_run(cost, name):
    assert cost.cpu(getattr(cost, name)) > 0.0


def test_the_history_has_five_commits_and_every_task_at_the_newest(cost_page):
    from cost_task import TASKS

    points = cost_page.history()["commits"]
    assert len(points) >= 5
    assert [point["date"] for point in points] == sorted(point["date"] for point in points)
    assert points[-1]["loops"].keys() == TASKS.keys()
    for point in points:
        assert point["loops"].keys() | point["lacks"].keys() == TASKS.keys()
        assert not point["loops"].keys() & point["lacks"].keys()
        assert all(value > 0.0 for value in point["loops"].values())
    assert (ROOT / "docs/images/cost.svg").stat().st_size > 1e4


def test_what_the_page_says_of_the_history_is_what_was_measured(cost_page):
    results = cost_page.history()
    about = " ".join(results["about"].split())
    first, newest = (results["commits"][k]["loops"] for k in (0, -1))
    change = {task: round(100.0 * (newest[task] / first[task] - 1.0)) for task in first}
    for task in ("plane", "line", "statics"):
        assert f"{change[task]} %" in about
    assert f"decreased by {-change['by_request']} %" in about
    assert results["load"][0] > 2.0
    assert "busy" in results["about"]


def test_a_worker_measures_a_task_and_says_what_it_lacks():
    """Of this checkout: a line of JSON for each that is asked for."""
    script = ROOT / "benchmarks/cost_task.py"
    done = subprocess.run(
        [sys.executable, script, ROOT], input="deck 2\nnone 1\n", capture_output=True, text=True
    )
    measured, lacks = map(json.loads, done.stdout.splitlines())
    assert measured["seconds"] > 0.0
    assert lacks["lacks"].startswith("KeyError")
