"""Results of the command `tension`: tension along the riser, setting, and the window of the setting."""

from __future__ import annotations

import math
from typing import NamedTuple

from riserstudy.dataset.table import Table
from riserstudy.design import engine_tension as engine
from riserstudy.design import tension as formula
from riserstudy.design.tension import Rig, Tolerances, setting
from riserstudy.design.window import lift_off, lift_off_lacks, window
from riserstudy.scene.resolve import Resolved


class TensionRequest(NamedTuple):
    """Inputs of the command."""

    tolerances: Tolerances
    rig: Rig
    overpull: float | None = None  # N
    ceiling: tuple[float, float] | None = None  # dynamic tension limit (N), allowed share of it


class Found(NamedTuple):
    """A tension of a riser."""

    quantity: str
    tension: float | None  # N; None: not evaluated
    note: str = ""


class Rows(NamedTuple):
    """Tensions in the order of the report."""

    ends: list[Found]  # T_SRmin at the ends of sections
    totals: list[Found]

    @property
    def missing(self) -> bool:
        """Whether a requested tension could not be evaluated."""
        return any(row.tension is None for row in self.totals)

    def table(self) -> Table:
        """The rows as a table in SI units."""
        rows = [[row.quantity, row.tension, row.note] for row in (*self.ends, *self.totals)]
        return Table(["quantity", "tension", "note"], ["", "N", ""], rows)


def tension_table(scene: Resolved, request: TensionRequest) -> Rows:
    """Minimum tension by formula and engine, the setting, and its window.

    Raises ValueError when the scene lacks inputs of the formula. Raises SimulationError when no equilibrium
    is found.
    """
    needed, first = formula.needed(scene, request.tolerances), scene.lowest_riser_section
    names = [f"lower end of {section.name}" for section in scene.riser]
    names.append(f"upper end of {scene.riser[-1].name}")
    below = "stack or conductor, below the flex joint: not counted"
    ends = [
        Found(name, float(value), below if k < first else "")
        for k, (name, value) in enumerate(zip(names, needed, strict=True))
        if not math.isnan(value)
    ]
    of = formula.governing(scene, request.tolerances)
    totals = [Found("formula", of.tension, f"governed by the {names[of.end]}"), _engine(scene, request)]
    units = f"with {request.rig.failed} of {request.rig.units} units failed"
    least = Found("setting", setting(of.tension, request.rig), units)
    return Rows(ends, [*totals, least, *_window(scene, request, of.tension)])


def _engine(scene: Resolved, request: TensionRequest) -> Found:
    if missing := engine.lacks(scene):
        return Found("engine", None, ", ".join(missing))
    slack = engine.needed(scene, request.tolerances)
    note = f"below it, effective tension becomes negative, first {slack.s:.4g} m from the bottom"
    if scene.top.tensioners:
        note += "; constant tension on the ring in place of the tensioners"
    return Found("engine", slack.tension, note)


def _window(scene: Resolved, request: TensionRequest, minimum: float) -> list[Found]:
    """Floor by the LMRP, ceiling, and the gap between floors and ceiling; empty if not requested."""
    rows, lifted = [], None
    if request.overpull is not None:
        if missing := lift_off_lacks(scene):
            return [Found("floor, LMRP lift-off", None, ", ".join(missing))]
        lifted = lift_off(scene, request.overpull)
        least = setting(lifted, request.rig._replace(failed=0))
        rows.append(Found("floor, LMRP lift-off", least, "weights as given, all units working"))
    if request.ceiling is None:
        return rows
    limit, share = request.ceiling
    of = window(minimum, lifted, request.rig, limit, share)
    note = f"{100.0 * share:g} % of the dynamic tension limit"
    rows.append(Found("ceiling", of.ceilings[of.ceiling], note))
    text = "from floor to ceiling" if of.gap >= 0.0 else "no setting: the ceiling is below the floor"
    return [*rows, Found("window", of.gap, f"{text}; floor: {of.floor}")]


def lines(rows: Rows) -> list[str]:
    """The rows as readable lines in kN."""
    texts = [
        f"{(row.tension or 0.0) / 1e3:10.2f} kN  {row.quantity}" + (f"  ({row.note})" if row.note else "")
        for row in rows.ends
    ]
    for row in rows.totals:
        if row.tension is None:
            texts.append(f"{row.quantity}: not evaluated: {row.note}")
        else:
            texts.append(f"{row.quantity}: {row.tension / 1e3:.2f} kN, {row.note}")
    return texts
