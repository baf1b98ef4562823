"""Where a value comes from: published, given, derived, assumed, calibrated or chosen.

In a scene file, a value may be wrapped to state its origin::

    count: {assumed: 6, options: [6, 7], because: "six make the 232 t the paper states"}
    roll_centre: {calibrated: 4.5 m, to: liu2020/N3, range: [0 m, 25 m]}
    added_mass: {derived: 1198 kg/m, from: "Ca rho pi D^2/4"}
    interval: {chosen: 0.1 s, because: "what is kept of a run, no property of the riser"}

``unwrap`` separates values and origins. A study can therefore vary every assumption.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from riserstudy.scene.paths import last_name, leaves, within_any

STATUSES = ("assumed", "derived", "calibrated", "chosen")
COMPANIONS = {
    "assumed": {"range", "options", "because"},
    "derived": {"from"},
    "calibrated": {"to", "range", "options", "because"},
    "chosen": {"because"},
}
NEEDED = {"assumed": ["because"], "derived": [], "calibrated": ["to"], "chosen": ["because"]}
#: statuses that require a reason, as messages call their values
REASONED = {"assumed": "the assumption", "chosen": "the choice"}
#: last names of paths that hold names and notes of a scene and its parts, not values
CALLED = ("title", "note", "paper", "name")


@dataclass(frozen=True)
class Origin:
    """Origin of one value; ``range`` and ``options`` hold values as written in the file."""

    status: str
    value: Any
    range: tuple[Any, Any] | None = None
    options: tuple[Any, ...] = ()
    why: str = ""


#: plain tree, origins by dotted path, and faults as (path, found, allowed)
Unwrapped = tuple[Any, dict[str, Origin], list[tuple[str, str, str]]]


def unwrap(tree: Any, path: str = "") -> Unwrapped:
    """Plain tree, origins by dotted path, and faults as (path, found, allowed)."""
    if isinstance(tree, dict):
        status = [key for key in STATUSES if key in tree]
        if status:
            return _unwrap_one(tree, path, status)
        plain: dict[str, Any] = {}
        origins: dict[str, Origin] = {}
        faults: list[tuple[str, str, str]] = []
        for key, value in tree.items():
            plain[key], inner, wrong = unwrap(value, f"{path}.{key}" if path else str(key))
            origins |= inner
            faults += wrong
        return plain, origins, faults
    if isinstance(tree, list):
        items = [unwrap(value, f"{path}[{k}]") for k, value in enumerate(tree)]
        merged: dict[str, Origin] = {}
        for _, inner, _ in items:
            merged |= inner
        return [item[0] for item in items], merged, [f for item in items for f in item[2]]
    return tree, {}, []


def _unwrap_one(tree: dict[str, Any], path: str, status: list[str]) -> Unwrapped:
    kind = status[0]
    faults = []
    unknown = set(tree) - {kind} - COMPANIONS[kind]
    if unknown:
        allowed = f"with '{kind}', use only {', '.join(sorted(COMPANIONS[kind]))}"
        faults.append((path, f"unknown key {', '.join(sorted(map(str, unknown)))}", allowed))
    span = tree.get("range")
    if span is not None and not (isinstance(span, list) and len(span) == 2):
        faults.append((f"{path}.range", f"{span!r} is not a range", "write two values, [lowest, highest]"))
        span = None
    options = tree.get("options", [])
    if not isinstance(options, list):
        faults.append((f"{path}.options", f"{options!r} is not a list", "write a list, [first, second]"))
        options = []
    if kind in REASONED and "because" not in tree:
        faults.append((path, f"{REASONED[kind]} has no reason", "add 'because:' with the reason in one line"))
    if kind == "calibrated" and "to" not in tree:
        found = "the published value of the calibration is missing"
        faults.append((path, found, "add 'to: paper/ID', such as 'to: liu2020/N3'"))
    why = str(tree.get("because") or tree.get("from") or tree.get("to") or "")
    origin = Origin(kind, tree[kind], tuple(span) if span else None, tuple(options), why)
    return tree[kind], {path: origin}, faults


def plain_values(tree: dict[str, Any], origins: Mapping[str, Origin]) -> Iterator[tuple[str, Any]]:
    """Values of a scene, by dotted path, whose origin is not stated."""
    for path, value in leaves(tree):
        called = last_name(path) in CALLED
        if not called and not within_any(path, origins):
            yield path, value
