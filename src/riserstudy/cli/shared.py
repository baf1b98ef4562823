"""Arguments, options and steps that several commands share."""

from __future__ import annotations

import json
import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from riserstudy.errors import InputError, RiserStudyError

if TYPE_CHECKING:
    from riserstudy.scene.models import Scene

SceneArgument = Annotated[Path, typer.Argument(help="scene file (YAML)", metavar="SCENE.yaml")]

SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        help="set a value: platform.heave.amplitude='3 m'; may be repeated",
        metavar="PATH=VALUE",
    ),
]

AtOption = Annotated[
    list[str] | None,
    typer.Option(
        "--at", help="which point: heave_amplitude=5; may be repeated", metavar="AXIS=VALUE"
    ),
]


def scene_of(path: Path, settings: list[str] | None, accuracy: str | None = None) -> Any:
    """Read a scene with the values of ``--set`` and the error of ``--accuracy``, and check it."""
    from riserstudy.scene.load import plain_yaml, read_scene
    from riserstudy.simulation.simulate import at_accuracy

    overrides: dict[str, Any] = {}
    for setting in settings or []:
        name, equals, text = setting.partition("=")
        if not equals or not name.strip():
            raise InputError(
                "--set", setting, "no PATH=VALUE", "allowed is platform.heave.amplitude='3 m'"
            )
        overrides[name.strip()] = plain_yaml(text, f"--set {name.strip()}")
    file = read_scene(path).with_values(overrides, "--set")
    if accuracy is not None:
        file = at_accuracy(file, accuracy)
    file.scene()
    return file


def compile_kernels(scene: Scene | None = None) -> None:
    """What every command does that simulates: compile all kernels, or those that a scene needs.

    The latter by a run that is broken off, so that compiling counts neither as time of the run nor against
    its patience.
    """
    from riserstudy.simulation.compile import compile_once

    if scene is None:
        compile_once(_tell)
        _plain_xarray()
        return
    from riserstudy.simulation.refine import run

    tell_of_kernels()
    with suppress(RiserStudyError):  # which the run itself will report
        run(scene, patience=0.0)


def tell_of_kernels() -> None:
    """Say so when a kernel is compiled, by what needs but those of one scene."""
    from riserstudy.simulation.compile import tell_of_compiling

    tell_of_compiling(_tell)
    _plain_xarray()


def _tell(said: str) -> None:
    print(f"riserstudy: {said}", file=sys.stderr)


def _plain_xarray() -> None:
    """Let xarray, which looks for kinds of arrays once, find no others than numpy's: no command has any."""
    from riserstudy.dataset.without import without

    with without("dask", "pint"):
        import xarray

        xarray.Dataset(coords={"s": [0.0]})


def check_writable(output: Path, scene: Path) -> None:
    """Refuse what would not be made, or would take the place of a device, a link or the scene."""
    import os

    try:
        folder = output.resolve().parent
        taken = output.is_symlink() or (output.exists() and not output.is_file())
        if taken or not folder.is_dir() or not os.access(folder, os.W_OK):
            allowed = "allowed is a file in a folder that exists"
            raise InputError("--output", str(output), "cannot be written", allowed)
        if output.exists() and output.samefile(scene):
            raise InputError("--output", str(output), "the file that is read", "name another file")
    except (OSError, ValueError) as error:  # names too long, loops of links, no name at all
        reason = getattr(error, "strerror", None) or "no file name"
        raise InputError("--output", str(output), reason, "allowed is another file") from None


def check_csv(output: Path) -> None:
    """Refuse a table that would not be CSV."""
    if output.suffix != ".csv":
        allowed = "allowed is .csv, which spreadsheets open"
        if output.suffix in (".xlsx", ".xls"):
            allowed += "; workbooks need a library that riserstudy does not bring"
        raise InputError("--output", str(output), f"no table {output.suffix!r}", allowed)


def place_of(at: list[str] | None) -> dict[str, str]:
    """Values by axis, as text."""
    given = [one.partition("=") for one in at or []]
    if bad := [name for name, equals, _ in given if not equals]:
        raise InputError("--at", bad[0], "no AXIS=VALUE", "allowed is heave_amplitude=5")
    return {name.strip(): value.strip() for name, _, value in given}


def say_warnings(dataset: Any) -> None:
    """Print what a run warns of."""
    for warning in json.loads(dataset.attrs["warnings"]):
        print(f"riserstudy: warning: {warning}", file=sys.stderr)
