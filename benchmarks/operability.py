"""Time an operability chart: five limits, nine currents, both sides of the well, as in the chapter design.

``python benchmarks/operability.py [PROCESSES]`` takes the best of three charts, kernels loaded before.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import numpy as np

from riserstudy import load_scene
from riserstudy.design.operability import AtRest, chart, offsets
from riserstudy.scene.resolve import Resolved

SCENE = Path(__file__).resolve().parents[1] / "config/scenes/design/riser.yaml"
CURRENTS = np.linspace(0.0, 1.6, 9)  # m/s
ALLOWANCES = {"lfj_angle": 0.009, "ufj_angle": 0.017, "stroke": 1.5, "von_mises_stress": 3e7}
LIMITS = 5
REACH = 240.0  # m
PROMISED = 5.0  # s, on two cores


def scene(speed: float) -> Resolved:
    """The generic riser with the first limits of drilling, in a current (m/s)."""
    whole = load_scene(SCENE, **{"current.profile.surface_speed": f"{speed} m/s"}).resolved()
    limits = [limit for limit in whole.limits or [] if limit.mode == "drilling"]
    return whole.replaced(limits=limits[:LIMITS])


def main(processes: int) -> None:
    """Measure and print."""
    scenes = [scene(speed) for speed in CURRENTS]
    offsets(scenes[0], REACH, ALLOWANCES)  # loads kernels
    times = []
    for _ in range(3):
        begun = time.perf_counter()
        found = chart(scenes, REACH, ALLOWANCES, processes)
        times.append(time.perf_counter() - begun)
    at = AtRest(scenes[-1])
    begun = time.perf_counter()
    at.extremes(30.0)
    one = time.perf_counter() - begun
    limits = len(found[0])
    print(f"{limits} limits, {len(scenes)} currents, both sides, {processes} processes:")
    print(f"  {min(times):.2f} s (promised {PROMISED:g} s), load {os.getloadavg()[0]:.1f}")
    print(f"  one riser at rest with its limits: {1e3 * one:.1f} ms")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 2)
