"""Run the study with Snakemake: one run at a time, whatever became of the one before.

A lock that the system frees when its holder ends keeps two runs apart. Every process of a run
carries the run's name in its environment, so what a killed run left behind is found and ended
before the next one starts; stored points are complete or absent, so ending a job at any moment
costs only what it was at.
"""

import argparse
import contextlib
import csv
import fcntl
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import uuid
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from itertools import pairwise
from pathlib import Path
from types import FrameType
from typing import NoReturn, TextIO

import psutil

from study_progress import Progress, lasting

ROOT = Path(__file__).resolve().parents[2]
SNAKEMAKE = (sys.executable, "-m", "snakemake", "--nocolor")
RUN_NAME = "RISERSTUDY_RUN"
VERDICTS = (
    *("reproduced", "calibrated", "holds", "depends", "fails"),
    *("not comparable", "not reproducible"),
)
WAIT_FOR_LOCK = 3.0  # s; a run whose `make` was killed needs less to end
LOG_TAIL = 25  # lines
BAD_INPUT = 2  # exit status


def main(arguments: list[str]) -> int:
    """Run Snakemake for the given tier, cores and targets; return its exit status."""
    options = parse(arguments)
    os.chdir(ROOT)
    began = time.monotonic()
    if fault := unwritable():
        return refuse(fault, BAD_INPUT)
    Path(".cache").mkdir(mode=0o700, exist_ok=True)
    with Path(".cache/study.lock").open("a+", encoding="utf-8") as lock:
        if not take(lock):
            return refuse(
                f"another run {holder(lock)}is at work here; try again when it has ended."
            )
        end_processes(former_run(lock))
        if locked() and (pid := foreign_snakemake()):
            return refuse(f"a snakemake (pid {pid}) is at work here; try again when it has ended.")
        run = uuid.uuid4().hex
        write(lock, f"{os.getpid()} {run}")
        install_signal_handlers()
        try:
            unlock()
            status = run_snakemake(options, environment(run))
        except KeyboardInterrupt:
            status = 130
            print("\nriserstudy: stopped; the next run goes on from here.", file=sys.stderr)
        finally:
            end_processes(run)
            unlock()
            write(lock, "")
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
    """Say why nothing is run."""
    print(f"riserstudy: {reason}", file=sys.stderr)
    return status


def unwritable() -> str | None:
    """Name a folder that the run needs and cannot write to, if there is one."""
    cache = Path(os.environ.get("RISERSTUDY_CACHE") or ".cache")
    for folder in (Path("results"), *Path("results").glob("*/"), Path("logs"), cache):
        there = next(path for path in (folder, *folder.absolute().parents) if path.exists())
        if not there.is_dir() or not os.access(there, os.W_OK | os.X_OK):
            return f"{folder}: cannot be written; make it a folder that can, or move it away"
    return None


# One run at a time


def take(lock: TextIO) -> bool:
    """Take the lock, waiting a moment for a run that is about to end."""
    deadline = time.monotonic() + WAIT_FOR_LOCK
    while True:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return True
        except BlockingIOError:
            if time.monotonic() > deadline:
                return False
            time.sleep(0.1)


def holder(lock: TextIO) -> str:
    """Name the process that holds the lock, as far as it has said so."""
    words = read(lock).split()
    return f"(pid {words[0]}) " if words else ""


def former_run(lock: TextIO) -> str | None:
    """Name of a run that did not come to its end, if there is one."""
    words = read(lock).split()
    return words[1] if len(words) == 2 else None


def read(lock: TextIO) -> str:
    """Read what the lock file says."""
    lock.seek(0)
    return lock.read()


def write(lock: TextIO, text: str) -> None:
    """Replace what the lock file says."""
    lock.seek(0)
    lock.truncate()
    lock.write(text)
    lock.flush()


def mark(run: str) -> str:
    """What processes of a run carry: a copy of this folder has the same lock file, but not this run."""
    return f"{run} in {ROOT}"


