"""What a step of the explicit kernel costs beside the same riser in C, on scene S2c.

Two loops in C: the plain one of the comparison, and one with all that the kernel reckons. The three run in
turns; the shortest time of each counts. ``python benchmarks/explicit.py``
"""

from __future__ import annotations

import ctypes
import math
import time
from pathlib import Path

import alone  # noqa: F401
import numpy as np
import ours
import scene
from peers import c_loop

SAME = Path(__file__).parent / "peers" / "c_same.c"
ELEMENTS = (50, 94, 200)
ROUNDS = 5
EXPLICIT = {"method": "explicit", "output": {"interval": "5 s"}}


def main() -> None:
    """Measure and print."""
    if why := c_loop.available() or c_loop.available(SAME):
        print(f"explicit kernel beside C: not available: {why}")
        return
    print("| elements | step (ms) | kernel | C | same in C | kernel / C | kernel / same |")
    print("|---|---|---|---|---|---|---|")
    for n in ELEMENTS:
        parts = math.ceil(scene.OUTPUT_STEP / (0.98 * scene.LENGTH / n * c_loop.SLOWNESS))
        step = scene.OUTPUT_STEP / parts
        steps = scene.DURATION / step
        spent = np.array([timed(n, step) for _ in range(ROUNDS)]).min(axis=0) / steps * 1e9
        cells = (f"{1e3 * step:.3g}", *(f"{ns:.0f} ns" for ns in spent))
        cells += (f"{spent[0] / spent[1]:.2f}", f"{spent[0] / spent[2]:.2f}")
        print(f"| {n} | " + " | ".join(cells) + " |", flush=True)


def timed(n: int, step: float) -> tuple[float, float, float]:
    """Processor times (s) of the kernel, of the plain loop, and of that with the same terms."""
    done, _, kernel = ours.simulated(ours.SCENE, n, 0.9999 * step, EXPLICIT)
    plain = c_loop.run(n, step)["seconds"]
    seconds, x = same(n, step)
    found, every = done.arrays["x"], round(5.0 / scene.OUTPUT_STEP)
    off = np.abs(x[::every] - found).max() / np.abs(found).max()
    if not off < 1e-3:
        raise ValueError(f"{n} elements: the loop with the same terms is off by {off:.2g}")
    return kernel, plain, seconds


def same(n: int, step: float) -> tuple[float, np.ndarray]:
    """Processor time (s) and x (outputs, nodes) of the loop with the same terms."""
    nodes = np.linspace(0.0, scene.LENGTH, n + 1)
    height = np.ascontiguousarray(scene.static_height(nodes))
    x, energy = np.full((scene.TIMES.size, n + 1), np.nan), np.zeros(2)
    simulate = c_loop.library(SAME).simulate
    riser = c_loop.riser()
    parts = round(scene.OUTPUT_STEP / step)
    started = time.process_time()
    failed = simulate(
        ctypes.byref(riser), n, c_loop.pointer(height), scene.TIMES.size, parts,
        ctypes.c_double(step), c_loop.pointer(x), c_loop.pointer(energy),
    )  # fmt: skip
    seconds = time.process_time() - started
    if failed or not 0.0 < energy[1] < 1.1 * energy[0]:
        raise ValueError(f"{n} elements: energy supplied and lost {energy} J")
    return seconds, x


if __name__ == "__main__":
    main()
