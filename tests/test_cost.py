"""The cost of ten tasks by version: kept for this version, and shown as it was kept."""

import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def cost():
    sys.path.insert(0, str(ROOT / "benchmarks"))
    import cost

    yield cost
    sys.path.remove(str(ROOT / "benchmarks"))


def test_every_task_is_kept_for_this_version(cost):
    about = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    kept = cost.kept()[about["project"]["version"]]["tasks"]
    assert kept.keys() == {task.__name__.removeprefix("time_") for task in cost.TASKS}
    assert len(kept) >= 10
    assert all(task["loops"] > 0.0 for task in kept.values())


def test_the_page_shows_what_is_kept(cost):
    assert (ROOT / "docs/cost.md").read_text("utf-8") == cost.page(cost.kept())


def test_a_page_has_a_column_for_each_version(cost):
    (version, result), *_ = cost.kept().items()
    older = {"tasks": {name: task | {"loops": 99.5} for name, task in result["tasks"].items()}}
    rows = cost.page({"0.1.0": older, version: result}).splitlines()
    first = next(row for row in rows if row.startswith("| Read and check"))
    assert "| 99.5 |" in first
    assert f"| {result['tasks']['read_scenes']['loops']} |" in first


@pytest.mark.parametrize("name", ["time_deck", "time_read_scenes"])
def test_tasks_can_be_run(cost, name):
    assert cost.cpu(getattr(cost, name)) > 0.0
