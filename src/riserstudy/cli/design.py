"""What is signed before a riser is run: tension, operability."""

from __future__ import annotations

import math
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

    Exit status 4 where the scene does not give what it takes, such as steel and buoyancy apart.
    """
    file = scene_of(scene, settings)
    if failed >= units:
        allowed = f"allowed are up to {units - 1} of {units}"
        raise InputError("--failed", str(failed), "no unit is left", allowed)
    for option, tolerance in (("--weight", weight), ("--buoyancy", buoyancy)):
        if not math.isfinite(tolerance):  # which a minimum lets pass
            raise InputError(option, str(tolerance), "no finite number", "allowed is such as 1.05")
    angle = _read("--fleet-angle", fleet_angle, "rad")
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


def operability(
    scene: SceneArgument,
    reach: Annotated[
        str, typer.Option(help="how far to either side of the well to look", metavar="LENGTH")
    ],
    allowance: Annotated[
        list[str] | None,
        typer.Option(
            help="what waves add: lfj_angle='0.5 deg'; may be repeated", metavar="OUTPUT=VALUE"
        ),
    ] = None,
    settings: SetOption = None,
) -> None:
    """Say between which offsets of the platform each limit of a scene is kept, on risers at rest.

    Exit status 4 where one could not be evaluated.
    """
    from riserstudy.dataset.limits import label

    file = scene_of(scene, settings)
    if "limits" not in file.tree:
        allowed = "allowed is a list such as {output: lfj_angle, largest: 4 deg, mode: drilling}"
        raise InputError(file.source, "limits", "missing", allowed)
    added, far = _allowances(allowance), _read("--reach", reach, "m")
    riser = file.scene()
    compile_kernels()
    from riserstudy.design.operability import offsets

    found = offsets(riser, far, added)
    for limit, between in zip(riser.limits or [], found, strict=True):
        print(f"{label(limit):50s} {_between(between.low, between.high, between.missing)}")
    if any(between.missing for between in found):
        raise typer.Exit(4)


def _allowances(given: list[str] | None) -> dict[str, float]:
    """Allowances in SI, by output."""
    from riserstudy.scene.limits import UNITS

    added = {}
    for one in given or []:
        name, equals, text = (part.strip() for part in one.partition("="))
        if not equals or name not in UNITS:
            allowed = "allowed is OUTPUT=VALUE, of " + ", ".join(UNITS)
            raise InputError("--allowance", one, "no output that has limits", allowed)
        added[name] = _read("--allowance", text, UNITS[name])
    return added


def _read(option: str, text: str, unit: str) -> float:
    """A quantity in SI."""
    from riserstudy.scene.units import to_si

    try:
        return to_si(text, unit)
    except ValueError as fault:
        raise InputError(option, text, str(fault), f"allowed is a value in {unit}") from None


def _between(low: float, high: float, missing: str) -> str:
    """Where a limit is kept, in words."""
    if missing:
        return f"not evaluated: {missing}"
    if math.isnan(low):
        return "kept at no offset"
    ends = ["not reached" if math.isinf(end) else f"{end:+.1f} m" for end in (low, high)]
    return f"{ends[0]} to {ends[1]}"
