"""The same numbers from one core and two, and from every Python named: ``run.py PYTHON PYTHON ...``.

Each interpreter gets a copy of the checkout with an environment from the locks. Cores must agree bit for
bit, interpreters to 1e-9 of a variable's largest magnitude: their libraries differ, see the lock files.
"""

import argparse
import os
import shutil
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

from riserstudy.dataset.diff import changes

ROOT = Path(__file__).parents[2]
BETWEEN_PYTHONS = 1e-9
BENCH = ("s1", "s2", "s2c", "s3", "s4b", "s4c", "s4e")
CHANG = ("from_rest", "quasi_static", "rigid", "riser_mass", "riser_mass_start", "open_law")
TARGETS = [*(f"results/bench/{n}.nc" for n in BENCH), *(f"results/chang2020/{n}.nc" for n in CHANG)]


def main(pythons, place):
    """Run and compare; whether all agree."""
    pythons = [python for python in pythons if here(python)]
    folders = [place / Path(python).name for python in pythons]
    for folder, python in zip(folders, pythons, strict=True):
        install(folder, python)
        study(folder, 1)
    for part in ("results", ".cache/points"):
        shutil.move(folders[0] / part, folders[0] / f"{part}-1")
    study(folders[0], 2)
    one = folders[0] / "results-1"
    ends = [notify(f"{pythons[0]}, 2 cores against 1", changes(one, folders[0] / "results"), 0.0)]
    for folder, python in zip(folders[1:], pythons[1:], strict=True):
        found = changes(one, folder / "results")
        ends.append(notify(f"{python} against {pythons[0]}", found, BETWEEN_PYTHONS))
    return all(ends)


def here(python):
    """Whether an interpreter can be run: a name on the path may have nothing behind it."""
    with suppress(OSError):
        if not subprocess.run([python, "-c", ""], capture_output=True).returncode:
            return True
    print(f"{python}: not on this machine, not compared", flush=True)
    return False


def install(folder, python):
    """Copy the checkout as far as it is under version control, and make its environment."""
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True)
    for name in listed.stdout.splitlines():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, folder / name)
    for stale in ("results", "results-1", ".cache/points", ".cache/points-1", ".snakemake"):
        shutil.rmtree(folder / stale, ignore_errors=True)
    make = ["sh", "workflow/scripts/with_python.sh", "workflow/scripts/make_environment.py", ".venv/.ready"]
    subprocess.run(make, cwd=folder, env=environment() | {"PYTHON": python}, check=True)


def study(folder, cores):
    """Run part of the study."""
    command = [".venv/bin/python", "workflow/scripts/run_study.py", "--tier", "preview"]
    subprocess.run([*command, "--cores", str(cores), *TARGETS], cwd=folder, env=environment(), check=True)


def environment():
    """Ours, without what points to another checkout."""
    own = ("PYTHONPATH", "PYTHONHOME", "RISERSTUDY_CACHE", "MAKELEVEL", "PYTHON")
    return {name: value for name, value in os.environ.items() if name not in own}


def notify(what, found, allowed):
    """Print a comparison; whether it is as allowed."""
    good = found.largest <= allowed and not any(one.why for one in found.varied)
    worst = max(found.varied, key=lambda one: one.change, default=None)
    where = f", most in {worst.dataset} {worst.variable} {worst.why}" if worst else ""
    count = f"{len(found.varied)} of {found.variables} variables differ"
    print(f"{what}: {count}, by {found.largest:.2g} at most{where}", flush=True)
    return good


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pythons", nargs="+", metavar="PYTHON", help="the first is compared with")
    parser.add_argument("--place", type=Path, default=ROOT / ".cache/pythons")
    options = parser.parse_args()
    sys.exit(not main(options.pythons, options.place))
