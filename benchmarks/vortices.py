"""Time vortex-induced vibration by riserstudy and by a peer that has the same model of it.

A riser of 1500 m in a sheared current, 600 s (``config/scenes/bench/vortices.yaml``). Histories differ from
run to run, so statistics are compared, over the time from which riserstudy judges a vibration and by the same
functions, with their standard errors by the length of that time. Times are processor times of one thread,
those of an accuracy of all the runs that it takes.
"""

from __future__ import annotations

import argparse
import time
from typing import Any, NamedTuple

import alone  # noqa: F401
import numpy as np
import scene as benchmark
from peers import moordyn_vortices

from riserstudy.model.vortices import slowest
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.simulation.refine import run
from riserstudy.simulation.sampling_error import standard_error
from riserstudy.simulation.vortex_vibration import since
from riserstudy.simulation.vortex_vibration_statistics import along, frequency, vibration

SCENE = benchmark.ROOT / "config/scenes/bench/vortices.yaml"
FIXED = {"analysis.mesh": {"elements": 120}, "analysis.step": "0.1 s", "analysis.accuracy": None}
SEEDS = (1, 2)  # of phases: by how much chance alone makes runs differ


class Row(NamedTuple):
    """One run of one code."""

    code: str
    elements: int
    step: float  # s
    seconds: float  # of the processor
    rms: float  # of the vibration over time and riser (m)
    by_chance: float  # standard error of it, relative (1)
    largest: float  # of root mean squares along the riser (m)
    frequency: float  # where that is (Hz)
    deflection: float  # largest mean displacement along the current (m)


def main(duration: str | None = None) -> None:
    """Run and print a table."""
    file = read_scene(SCENE)
    if duration:
        file = file.with_values({"analysis.duration": duration}, "benchmark")
    fixed = file.with_values(FIXED, "benchmark")
    ours(fixed.with_values({"analysis.duration": "40 s"}, "benchmark"), "")  # loads kernels
    rows = [
        ours(fixed.with_values({"riser[0].viv.seed": seed}, "benchmark"), f"riserstudy, seed {seed}")
        for seed in SEEDS
    ]
    rows.append(ours(file, f"riserstudy, {100 * file.resolved().analysis.accuracy:g} %"))
    rows += peer(fixed)
    print("| code | segments | step (s) | CPU time (s) | rms (m) | largest (m) | f (Hz) | deflection (m) |")
    print("|---|---|---|---|---|---|---|---|")
    for row in rows:
        print(
            f"| {row.code} | {row.elements} | {row.step:.3g} | {row.seconds:.3g} | "
            f"{row.rms:.3f} ± {100 * row.by_chance:.2g} % | {row.largest:.3f} | {row.frequency:.4f} | "
            f"{row.deflection:.1f} |"
        )


def ours(file: SceneFile, code: str) -> Row:
    """A run of riserstudy."""
    scene = file.resolved()
    started = time.process_time()
    found = run(scene, estimated=scene.analysis.mesh is None)
    seconds = time.process_time() - started
    facts = found.facts
    return judged(code, facts["elements"], facts["step"], seconds, file, found.arrays)


def peer(file: SceneFile) -> list[Row]:
    """Runs of MoorDyn, its top held at the height of riserstudy's; none where it cannot be had."""
    if why := moordyn_vortices.available():
        print(f"MoorDyn: not available: {why}")
        return []
    rest = run(file.with_values({"analysis.duration": "40 s"}, "benchmark").resolved(), estimated=False)
    height, rows = float(rest.arrays["z_static"][-1]), []
    for elements, step in moordyn_vortices.LADDER:
        arrays, seconds = moordyn_vortices.run(file.resolved(), elements, step, height)
        rows.append(judged(moordyn_vortices.version(), elements, step, seconds, file, arrays))
    return rows


def judged(
    code: str, elements: int, step: float, seconds: float, file: SceneFile, arrays: dict[str, Any]
) -> Row:
    """Statistics of a run."""
    scene = file.resolved()
    late, above = arrays["time"] >= since(scene), slowest(scene)
    times, s = arrays["time"][late], arrays["s"]
    x, y = (vibration(arrays[name][late], times, above) for name in ("x", "y"))
    squares = x**2 + y**2
    most = int(squares.mean(axis=0).argmax())
    rms = along(squares.mean(axis=0), s)
    error = standard_error(lambda block: np.array([along(squares[block].mean(axis=0), s) ** 2]), len(squares))
    return Row(
        code, elements, step, seconds, rms, 0.5 * float(error.max()) / rms**2,
        float(np.sqrt(squares.mean(axis=0)[most])), frequency(times, y[:, most]),
        float(arrays["x"][late].mean(axis=0).max()),
    )  # fmt: skip


if __name__ == "__main__":
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("--duration", help="another one, such as '300 s'")
    main(words.parse_args().duration)
