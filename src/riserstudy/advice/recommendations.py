"""Advice on a scene: effects that its tolerance allows to remove, and effects that are missing."""

from __future__ import annotations

import math
from typing import NamedTuple

from riserstudy.advice.ablation import Ablation, Changed, Notify, Peaks, ablate
from riserstudy.errors import SimulationError
from riserstudy.records.warning import filled
from riserstudy.scene.limits import Limit
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.refine import run
from riserstudy.simulation.starting_mesh import period
from riserstudy.simulation.tolerance import DISPLACEMENT, MOMENT

REPEATS = 5  # rounds of timed runs; the median counts
BUDGET = 5e5  # node-steps of a run; longer scenes are cut
COULD_GO, NEEDED, NO_GAIN = "removable", "needed", "removable, no time saved"
AFTER_RAMPS = 3  # periods
DAMAGE = (
    "Fatigue damage is not compared. An effect that does not change the peaks may still change the damage."
)
COMPARED = ("bending_moment", "effective_tension")  # outputs whose largest values are compared
MISSING, NOT_MISSED = "recommended", "not needed"


class Row(NamedTuple):
    """One change of the scene: its effect on peaks and run time, and the advice."""

    label: str
    effect: str  # that the change removes or adds
    because: str
    sizes: list[float]  # relative changes (1) of displacement, moment and tension; NaN: not known
    changes: list[str]  # the sizes and the change of the run time, in words
    verdict: str
    counts: bool


class Advice(NamedTuple):
    """All changes, the recommended ones first, and the advice in words."""

    rows: list[Row]
    sentences: list[str]


def advice(file: SceneFile, notify: Notify = lambda _: None) -> Advice:
    """Change every effect of a scene in turn.

    ``notify``: receives the name of the next run. Raises SimulationError when the scene itself cannot be run.
    """
    limits = accuracy_of(file.resolved())
    base = ablate(file, REPEATS, BUDGET, notify, shortest=_shortest(file.resolved()))
    rows = [row(base, changed, limits) for changed in base.changed]
    order = (COULD_GO, MISSING, NEEDED, NO_GAIN, NOT_MISSED)
    rows.sort(key=lambda r: order.index(r.verdict) if r.verdict in order else len(order))
    go = [f"{r.effect} (run time {r.changes[-1]})" for r in rows if r.verdict == COULD_GO]
    idle = [r.effect for r in rows if r.verdict == NO_GAIN]
    missing = [f"{r.effect} ({_largest(r)})" for r in rows if r.verdict == MISSING]
    limit = f"{100 * limits[0]:g} % of displacement, {100 * limits[1]:g} % of moment and tension"
    before, after = (f.resolved().analysis.duration for f in (file, base.file))
    step = f", step {base.step:.3g} s" if base.step else ""
    cut = f", over the first {after:.4g} s of {before:.4g} s" if before != after else ""
    probe = f"Computed on {len(base.mesh.l0)} segments{step}{cut}; times are medians of {REPEATS} runs."
    return Advice(
        rows,
        [
            f"Removable, one at a time, with a shorter run: {', '.join(go) or 'none'}.",
            f"Removable, but no time is saved: {', '.join(idle) or 'none'}.",
            f"Recommended: {', '.join(missing) or 'none'}.",
            f"An effect is removable if the results change by at most {limit}.",
            probe,
            _uncertain(base, notify),
            *_not_compared(file.resolved()),
            *_in_doubt(base),
        ],
    )


def _shortest(scene: Resolved) -> float:
    """Return the time (s) below which runs are not cut: all of a drift, and some periods after all ramps.

    Earlier, an effect that is still small would seem removable.
    """
    if scene.vessel or (scene.platform and scene.platform.cruise):
        return math.inf
    return scene.built_up + AFTER_RAMPS * period(scene) if scene.analysis.duration else 0.0


def _not_compared(scene: Resolved) -> list[str]:
    """Return the criteria of the scene that the advice does not consider."""
    names = list(dict.fromkeys(map(_criterion, scene.limits or [])))
    names = [name for name in names if name not in COMPARED]
    found = [DAMAGE] if scene.fatigue else []
    if scene.disconnect:
        names += [name for name in ("overpull", "lmrp_clearance") if name not in names]
    if names:
        found.append(
            f"Not compared: {', '.join(names)}. An effect that is removable here may change "
            f"{'it' if len(names) == 1 else 'them'}."
        )
    return found


def _criterion(limit: Limit) -> str:
    """Return the output of a limit; side and place are named where the compared peaks do not cover them."""
    if limit.output not in COMPARED:
        return limit.output
    side = "" if limit.side == "largest" else f"{limit.side} "
    return f"{side}{limit.output}" + (f" ({limit.place})" if limit.at else "")


