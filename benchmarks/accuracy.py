"""What an accuracy asked for costs on scene S2c, and how large the error really is.

Prints the table of ``docs/choosing_accuracy.md``. The error is the largest difference from the stored
reference over all output times, at four stations for displacement and at 41 for the moment, divided by
the largest value of the reference.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

from riserstudy import load_scene, simulate

ROOT = Path(__file__).resolve().parents[1]
SCENE = ROOT / "config/scenes/bench/s2c.yaml"
ACCURACIES = (None, "5 %", "1 %", "0.2 %", "0.05 %", "0.01 %")


def main() -> None:
    """Measure and print."""
    with np.load(ROOT / "tests/verification/data/S2c.npz") as file:
        best = {name: file[name] for name in file.files}
    print(
        "| accuracy asked for | segments | step (s) | displacement: estimated | real "
        "| moment: estimated | real | wall (ms) |"
    )
    print("|---|---|---|---|---|---|---|---|")
    simulate(load_scene(SCENE))  # loads what is compiled
    for accuracy in ACCURACIES:
        values = {"analysis.accuracy": accuracy} if accuracy else {}
        run = simulate(load_scene(SCENE, **values))
        x = CubicSpline(run["s"], run["x"], axis=1)(best["s"])
        moment = CubicSpline(run["s"], run["bending_moment"], axis=1)(best["moment_s"])
        estimated = json.loads(run.attrs["error_estimate"])
        cells = (
            accuracy or "none: the default",
            run.attrs["elements"],
            f"{run.attrs['step']:.3g}",
            percent(estimated["displacement"]),
            percent(off(x, best["x"])),
            percent(estimated["moment"]),
            percent(off(moment[::2], best["moment"])),
            f"{1000 * run.attrs['wall_seconds']:.0f}",
        )
        print("| " + " | ".join(map(str, cells)) + " |")


def off(found: np.ndarray, best: np.ndarray) -> float:
    """Largest difference over the largest value."""
    return float(np.abs(found - best).max() / np.abs(best).max())


def percent(share: float) -> str:
    """A share in per cent, to two digits."""
    return f"{100 * share:.2g} %"


if __name__ == "__main__":
    main()
