"""Do every fault to a small study, run it once more, and write down what came of it.

``python tests/faults/run.py [--kills 50] [--in-a-row 1] [--write docs/faults.md]``
"""

import argparse
import random
import shutil
import sys
import tempfile
import time
from pathlib import Path

from faults import FAULTS, killed
from small import differs, lay_out, run

MARKS = ("<!-- table -->\n", "<!-- end -->\n")

SAME = "exit 0, identical"
KILLED = "killed"  # the name of that fault, which takes longest
ALL = [*(fault.__name__ for fault in FAULTS), KILLED]


def main(place, names, kills, in_a_row):
    """Rows of the table: what was done, what the run then said, how the next one ended."""
    reference, longest = undisturbed(place)
    rows = []
    for fault in [f for f in FAULTS if f.__name__ in names]:
        folder = place / fault.__name__
        shutil.copytree(reference, folder, symlinks=True)
        try:
            row = (fault.__doc__, fault(folder), after(folder, reference))
        except PermissionError as error:
            row = (fault.__doc__, f"not tried: {error}", "")
        rows.append(row)
        print(*row, sep=" | ", flush=True)
        shutil.rmtree(folder)
    if KILLED in names:
        rows.append(kill_often(place, reference, kills, in_a_row, longest))
        print(*rows[-1], sep=" | ", flush=True)
    return rows


def undisturbed(place):
    """A checkout whose study has run without any fault, and how long that took (s)."""
    folder, timing = place / "undisturbed", place / "seconds"
    if not timing.exists():
        lay_out(folder)
        began = time.monotonic()
        status, text = run(folder)
        if status:
            sys.exit(text)
        timing.write_text(f"{time.monotonic() - began:.1f}")
    return folder, float(timing.read_text())


def kill_often(place, reference, kills, in_a_row, longest):
    """The row about killed runs."""
    rng, bad, moments = random.Random(7), [], []
    while len(moments) < kills:
        folder = place / "killed"
        shutil.copytree(reference, folder, symlinks=True)
        moments += killed(folder, min(in_a_row, kills - len(moments)), longest, rng)
        end = after(folder, reference)
        bad += [end] if end != SAME else []
        shutil.rmtree(folder)
    what = (
        f"kill -9 of the run, alone or with all it started, at {kills} random moments from start to end, "
        f"{in_a_row} runs in a row before each full one"
    )
    seen = f"from {min(moments):.1f} to {max(moments):.1f} s of {longest:.0f} s"
    return what, seen, f"{len(bad)} not so: {bad[0]}" if bad else SAME


def after(folder, reference):
    """How one more run ends, and whether its numbers are those of the undisturbed one."""
    status, text = run(folder)
    if status:
        return f"EXIT {status}: {text[-300:]}"
    return differs(folder, reference) or SAME


def write(page, rows):
    """Put the table into a page, between its marks."""
    lines = ["| what was done | what came of it | the next `make study` |", "|---|---|---|"]
    lines += [f"| {' | '.join(cell.replace('|', '/') for cell in row)} |" for row in rows]
    head, _, rest = page.read_text().partition(MARKS[0])
    _, _, tail = rest.partition(MARKS[1])
    page.write_text(head + MARKS[0] + "\n".join(lines) + "\n" + MARKS[1] + tail)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", default=ALL, help="only these: " + ", ".join(ALL))
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--in-a-row", type=int, default=1)
    parser.add_argument(
        "--place", type=Path, help="keep the undisturbed checkout there for the next time"
    )
    parser.add_argument("--write", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        place = options.place or Path(temporary)
        found = main(place, options.names, options.kills, options.in_a_row)
    if options.write:
        write(options.write, found)
    sys.exit(any(end not in (SAME, "") for _, _, end in found))
