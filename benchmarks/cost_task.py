"""Tasks of one commit, measured on request: `python cost_task.py CHECKOUT`.

Reads a task and a count a line, and answers a line of JSON: CPU time (s) of this process for one repetition,
or why the commit has no such task. It runs with any version of the package since the first with these
scenes, so that it asks for nothing else.
"""

import json
import sys
import time
from functools import partial
from pathlib import Path

import numpy as np

CHECKOUT = Path(sys.argv[1] if __name__ == "__main__" else ".")
SCENES = CHECKOUT / "config/scenes"
PLANE = {"analysis.mesh": {"elements": 64}, "analysis.step": "0.05 s"}


def run(name, **changes):
    """Simulate a scene with other values."""
    from riserstudy import load_scene, simulate

    simulate(load_scene(SCENES / f"{name}.yaml", **changes))


def statics():
    """Static equilibrium, ten times."""
    for _ in range(10):
        run("bench/s1")


def modes():
    """Ten natural modes of 120 segments."""
    from riserstudy import load_scene, modes

    mesh = {"analysis.mesh": {"elements": 120}, "analysis.step": "0.1 s"}
    modes(load_scene(SCENES / "bench/s2c.yaml", **mesh), 10)


def read_scenes():
    """Read and check three scenes, seven times."""
    from riserstudy.scene.load import read_scene

    for _ in range(7):
        for name in ("bench/s1", "bench/s2c", "chang2020/heave"):
            file = read_scene(SCENES / f"{name}.yaml")
            (file.resolved if hasattr(file, "resolved") else file.scene)()


def deck():
    """Read a deck of another program."""
    try:
        from riserstudy.importers.orcaflex import read_deck
    except ImportError:  # where it stood before
        from riserstudy.scene.orcaflex import read_deck

    read_deck(next((CHECKOUT / "tests").glob("*/decks/riser.yml")))


def fixed_loop():
    """Work that no commit changes: sums and products of arrays, and plain Python."""
    values = np.linspace(0.0, 1.0, 200_000)
    for _ in range(60):
        values = np.sqrt(values * values + 1e-3) - 1e-3
    return sum(k * k for k in range(400_000))


#: what is measured, by name; the words are those of the page
TASKS = {
    "plane": ("Surge in a plane, 64 segments, 150 s", partial(run, "bench/s2c", **PLANE)),
    "by_request": (
        "Surge in a plane, 60 s, with a tolerance of 1 %",
        partial(run, "bench/s2c", **{"analysis.accuracy": "1 %", "analysis.duration": "60 s"}),
    ),
    "line": ("Heave of a mass on a tensioner, 100 s", partial(run, "chang2020/heave")),
    "statics": ("Static equilibrium, ten times", statics),
    "modes": ("Ten natural modes of 120 segments", modes),
    "read_scenes": ("Read and check three scenes, seven times", read_scenes),
    "deck": ("Read an OrcaFlex model", deck),
}


def main():
    tasks = {name: task for name, (_, task) in TASKS.items()} | {"fixed_loop": fixed_loop}
    for line in sys.stdin:
        name, count = line.split()
        try:
            began = time.process_time()
            for _ in range(int(count)):
                tasks[name]()
            answer = {"seconds": (time.process_time() - began) / int(count)}
        except Exception as error:  # of any version: it has no such task, or does it otherwise
            answer = {"lacks": f"{type(error).__name__}: {error}"[:300]}
        print(json.dumps(answer), file=sys.__stdout__, flush=True)


if __name__ == "__main__":
    main()
