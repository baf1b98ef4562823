"""Emergency disconnects: recoil, watch-circles."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from riserstudy.cli.check import show_limits
from riserstudy.cli.shared import (
    AccuracyOption,
    CsvOption,
    SceneArgument,
    SetOption,
    check_targets,
    quantity,
    save_dataset,
    scene_of,
    show,
    simulated,
)
from riserstudy.cli.targets import ForceOption, Writes
from riserstudy.errors import InputError

DatasetOption = Annotated[
    Path | None,
    typer.Option("-o", "--output", help="also write the dataset (netCDF)", metavar="OUT.nc"),
    Writes("dataset"),
]


def recoil(
    scene: SceneArgument,
    settings: SetOption = None,
    accuracy: AccuracyOption = None,
    output: DatasetOption = None,
    csv: CsvOption = None,
    force: ForceOption = False,
) -> None:
    """Simulate an emergency disconnect: overpull, lift, clearance, re-contact, strokes, mud velocity.

    The overpull is the effective tension between LMRP and BOP at the disconnect. The lift is the height of
    the LMRP above the BOP, and the clearance is the smallest lift after its first maximum. The exit status is
    2 if the scene has no disconnect before the end of its run. The exit status is 4 if the smallest clearance
    could not be evaluated.
    """
    file = scene_of(scene, settings, accuracy)
    check_targets(file.files, force, csv, output=output)
    if file.resolved().disconnect is None:
        allowed = "add, for example, `disconnect: {at: 12 s}`"
        raise InputError(file.source, "disconnect", "missing, so the riser does not disconnect", allowed)
    dataset = simulated(file)
    from riserstudy.dataset import recoil_table

    show(recoil_table.recoil(file.resolved(), dataset), csv)
    show_limits(dataset)
    save_dataset(dataset, output)
    if "clearance_min" not in dataset.attrs:
        raise typer.Exit(4)


class Mode(StrEnum):
    """Modes of operation of limits."""

    DRILLING = "drilling"
    CONNECTED = "connected"
    DISCONNECT = "disconnect"


def watch_circles(
    scene: SceneArgument,
    disconnect: Annotated[
        str, typer.Option(help="time from the red alarm to the disconnect of the LMRP", metavar="TIME")
    ],
    prepare: Annotated[str, typer.Option(help="time from the yellow alarm to the red alarm", metavar="TIME")],
    mode: Annotated[
        list[Mode] | None,
        typer.Option(help="use only limits of this operating mode; may be repeated; default: all"),
    ] = None,
    settings: SetOption = None,
    accuracy: AccuracyOption = None,
    output: DatasetOption = None,
    csv: CsvOption = None,
    force: ForceOption = False,
) -> None:
    """Simulate a drift-off or a drive-off: the time at which each limit is reached, and the watch circles.

    The scene must have a `vessel`, or a `platform` with the key `cruise`. If the scene has both a
    `vessel` and a `platform`, ``watch-circles`` adds the motions of the `platform` in waves to the drift
    of the `vessel`. The exit status is 4 if a limit could not be evaluated.
    """
    file = scene_of(scene, settings, accuracy)
    check_targets(file.files, force, csv, output=output)
    times = [
        quantity(option, text, "s") for option, text in (("--disconnect", disconnect), ("--prepare", prepare))
    ]
    for option, text, value in zip(("--disconnect", "--prepare"), (disconnect, prepare), times, strict=True):
        if value < 0.0:
            raise InputError(option, text, "the time is negative", "give a time from 0 s")
    from riserstudy.design.watch_circles_of_run import Times, circles, moves_off

    of = file.resolved()
    moves_off(of, file.source)
    limited = {limit.mode for limit in of.limits or []}
    for one in mode or []:
        if one.value not in limited:
            why = "no limit of the scene has this mode of operation"
            raise InputError("--mode", one.value, why, "choose another mode, or add a limit with this mode")
    modes = [one.value for one in Mode if one.value in limited and (not mode or one in mode)]
    dataset = simulated(file)
    from riserstudy.study.in_sea import one_sea

    found = circles(of, dataset, Times(*times), modes)
    show(found.table, csv)
    if chance := one_sea(of):
        print(f"{chance}; use the smallest circles of several seeds")
    save_dataset(dataset, output)
    if found.missing:
        raise typer.Exit(4)
