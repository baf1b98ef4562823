"""Identity of a reference solution: a scene, without its numerical settings, and the engine's physics."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from typing import Any

from riserstudy.model.layout import flexibility_of
from riserstudy.scene.resolve import Resolved
from riserstudy.study.store import COUNTS, canonical

#: Version of the physics. Increase it when the exact solution of scenes changes (a law, a load, the meaning
#: of a field), not when the numerical method does. Then no stored solution is used until it is recomputed.
PHYSICS = 2
#: Changes since this version that concern only some scenes. Only solutions of these scenes are recomputed.
CHANGES: dict[str, Callable[[Resolved], bool]] = {
    "structural damping of the pipe, not of joints": lambda s: _damped(s) and _held(s),
    "no water forces in the soil": lambda s: bool(s.soil and s.riser[0].drag),
    "waves on bodies": lambda s: bool(s.wave and s.bodies),
}

#: fields of ``analysis`` that define how a scene is solved, and do not change the exact solution
HOW = frozenset({"mesh", "step", "method", "solver", "accuracy"})


def scene_digest(scene: Resolved) -> str:
    """Hash of a scene without mesh, step, method and tolerance, 32 hexadecimal digits.

    Absent fields do not count; therefore a new optional field of scenes does not change the hash. Changes of
    the physics that concern the scene do count.
    """
    parts = {name: canonical(getattr(scene, name)) for name in COUNTS}
    analysis = {name: part for name, part in parts["analysis"].items() if name not in HOW}
    output = {**(analysis.get("output") or {}), "stations": None}
    changes = [name for name, concerns in CHANGES.items() if concerns(scene)]
    parts |= {"analysis": analysis | {"output": output}, **({"changes": changes} if changes else {})}
    text = json.dumps(_present(parts), sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def _damped(scene: Resolved) -> bool:
    """Whether the pipe has structural damping."""
    return any(section.structural_damping for section in scene.riser)


def _held(scene: Resolved) -> bool:
    """Whether a flex joint or a clamp holds the direction of the riser anywhere."""
    ends = (scene.bottom.rotation, scene.top.rotation)
    return any(flexibility_of(end) is not None for end in ends) or any(
        s.flex_joint_below for s in scene.riser
    )


def _present(part: Any) -> Any:
    """Return plain data without absent fields."""
    if isinstance(part, dict):
        kept = {name: _present(value) for name, value in part.items()}
        return {name: value for name, value in kept.items() if value not in (None, {})}
    return [_present(value) for value in part] if isinstance(part, list) else part
