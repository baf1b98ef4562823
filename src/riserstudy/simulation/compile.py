"""Compile kernels once, on several cores, and record the compile time.

Each group of kernels has a separate marker file, so a command that needs one group need not wait for the
others.
"""

from __future__ import annotations

import gc
import json
import os
import time
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from filelock import FileLock

from riserstudy.files.whole import write_whole
from riserstudy.simulation.kernel_groups import GROUPS
from riserstudy.solve.kernel_cache import kernel_cache


def marker(group: str | None = None) -> Path:
    """The file that marks the kernels of a group, or of all groups, as compiled."""
    return kernel_cache() / (f"compiled-{group}" if group else "compiled")


def compile_once(notify: Callable[[str], None]) -> None:
    """Compile all kernels on all cores, unless they are compiled; reports it, because it takes minutes."""
    if marker().exists():
        return
    cores = min(available_cores(), len(GROUPS))
    on = "one core" if cores == 1 else f"{cores} cores"
    try:
        kernel_cache().mkdir(parents=True, exist_ok=True)
        with FileLock(kernel_cache() / "compiling"):
            if lacking := [group for group in GROUPS if not marker(group).exists()]:
                notify(f"compiling the kernels on {on}, once for this version: 2 to 6 minutes")
                compile_groups(lacking, cores)
            join_markers()
    # the cache cannot be written: each run compiles the kernels that it needs
    except OSError as error:
        notify(f"{kernel_cache()} cannot be written ({error.strerror}): every run will compile again")


def report_compiling(notify: Callable[[str], None]) -> None:
    """Report compiling from the first kernel on; a command compiles only the kernels that it needs."""
    from riserstudy.simulation.compile_times import follow  # which loads the compiler

    def report(kernel: str, done: int, spent: float) -> None:
        if kernel:
            notify(f"compiling: {done} functions in {spent:.0f} s, now {kernel}")
            return
        once = "once for this version"
        try:
            kernel_cache().mkdir(parents=True, exist_ok=True)
        except OSError as error:
            once = f"in every run: {kernel_cache()} cannot be written ({error.strerror})"
        notify(f"compiling the kernels that this scene needs, up to a minute, {once}")

    follow(report)


def available_cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def compile_groups(groups: Iterable[str], processes: int) -> None:
    """Compile the kernels of some groups, in separate processes."""
    with ProcessPoolExecutor(processes, get_context("spawn")) as pool:
        list(pool.map(compile_group, groups))


def compile_group(group: str) -> str:
    """Compile a group of kernels, and write kernels and times to its marker; returns the group's name."""
    from riserstudy.simulation.compile_times import while_compiling  # which loads the compiler
    from riserstudy.simulation.warm_up import warm_up

    # The compiler makes millions of objects and hardly any cyclic garbage; without garbage collection it
    # takes a fifteenth less time.
    gc.disable()
    began, spent = time.time(), time.process_time()
    kernels = while_compiling(partial(warm_up, group))
    gc.enable()
    ended, spent = time.time(), time.process_time() - spent
    about = {"began": began, "ended": ended, "core_seconds": spent, "kernels": kernels}
    marker(group).parent.mkdir(parents=True, exist_ok=True)
    write_whole(marker(group), json.dumps(about).encode())
    return f"{'compiled' if kernels else 'loaded'} in {ended - began:.1f} s, {spent:.1f} core-s"


def join_markers() -> None:
    """Write the marker of all groups, with compile times if all kernels were compiled from an empty cache."""
    notes: list[dict[str, Any]] = [json.loads(marker(g).read_text("utf-8")) for g in GROUPS]
    about: dict[str, Any] = {"cold_seconds": None}
    if all(note["kernels"] for note in notes):
        about = {
            "cold_seconds": max(n["ended"] for n in notes) - min(n["began"] for n in notes),
            "cold_core_seconds": sum(note["core_seconds"] for note in notes),
            "kernels": [kernel for note in notes for kernel in note["kernels"]],
        }
    write_whole(marker(), json.dumps(about).encode())
