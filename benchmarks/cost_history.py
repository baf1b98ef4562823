"""What tasks cost at commits of the history: `python benchmarks/cost_history.py [--draw]`.

Each commit is laid out in a folder of its own and measured by a process of its own with the libraries of
today's locks, one task after another, commit after commit, turn after turn: what else the machine does
meets all alike. Times are CPU time; the least of the turns counts. Results stand in cost_history.json, from
which docs/cost.md and its figure are made; --draw makes both from what stands there.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from datetime import UTC, datetime
from pathlib import Path

from cost_page import PAGE, RESULTS, history, whole_page
from cost_task import TASKS

ROOT = Path(__file__).parents[1]
FIGURE = ROOT / "docs/images/cost.svg"
#: one half day of work apart or so, from the first with these scenes on
COMMITS = ("3860a62", "6b15e92", "ce4e45c", "f9f55ea", "c766789", "1296f5d")
TURNS, FIXED = 5, 4
#: how often a task is repeated in a turn
TIMES = {"plane": 4, "by_request": 3, "line": 2, "statics": 4, "modes": 6, "read_scenes": 4, "deck": 10}


class Worker:
    """A process that measures the tasks of one commit."""

    def __init__(self, commit, folder):
        self.commit, self.least, self.lacks = commit, {}, {}
        checkout = folder / commit
        checkout.mkdir()
        packed = subprocess.run(["git", "archive", commit], cwd=ROOT, check=True, capture_output=True)
        subprocess.run(["tar", "-x", "-C", checkout], input=packed.stdout, check=True)
        environment = os.environ | {
            "PYTHONPATH": str(checkout / "src"), "RISERSTUDY_CACHE": str(checkout / ".cache"),
            "NUMBA_CACHE_DIR": str(checkout / ".cache/numba"), "OMP_NUM_THREADS": "1",
        }  # fmt: skip
        task = Path(__file__).with_name("cost_task.py")
        self._process = subprocess.Popen(
            [sys.executable, task, checkout], cwd=checkout, env=environment, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        )  # fmt: skip

    def measure(self, task, count):
        """CPU time (s) of a task, the mean of so many; None where the commit has none."""
        if task in self.lacks:
            return None
        print(task, count, file=self._process.stdin, flush=True)
        while not (line := self._process.stdout.readline()).startswith("{"):
            if not line:
                raise RuntimeError(f"{self.commit} ended at {task}")
        answer = json.loads(line)
        if "lacks" in answer:
            self.lacks[task] = answer["lacks"].partition(" (")[0]  # without the folder
            return None
        return answer["seconds"]

    def end(self):
        """End the process."""
        self._process.stdin.close()
        self._process.wait()


def measured(turns):
    """Least CPU time over that of the fixed loop, by commit and task."""
    with tempfile.TemporaryDirectory() as folder:
        workers = [Worker(commit, Path(folder)) for commit in COMMITS]
        for worker in workers:  # compiles what it needs
            for task in TASKS:
                worker.measure(task, 1)
            print(worker.commit, worker.lacks, flush=True)
        for turn in range(turns):
            for worker in workers:
                seconds = {task: worker.measure(task, TIMES[task]) for task in TASKS}
                seconds["fixed_loop"] = worker.measure("fixed_loop", FIXED)
                for task, found in seconds.items():
                    if found is not None:
                        worker.least[task] = min(found, worker.least.get(task, found))
            print("turn", turn + 1, "load", os.getloadavg(), flush=True)
        for worker in workers:
            worker.end()
    loop = min(worker.least.pop("fixed_loop") for worker in workers)
    return [
        {
            "commit": worker.commit,
            "date": when(worker.commit),
            "loops": {task: round(seconds / loop, 3) for task, seconds in worker.least.items()},
            "lacks": worker.lacks,
        }
        for worker in workers
    ]


def when(commit):
    """Day and hour of a commit (UTC)."""
    words = ["git", "log", "-1", "--format=%cI", commit]
    said = subprocess.run(words, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return datetime.fromisoformat(said.strip()).astimezone(UTC).strftime("%Y-%m-%d %H:%M")


def draw(results):
    """Cost of each task over the commits, over that at the newest."""
    import matplotlib as mpl
    import numpy as np
    from matplotlib.figure import Figure

    from riserstudy.figures.style import COLOURS

    points = results["commits"]
    with mpl.rc_context({"svg.hashsalt": "cost", "font.size": 8, "svg.fonttype": "path"}):
        figure = Figure((7.0, 4.2), layout="constrained")
        axes = figure.subplots()
        for k, (task, (words, _)) in enumerate(TASKS.items()):
            newest = points[-1]["loops"].get(task)
            ratio = np.array([p["loops"].get(task, np.nan) for p in points]) / newest
            marker = "os^vDP*"[k]
            axes.plot(range(len(points)), ratio, marker=marker, color=COLOURS[k % len(COLOURS)], label=words)
        axes.axhline(1.0, color="0.6", linewidth=0.8)
        axes.set_ylim(0.0, None)
        axes.set_xticks(range(len(points)), [p["date"][5:].replace(" ", "\n") for p in points])
        axes.set_xlabel("commit of main (month-day, hour)")
        axes.set_ylabel("CPU time relative to the newest commit")
        axes.set_title(results["title"], loc="left", fontsize=9)
        axes.legend(fontsize=7, ncols=2, loc="upper center", bbox_to_anchor=(0.5, -0.2), frameon=False)
        FIGURE.parent.mkdir(exist_ok=True)
        figure.savefig(FIGURE, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--draw", action="store_true", help="measure nothing")
    parser.add_argument("--turns", type=int, default=TURNS)
    asked = parser.parse_args()
    results = history() or {"title": "Cost of seven tasks over the commits of main", "about": ""}
    if not asked.draw:
        load = os.getloadavg()[0]
        results["commits"] = measured(asked.turns)
        results |= {"load": [round(load, 1), round(os.getloadavg()[0], 1)], "turns": asked.turns}
        RESULTS.write_text(json.dumps(results, indent=1) + "\n", "utf-8")
    draw(results)
    PAGE.write_text(whole_page(), "utf-8")


if __name__ == "__main__":
    main()
