"""Our engine on scene S2c: the one place where it is plugged into the benchmarks.

The scene is ``config/scenes/bench/s2c.yaml`` on a given mesh and step. Compiling does not count (the
runner's first round is discarded), nor do reading the scene, building the model and statics: like
CableDyn's, the time is that of a run less that of a run of one step. Histories of every node at every
output time, moments and tension among them, are recorded in every run.
"""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import scene

SCENE = scene.ROOT / "config" / "scenes" / "bench" / "s2c.yaml"
SMOOTH = {"method": {"rho_inf": 0.9}}
EXPLICIT = {"method": "explicit"}
LADDER = [
    (10, 0.3, {}),
    (20, 0.2, {}),
    (28, 0.1, SMOOTH),
    (40, 0.06, SMOOTH),
    (56, 0.05, SMOOTH),
    (44, 0.004, EXPLICIT),
    (94, 0.0019, EXPLICIT),
]


def available() -> str | None:
    """Why our engine cannot run, or None."""
    try:
        import riserstudy.run  # noqa: F401
    except ImportError as error:
        return f"{type(error).__name__}: {error}"
    return None if SCENE.exists() else f"no {SCENE.name}"


def ours(elements: int, step: float, moments: bool = False, **analysis: Any) -> dict[str, Any]:
    """Simulate S2c with uniform elements and steps (s); other values of ``analysis`` by name."""
    from riserstudy.mesh import even
    from riserstudy.single import single

    riser = checked(elements, step, analysis)
    mesh = even(riser, elements)
    short = riser.model_copy(
        update={"analysis": riser.analysis.model_copy(update={"duration": riser.analysis.step})}
    )
    walls = []
    for what in (short, short, riser):
        started = time.perf_counter()
        done = single(what, mesh, what.analysis.step)
        walls.append(time.perf_counter() - started)
    arrays, facts = done.arrays, done.facts
    x = scene.resample(arrays["time"], arrays["x"] @ scene.lagrange(mesh.s, scene.STATIONS).T)
    result = {
        "time": scene.TIMES,
        "x": x,
        "wall_seconds": walls[-1] - min(walls[:-1]),
        "meta": {
            "scheme": "explicit"
            if analysis.get("method") == "explicit"
            else f"implicit {analysis}",
            "step": facts["step"],
            "failed": not (np.abs(x) < scene.BOUND).all(),
            "iterations": facts["newton_iterations"] or None,
        },
    }
    if moments:
        result |= {"moment": arrays["bending_moment"], "moment_s": mesh.s}
    return result


def checked(elements: int, step: float, analysis: dict[str, Any]) -> Any:
    """The scene in SI, with mesh, step and other values of its analysis."""
    from riserstudy.scene.load import read_scene

    values = {"mesh": {"elements": elements}, "step": f"{step!r} s", **analysis}
    file = read_scene(SCENE)
    return file.with_values({f"analysis.{k}": v for k, v in values.items()}, "benchmark").scene()