def _uncertain(base: Ablation, notify: Notify) -> str:
    """Return the estimated errors of the scene's own run, on the mesh and with the step of all runs."""
    notify("estimating the errors of the scene itself")
    try:
        found = run(base.file.resolved()).facts.get("error_estimate", {})
    except SimulationError:
        found = {}
    names = ("displacement", "moment", "tension")
    errors: dict[str, float] = {name: found[name] for name in names if name in found}
    if not errors:
        return "The errors of these runs are not estimated: small changes may be numerical errors."
    text = (
        "Estimated errors of the scene itself on this mesh: {errors:percent}. Changes that are smaller than "
        "these errors may be numerical errors."
    )
    return filled(text, {"errors": errors})


def _in_doubt(base: Ablation) -> list[str]:
    """Return changes whose runs do not balance their energy: a difference may come from the step."""
    doubtful = [one.change.label for one in base.changed if one.unbalanced]
    if base.unbalanced:
        doubtful.insert(0, "the scene itself")
    if not doubtful:
        return []
    return [
        f"Energy is not balanced in the runs of: {', '.join(doubtful)}. Their changes may be numerical "
        "errors; give a shorter analysis.step, together with analysis.mesh."
    ]


def accuracy_of(scene: Resolved) -> tuple[float, float, float]:
    """Return the requested accuracies (1) of displacement, moment and tension."""
    accuracy = scene.analysis.accuracy
    return (accuracy or DISPLACEMENT, accuracy or MOMENT, accuracy or MOMENT)


def row(base: Ablation, changed: Changed, limits: tuple[float, float, float]) -> Row:
    """Return the effect of a change, in words."""
    label, effect, because = changed.change.label, changed.change.name, changed.because
    if changed.peaks is None or base.peaks is None or changed.message:
        because = f"cannot be run: {changed.message}"
        return Row(label, effect, because, [math.nan] * 3, [""] * 4, "cannot be run", False)
    sizes = _sizes(base, changed, base.peaks, changed.peaks)
    lost = math.isnan(changed.peaks.moment) and base.peaks.moment > 0.0
    small = not lost and all(
        math.isnan(size) or abs(size) <= limit for size, limit in zip(sizes, limits, strict=True)
    )
    if changed.change.kind == "removed":
        verdict = (COULD_GO if saves(base, changed) else NO_GAIN) if small else NEEDED
    else:
        verdict = NOT_MISSED if small else MISSING
    displayed = [*map(percent, sizes), longer(base, changed)]
    return Row(label, effect, because, sizes, displayed, verdict, verdict in (COULD_GO, MISSING))


def _sizes(base: Ablation, changed: Changed, before: Peaks, after: Peaks) -> list[float]:
    """Return the relative changes (1) of displacement, moment and tension.

    That of the tension is the larger one of its changes at the top, and where it is smallest; both are shares
    of the tension at the top. With tensioners, the top may not notice a change of all the tension below.
    """
    sizes = [*before.change_to(after)]
    change = changed.smallest_tension - base.smallest_tension
    below = change / before.tension if before.tension > 0.0 else math.nan
    if abs(below) > abs(sizes[-1]):
        sizes[-1] = below
    return sizes


def _largest(row: Row) -> str:
    """Return the largest change of a row, with its quantity."""
    named = zip(row.sizes, ("displacement", "moment", "tension"), strict=True)
    known = [(size, name) for size, name in named if not math.isnan(size)]
    if not known:
        return "change not known"
    size, name = max(known, key=lambda one: abs(one[0]))
    return f"{percent(size)} {name}"


def saves(base: Ablation, changed: Changed) -> bool:
    """Return whether a change shortens the run by more than the scatter of its repeats."""
    return 1.0 - changed.seconds / base.seconds > max(base.scatter, changed.scatter)


def longer(base: Ablation, changed: Changed) -> str:
    """Return the change of the run time in words, if it exceeds the scatter of the repeats."""
    ratio = changed.seconds / base.seconds
    if abs(ratio - 1.0) <= max(base.scatter, changed.scatter):
        return "as before"
    return f"{ratio:.2g} times" if ratio >= 2.0 else percent(ratio - 1.0)


def percent(value: float) -> str:
    """Return a relative change (1) as a signed percentage with two digits."""
    if math.isnan(value):
        return ""
    size = 100.0 * value
    if abs(size) < 0.005:
        return "0 %"
    return f"{size:+.0f} %" if abs(size) >= 10.0 else f"{size:+.2g} %"
