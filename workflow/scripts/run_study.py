"""Run the study with Snakemake, one run at a time, and print a summary."""

import argparse
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

from one_run import LOCK, ROOT, SNAKEMAKE, Occupied, one_run
from study_summary import summarise

BAD_INPUT, INTERRUPTED = 2, 130  # exit statuses
LEAST_FREE = 1_000_000  # bytes; with less, Snakemake cannot write its own records


def main(arguments: list[str]) -> int:
    """Run Snakemake for the given tier, cores and targets; return its exit status."""
    options = parse(arguments)
    os.chdir(ROOT)
    began = time.monotonic()
    if fault := unwritable():
        return refuse(fault, BAD_INPUT)
    try:
        with one_run() as environment:
            status = run_snakemake(options, environment)
    except Occupied as reason:
        return refuse(str(reason))
    except OSError as error:  # such as a full disk
        return refuse(f"{error.filename or LOCK}: {error.strerror}; see whether the disk is full")
    except KeyboardInterrupt:
        print("\nriserstudy: stopped; the next run goes on from here.", file=sys.stderr)
        return INTERRUPTED
    if status == 0:
        summarise(time.monotonic() - began)
    return status


def parse(arguments: list[str]) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description="Run the study.")
    parser.add_argument("--tier", choices=("preview", "standard", "reference"), default="standard")
    parser.add_argument("--cores", default="all", help="a number, or all")
    parser.add_argument("targets", nargs="*", help="Snakemake targets; everything when left out")
    options = parser.parse_args(arguments)
    if options.cores != "all" and not (options.cores.isdecimal() and int(options.cores) > 0):
        parser.error(f"--cores takes a whole number above 0, or all; it was {options.cores!r}")
    return options


def refuse(reason: str, status: int = 1) -> int:
    """Print why nothing is run, and return the exit status."""
    print(f"riserstudy: {reason}", file=sys.stderr)
    return status


def unwritable() -> str | None:
    """Return a folder that the run needs and cannot write to, if there is one, and the reason."""
    cache = Path(os.environ.get("RISERSTUDY_CACHE") or ".cache")
    for folder in (Path("results"), *Path("results").glob("*/"), Path("logs"), cache):
        there = next(path for path in (folder, *folder.absolute().parents) if path.exists())
        if not there.is_dir() or not os.access(there, os.W_OK | os.X_OK):
            return f"{folder}: cannot be written; make the folder writable, or move it away"
        if shutil.disk_usage(there).free < LEAST_FREE:
            return f"{folder}: the disk is full; free some space"
    return None


def run_snakemake(options: argparse.Namespace, environment: dict[str, str]) -> int:
    """Run Snakemake with the project's progress plugin, and with the project's tools first on the path."""
    tools = Path(sys.executable).parent
    path = environment.get("PATH", os.defpath)
    command = [
        *(*SNAKEMAKE, *options.targets, "--rerun-incomplete"),
        *("--workflow-profile", "none", "--scheduler", "greedy"),  # as in profiles/default
        *("--logger", "riserstudy", "--logger-riserstudy-tier", options.tier),
        *("--cores", options.cores, "--config", f"tier={options.tier}"),
    ]
    done = subprocess.run(
        command,
        env=environment | {"PATH": f"{tools}{os.pathsep}{path}"},
        stdin=subprocess.DEVNULL,
        check=False,
    )
    return done.returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