def end_processes(run: str | None) -> None:
    """End every process of a run and wait until all are gone."""
    while run is not None and (processes := list(processes_of(run))):
        for process in processes:
            with contextlib.suppress(psutil.NoSuchProcess):
                process.kill()
        psutil.wait_procs(processes, timeout=10)


def processes_of(run: str) -> Iterator[psutil.Process]:
    """Find the living processes that carry a run's name."""
    for process in psutil.process_iter(["environ", "status"]):
        named = (process.info["environ"] or {}).get(RUN_NAME)
        if named == mark(run) and process.info["status"] != psutil.STATUS_ZOMBIE:
            yield process


def foreign_snakemake() -> int | None:
    """Process number of a snakemake that was started in this folder by hand."""
    for process in psutil.process_iter(["cmdline", "cwd"]):
        names = [Path(word).name for word in process.info["cmdline"] or ()]
        if process.info["cwd"] == str(ROOT) and "snakemake" in names[1:3]:
            return int(process.pid)
    return None


def install_signal_handlers() -> None:
    """Turn a request to end, and the end of the `make` that started us, into an interrupt."""

    def interrupt(_signal: int, _frame: FrameType | None) -> NoReturn:
        raise KeyboardInterrupt

    def watch(parent: int) -> None:
        while os.getppid() == parent:
            time.sleep(0.3)
        os.kill(os.getpid(), signal.SIGTERM)

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN or number == signal.SIGTERM:
            signal.signal(number, interrupt)
    if "MAKELEVEL" in os.environ:
        threading.Thread(target=watch, args=(os.getppid(),), daemon=True).start()


# Snakemake


def environment(run: str) -> dict[str, str]:
    """Environment of a run: its name, and our tools first on the path."""
    tools = Path(sys.executable).parent
    path = os.environ.get("PATH", os.defpath)
    return os.environ | {RUN_NAME: mark(run), "PATH": f"{tools}{os.pathsep}{path}"}


def locked() -> bool:
    """Whether Snakemake's own lock is set."""
    return any(Path(".snakemake/locks").glob("*"))


def unlock() -> None:
    """Remove the lock of a Snakemake that was killed; only when none is at work."""
    if locked():
        subprocess.run([*SNAKEMAKE, "--unlock"], capture_output=True, check=False)


def run_snakemake(options: argparse.Namespace, env: dict[str, str]) -> int:
    """Run Snakemake, showing its progress in short; say what failed."""
    command = [
        *(*SNAKEMAKE, *options.targets, "--rerun-incomplete"),
        *("--cores", options.cores, "--config", f"tier={options.tier}"),
    ]
    with subprocess.Popen(
        command,
        env=env,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
    ) as process:
        text = list(show_progress(process.stdout or (), Progress(options.tier)))
    if process.returncode and (fault := bad_input(text)):
        return refuse(fault, BAD_INPUT)
    if process.returncode:
        print(failure(text), file=sys.stderr)
    return process.returncode


def bad_input(output: list[str]) -> str | None:
    """Tell what is wrong in the configuration, when that is why Snakemake did not start."""
    for before, line in pairwise(output):
        if before.startswith("WorkflowError in") and line.startswith("riserstudy: "):
            return line.removeprefix("riserstudy: ")
    return None


def show_progress(lines: Iterable[str], progress: Progress) -> Iterator[str]:
    """Pass lines on; show how far the run is, on one line, or in a log by one line per change."""
    terminal = sys.stdout.isatty()
    ended = threading.Event()

    def show() -> None:
        last: tuple[object, ...] = ()
        while not ended.wait(1.0 if terminal else 10.0):
            state = progress.state()
            if (progress.steps or progress.at_work) and (terminal or state != last):
                show_line(progress.text(), terminal)
                last = state

    showing = threading.Thread(target=show, daemon=True)
    showing.start()
    try:
        for line in lines:
            yield line.rstrip()
            progress.see(line)
            if line.startswith("riserstudy: note: "):
                print(line.rstrip().removeprefix("riserstudy: note: "), flush=True)
            elif line.startswith("Nothing to be done"):
                print("Nothing to do: every result is up to date.", flush=True)
    finally:
        ended.set()
        showing.join()
        progress.remember()
    if progress.steps:
        show_line(progress.text(), terminal)
        print(end="\n" if terminal else "", flush=True)


