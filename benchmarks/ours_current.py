"""Our engine on scene S1 with its top held; the time includes building the model."""

from __future__ import annotations

import time
from typing import Any

import current
import ours

SCENE = ours.SCENE.with_name("s1.yaml")
LADDER = [(n, None, {}) for n in (8, 12, 16, 24, 32, 48, 64, 100, 200)]
available = ours.available


def run(elements: int, step: None) -> dict[str, Any]:
    """The equilibrium on uniform elements."""
    from riserstudy.model.mesh import even
    from riserstudy.scene.load import read_scene
    from riserstudy.simulation.run import single

    riser = read_scene(SCENE).with_values(current.HELD, "benchmark").resolved()
    started = time.process_time()
    mesh = even(riser, elements)
    done = single(riser, mesh, None)
    seconds = time.process_time() - started
    return {
        "s": mesh.s,
        "x": done.arrays["x_static"],
        "moment_s": mesh.s,
        "moment": done.arrays["bending_moment_static"],
        "seconds": seconds,
        "meta": {"scheme": "Newton", "step": None, "failed": False},
    }
