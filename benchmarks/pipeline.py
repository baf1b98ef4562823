"""Time the pipeline: the whole study with warm kernels, beside what it simulates and draws.

``python benchmarks/pipeline.py [TIER]`` removes the results of this checkout (``make clean``) and makes
them again.
"""

from __future__ import annotations

import os
import re
import resource
import subprocess
import sys
import time
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import xarray as xr

from riserstudy.chapters.draw import draw
from riserstudy.figures import save
from riserstudy.study.read import read_studies

ROOT = Path(__file__).resolve().parents[1]
# The promise: wall <= FACTOR (simulation + plotting) / cores + START_UP (s)
FACTOR, START_UP = 2.0, 15.0


def main(tier: str) -> None:
    """Measure and print."""
    os.chdir(ROOT)
    make("study", tier)  # whatever is missing, kernels above all
    make("clean", tier)
    load, before = os.getloadavg()[0], cpu_seconds()
    wall, said = make("study", tier)
    cpu = cpu_seconds() - before
    idle, _ = make("study", tier)
    jobs = int(re.findall(r"of (\d+) steps", said)[-1])
    simulation, points = simulated()
    plotting, figures = drawn()
    cores = os.cpu_count() or 1
    own = (simulation + plotting) / cores
    promise = FACTOR * own + START_UP
    print(f"tier {tier}, {cores} cores, load average {load:.1f} before the run")
    print(f"simulation {simulation:.1f} s ({points} points), plotting {plotting:.1f} s ({figures} figures)")
    print(f"make study after make clean: {wall:.1f} s, {jobs} jobs; promised {promise:.1f} s at most")
    print(f"processor time {cpu:.0f} s, which these cores do in {cpu / cores:.0f} s when left alone")
    print(f"beyond simulation and plotting: {wall - own:.1f} s, {(wall - own) / jobs:.2f} s a job,")
    print(f"  {(wall - own) / wall:.0%} of the wall time")
    print(f"make study again, nothing to do: {idle:.1f} s")


def make(target: str, tier: str) -> tuple[float, str]:
    """Wall time and words of a make target."""
    began = time.perf_counter()
    done = subprocess.run(["make", target, f"TIER={tier}"], capture_output=True, text=True, check=True)
    return time.perf_counter() - began, done.stdout


def cpu_seconds() -> float:
    """Processor time of all children so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def simulated() -> tuple[float, int]:
    """Seconds of all simulations, as each noted when it ran, and their number."""
    seconds: dict[str, float] = {}
    for path in Path("results").glob("*/*.nc"):
        with xr.open_dataset(path) as dataset:
            if "point_key" in dataset:
                keys = dataset["point_key"].values.ravel()
                times = dataset["wall_seconds"].values.ravel()
                seconds |= dict(zip(keys, times.tolist(), strict=True))
    return sum(seconds.values()), len(seconds)


def drawn() -> tuple[float, int]:
    """Seconds of drawing and saving all figures of datasets, one after the other, and their number."""
    seconds, count = 0.0, 0
    known = cache(lambda paper: read_studies(Path("config"), paper).figures)
    with TemporaryDirectory() as folder:
        for png in sorted(Path("results").glob("*/*.png")):
            paper, name = png.parent.name, png.stem
            if name not in known(paper):  # a schematic
                continue
            reads = known(paper)[name].reads
            datasets = {r: xr.load_dataset(f"results/{paper}/{r}.nc") for r in reads}
            began = time.perf_counter()
            save(draw(paper, name, datasets), Path(folder) / "a.png", Path(folder) / "a.pdf")
            seconds += time.perf_counter() - began
            count += 1
    return seconds, count


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "standard")
