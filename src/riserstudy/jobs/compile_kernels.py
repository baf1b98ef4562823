"""Compile all kernels once, before jobs fan out, and note how long that took from nothing."""

from __future__ import annotations

import argparse
import json
import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path

from riserstudy.folders import write_whole
from riserstudy.jobs.compile_times import Compiled, while_compiling
from riserstudy.simulation.warm_up import scenes, warm_up
from riserstudy.solve.kernel_cache import kernel_cache


def main(marker: Path, threads: int) -> None:
    """Warm up, and write the times into the marker when there were no kernels before."""
    cold = next(kernel_cache().rglob("*.nbi"), None) is None
    started = time.perf_counter()
    with ProcessPoolExecutor(threads, get_context("spawn")) as pool:
        groups = list(pool.map(warm, scenes()))
    seconds = round(time.perf_counter() - started, 1)
    spent = round(sum(spent for spent, _ in groups), 1)
    about = {"cold_seconds": None} if not cold else {
        "cold_seconds": seconds,
        "cold_core_seconds": spent,
        "kernels": [kernel for _, kernels in groups for kernel in kernels],
    }  # fmt: skip
    marker.parent.mkdir(parents=True, exist_ok=True)
    write_whole(marker, json.dumps(about).encode())
    print(f"{'compiled' if cold else 'loaded'} in {seconds} s, {spent} core-s")


def warm(group: str) -> tuple[float, list[Compiled]]:
    """Warm a group of kernels up; processor time (s), and what was compiled."""
    started = time.process_time()
    kernels = while_compiling(partial(warm_up, group))
    return time.process_time() - started, kernels


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("marker", type=Path)
    parser.add_argument("--threads", type=int, default=1)
    main(**vars(parser.parse_args()))
