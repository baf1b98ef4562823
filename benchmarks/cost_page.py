"""The page docs/cost.md: what tasks cost, by version and by commit of the history."""

import json
from pathlib import Path

from cost_task import TASKS

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs/cost.md"
KEPT = Path(__file__).with_name("cost")
RESULTS = Path(__file__).with_name("cost_history.json")
ABOUT = """\
This page shows how the computing cost of ten typical tasks changes from version to version of riserstudy. At each release, the tasks are
measured by `python benchmarks/cost.py --write docs/cost.md`. To compare different machines, the CPU time of each task is divided by the CPU
time of a *fixed loop*, a short calculation that never changes, on the same machine. In the next table, the column of a version gives this
ratio of CPU times. The last column of the table gives the CPU time of each task in the newest version. Each CPU time is the smallest of
five repetitions. Version 1.0.0 was measured on a busy machine, so its CPU times can be too large."""  # noqa: E501


def page(results):
    """The page: a row a task, a column a version."""
    newest = results[max(results, key=lambda v: tuple(map(int, v.split("."))))]["tasks"]
    rows = [
        f"| {task['what']} | "
        + " | ".join(f"{results[v]['tasks'].get(name, {}).get('loops', '–')}" for v in results)
        + f" | {task['seconds']:.2g} s |"
        for name, task in newest.items()
    ]
    heads = "".join(f" {v} |" for v in results)
    lines = [
        "# Cost by version",
        "",
        ABOUT,
        "",
        f"| task |{heads} newest, CPU time |",
        "|---|" + "---|" * (len(results) + 1),
        *rows,
        "",
    ]
    return "\n".join(lines)


def whole_page():
    """The page with the history of commits, where that was measured."""
    commits = history()
    return page(kept()) + (f"\n{section(commits)}" if commits else "")


def kept():
    """Results of all versions, the oldest first."""
    files = sorted(KEPT.glob("*.json"), key=lambda f: tuple(map(int, f.stem.split("."))))
    return {file.stem: json.loads(file.read_text("utf-8")) for file in files}


def history():
    """Costs at commits of the history; None where none were measured."""
    return json.loads(RESULTS.read_text("utf-8")) if RESULTS.exists() else None


def section(results):
    """What the page says of the history."""
    points = results["commits"]
    rows = [
        f"| {words} | " + " | ".join(f"{p['loops'].get(task, '–')}" for p in points) + " |"
        for task, (words, _) in TASKS.items()
    ]
    heads = " | ".join(f"{p['date'][5:]}<br>`{p['commit']}`" for p in points)
    return "\n".join([
        "## Over the commits", "", results["about"], "",
        f"![{results['title']}](images/cost.svg)", "",
        f"| task | {heads} |", "|---|" + "---|" * len(points), *rows, "",
    ])  # fmt: skip
