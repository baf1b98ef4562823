"""Do every fault to a small study, run it once more, and write down what came of it.

``python tests/faults/run.py [--kills 50] [--in-a-row 1] [--at-once 2] [--write docs/faults.md]``
"""

import argparse
import os
import random
import shutil
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

from faults import FAULTS, killed
from small import differs, forget, lay_out, run

MARKS = ("<!-- table -->\n", "<!-- end -->\n")

SAME = "exit 0, identical"
NOT_TRIED = "not tried: "
KILLED = "killed"  # the name of that fault, which takes longest
ALL = [*(fault.__name__ for fault in FAULTS), KILLED]


def main(place, names, kills, in_a_row, at_once):
    """Rows of the table: what was done, what the run then said, how the next one ended."""
    reference = undisturbed(place)
    rows = []
    for fault in [f for f in FAULTS if f.__name__ in names]:
        folder = place / fault.__name__
        shutil.copytree(reference, folder, symlinks=True)
        try:
            row = (fault.__doc__, fault(folder), after(folder, reference))
        except PermissionError as error:
            row = (fault.__doc__, f"{NOT_TRIED}{error}", "")
        rows.append(row)
        print(*row, sep=" | ", flush=True)
        shutil.rmtree(folder)
    if KILLED in names:
        rows.append(kill_often(place, reference, kills, in_a_row, at_once))
        print(*rows[-1], sep=" | ", flush=True)
    return rows


def undisturbed(place):
    """A checkout whose study has run without any fault."""
    folder, made = place / "undisturbed", place / "made"
    if not made.exists():
        lay_out(folder)
        status, text = run(folder)
        if status:
            sys.exit(text)
        made.touch()
    return folder


def kill_often(place, reference, kills, in_a_row, at_once):
    """The row about killed runs: so many at once as there are cores, each in a folder of its own."""
    rng, bad, moments = random.Random(7), [], []
    shares = [(k + rng.random()) / kills for k in range(kills)]  # one in every piece of the time
    rng.shuffle(shares)
    rows = [shares[k : k + in_a_row] for k in range(0, kills, in_a_row)]
    with ThreadPoolExecutor(at_once) as pool:
        longest = max(pool.map(partial(from_nothing, place, reference), range(at_once)))
        for folder, moment, done in pool.map(
            partial(kill_and_run, place, reference, longest), range(len(rows)), rows
        ):
            end = judged(*done, folder, reference)
            moments += moment
            bad += [end] if end != SAME else []
            print(f"{len(moments)} kills", *(f"{m:.1f} s" for m in moment), end, flush=True)
            shutil.rmtree(folder)
    what = (
        f"The run is killed (`kill -9`) at one of {kills} random moments, "
        "alone or with all processes that it started."
    )
    if in_a_row > 1:
        what += f" {in_a_row} killed runs precede each complete one."
    seen = f"killed after {min(moments):.1f} to {max(moments):.1f} s of {longest:.0f} s"
    return what, seen, f"{len(bad)} not so: {bad[0]}" if bad else SAME


def from_nothing(place, reference, number):
    """How long an undisturbed run takes beside as many others as there are kills at once (s)."""
    folder = shutil.copytree(reference, place / f"timed-{number}", symlinks=True)
    forget(folder)
    began = time.monotonic()
    run(folder)
    seconds = time.monotonic() - began
    shutil.rmtree(folder)
    return seconds


def kill_and_run(place, reference, longest, number, shares):
    """Kill runs in a folder of their own, then run once more: the folder, moments (s), how that ended."""
    folder = shutil.copytree(reference, place / f"killed-{number}", symlinks=True)
    moments = killed(folder, shares, longest, random.Random(number))
    return folder, moments, run(folder)


def after(folder, reference):
    """How one more run ends, and whether its numbers are those of the undisturbed one."""
    return judged(*run(folder), folder, reference)


def judged(status, text, folder, reference):
    """What to say of a run that ended so."""
    if status:
        return f"EXIT {status}: {text[-300:]}"
    return differs(folder, reference) or SAME


def write(page, rows):
    """Put rows into the table of a page, between its marks; a row stays where nothing was tried anew."""
    head, _, rest = page.read_text().partition(MARKS[0])
    before, _, tail = rest.partition(MARKS[1])
    heading = ["| fault | result or extent of damage | the next `make study` |", "|---|---|---|"]
    lines = {line.split(" | ")[0]: line for line in before.splitlines()[len(heading) :]}
    for row in rows:
        cells = [" ".join(cell.replace("|", "/").split()).rstrip(".") for cell in row]
        if not cells[1].startswith(NOT_TRIED) or f"| {cells[0]}" not in lines:
            lines[f"| {cells[0]}"] = f"| {' | '.join(cells)} |"
    table = "\n".join([*heading, *lines.values()])
    page.write_text(head + MARKS[0] + table + "\n" + MARKS[1] + tail)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", default=ALL, help="only these: " + ", ".join(ALL))
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--in-a-row", type=int, default=1)
    parser.add_argument("--at-once", type=int, default=os.cpu_count(), help="killed runs at once")
    parser.add_argument("--place", type=Path, help="keep the undisturbed checkout there for the next time")
    parser.add_argument("--write", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        place = options.place or Path(temporary)
        found = main(place, options.names, options.kills, options.in_a_row, options.at_once)
    if options.write:
        write(options.write, found)
    sys.exit(any(end not in (SAME, "") for _, _, end in found))
