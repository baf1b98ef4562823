"""What users pay: a run without mesh and step beside the cheapest that errs no more, and points of a grid.

``python benchmarks/prices.py [SCENE ...]`` takes nine scenes of the papers, or those named. Times are of
the processor, all runs counted, the shorter of two taken by turns with those of the cheapest: of meshes,
steps and methods that are tried by rising work, the first within 0.2 % of displacement and 1 % of moment
and tension of a much finer run by another method. The grid is of scene S2c over period and amplitude on
the cheapest mesh and step, envelopes and a history of one station kept.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from riserstudy import load_scene
from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError
from riserstudy.model.mesh import Mesh, even
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import single
from riserstudy.simulation.starting_mesh import coarsest_mesh, massless, period
from riserstudy.simulation.tolerance import DISPLACEMENT, MOMENT
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

ROOT = Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT))
from chapters.numerics.attempt import mesh_of  # noqa: E402
from chapters.numerics.fixed_step import stepped  # noqa: E402
from chapters.numerics.references import by_run  # noqa: E402

CONFIG = ROOT / "config"
OWN = dict.fromkeys(("analysis.mesh", "analysis.step", "analysis.method", "analysis.accuracy"))
#: scenes by paper and study, of which the point in the middle counts
SCENES = {
    "S2c": ("bench", "s2c"),
    "surge": ("liu2020", "surge_case"),
    "roll": ("liu2020", "roll_case"),
    "heave": ("liu2020", "heave_case"),
    "statics": ("liu2020", "statics"),
    "waves": ("fem_riser", "settled"),
    "hang-off": ("mao_hangoff", "hangoff_ref"),
    "drive-off": ("liu2017", "open_runs"),
    "tensioners": ("chang2020", "period_sweep"),
}
METHODS: tuple[str | None, ...] = (None, "TR-BDF2", "ESDIRK4")
WORK = {None: 1.0, "TR-BDF2": 2.0, "ESDIRK4": 5.0}  # of a step, about
SEGMENTS = tuple(round(8 * 2 ** (k / 2)) for k in range(15))
STEPS = tuple(6 * 2 ** (k / 2) for k in range(18))  # a period
FINE = 64  # segments, beyond which a reference halves them instead of quartering
FOURTH = {"analysis.method": "ESDIRK4"}
TARGET = {"displacement": DISPLACEMENT, "moment": MOMENT, "tension": MOMENT}
GRID = 64  # points, of which one in eight tells its error


def scene_file(name: str) -> SceneFile:
    """A scene without mesh, step, method and accuracy of its own."""
    paper, study = SCENES[name]
    files = read_studies(CONFIG, paper)
    of = Study(paper, study, files.studies[study], CONFIG, "preview", None, files.readings)
    file = of.grid.file(of.plan[len(of.plan) // 2].index)
    if file.tree["analysis"].get("solver"):
        file = file.with_values({"analysis.solver": None}, "benchmark")
    stations = {"analysis.output.stations": None} if "output" in file.tree["analysis"] else {}
    return file.with_values(OWN | stations, "benchmark")


def settings(file: SceneFile, found: Result) -> Iterator[tuple[str | None, Mesh, float]]:
    """Methods, meshes and steps (s), the cheapest first, up to twice the work of what was found."""
    scene = file.resolved()
    graded = [coarsest_mesh(scene)]
    while 2 * len(graded[-1].l0) <= SEGMENTS[-1]:
        graded.append(graded[-1].halved())
    one = found.facts["elements"] == 1
    meshes = [even(scene, 1)] if one else [*(even(scene, n) for n in SEGMENTS), *graded]
    still = scene.analysis.duration is None
    steps = [0.0] if still else [period(scene) / k for k in STEPS]
    methods: tuple[str | None, ...] = (None,) if still else METHODS
    every = [
        (len(mesh.l0) * WORK[method] / (step or 1.0), method, mesh, step)
        for method in methods
        for mesh in meshes
        for step in steps
    ]
    most = 2.0 * found.facts["elements"] / (found.facts.get("step") or 1.0)
    for work, method, mesh, step in sorted(every, key=lambda item: item[0]):
        if work <= most:
            yield method, mesh, step


def reference(file: SceneFile, scene: Resolved, found: Result) -> Result:
    """A much finer run, in time by another method."""
    if scene.analysis.duration is None:
        return single(scene, mesh_of(scene, found).halved().halved(), None)
    mesh, step = mesh_of(scene, found), 0.5 * found.facts["step"]
    if not massless(scene):
        mesh = mesh.halved().halved() if len(mesh.l0) <= FINE else mesh.halved()
    return single(stepped(file, FOURTH, mesh, step), mesh, step, True)


def spent(do: Any) -> float:
    """Processor time (s)."""
    begun = time.thread_time()
    do()
    return time.thread_time() - begun


def price(name: str) -> float:
    """Print what the default and the cheapest cost for a scene; their ratio."""
    file = scene_file(name)
    scene = file.resolved()
    found = run(scene)
    measure = by_run(reference(file, scene, found))

    def excess(result: Result) -> float:
        errors = measure.errors(result)
        return max(error / TARGET[q] for q, error in errors.items() if q in TARGET)

    for method, mesh, step in settings(file, found):
        one = stepped(file, {"analysis.method": method} if method else {}, mesh, step)
        try:
            result = single(one, mesh, step or None)
        except SimulationError:
            continue
        if excess(result) <= 1.0:
            break
    else:
        raise SystemExit(f"{name}: nothing tried is within the accuracy")
    asked, fixed = [], []
    for _ in range(2):
        asked.append(spent(lambda: run(scene)))
        fixed.append(spent(lambda: single(one, mesh, step or None)))
    ratio = min(asked) / min(fixed)
    print(
        f"| {name} | {1e3 * min(asked):.1f} | {excess(found):.2f} | {len(found.facts['refinements'])} | "
        f"{1e3 * min(fixed):.1f} | {method or 'generalised-alpha'}, {len(mesh.l0)} segments, {step:.3g} s | "
        f"{ratio:.1f} |",
        flush=True,
    )
    return ratio


def grid() -> None:
    """Print how many points of a grid of S2c a core does in a second, with and without their errors."""
    base = load_scene(CONFIG / "scenes/bench/s2c.yaml", **OWN).with_values(
        {"analysis.mesh": {"elements": 45}, "analysis.step": "0.11 s"}
        | {"analysis.output": {"interval": "1 s", "stations": ["400 m"]}},
        "benchmark",
    )
    scenes = [
        base.with_values(
            {"platform.surge.period": f"{8 + p} s", "platform.surge.amplitude": f"{1 + 0.1 * a} m"},
            "benchmark",
        ).resolved()
        for p in range(8)
        for a in range(GRID // 8)
    ]
    run(scenes[0], estimated=False)
    seconds = spent(lambda: [run(s, estimated=k % 8 == 0) for k, s in enumerate(scenes)])
    alone = spent(lambda: [run(s, estimated=False) for s in scenes])
    print(f"\n{GRID} points of S2c: {GRID / seconds:.0f} a second and core, every eighth with its error;")
    print(f"{GRID / alone:.0f} without errors")


def main(names: list[str]) -> None:
    """Measure and print."""
    print("| scene | default (ms) | excess | runs | cheapest (ms) | what | ratio |")
    print("|---|---|---|---|---|---|---|")
    ratios = [price(name) for name in names]
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
    print(f"\ngeometric mean {mean:.1f}, worst {max(ratios):.1f}")
    grid()


if __name__ == "__main__":
    main(sys.argv[1:] or list(SCENES))
