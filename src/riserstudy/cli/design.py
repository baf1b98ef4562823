"""Checks of a design before any sea is simulated: top tension, vortex-induced vibration."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from riserstudy.cli.shared import (
    CsvOption,
    PlotOption,
    SceneArgument,
    SetOption,
    check_targets,
    compile_as_needed,
    notify,
    positive,
    quantity,
    save_figure,
    scene_of,
    show,
    write_table,
)
from riserstudy.cli.targets import ForceOption
from riserstudy.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

TensionRatioOption = Annotated[
    float,
    typer.Option(
        min=0.01,
        max=1.0,
        help="ratio R_f of the vertical tension at the ring to the tension setting, such as 0.95",
    ),
]
WeightOption = Annotated[
    float,
    typer.Option(
        min=0.1,
        max=10.0,
        help="tolerance factor on the weight of steel, such as 1.05; 1 if the steel was weighed",
    ),
]
BuoyancyOption = Annotated[
    float,
    typer.Option(
        min=0.0,
        max=10.0,
        help="tolerance factor on the lift of buoyancy modules, such as 0.96; 1 if the modules were weighed",
    ),
]
FleetAngleOption = Annotated[
    str,
    typer.Option(
        help="angle of the tensioner lines from the vertical, if the ratio R_f does not include the angle",
        metavar="ANGLE",
    ),
]
DynamicLimitOption = Annotated[
    str | None,
    typer.Option(
        help="dynamic tension limit of all units together, such as 6.7 MN; requires --share", metavar="FORCE"
    ),
]
ShareOption = Annotated[
    float | None,
    typer.Option(
        min=0.01,
        max=1.0,
        help="largest allowed tension setting as a fraction of --dynamic-limit, such as 0.9",
    ),
]
OverpullOption = Annotated[
    str | None,
    typer.Option(
        help="tension required between LMRP and BOP stack, such as 200 kN; default: no requirement",
        metavar="FORCE",
    ),
]


def tension(
    scene: SceneArgument,
    units: Annotated[int, typer.Option(min=1, help="number of tensioner units")],
    failed: Annotated[int, typer.Option(min=0, help="number of failed tensioner units")],
    tension_ratio: TensionRatioOption,
    weight: WeightOption,
    buoyancy: BuoyancyOption,
    fleet_angle: FleetAngleOption = "0 deg",
    dynamic_limit: DynamicLimitOption = None,
    share: ShareOption = None,
    overpull: OverpullOption = None,
    settings: SetOption = None,
    csv: CsvOption = None,
    force: ForceOption = False,
) -> None:
    """Compute the minimum top tension, and the window (allowed range) of the tension setting.

    The command ``tension`` computes the minimum top tension by the formula of API RP 16Q and by
    simulation. In the simulation, a constant tension replaces the tensioners. The upper end of the window
    is a share (--share) of the dynamic tension limit (--dynamic-limit). The lower end of the window is
    the smallest setting that gives both the minimum tension and the required overpull (--overpull). The
    exit status is 4 if the scene lacks an input of the formula, such as separate weights of steel and
    buoyancy modules.
    """
    file = scene_of(scene, settings)
    check_targets(file.files, force, csv)
    if (share is None) != (dynamic_limit is None):
        alone = "--share" if dynamic_limit is None else "--dynamic-limit"
        raise InputError(alone, "", "has no effect alone", "give both --dynamic-limit and --share")
    _check_rig(units, failed, weight, buoyancy)
    angle = quantity("--fleet-angle", fleet_angle, "rad")
    if not 0.0 <= angle < 0.5 * math.pi:
        allowed = "give an angle from 0 deg to less than 90 deg"
        raise InputError("--fleet-angle", fleet_angle, "a line at this angle does not pull upwards", allowed)
    pulled = None if overpull is None else positive("--overpull", overpull, "N")
    limit = None if dynamic_limit is None else positive("--dynamic-limit", dynamic_limit, "N")
    from riserstudy.design import tension as formula
    from riserstudy.design.tension import Rig, Tolerances

    riser = file.resolved()
    if missing := formula.lacks(riser):
        print("not evaluated: " + ", ".join(missing))
        raise typer.Exit(4)
    compile_as_needed()
    from riserstudy.design.tension_table import TensionRequest, lines, tension_table

    ceiling = None if limit is None or share is None else (limit, share)
    requested = TensionRequest(Tolerances(weight, buoyancy), Rig(units, failed, tension_ratio, angle))
    rows = tension_table(riser, requested._replace(overpull=pulled, ceiling=ceiling))
    print("\n".join(lines(rows)))
    write_table(rows.table(), csv)
    if rows.missing:
        raise typer.Exit(4)


def _check_rig(units: int, failed: int, weight: float, buoyancy: float) -> None:
    """Refuse a rig without a working unit, and tolerances that are not finite."""
    if failed >= units:
        allowed = f"give at most {units - 1}, or increase --units"
        raise InputError("--failed", str(failed), f"all {units} tensioner units have failed", allowed)
    for option, tolerance in (("--weight", weight), ("--buoyancy", buoyancy)):
        if not math.isfinite(tolerance):  # the option's minimum accepts these
            raise InputError(option, str(tolerance), "the value is not finite", "write, for example, 1.05")


def viv(
    scene: SceneArgument,
    strouhal: Annotated[
        float,
        typer.Option(
            help="Strouhal number f D / U of the shedding frequencies that are printed and plotted; "
            "in the literature 0.17 to 0.25"
        ),
    ] = 0.2,
    slowest: Annotated[
        float, typer.Option(help="lowest reduced velocity U / (f D) of lock-in; in the literature 3 to 5")
    ] = 4.0,
    fastest: Annotated[
        float, typer.Option(help="highest reduced velocity of lock-in; in the literature 7 to 10")
    ] = 8.0,
    lift: Annotated[
        float, typer.Option(help="lift coefficient in phase with velocity; in the literature 0.6 to 1.3")
    ] = 1.2,
    drag: Annotated[
        float | None, typer.Option(help="drag coefficient; default: the coefficient of the scene")
    ] = None,
    drag_gain: Annotated[
        float,
        typer.Option(
            help="coefficient g of the factor 1 + g A / D by which a vibration of amplitude A increases "
            "the drag; in the literature 1.1 to 2.1"
        ),
    ] = 2.1,
    settings: SetOption = None,
    csv: CsvOption = None,
    plot: PlotOption = None,
    force: ForceOption = False,
) -> None:
    """Screen a riser in a current for vortex-induced vibration: modes, lock-in regions, amplitudes, drag.

    The screening uses the natural modes about the static equilibrium, and does not simulate over time.
    Each mode is treated as if it vibrated alone. In the lock-in region of a mode, vortices follow the
    vibration. At the predicted amplitude, the lift of the vortices supplies as much power as drag
    removes. The command ``viv`` prints the predicted amplitude divided by the diameter. The Strouhal
    number changes neither the lock-in regions nor the amplitudes. In the options, U is the current speed,
    f a frequency, D the diameter, and A the amplitude.
    """
    file = scene_of(scene, settings)
    check_targets(file.files, force, csv, plot)
    compile_as_needed()
    from riserstudy.design.vortex_screening import Coefficients, screening

    found = screening(file, Coefficients(strouhal, slowest, fastest, lift, drag, drag_gain))
    if warning := found.attrs.get("warning"):
        notify(f"warning: {warning}")
    _show_modes(found, csv)
    shed = found["shedding_frequency"].values
    print(
        f"vortices are shed at {shed.min():.3g} to {shed.max():.3g} Hz, for a Strouhal number of "
        f"{strouhal:g}; the table depends on reduced velocities, not on the Strouhal number"
    )
    if any(section.viv for section in file.resolved().riser):
        print(f"keys `viv` of sections are not used: lift of {lift:g} can act on the whole riser in water")
    if plot is not None:
        from riserstudy.figures.vortex_frequencies import vortex_frequencies

        save_figure(vortex_frequencies(found, str(file.tree["title"])), plot)


def _show_modes(found: xr.Dataset, csv: Path | None) -> None:
    """Print the modes that may lock in as a table."""
    from riserstudy.dataset.table import Cell, Table
    from riserstudy.design.vortex_screening import ABOUT

    units = [unit.replace("m s-1", "m/s").replace("1", "") for unit, _ in ABOUT.values()]
    rows: list[list[Cell]] = [
        [str(mode), *(float(f"{float(found[name][k]):.4g}") for name in ABOUT)]
        for k, mode in enumerate(found["mode"].values)
    ]
    table = Table(["mode", *ABOUT], ["", *units], rows)
    if rows:
        show(table, csv)
    else:
        print("no mode can lock in")
        write_table(table, csv)  # which replaces the table of another current
