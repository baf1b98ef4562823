"""Meet hostile input at full count: ``python tests/fuzz/run.py [KIND=COUNT ...] [--first SEED]``.

A case is its kind and its seed. ``--seed`` repeats one and prints what it was.
"""

import argparse
import sys
import tempfile
import time
from pathlib import Path

from hostile import KINDS, case
from judge import attempt, faults_of, in_a_process

from riserstudy.simulation.compile import compile_once

FULL = {"scene": 10_000, "study": 2_000, "table": 1_000, "command": 1_000}
PROCESSES = 100  # of scenes, tables and commands each, also through the installed command


def main(counts, first):
    """Meet so many cases of each kind; the number of faults."""
    total = 0
    for kind, count in counts.items():
        began = time.monotonic()
        seeds = range(first, first + count)
        faults, codes = faults_of(kind, seeds, lambda text: print(text, flush=True))
        total += len(faults)
        shares = ", ".join(f"{n} exit {code}" for code, n in sorted(codes.items(), key=str))
        spent = f"{time.monotonic() - began:.0f} s"
        print(f"{kind}: {count} cases, {shares}, {len(faults)} faults; {spent}", flush=True)
    return total


def through_processes(count, first):
    """Meet cases through the installed command; the number of faults."""
    faults = 0
    for kind in ("scene", "table", "command"):
        for seed in range(first, first + count):
            _, fault = in_a_process(kind, seed)
            if fault:
                faults += 1
                print(f"process {kind} {seed}: {fault}", flush=True)
    print(f"process: {3 * count} cases, {faults} faults", flush=True)
    return faults


def show(kind, seed):
    """Print a case and how it ends."""
    with tempfile.TemporaryDirectory() as name:
        doing = case(kind, seed, Path(name))
        for pattern in ("case.yaml", "a.csv", "config/studies/*"):
            for path in Path(name).glob(pattern):
                print(f"--- {path.name}\n{path.read_bytes()[:3000]!r}")
        print(doing if isinstance(doing, list) else "")
    print(*attempt(kind, seed), sep="\n")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("counts", nargs="*", metavar="KIND=COUNT")
    parser.add_argument("--first", type=int, default=0, help="first seed")
    parser.add_argument("--processes", type=int, default=PROCESSES)
    parser.add_argument("--seed", help="KIND:SEED of one case to show")
    options = parser.parse_args()
    if options.seed:
        show(options.seed.partition(":")[0], int(options.seed.partition(":")[2]))
        sys.exit()
    wanted = {kind: int(count) for kind, _, count in (word.partition("=") for word in options.counts)}
    unknown = set(wanted) - set(KINDS)
    if unknown:
        parser.error(f"no kind {unknown}; kinds are {', '.join(KINDS)}")
    compile_once(lambda text: print(text, flush=True))  # the time of a case does not include it
    found = main(wanted or FULL, options.first)
    if not wanted:
        found += through_processes(options.processes, options.first)
    sys.exit(min(found, 1))
