"""Write the times of steps that come with the project, for runs without an earlier run.

    python workflow/scripts/first_times.py [.cache/steps.json]

Reads the memory of a run of the standard tier (``riserstudy.jobs.progress``).
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from riserstudy.jobs.progress import FIRST, MEMORY, Taken

ONE_BY_ONE = ("compile", "simulate", "measure")  # rules whose steps have very different times


def main(memory: Path) -> None:
    """Replace the times of single steps, and the mean times of the other rules of the run."""
    steps = {m: Taken(*of) for m, of in json.loads(memory.read_text("utf-8"))["standard"].items()}
    first = json.loads(FIRST.read_text("utf-8"))
    for rule in {of.rule for of in steps.values()} - {*ONE_BY_ONE, "all"}:
        times = [of.seconds for of in steps.values() if of.rule == rule]
        first["a_step"][rule] = round(sum(times) / len(times), 2)
    first["steps"] = {
        message: [of.rule, round(of.seconds, 1), of.points]
        for message, of in sorted(steps.items())
        if of.rule in ONE_BY_ONE
    }
    *rows, last = (f"    {json.dumps(m)}: {json.dumps(of)}" for m, of in first["steps"].items())
    parts = [f"  {json.dumps(key)}: {json.dumps(first[key])}" for key in ("about", "a_step", "a_point")]
    parts.append('  "steps": {\n' + ",\n".join([*rows, last]) + "\n  }")
    FIRST.write_text("{\n" + ",\n".join(parts) + "\n}\n", "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if sys.argv[1:] else MEMORY)
