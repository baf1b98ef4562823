"""A study as its file has it beside another mesh, step and method: time by turns, true errors of the latter.

``python benchmarks/tuned.py PAPER STUDY ELEMENTS STEP METHOD [BOTTOM TOP]``, such as
``liu2020 roll_runs 91 0.25 ESDIRK4 11 11`` (s; lengths of layers in m). A seeded twentieth of the points is
run both ways, as the study runs them. Errors are true ones, measured as `riserstudy tune` does, with what the
reference itself may err by.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.refine import run
from riserstudy.study.corners import others
from riserstudy.study.read import read_study
from riserstudy.study.setting import ENDS, Setting
from riserstudy.study.tune import Tuner

CONFIG = Path(__file__).resolve().parents[1] / "config"
SHARE, SEED = 20, 20  # one in so many points; of the draw


def spent(scene: Resolved, estimated: bool) -> float:
    """Processor time of a point (s)."""
    begun = time.thread_time()
    run(scene, estimated=estimated)
    return time.thread_time() - begun


def main(paper: str, name: str, elements: str, step: str, method: str, *layers: str) -> None:
    """Measure and print."""
    study = read_study(CONFIG, paper, name, "standard", None)
    lengths = tuple(zip(ENDS, map(float, layers), strict=False))
    setting = Setting(int(elements), lengths, float(step), method)
    tuner = Tuner(study, None, lambda _: None)
    points = others(study, [], max(4, len(study.grid) // SHARE), SEED)
    seconds = {"old": 0.0, "new": 0.0}
    worst = 0.0
    for number, index in enumerate(points):
        file = study.grid.file(index)
        estimated = number % 8 == 0
        scenes = {"old": file.resolved(), "new": file.with_values(setting.values, "new").resolved()}
        for way, scene in scenes.items():
            seconds[way] += spent(scene, estimated)
        error = tuner.excess(setting, tuner.place(index))
        worst = max(worst, error)
        print(f"{index}: error {error:.2f} of the accuracy", flush=True)
    gain = seconds["old"] / seconds["new"]
    print(
        f"{len(points)} points of {len(study.grid)}: {seconds['old']:.1f} s as the file has it, "
        f"{seconds['new']:.1f} s so, {gain:.2f} times as fast; largest error {worst:.2f} of the accuracy"
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
