"""Our engine on scene S3, as ``ours`` has it on S2c."""

from __future__ import annotations

from typing import Any

import heave
import ours

SCENE = ours.SCENE.with_name("s3.yaml")
FOURTH = {"method": "ESDIRK4"}
LADDER = [
    (4, 0.4, {}),
    (6, 0.2, {}),
    (16, 0.1, {}),
    (24, 0.05, {}),
    (48, 0.025, {}),
    (4, 1.0, FOURTH),
    (6, 0.8, FOURTH),
    (6, 0.4, FOURTH),
    (8, 0.2, FOURTH),
    (12, 0.1, FOURTH),
]
available = ours.available


def run(elements: int, step: float, **analysis: Any) -> dict[str, Any]:
    """Simulate S3 with uniform elements and steps (s); other values of ``analysis`` by name."""
    done, _mesh, seconds = ours.simulated(SCENE, elements, step, analysis)
    arrays = done.arrays
    bottom = arrays["z"][:, 0] - arrays["z_static"][0]
    return {
        "bottom": bottom,
        "top_tension": arrays["effective_tension"][:, -1],
        "seconds": seconds,
        "meta": ours.meta(done, analysis, bool((abs(bottom) < heave.BOUND).all())),
    }