def show_line(text: str, terminal: bool) -> None:
    """Show a line; on a terminal in place of the last one, no longer than it is wide."""
    if terminal:
        width = shutil.get_terminal_size().columns - 1
        short = text if len(text) <= width else text[: width - 1] + "…"
        print(f"\r{short:{width}}", end="", flush=True)
    else:
        print(text, flush=True)


def failure(output: list[str]) -> str:
    """Tell which rules failed and how their logs end, or why Snakemake did not start."""
    parts = []
    for number, line in enumerate(output):
        if found := re.match(r"Error in rule (\w+):", line):
            block: dict[str, str] = {}
            for entry in output[number + 1 : number + 9]:
                key, _, value = entry.strip().partition(": ")
                block.setdefault(key, value)
            parts.append(
                f"riserstudy: {found[1]} failed to make {block.get('output', 'its output')}"
            )
            log = block.get("log", "").partition(" (check log")[0]
            if Path(log).is_file():
                tail = Path(log).read_text(encoding="utf-8", errors="replace").splitlines()
                parts += [f"{log} ends:", *(f"    {line}" for line in tail[-LOG_TAIL:])]
    if not parts:
        error = re.compile(r"\w*(Error|Exception)\b")
        first = next((i for i, line in enumerate(output) if error.match(line)), -LOG_TAIL)
        parts = ["riserstudy: snakemake stopped:", *output[first:][:LOG_TAIL]]
    parts += [line for line in output if line.startswith("Complete log")]
    return "\n".join(parts)


# What came out


def summarise(seconds: float) -> None:
    """Say where the results are and how the published numbers and claims came out."""
    report, table = Path("results/report.html"), Path("results/reproduction.csv")
    datasets = Counter(path.parent for path in sorted(Path("results").glob("*/*.nc")))
    print(f"Done in {lasting(seconds)}.")
    for folder, count in datasets.items():
        print(f"  datasets  {folder}/*.nc ({count})")
    graded = sorted(Path("results").glob("*/reproduction.csv"))
    newest = max((path.stat().st_mtime for path in graded), default=0.0)
    old = {path for path in (report, table) if path.exists() and path.stat().st_mtime < newest}
    for kind, path in (("report", report), ("table", table)):
        if path.exists():
            print(f"  {kind:9} {path}{' (of an earlier run)' if path in old else ''}")
    reported = graded if table in old else [table] if table.exists() else []
    if reported:
        rows = [row for path in reported for row in graded_in(path)]
        print(f"\n{verdicts(rows)}")
        if failed := [f"{row['paper']} {row['id']}" for row in rows if row["verdict"] == "fails"]:
            print(f"\nFails: {', '.join(failed)}")
    if report.exists() and report not in old:
        print(f"\nOpen {report.resolve().as_uri()}")


def graded_in(table: Path) -> list[dict[str, str]]:
    """Rows of a table of numbers and claims."""
    with table.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def verdicts(rows: Iterable[dict[str, str]]) -> str:
    """Count the verdicts per paper and kind."""
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for row in rows:
        counts[f"{row['paper']} {row['kind']}s"][row["verdict"]] += 1
    met = {verdict for counter in counts.values() for verdict in counter}
    columns = [*(v for v in VERDICTS if v in met), *sorted(met.difference(VERDICTS))]
    width = max(map(len, counts), default=0)
    lines = ["  ".join((f"  {'':{width}}", *columns))]
    for name, counter in counts.items():
        cells = (f"{counter[column] or '-':>{len(column)}}" for column in columns)
        lines.append("  ".join((f"  {name:{width}}", *cells)))
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
