"""Measurements of the engine, case by case, as sortable tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from riserstudy.records.numerals import duration
from riserstudy.records.page import Cell, Table
from riserstudy.report.formats import number, share

if TYPE_CHECKING:
    import xarray as xr

CHANGES = {"displacement_change": "displacement", "moment_change": "moment", "tension_change": "tension"}


def tables(datasets: Mapping[str, xr.Dataset]) -> Iterator[Table]:
    """Yield a table for each dataset that has one."""
    if "stability" in datasets:
        yield hard_cases(datasets["stability"])
    if "effects" in datasets:
        yield changes(datasets["effects"])
    if "accuracy" in datasets:
        yield requests(datasets["accuracy"])
    if "energy" in datasets:
        yield balances(datasets["energy"])
    if "validation" in datasets:
        yield known(datasets["validation"])


def hard_cases(stability: xr.Dataset) -> Table:
    """One row per case: outcome of the scene as written, and the largest steps of each method."""
    methods = [str(name) for name in stability["method"].values]
    rows = []
    for case in stability["case"].values:
        of = stability.sel(case=case)
        steps = [
            [
                float(of[name].sel({"method": method}))
                for name in ("largest_accurate_step", "largest_stable_step")
            ]
            for method in methods
        ]
        rows.append(
            [
                Cell(str(case)),
                Cell(str(of["family"].values)),
                Cell(str(of["about"].values)),
                Cell(str(of["written_outcome"].values)),
                Cell("as expected" if bool(of["as_expected"]) else str(of["finding"].values)),
                _share(float(of["written_error"])),
                _share(float(of["written_estimate"])),
                *(Cell(" | ".join(map(_step, pair)), _order(pair[0])) for pair in steps),
            ]
        )
    about = (
        "The columns Error and Estimate are for a run with the mesh, time step and method of the scene. For "
        "each method, two time steps (s) are given: the longest that is accurate to 1 %, and the longest "
        "that is stable. Both time steps are for the mesh of the default accuracy. A dash means that no "
        "tested time step is accurate, or stable."
    )
    columns = ["Case", "Family", "Description", "Ended", "Verdict", "Error", "Estimate", *methods]
    return Table("Hard cases", about, columns, {*range(5, len(columns))}, rows)


def changes(effects: xr.Dataset) -> Table:
    """One row per scene and change: change of the results and of the run time."""
    rows = []
    for scene in effects["scene"].values:
        of = effects.sel(scene=scene)
        for change in of["change"].values:
            one = of.sel(change=change)
            values = [float(abs(one[name])) for name in CHANGES]
            fault = str(one["fault"].values)
            if not fault and np.isnan(values).all():
                continue
            time = float(one["time_change"])
            signed = f"{100 * time:+.0f} %" if time == time else ""
            signed = "0 %" if signed in ("+0 %", "-0 %") else signed.replace("-", "−")
            cells = [Cell(str(scene)), Cell(str(change)), *map(_share, values), Cell(signed, _order(time))]
            rows.append([*cells, Cell(f"Not possible: {fault}." if fault else "")])
    about = (
        "Each row compares two runs of a scene on one mesh and time step, with and without one effect. The "
        "columns give the relative change of the largest displacement, moment and top tension, and of the "
        "run time."
    )
    columns = ["Scene", "Change", *map(str.capitalize, CHANGES.values()), "Time", "Remark"]
    return Table("Effects, one by one", about, columns, {2, 3, 4, 5}, rows)


def requests(accuracy: xr.Dataset) -> Table:
    """One row per run to a tolerance: tolerance, estimated error, true error and time."""
    rows = []
    for k in range(accuracy.sizes.get("request", 0)):
        of = accuracy.isel(request=k)
        errors = {
            kind: [float(of[f"{kind}_{q}"]) for q in CHANGES.values()] for kind in ("estimated", "reached")
        }
        largest = [np.nanmax(v) if np.isfinite(v).any() else np.nan for v in errors.values()]
        spent = float(of["request_seconds"])
        rows.append(
            [
                Cell(str(of["request_scene"].values)),
                _share(float(of["requested"])),
                *(_share(float(v)) for v in largest),
                Cell(duration(spent, 3) if spent == spent else "", _order(spent)),
                Cell(str(int(of["request_elements"])) if spent == spent else ""),
                Cell(number(float(of["request_step"])) if spent == spent else ""),
                Cell(str(of["request_message"].values)),
            ]
        )
    about = (
        "Each error is the largest of the errors of displacement, moment and tension. The time includes the "
        "runs that find mesh and time step."
    )
    columns = [
        "Scene",
        "Tolerance",
        "Estimated error",
        "True error",
        "Time",
        "Segments",
        "Step (s)",
        "Remark",
    ]
    return Table("Runs with a tolerance", about, columns, {1, 2, 3, 4, 5, 6}, rows)


def balances(energy: xr.Dataset) -> Table:
    """One row per case and method: largest shares of numerical dissipation and energy residual."""
    rows = []
    for case in energy["case"].values:
        for method in energy["method"].values:
            of = energy.sel({"case": case, "method": method})
            scale = max(float(abs(of[name]).max()) for name in ("exchanged", "stored"))
            shares = [float(abs(of[n]).max()) / scale for n in ("numerical", "unexplained")]
            rows.append([Cell(str(case)), Cell(str(method)), *map(_share, shares)])
    about = (
        "Dissipated and residual energy: largest values over time, divided by the largest energy exchanged "
        "or stored."
    )
    columns = ["Case", "Method", "Numerical dissipation", "Energy residual"]
    return Table("Energy", about, columns, {2, 3}, rows)


def known(validation: xr.Dataset) -> Table:
    """One row per comparison of the engine with a closed form, second method or conservation law."""
    rows = []
    for k in range(validation.sizes["row"]):
        of = validation.isel(row=k)
        text = {name: str(of[name].values) for name in ("name", "quantity", "kind", "by", "because")}
        unit = str(of["unit"].values)
        unit = "" if unit == "1" else f" {unit}"
        both = [Cell(f"{float(of[name]):.8g}{unit}", float(of[name])) for name in ("reference", "value")]
        allowed = [Cell(f"{float(of[name]):.1e}", float(of[name])) for name in ("error", "tolerance")]
        verdict = Cell("holds" if bool(of["holds"]) else "does not hold")
        words = [Cell(text[name]) for name in ("name", "quantity", "kind", "by")]
        rows.append([*words, *both, *allowed, verdict, Cell(f"The tolerance covers {text['because']}.")])
    about = (
        "The comparisons in this table are repeated in every run of the chapter. The error is the difference "
        "divided by the magnitude of the reference. The last column gives the reason for the tolerance."
    )
    columns = ["What", "Number", "Reference", "By", "Known", "Computed", "Error", "Tolerance"]
    return Table("Comparison with known results", about, [*columns, "Verdict", "Because"], {4, 5, 6, 7}, rows)


def _share(value: float) -> Cell:
    return Cell(share(value) if value == value else "", _order(value))


def _step(value: float) -> str:
    return f"{value:.2g}" if value == value else "–"


def _order(value: float) -> float | None:
    return value if value == value else None
