"""The outcome of a disconnect: overpull, lift, clearance, re-contact, strokes and their ends, mud."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from riserstudy.dataset.clearance import TOUCHING
from riserstudy.dataset.limits import taken_by
from riserstudy.dataset.table import OF_ROW, Cell, Table
from riserstudy.dataset.unit_systems import read_in
from riserstudy.errors import InputError
from riserstudy.scene.pressures import not_in_tension
from riserstudy.scene.resolve import Resolved

if TYPE_CHECKING:
    import xarray as xr

AXIAL = 0.005  # m, distance from the well that counts as zero


def recoil(scene: Resolved, dataset: xr.Dataset) -> Table:
    """Outcome of the disconnect of one run, in kN, m and s; notes have lengths in the reader's unit.

    Raises InputError when the scene has no disconnect, or its run ends before the disconnect.
    """
    of, release = dataset.attrs, scene.disconnect
    if release is None:
        allowed = "add, for example, `disconnect: {at: 12 s}` to the scene"
        raise InputError("scene", "disconnect", "missing, so the riser does not disconnect", allowed)
    if "lift_max" not in of:
        allowed = "increase analysis.duration by some seconds"
        found = f"the run ends before or soon after the disconnect at {release.at:g} s"
        raise InputError("scene", "disconnect.at", found, allowed)
    overpull = float(of["overpull"])
    rows: list[list[Cell]] = [
        ["overpull", overpull / 1e3, "kN", release.at, _seat(overpull, not_in_tension(scene))],
        ["largest lift", of["lift_max"], "m", None, ""],
        _clearance(of),
        ["re-contact", None, "", of.get("recontact_time"), _contact(of)],
        ["largest upward speed", of["lift_rate_max"], "m/s", None, ""],
        *_strokes(scene, json.loads(of.get("extremes", "[]"))),
    ]
    if "smallest_tension" in of:
        rows.append(["smallest effective tension", of["smallest_tension"] / 1e3, "kN", None, ""])
    if "contents_speed_max" in of:
        rows.append(["largest speed of the mud", of["contents_speed_max"], "m/s", None, ""])
        lowest = of["contents_top_min"]
        rows.append(["lowest level of the mud", lowest, "m", None, "above the lower end"])
    return Table(["quantity", "value", "unit", "time", "note"], ["", OF_ROW, "", "s", ""], rows)


def disconnects(dataset: xr.Dataset) -> bool:
    """Whether a run has a disconnect to report."""
    return "lift_max" in dataset.attrs


def _seat(overpull: float, mud: float) -> str:
    """Whether the LMRP rests on the stack, and the weight of the mud (N) that an overpull leaves out."""
    on = ["on the stack"] if overpull < 0.0 else []
    left_out = [f"{taken_by(mud)}, not subtracted"] if mud > 0.0 else []
    return "; ".join(on + left_out)


def _clearance(of: dict[str, Any]) -> list[Cell]:
    if "clearance_min" not in of:
        return ["smallest clearance", None, "m", None, f"not evaluated: {_why_unknown(of)}"]
    aside = _aside(of.get("clearance_aside"))
    return ["smallest clearance", of["clearance_min"], "m", of["clearance_time"], aside]


def _contact(of: dict[str, Any]) -> str:
    if "recontact_time" in of:
        aside = _aside(of.get("recontact_aside"))
        return "yes" + (f", up to {aside}" if aside else "")
    return "no" if "clearance_min" in of else f"not within the run: {_why_unknown(of)}"


def _why_unknown(of: dict[str, Any]) -> str:
    """Why a run without re-contact has no clearance."""
    if of["lift_max"] < TOUCHING:
        return "the LMRP does not lift off"
    return "the LMRP is still rising or falling at the end of the run"


def _aside(distance: float | None) -> str:
    """Distance (m) of the LMRP from the well, if it is not above the well; absent from older datasets."""
    return f"{_length(distance, '.3g')} aside from the well" if distance and distance > AXIAL else ""


def _strokes(scene: Resolved, extremes: list[dict[str, Any]]) -> list[list[Cell]]:
    """Largest strokes of cylinders and telescopic joint, with the ends of their strokes."""
    rig, joint = scene.top.tensioners, scene.top.telescopic_joint
    ends: dict[str, tuple[str, float | None, float | None]] = {}
    if rig:
        stroke = rig.stroke
        ends["tensioner_stroke"] = (
            "cylinder stroke",
            stroke.shortest if stroke else None,
            stroke.longest if stroke else None,
        )
    if joint:
        stop = joint.stop
        collapse = -stop.collapse if stop and stop.collapse else None
        ends["joint_stroke"] = ("joint stroke", collapse, stop.stroke if stop else None)
    rows: list[list[Cell]] = []
    for row in extremes:
        if row["output"] in ends:
            name, low, high = ends[row["output"]]
            least, most = row["smallest"], row["largest"]
            out = low is not None and least < low - TOUCHING
            rows.append([f"shortest {name}", least, "m", row.get("smallest_time"), _end(low, out)])
            out = high is not None and most > high + TOUCHING
            rows.append([f"longest {name}", most, "m", row.get("largest_time"), _end(high, out)])
    return rows


def _end(end: float | None, out: bool) -> str:
    if end is None:
        return "no end in the scene"
    at = _length(end, "+.4g")
    return f"stroke-out: the end is at {at}" if out else f"end at {at}"


def _length(metres: float, digits: str) -> str:
    """A length in the reader's unit."""
    of = read_in("m")
    return f"{of.factor * metres:{digits}} {of.unit}"
