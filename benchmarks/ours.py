"""Our engine on scene S2c: the one place where it is plugged into the benchmarks.

The scene is ``config/scenes/bench/s2c.yaml`` on a given mesh and step. Compiling does not count (the
runner runs everything once before), nor do reading the scene, building the model and statics: like
CableDyn's, the time is that of a run less that of a run of one step. Histories of every node at every
output time, moments and tension among them, are recorded in every run.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import scene

SCENE = scene.ROOT / "config" / "scenes" / "bench" / "s2c.yaml"
SMOOTH = {"method": {"rho_inf": 0.9}}
EXPLICIT = {"method": "explicit"}
FOURTH = {"method": "ESDIRK4"}
LADDER = [
    (10, 0.3, {}),
    (20, 0.2, {}),
    (28, 0.1, SMOOTH),
    (40, 0.05, SMOOTH),
    (56, 0.1, SMOOTH),
    (80, 0.05, SMOOTH),
    (120, 0.0125, SMOOTH),
    (20, 0.6, FOURTH),
    (24, 0.75, FOURTH),
    (24, 0.6, FOURTH),
    (28, 0.5, FOURTH),
    (40, 0.5, FOURTH),
    (56, 0.4, FOURTH),
    (80, 0.3, FOURTH),
    (120, 0.2, FOURTH),
    (160, 0.15, FOURTH),
    (44, 0.004, EXPLICIT),
    (94, 0.0019, EXPLICIT),
    (182, 0.0009, EXPLICIT),
]


def available() -> str | None:
    """Why our engine cannot run, or None."""
    try:
        import riserstudy.simulation.refine  # noqa: F401
    except ImportError as error:
        return f"{type(error).__name__}: {error}"
    return None if SCENE.exists() else f"no {SCENE.name}"


def run(elements: int, step: float, moments: bool = False, **analysis: Any) -> dict[str, Any]:
    """Simulate S2c with uniform elements and steps (s); other values of ``analysis`` by name."""
    done, mesh, seconds = simulated(SCENE, elements, step, analysis)
    arrays = done.arrays
    x = scene.resample(arrays["time"], arrays["x"] @ scene.lagrange(mesh.s, scene.STATIONS).T)
    result = {
        "time": scene.TIMES,
        "x": x,
        "seconds": seconds,
        "meta": meta(done, analysis, bool((abs(x) < scene.BOUND).all())),
    }
    if moments:
        result |= {"moment": arrays["bending_moment"], "moment_s": mesh.s}
    return result


def simulated(path: Path, elements: int, step: float, analysis: dict[str, Any]) -> tuple[Any, Any, float]:
    """Result, mesh and processor time (s) of a scene less that of its first step."""
    from riserstudy.model.mesh import even
    from riserstudy.simulation.run import single

    riser = checked(path, analysis | {"mesh": {"elements": elements}, "step": f"{step!r} s"})
    mesh = even(riser, elements)
    short = riser.replaced(analysis=riser.analysis.replaced(duration=riser.analysis.step))
    spent = []
    for what in (short, short, riser):
        started = time.process_time()
        done = single(what, mesh, what.analysis.step)
        spent.append(time.process_time() - started)
    return done, mesh, spent[-1] - min(spent[:-1])


def meta(done: Any, analysis: dict[str, Any], finite: bool) -> dict[str, Any]:
    """What is told of a run beside its numbers."""
    explicit = analysis.get("method") == "explicit"
    return {
        "scheme": "explicit" if explicit else f"implicit {analysis}",
        "step": done.facts.get("step"),
        "failed": not finite,
        "iterations": done.facts.get("newton_iterations") or None,
    }


def checked(path: Path, analysis: dict[str, Any]) -> Any:
    """A scene in SI, with values of its analysis."""
    from riserstudy.scene.load import read_scene

    values = {f"analysis.{name}": value for name, value in analysis.items()}
    return read_scene(path).with_values(values, "benchmark").resolved()
