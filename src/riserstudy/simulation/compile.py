"""Compile all kernels once, on several cores, and note how long that took from nothing."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path

from filelock import FileLock

from riserstudy.folders import write_whole
from riserstudy.simulation.compile_times import Compiled, while_compiling
from riserstudy.simulation.warm_up import scenes, warm_up
from riserstudy.solve.kernel_cache import kernel_cache


def marker() -> Path:
    """The file that tells that all kernels are compiled."""
    return kernel_cache() / "compiled"


def compile_once(tell: Callable[[str], None]) -> None:
    """Compile all kernels on all cores, unless that was done, and say so: it takes minutes."""
    if marker().exists():
        return
    cores = min(available_cores(), len(scenes()))
    on = "one core" if cores == 1 else f"{cores} cores"
    try:
        kernel_cache().mkdir(parents=True, exist_ok=True)
        with FileLock(kernel_cache() / "compiling"):
            if not marker().exists():
                tell(f"compiling the kernels on {on}, once for this version: 2 to 6 minutes")
                compile_all(marker(), cores)
    except OSError as error:  # nothing can be kept: each run compiles what it needs
        tell(f"{kernel_cache()} cannot be written ({error.strerror}): every run will compile anew")


def available_cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def compile_all(target: Path, processes: int) -> str:
    """Warm up, and write the times into the marker when there were no kernels before; what was done."""
    cold = next(kernel_cache().rglob("*.nbi"), None) is None
    started = time.perf_counter()
    with ProcessPoolExecutor(processes, get_context("spawn")) as pool:
        groups = list(pool.map(_warm, scenes()))
    seconds = round(time.perf_counter() - started, 1)
    spent = round(sum(spent for spent, _ in groups), 1)
    about = {"cold_seconds": None} if not cold else {
        "cold_seconds": seconds,
        "cold_core_seconds": spent,
        "kernels": [kernel for _, kernels in groups for kernel in kernels],
    }  # fmt: skip
    target.parent.mkdir(parents=True, exist_ok=True)
    write_whole(target, json.dumps(about).encode())
    return f"{'compiled' if cold else 'loaded'} in {seconds} s, {spent} core-s"


def _warm(group: str) -> tuple[float, list[Compiled]]:
    """Warm a group of kernels up; processor time (s), and what was compiled."""
    started = time.process_time()
    kernels = while_compiling(partial(warm_up, group))
    return time.process_time() - started, kernels
