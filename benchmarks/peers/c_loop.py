"""The same riser as an explicit loop in C, compiled for this machine when first used.

Lumped masses in arrays, no memory but the first-level cache, loops that the compiler vectorises: the
yardstick of what plain explicit stepping costs. Everything of the scene is represented. Extrapolated in
element length and step from 200 and 400 elements it agrees with the stored reference to 2e-6.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import shutil
import subprocess
import tempfile
import time
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import scene

SOURCE = Path(__file__).with_suffix(".c")
FLAGS = ["-O3", "-march=native", "-ffast-math", "-fPIC"]
LARGEST = 1024
# Steps in which the axial wave crosses an element; larger ones are unstable.
SLOWNESS = (scene.MASS / scene.AXIAL_STIFFNESS) ** 0.5
LADDER = [(n, 0.999 * scene.LENGTH / n * SLOWNESS, {}) for n in (20, 43, 64, 94, 130, 182, 364)]


class Riser(ctypes.Structure):
    """The C struct of the same name."""

    _fields_ = [
        (name, ctypes.c_double)
        for name in (
            *("length", "ea", "ei", "mass", "added", "drag", "weight"),
            *("amplitude", "period", "ramp"),
        )
    ]


def available(source: Path = SOURCE) -> str | None:
    """Why this peer cannot run, or None."""
    if not compiler():
        return "no C compiler (cc, gcc or clang)"
    try:
        library(source)
    except subprocess.CalledProcessError as error:
        return f"compiling failed: {error.stderr.strip().splitlines()[-1]}"
    return None


def compiler() -> str | None:
    """Path of the C compiler, if any."""
    return next(filter(None, map(shutil.which, (os.environ.get("CC", "cc"), "gcc", "clang"))), None)


@cache
def library(source: Path = SOURCE) -> ctypes.CDLL:
    """A compiled loop, from the cache when source, flags and compiler are the same."""
    cc = compiler()
    version = subprocess.run([cc, "--version"], capture_output=True, text=True, check=True).stdout
    key = hashlib.sha256("\n".join([source.read_text(), version, _processor(), *FLAGS]).encode()).hexdigest()[
        :16
    ]
    target = scene.CACHE / "bench" / f"{source.stem}-{key}.so"
    if not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        # Linked apart: with -ffast-math some linkers add code that flushes denormals to zero in the
        # whole process, other methods included.
        with tempfile.TemporaryDirectory(dir=target.parent) as folder:
            compiled, linked = Path(folder, "loop.o"), Path(folder, "loop.so")
            for command in (
                [cc, *FLAGS, "-c", "-o", compiled, source],
                [cc, "-shared", "-o", linked, compiled, "-lm"],
            ):
                subprocess.run(command, capture_output=True, text=True, check=True)
            linked.replace(target)
    return ctypes.CDLL(str(target))


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return ""
    return next((line for line in lines if line.startswith("flags")), "")


def run(elements: int, step: float, moments: bool = False) -> dict[str, Any]:
    """Simulate S2c with the largest step that is at most ``step`` (s) and divides the output step."""
    if not 5 <= elements <= LARGEST:
        raise ValueError(f"elements: {elements}; allowed: 5 to {LARGEST}")
    substeps = int(np.ceil(scene.OUTPUT_STEP / step - 1e-9))
    nodes = np.linspace(0.0, scene.LENGTH, elements + 1)
    shape = (scene.TIMES.size, elements + 1)
    x, z, moment = (np.full(shape, np.nan) for _ in range(3))
    height = np.ascontiguousarray(scene.static_height(nodes))
    simulate = library().simulate
    values = riser()
    started = time.process_time()
    simulate(
        ctypes.byref(values), elements, pointer(height), shape[0], substeps,
        ctypes.c_double(scene.OUTPUT_STEP / substeps),
        pointer(x), pointer(z), pointer(moment) if moments else None,
    )  # fmt: skip
    seconds = time.process_time() - started
    result = {
        "time": scene.TIMES,
        "x": x @ scene.lagrange(nodes, scene.STATIONS).T,
        "seconds": seconds,
        "meta": {
            "scheme": "semi-implicit Euler",
            "step": scene.OUTPUT_STEP / substeps,
            "failed": not (np.abs(x) < scene.BOUND).all(),
        },
    }
    if moments:
        result |= {"moment": moment, "moment_s": nodes}
    return result


def riser() -> Riser:
    """The scene as C takes it."""
    return Riser(
        scene.LENGTH, scene.AXIAL_STIFFNESS, scene.BENDING_STIFFNESS, scene.MASS, scene.ADDED_MASS,
        scene.DRAG, scene.WEIGHT, scene.AMPLITUDE, scene.PERIOD, scene.RAMP,
    )  # fmt: skip


def pointer(array: np.ndarray) -> ctypes.c_void_p:
    """Address of an array for a C call."""
    return array.ctypes.data_as(ctypes.c_void_p)
