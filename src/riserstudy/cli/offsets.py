"""Offsets at which a connected riser meets its limits: in one current, and as an operating envelope."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

import typer

from riserstudy.cli.shared import (
    CsvOption,
    SceneArgument,
    SetOption,
    check_targets,
    compile_as_needed,
    notify,
    pairs,
    positive,
    quantity,
    require_limits,
    scene_of,
    show,
)
from riserstudy.cli.targets import ForceOption
from riserstudy.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from riserstudy.design.operability import Offsets
    from riserstudy.scene.limits import Limit

SEEDS = 5  # default number of runs of a sea

ReachOption = Annotated[
    str,
    typer.Option(
        help="largest offset to search, to either side of the well, such as '100 m'", metavar="LENGTH"
    ),
]

TowardsOption = Annotated[
    str | None,
    typer.Option(
        help="direction of positive offsets, from +x towards +y, such as '45 deg'; default: +x",
        metavar="ANGLE",
    ),
]


def operability(
    scene: SceneArgument,
    reach: ReachOption,
    allowance: Annotated[
        list[str] | None,
        typer.Option(
            help="effect of waves on an output, such as lfj_angle='0.5 deg': added to the static value, or "
            "subtracted if the limit is a lower limit; may be repeated",
            metavar="OUTPUT=VALUE",
        ),
    ] = None,
    towards: TowardsOption = None,
    settings: SetOption = None,
) -> None:
    """Compute the static offset range within which each limit is met.

    For each limit, the table gives the allowable value, the allowance for waves (if given by --allowance),
    and the offset range. The exit status is 4 if a limit could not be evaluated.
    """
    file = scene_of(scene, settings)
    require_limits(file)
    riser, far = file.resolved(), positive("--reach", reach, "m")
    added, direction = _allowances(allowance, riser.limits or []), _direction(towards)
    compile_as_needed()
    from riserstudy.design.operability import offsets

    found = offsets(riser, far, added, direction)
    if towards is not None:
        print(_positive(towards))
    for line in _ranges(riser.limits or [], found, added):
        print(line)
    if any(between.missing for between in found):
        raise typer.Exit(4)


def envelope(
    scene: SceneArgument,
    reach: ReachOption,
    current: Annotated[
        list[str],
        typer.Option(
            help="current speed at the surface, such as '0.5 m/s'; may be repeated", metavar="SPEED"
        ),
    ],
    sea: Annotated[
        list[str] | None,
        typer.Option(
            help="significant wave height and peak period of a sea, such as '4 m, 10 s'; may be repeated; "
            "default: no waves",
            metavar="HEIGHT,PERIOD",
        ),
    ] = None,
    seeds: Annotated[
        int | None,
        typer.Option(
            min=5,
            help="number of runs of each sea in each current, with different random phases; requires --sea; "
            "default: 5",
        ),
    ] = None,
    exposure: Annotated[
        str | None,
        typer.Option(
            help="duration of the storm for which allowances are computed, such as '3 h'; requires --sea; "
            "default: duration of a run after its ramps",
            metavar="TIME",
        ),
    ] = None,
    towards: TowardsOption = None,
    settings: SetOption = None,
    csv: CsvOption = None,
    force: ForceOption = False,
) -> None:
    """Compute the operating envelope: for each current and sea, the offsets between which all limits are met.

    At each offset, ``envelope`` computes the static equilibrium. To include a sea, ``envelope`` adds an
    allowance to the static value of each output. If the limit is a smallest allowed value, ``envelope``
    subtracts the allowance from the static value. In nine of ten random realisations of the sea, the
    change due to waves does not exceed the allowance. The command ``envelope`` computes the allowance by
    simulations in the sea and in each current, at the offset of the scene and at the ends of the
    envelope. The allowance applies to a sea that lasts as long as a simulation after its ramps, or as
    long as --exposure states. For a limit on a mean value, the allowance is the average change of the
    mean due to waves. The exit status is 4 if a limit could not be evaluated.
    """
    file = scene_of(scene, settings)
    check_targets(file.files, force, csv)
    require_limits(file)
    far, direction = positive("--reach", reach, "m"), _direction(towards)
    speeds = [quantity("--current", one, "m/s") for one in current]
    sea_states = [_sea(one) for one in sea or []]
    for option, given in (("--seeds", seeds), ("--exposure", exposure)):
        if given is not None and not sea_states:
            raise InputError(
                "envelope", option, "has no effect without --sea", "add --sea, or omit the option"
            )
    storm = None if exposure is None else positive("--exposure", exposure, "s")
    _once("--current", current, [(speed,) for speed in speeds])
    _once("--sea", sea or [], sea_states)
    compile_as_needed()
    from riserstudy.design.envelope import envelope as computed
    from riserstudy.study.in_sea import Sea, in_sea
    from riserstudy.study.in_sea import exposure as run_of

    seas = [Sea(*one) for one in sea_states]
    for one in seas:
        in_sea(file, one, 1).resolved()  # refuses a scene without a sea before any run
    found = computed(file, far, speeds, seas, seeds or SEEDS, notify, storm, direction)
    if towards is not None:
        print(_positive(towards))
    show(found.table, csv)
    if seas:
        print(_allowed_for(run_of(file.resolved()), storm, seeds or SEEDS))
    for name, why in found.missing.items():
        print(f"{name}: not evaluated: {why}; rows with this note omit the limit")
    if found.missing:
        raise typer.Exit(4)


def _direction(text: str | None) -> float:
    """Direction of positive offsets (rad)."""
    return 0.0 if text is None else quantity("--towards", text, "rad")


def _positive(towards: str) -> str:
    """A line on the direction of positive offsets."""
    return f"offsets are positive towards {towards} (from +x towards +y)"


def _allowed_for(run: float, storm: float | None, seeds: int) -> str:
    """A line on the duration of the seas of the allowances and of the runs after their ramps (s)."""
    return (
        f"nine of ten seas of {run if storm is None else storm:g} s do not exceed the allowances, from "
        f"{seeds} runs of {run:g} s in each sea and current, at up to three offsets"
    )


def _sea(text: str) -> tuple[float, float]:
    """Significant height (m) and peak period (s)."""
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2:
        allowed = "give a significant wave height and a peak period, such as '4 m, 10 s'"
        raise InputError("--sea", text, "the text is not a pair of values", allowed)
    return positive("--sea", parts[0], "m"), positive("--sea", parts[1], "s")


def _once(option: str, texts: Sequence[str], values: Sequence[tuple[float, ...]]) -> None:
    """Check that no value of an option, in SI, is given twice. Raises InputError with the second one."""
    rounded = [[f"{part:.9g}" for part in value] for value in values]
    for k, text in enumerate(texts):
        if rounded[k] in rounded[:k]:
            raise InputError(option, text, "the value is given twice", "give each value once")


def _allowances(given: list[str] | None, limits: Sequence[Limit]) -> dict[str, float]:
    """Allowances in SI, by output; each output must have a limit that its allowance is added to."""
    from riserstudy.scene.limits import UNITS

    added: dict[str, float] = {}
    used = {limit.output for limit in limits if limit.side != "mean"}
    for name, text in pairs("--allowance", given, "OUTPUT=VALUE", "lfj_angle='0.5 deg'").items():
        option = f"--allowance {name}"
        if name not in UNITS:
            allowed = "use one of " + ", ".join(UNITS)
            raise InputError(option, text, f"{name!r} is not an output that can have a limit", allowed)
        if name not in used:
            found = f"the scene has no limit on the largest or smallest {name}"
            raise InputError(option, text, found, f"use one of {', '.join(sorted(used))}")
        added[name] = quantity(option, text, UNITS[name])
        if added[name] < 0.0:
            raise InputError(option, text, "the allowance is negative", "give the magnitude of the allowance")
    return added


def _ranges(limits: Sequence[Limit], found: Sequence[Offsets], added: Mapping[str, float]) -> list[str]:
    """A heading, and a line per limit: its allowable value, its allowance if any, and the offsets."""
    from riserstudy.dataset.limits import labels
    from riserstudy.dataset.table import aligned
    from riserstudy.dataset.unit_systems import UnitSystem, read_in
    from riserstudy.scene.limits import UNITS

    allowance_column = any(added.values())
    rows = [("limit", "allowable", *["allowance"] * allowance_column, "offsets")]
    for limit, name, between in zip(limits, labels(limits), found, strict=True):
        factor, unit = read_in(UNITS[limit.output], UnitSystem.FIELD)
        add = 0.0 if limit.side == "mean" else added.get(limit.output, 0.0)
        allowance = f"{factor * add:.4g} {unit}" if add else ""
        allowable = f"{factor * limit.allowable:.4g} {unit}"
        rows.append((name, allowable, *[allowance] * allowance_column, _between(between)))
    return aligned(rows)


def _between(found: Offsets) -> str:
    """Offsets between which a limit is met, in words."""
    if found.missing:
        return f"not evaluated: {found.missing}"
    if math.isnan(found.low):
        return "met at no offset"
    ends = ["not reached" if math.isinf(end) else f"{end:+.1f} m" for end in (found.low, found.high)]
    also = "" if math.isnan(found.also) else f"; also met at other offsets, such as {found.also:+.1f} m"
    return f"{ends[0]} to {ends[1]}{also}"
