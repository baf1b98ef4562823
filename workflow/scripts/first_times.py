"""Write the times of steps that come with the project, for runs without an earlier run.

    python workflow/scripts/first_times.py [.cache/steps.json]

Reads the memory of a run of the standard tier (``riserstudy.jobs.progress``).
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from riserstudy.jobs.progress import MEMORY, RECORDED
from riserstudy.jobs.step_times import FIRST, Taken, lines_of, remembered

ONE_BY_ONE = ("compile", "simulate", "measure")  # rules whose steps have very different times


def main(memory: Path, target: Path = FIRST) -> None:
    """Replace the times of single steps, and the mean times of the other rules of the run."""
    steps = remembered(memory).get(RECORDED)
    if not steps:
        sys.exit(f"{memory} has no times of the tier {RECORDED}; run `make study` first")
    first = json.loads(target.read_text("utf-8"))
    for rule in {name.rule for name in steps} - {*ONE_BY_ONE, "all"}:
        times = [taken.seconds for name, taken in steps.items() if name.rule == rule]
        first["a_step"][rule] = round(sum(times) / len(times), 2)
    single = {
        name: Taken(round(taken.seconds, 1), taken.points)
        for name, taken in sorted(steps.items())
        if name.rule in ONE_BY_ONE
    }
    rows = ",\n".join(f"    {json.dumps(line)}" for line in lines_of(single))
    parts = [f"  {json.dumps(key)}: {json.dumps(first[key])}" for key in ("about", "a_step", "a_point")]
    parts.append(f'  "steps": [\n{rows}\n  ]')
    target.write_text("{\n" + ",\n".join(parts) + "\n}\n", "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if sys.argv[1:] else MEMORY)
