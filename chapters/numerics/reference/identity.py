"""Identity of a reference solution: a scene, without its numerical settings, and the engine's physics."""

from __future__ import annotations

import hashlib
import json
from typing import Any

from riserstudy.scene.resolve import Resolved
from riserstudy.study.store import COUNTS, canonical

#: Version of the physics. Increase it when the exact solution of a scene changes (a law, a load, a meaning of
#: a field), not when the numerical method does. Then no stored solution is used until it is recomputed.
PHYSICS = 2

#: fields of ``analysis`` that define how a scene is solved, and do not change the exact solution
HOW = frozenset({"mesh", "step", "method", "solver", "accuracy"})


def scene_digest(scene: Resolved) -> str:
    """Hash of a scene without mesh, step, method and tolerance, 32 hexadecimal digits.

    Absent fields do not count; therefore a new optional field of scenes does not change the hash.
    """
    parts = {name: canonical(getattr(scene, name)) for name in COUNTS}
    analysis = {name: part for name, part in parts["analysis"].items() if name not in HOW}
    output = {**(analysis.get("output") or {}), "stations": None}
    text = json.dumps(_present(parts | {"analysis": analysis | {"output": output}}), sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def _present(part: Any) -> Any:
    """Return plain data without absent fields."""
    if isinstance(part, dict):
        kept = {name: _present(value) for name, value in part.items()}
        return {name: value for name, value in kept.items() if value not in (None, {})}
    return [_present(value) for value in part] if isinstance(part, list) else part
