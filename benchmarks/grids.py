"""Time big grids: planning, simulation in shards, joining; reckon a million points on 64 cores.

``python benchmarks/grids.py [POINTS [SHARDS]]`` works in a folder of its own, with kernels compiled before.
The table stands in docs/clusters.md. Points are 15 s of surge of the riser of scene S2c on a given mesh.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import psutil
from ruamel.yaml import YAML

from riserstudy.jobs.server import MANY
from riserstudy.jobs.start_server import start_server
from riserstudy.jobs.workplan import Workplan
from riserstudy.simulation.compile import compile_once
from riserstudy.solve.kernel_cache import kernel_cache

ROOT = Path(__file__).resolve().parents[1]
TYPICAL, CORES, MILLION = 0.02, 64, 1_000_000  # s a point; of the reckoning
SNAKEMAKE = 2.0  # s that it takes to start on a node
PLAN = """if True:
    import sys
    from pathlib import Path
    from riserstudy.jobs.workplan import Workplan
    settings = {"papers": ["grids"], "tier": "standard"}
    plan = Workplan.read(Path("config"), settings, only=[("grids", sys.argv[1])])
    print(len(plan.study("grids", sys.argv[1]).plan))"""


@dataclass
class Cost:
    """What a process took: processor time (s) and largest memory (MB), where that is known."""

    seconds: float
    memory: float | None


def main(points: int = 10_000, shards: int = 4) -> None:
    """Measure and print."""
    compile_once(print)
    numba = kernel_cache().parent.resolve()
    with TemporaryDirectory() as folder:
        os.chdir(folder)
        os.environ["RISERSTUDY_CACHE"] = f"{folder}/.cache"
        Path(".cache").mkdir()
        Path(".cache/numba").symlink_to(numba)
        lay_out(points)
        report(points, shards)


def report(points: int, shards: int) -> None:
    """Run every step and tell what it takes."""
    few, many = (run("-c", PLAN, study) for study in ("few", "many"))
    plan = Workplan.read(Path("config"), SETTINGS, only=[])
    print("| | core-seconds | memory (MB) |\n|---|---|---|")
    row("plan 10 points: start of Python, and reading", few)
    row("plan 100 000 points", many)
    started = shard(plan, "few", 0, 1)
    row("simulate 10 points: the same, and loading the kernels", started)
    row("simulate 10 points, in a fork of the server of jobs", forked(plan))
    parts = [shard(plan, "run", number, shards) for number in range(shards)]
    part = Cost(sum(p.seconds for p in parts) / shards, max(p.memory or 0.0 for p in parts))
    size = points // shards
    row(f"simulate {size} points of {points}, one job of {shards}", part)
    tenth = shard(plan, "run", 0, 10 * shards)
    row(f"find {size // 10} points in the store", tenth)
    again = shard(plan, "run", 0, shards)
    row(f"find {size} points in the store", again)
    joined = join(plan)
    row(f"join {points} points", joined)
    a_point = (part.seconds - started.seconds) / (size - 10)
    print(f"\na point: {1e3 * a_point:.1f} ms; start-up {started.seconds / part.seconds:.0%} of a job")
    reckon(
        planning=(many.seconds - few.seconds) / 100_000,
        starting=started.seconds + few.seconds + SNAKEMAKE,
        finding=(again.seconds - tenth.seconds) / (0.9 * size),
        joining=(joined.seconds - few.seconds) / points,
    )


def reckon(planning: float, starting: float, finding: float, joining: float) -> None:
    """What a million points of typical length would cost, from what was measured (s a point, a job)."""
    jobs = 8 * CORES
    simulating = MILLION * (TYPICAL + planning + finding) + jobs * starting
    alone = MILLION * (2 * planning + joining)  # by Snakemake, and by the job that joins
    wall, hours = (alone + simulating / CORES) / 60, (alone + simulating) / 3600
    print(f"a million points of {TYPICAL * 1e3:.0f} ms on {CORES} cores, {jobs} jobs, on paper:")
    print(f"{MILLION * planning:.0f} s of planning, {simulating / CORES:.0f} s of all cores,")
    print(f"{MILLION * (planning + joining):.0f} s of joining: {wall:.0f} min, {hours:.1f} core-hours")


SETTINGS = {"papers": ["grids"], "tier": "standard"}


def lay_out(points: int) -> None:
    """Write the configuration: one scene, the same axes with many, some and few values."""
    yaml = YAML()
    for part in ("scenes", "studies"):
        Path("config", part).mkdir(parents=True)
    scene = yaml.load(ROOT / "config/scenes/bench/s2c.yaml")
    scene["analysis"] = {"duration": "15 s", "output": {"interval": "1 s"}}
    scene["analysis"] |= {"mesh": {"elements": 12}, "step": "0.1 s"}
    yaml.dump(scene, Path("config/scenes/scene.yaml"))
    studies = {"run": study(points // 1000), "many": study(100), "few": study(10, 1)}
    about = {"paper": "grids", "studies": studies, "figures": {}}
    yaml.dump(about, Path("config/studies/grids.yaml"))
    yaml.dump(SETTINGS | {"tiers": {"standard": {}}}, Path("config/config.yaml"))


def study(amplitudes: int, others: int = 10) -> dict[str, object]:
    """A grid of four axes."""

    def axis(path: str, unit: str, start: float, step: float, count: int) -> dict[str, object]:
        return {"path": path, "unit": unit, "values": [start + step * k for k in range(count)]}

    axes = {
        "mass": axis("riser[0].mass", "kg/m", 900.0, 10.0, others),
        "period": axis("platform.surge.period", "s", 9.0, 0.5, others),
        "drag": axis("riser[0].drag.coefficient", "1", 0.7, 0.05, others),
        "amplitude": axis("platform.surge.amplitude", "m", 0.5, 0.01, amplitudes),
    }
    keep = ["x_max", "x_min", "bending_moment_max"]
    return {"scene": "scenes/scene.yaml", "caption": "a grid", "axes": axes, "keep": keep}


def shard(plan: Workplan, study: str, number: int, shards: int, *, alone: bool = True) -> Cost:
    """Cost of simulating a shard, in a process of its own or in a fork of the server of jobs."""
    words = ["grids", study, str(number), str(shards)]
    expect = ["--expect", plan.shard_digest(*words)]
    words += ["marker", "--tier", "standard"]
    command = ["riserstudy.jobs", *(["--alone"] if alone else []), "shard"]
    return run("-m", *command, *words, "--threads", "1", *expect)


def forked(plan: Workplan) -> Cost:
    """Cost of simulating ten points as a job of a run on one machine, whose server has loaded everything."""
    Path(".snakemake").mkdir()
    start_server(str(plan.compiled))
    server = psutil.Process().children()[0]
    for number in range(MANY + 3):  # so many that the server loads the kernels
        before = children_of(server)
        asking = shard(plan, "many", number, 10_000, alone=False)
        while (spent := children_of(server) - before) == 0.0:
            time.sleep(0.1)  # the job has ended, and is not buried yet
        time.sleep(1.0)
        while server.cpu_percent(0.5) > 5.0:  # it loads them when nobody asks
            pass
    return Cost(asking.seconds + spent, None)


def children_of(process: psutil.Process) -> float:
    """Processor time of a process's children that have ended (s)."""
    times = process.cpu_times()
    return float(times.children_user + times.children_system)


def join(plan: Workplan) -> Cost:
    """Cost of joining all points."""
    digest = plan.study_digest("grids", "run")
    words = ["grids", "run", "results/grids/run.nc", "--tier", "standard", "--threads", "1"]
    return run("-m", "riserstudy.jobs", "--alone", "simulate", *words, "--expect", digest)


def run(*arguments: str) -> Cost:
    """Run Python with these arguments."""
    process = subprocess.Popen([sys.executable, *arguments], stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    if status:
        raise SystemExit(f"failed: {' '.join(arguments)}")
    return Cost(used.ru_utime + used.ru_stime, used.ru_maxrss / 1e3)


def row(what: str, cost: Cost) -> None:
    """Print a line of the table."""
    memory = "" if cost.memory is None else f"{cost.memory:.0f}"
    print(f"| {what} | {cost.seconds:.1f} | {memory} |", flush=True)


if __name__ == "__main__":
    main(*(int(word) for word in sys.argv[1:]))
