"""Scene S3 as an explicit loop in C, compiled for this machine when first used.

Its longest stable step is also its best: there, waves along the pipe travel undistorted.
"""

from __future__ import annotations

import ctypes
import time
from pathlib import Path
from typing import Any

import heave
import numpy as np

from peers import c_loop

SOURCE = Path(__file__).with_suffix(".c")
LARGEST = 4095
SLOWNESS = (heave.MASS / heave.AXIAL_STIFFNESS) ** 0.5
LADDER = [(n, 0.999 * heave.LENGTH / n * SLOWNESS, {}) for n in (8, 16, 32, 64, 128, 256, 512)]


class Hanging(ctypes.Structure):
    """The C struct of the same name."""

    _fields_ = [
        (name, ctypes.c_double)
        for name in ("length", "ea", "mass", "end_mass", "drag", "amplitude", "period", "ramp")
    ]


def available() -> str | None:
    """Why this peer cannot run, or None."""
    return c_loop.available(SOURCE)


def run(elements: int, step: float) -> dict[str, Any]:
    """Simulate S3 with the largest step that is at most ``step`` (s) and divides the output step."""
    if not 2 <= elements <= LARGEST:
        raise ValueError(f"elements: {elements}; allowed: 2 to {LARGEST}")
    substeps = int(np.ceil(heave.OUTPUT_STEP / step - 1e-9))
    bottom, top = (np.full(heave.TIMES.size, np.nan) for _ in range(2))
    pipe = Hanging(
        heave.LENGTH, heave.AXIAL_STIFFNESS, heave.MASS, heave.END_MASS, heave.DRAG,
        heave.AMPLITUDE, heave.PERIOD, heave.RAMP,
    )  # fmt: skip
    simulate = c_loop.library(SOURCE).heave
    started = time.process_time()
    simulate(
        ctypes.byref(pipe), elements, heave.TIMES.size, substeps,
        ctypes.c_double(heave.OUTPUT_STEP / substeps), c_loop.pointer(bottom), c_loop.pointer(top),
    )  # fmt: skip
    seconds = time.process_time() - started
    return {
        "bottom": bottom,
        "top_tension": heave.STATIC_TOP + top,
        "seconds": seconds,
        "meta": {
            "scheme": "semi-implicit Euler",
            "step": heave.OUTPUT_STEP / substeps,
            "failed": not (np.abs(bottom) < heave.BOUND).all(),
        },
    }
