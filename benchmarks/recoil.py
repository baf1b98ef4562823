"""Time emergency disconnects: one run of 60 s at the default accuracy, and a sample of the chapter's grid.

``python benchmarks/recoil.py [PROCESSES]`` takes the best of three runs, kernels loaded before; the grid of
1200 points is told by one in seven.
"""

from __future__ import annotations

import itertools
import os
import sys
import time
from multiprocessing import Pool
from pathlib import Path

from riserstudy import load_scene
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.refine import run

SCENE = Path(__file__).resolve().parents[1] / "config/scenes/design/recoil.yaml"
DEFAULT = {"analysis.accuracy": None}
PHASES, HEAVES = range(0, 360, 30), (0.5, 1, 2, 3, 4)  # deg, m
MUDS, PRESSURES = (1100, 1300, 1500, 1700), (50, 57, 64, 71, 78)  # kg/m3, bar
EVERY = 7  # of the grid; no divisor of an axis's length
PROMISED_RUN, PROMISED_GRID = 0.3, 300.0  # s


def scene(phase: float, heave: float, mud: float, pressure: float) -> Resolved:
    """A point of the chapter's grid."""
    values = {f"riser[{k}].contents.density": f"{mud} kg/m^3" for k in range(4)}
    values |= {"disconnect.phase": f"{phase} deg", "platform.heave.amplitude": f"{heave} m"}
    values["top.tensioners.gas.pressure"] = f"{pressure} bar absolute"
    return load_scene(SCENE, **values).resolved()


def seconds(one: Resolved) -> float:
    """Processor time of a run (s)."""
    begun = time.process_time()
    run(one)
    return time.process_time() - begun


def main(processes: int) -> None:
    """Measure and print."""
    alone = load_scene(SCENE, **DEFAULT).resolved()
    run(alone)  # loads kernels
    print(
        f"one run of 60 s at the default accuracy: {min(seconds(alone) for _ in range(3)):.2f} s "
        f"of processor (promised {PROMISED_RUN:g} s), load {os.getloadavg()[0]:.1f}"
    )
    grid = list(itertools.product(PHASES, HEAVES, MUDS, PRESSURES))
    sample = [scene(*point) for point in grid[::EVERY]]
    begun = time.perf_counter()
    with Pool(processes) as pool:
        each = pool.map(seconds, sample, chunksize=4)
    whole = (time.perf_counter() - begun) * len(grid) / len(sample)
    print(
        f"grid of {len(grid)} points on {processes} processes, from {len(sample)}: {whole:.0f} s "
        f"(promised {PROMISED_GRID:g} s); {sum(each) / len(each):.2f} s of processor a point, "
        f"at most {max(each):.2f} s"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 2)
