"""Predict the vibration of the model riser in a stepped current at several speeds, and write a table."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from riserstudy.dataset.result import Result
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.simulation.refine import run

FOLDER = Path(__file__).resolve().parents[2] / "config/predictions"
SPEEDS = (0.16, 0.31, 0.45, 0.6, 0.75, 0.9, 1.0)  # m/s
DIAMETER = 0.028  # m
MODES = 16  # number of modes among which the dominant one is sought
COLUMNS = (
    "speed (m/s)",
    "dominant mode across the flow",
    "frequency (Hz)",
    "largest rms across the flow (diameters)",
    "largest mean deflection along it (diameters)",
    "estimated error (%)",
)


def at_speed(file: SceneFile, speed: float) -> SceneFile:
    """Return the scene with another current speed (m/s)."""
    return file.with_values({f"current.profile[{k}].speed": f"{speed} m/s" for k in (0, 1)}, "predictions")


def predicted(result: Result, diameter: float) -> list[float]:
    """Return the values of a table row from a run; diameter in m."""
    arrays, facts = result.arrays, result.facts
    late = arrays["time"] >= facts["vibration_since"]
    y, length = arrays["y"][late], arrays["s"][-1]
    shapes = np.sin(np.pi * np.outer(np.arange(1, MODES + 1), arrays["s"]) / length)
    shares = [np.trapezoid(y * shape, arrays["s"], axis=1).std() for shape in shapes]
    return [
        1 + int(np.argmax(shares)),
        facts["vibration_frequency"],
        float(y.std(axis=0).max()) / diameter,
        float(arrays["x"][late].mean(axis=0).max()) / diameter,
        100.0 * max(facts["error_estimate"].values()),
    ]


def main() -> None:
    """Write the table."""
    file = read_scene(FOLDER / "stepped_current.yaml")
    with (FOLDER / "stepped_current.csv").open("w", newline="", encoding="utf-8") as out:
        rows = csv.writer(out, lineterminator="\n")
        rows.writerow(COLUMNS)
        for speed in SPEEDS:
            values = predicted(run(at_speed(file, speed).resolved()), DIAMETER)
            rows.writerow([speed, *(f"{value:.4g}" for value in values)])


if __name__ == "__main__":
    main()
