"""What ten tasks cost in this version: `python benchmarks/cost.py [--write docs/cost.md]`.

CPU time of this process, the least of several turns, and the same over the time of a fixed loop measured in
the same turn: machines and what runs beside it move both alike. With --write the results are kept as
benchmarks/cost/VERSION.json, and the page shows all versions. Functions are named as asv names benchmarks.
"""

import argparse
import json
import platform
import sys
import time
from importlib.metadata import version
from pathlib import Path

from cost_page import KEPT, whole_page
from cost_task import fixed_loop

from riserstudy import load_scene, modes, simulate
from riserstudy.grading import grade_claims, read_claims
from riserstudy.importers.orcaflex import read_deck
from riserstudy.jobs.workplan import Workplan
from riserstudy.scene.load import read_scene

ROOT = Path(__file__).parents[1]
SCENES = ROOT / "config/scenes"
TURNS, FIXED = 5, 8  # turns, and repetitions of the fixed loop
#: how often a task is repeated in a turn, so that it takes about a second
TIMES = {
    "time_by_request": 10,
    "time_deck": 40,
    "time_line": 3,
    "time_modes": 20,
    "time_plan_a_study": 2,
    "time_plane": 8,
    "time_plane_fourth_order": 3,
    "time_read_scenes": 6,
    "time_statics": 8,
}


def run(name, elements, seconds, method=None):
    """A run on a mesh of its own, without refinement."""
    changes = {
        "analysis.mesh": {"elements": elements},
        "analysis.step": "0.05 s",
        "analysis.duration": f"{seconds} s",
    }
    if method:
        changes["analysis.method"] = method
    return simulate(load_scene(SCENES / f"{name}.yaml", **changes))


def time_read_scenes():
    """Read and check twenty scenes."""
    for path in sorted(SCENES.glob("*/*.yaml"))[:20]:
        read_scene(path).resolved()


def time_plan_a_study():
    """Plan the simulations of a paper: check each simulation and compute its name in the store."""
    Workplan.read(ROOT / "config", {"tier": "preview", "papers": ["liu2017"]})


def time_statics():
    """Static equilibrium, ten times."""
    for _ in range(10):
        simulate(load_scene(SCENES / "bench/s1.yaml"))


def time_plane():
    """Surge of a riser in a plane, 64 segments, 150 s."""
    run("bench/s2c", 64, 150)


def time_plane_fourth_order():
    """Surge of a riser in a plane by the fourth-order method ESDIRK4, 64 segments, 150 s."""
    run("bench/s2c", 64, 150, "ESDIRK4")


def time_by_request():
    """Surge of a riser, 60 s, with a tolerance of 1 %: the engine chooses mesh and time step."""
    simulate(
        load_scene(SCENES / "bench/s2c.yaml", **{"analysis.accuracy": "1 %", "analysis.duration": "60 s"})
    )


def time_line():
    """Heave of a riser that is modelled as a mass on a tensioner, 100 s."""
    simulate(load_scene(SCENES / "chang2020/heave.yaml"))


def time_modes():
    """Ten natural modes."""
    modes(
        load_scene(
            SCENES / "bench/s2c.yaml", **{"analysis.mesh": {"elements": 120}, "analysis.step": "0.1 s"}
        ),
        10,
    )


def time_deck():
    """Read an OrcaFlex model."""
    read_deck(ROOT / "tests/importers/decks/riser.yml")


def time_grade_claims():
    """Grade four claims about a cooling fin with 128 samples."""
    sys.path.insert(0, str(ROOT / "examples/grading"))
    from heat_fin import CHECKS, FILE

    grade_claims(read_claims(FILE), CHECKS)


TASKS = [f for name, f in sorted(globals().items()) if name.startswith("time_")]


def cpu(task, count=1):
    """CPU time (s) of a task, the mean of so many."""
    began = time.process_time()
    for _ in range(count):
        task()
    return (time.process_time() - began) / count


def measured():
    """CPU time (s) and its ratio to the fixed loop, least of the turns, by task."""
    found = {}
    for task in TASKS:
        task()  # loads and compiles what it needs
        count = TIMES.get(task.__name__, 1)
        turns = [(cpu(task, count), cpu(fixed_loop, FIXED)) for _ in range(TURNS)]
        seconds = min(own for own, _ in turns)
        loops = seconds / min(loop for _, loop in turns)
        found[task.__name__.removeprefix("time_")] = {
            "what": task.__doc__.strip().rstrip("."),
            "seconds": round(seconds, 4),
            "loops": round(loops, 3),
        }
        print(f"{task.__name__:26} {seconds:8.3f} s {loops:8.2f} loops", flush=True)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", type=Path)
    asked = parser.parse_args()
    about = {"python": platform.python_version(), "processor": platform.machine()}
    result = {"about": about, "tasks": measured()}
    if asked.write:
        KEPT.mkdir(exist_ok=True)
        file = KEPT / f"{version('riserstudy')}.json"
        file.write_text(json.dumps(result, indent=1) + "\n", "utf-8")
        asked.write.write_text(whole_page(), "utf-8")


if __name__ == "__main__":
    main()
