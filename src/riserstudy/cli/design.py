"""What is signed before a riser is run: tension."""

from __future__ import annotations

from typing import Annotated

import typer

from riserstudy.cli.shared import SceneArgument, SetOption, compile_kernels, scene_of
from riserstudy.errors import InputError


def tension(
    scene: SceneArgument,
    units: Annotated[int, typer.Option(min=1, help="tensioner units")],
    failed: Annotated[int, typer.Option(min=0, help="units that are out")],
    tension_ratio: Annotated[
        float,
        typer.Option(min=0.01, max=1.0, help="R_f: vertical tension over setting, such as 0.95"),
    ],
    weight: Annotated[
        float, typer.Option(min=0.1, help="tolerance on steel: 1.05, or 1 if weighed")
    ],
    buoyancy: Annotated[
        float, typer.Option(min=0.0, help="tolerance on modules: 0.96, or 1 if weighed")
    ],
    fleet_angle: Annotated[
        str, typer.Option(help="of lines to the vertical, where R_f leaves it out", metavar="ANGLE")
    ] = "0 deg",
    settings: SetOption = None,
) -> None:
    """Say the smallest tension at which no point of a riser is slack, by the formula and by the engine.

    Exit status 4 where the scene does not tell what it takes, such as steel and buoyancy apart.
    """
    from riserstudy.scene.units import to_si

    file = scene_of(scene, settings)
    if failed >= units:
        allowed = f"allowed are up to {units - 1} of {units}"
        raise InputError("--failed", str(failed), "no unit is left", allowed)
    try:
        angle = to_si(fleet_angle, "rad")
    except ValueError as fault:
        raise InputError("--fleet-angle", fleet_angle, str(fault), "allowed is 5 deg") from None
    from riserstudy.design import tension as formula
    from riserstudy.design.tension import Rig, Tolerances

    riser = file.scene()
    if missing := formula.lacks(riser):
        print("not evaluated: " + ", ".join(missing))
        raise typer.Exit(4)
    compile_kernels()
    from riserstudy.design import engine_tension as engine

    tolerances, rig = Tolerances(weight, buoyancy), Rig(units, failed, tension_ratio, angle)
    needed = formula.needed(riser, tolerances)
    governing = int(needed.argmax())
    ends = [f"lower end of {section.name}" for section in riser.riser]
    ends.append(f"upper end of {riser.riser[-1].name}")
    for name, value in zip(ends, needed, strict=True):
        print(f"{value / 1e3:10.2f} kN  {name}")
    print(f"formula: {needed[governing] / 1e3:.2f} kN, governed by the {ends[governing]}")
    if missing := engine.lacks(riser):
        print("engine:  not evaluated: " + ", ".join(missing))
    else:
        slack = engine.needed(riser, tolerances)
        print(f"engine:  {slack.tension / 1e3:.2f} kN, slack first {slack.s:.4g} m from the bottom")
    setting = formula.setting(float(needed[governing]), rig) / 1e3
    print(f"setting: {setting:.2f} kN with {failed} of {units} units out")
