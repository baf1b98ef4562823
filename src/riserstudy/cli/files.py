"""Commands that make files: draw, import, new, schema."""

from __future__ import annotations

import json
import shlex
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from riserstudy.cli.shared import SceneArgument, SetOption, quantity, scene_of, wrote
from riserstudy.cli.targets import ForceOption, Writes, check_output
from riserstudy.errors import InputError
from riserstudy.files.whole import whole_file


class FirstColumn(StrEnum):
    """First column of a .4 file of WAMIT."""

    PERIOD = "period"
    FREQUENCY = "frequency"


ONLY_WAMIT = "omit the option, which is only for .4 files of WAMIT"


def draw(
    scene: SceneArgument,
    output: Annotated[
        Path,
        typer.Option("-o", "--output", help="drawing (PNG, PDF or SVG)", metavar="OUT.png"),
        Writes("figure"),
    ],
    settings: SetOption = None,
    force: ForceOption = False,
) -> None:
    """Draw a scene to scale: parts, degrees of freedom, loads."""
    file = scene_of(scene, settings)
    check_output(output, ("figure",), file.files, force)
    from riserstudy.figures import save
    from riserstudy.schematic import schematic

    save(schematic(file.resolved(), assumed=file.assumed, calibrated=file.calibrated), output)
    wrote(output)


def import_deck(
    deck: Annotated[
        Path,
        typer.Argument(
            help="OrcaFlex text model (.yml), WAMIT output with RAOs (.4), or Capytaine dataset with RAOs",
            metavar="DECK.yml",
        ),
    ],
    output: Annotated[
        Path,
        typer.Option(
            "-o",
            "--output",
            help="scene to write, or CSV table if the input holds RAOs",
            metavar="SCENE.yaml",
        ),
        Writes("scene", "table of operators"),
    ],
    length: Annotated[
        str | None,
        typer.Option(
            help="length ULEN of the WAMIT body, such as '1 m'; required for a .4 file", metavar="LENGTH"
        ),
    ] = None,
    first_column: Annotated[
        FirstColumn | None,
        typer.Option(help="first column of a .4 file of WAMIT: period (s) or frequency (rad/s)"),
    ] = None,
    force: ForceOption = False,
) -> None:
    """Convert an OrcaFlex text model of a vertical riser to a scene, or platform RAOs to a table.

    The command ``import`` lists everything that it leaves out of the scene. The command ``import`` refuses a
    model that a scene cannot represent.
    """
    if deck.suffix in (".4", ".nc"):
        _import_operators(deck, output, length, first_column, force)
        return
    _refuse_wamit_options(length, first_column)
    from riserstudy.importers.orcaflex import as_text, read_deck

    deck_scene = read_deck(deck)
    check_output(output, ("scene",), [deck], force)
    with whole_file(output) as partial:
        partial.write_text(as_text(deck_scene, deck), "utf-8")
    for line in deck_scene.left_out:
        print(f"left out: {line}")
    print(
        f"{output} is written. {len(deck_scene.left_out)} entries of the model are left out of "
        "the scene or differ"
    )


def export_deck(
    scene: SceneArgument,
    output: Annotated[
        Path,
        typer.Option("-o", "--output", help="text model of OrcaFlex to write", metavar="DECK.yml"),
        Writes("deck"),
    ],
    orcaflex: Annotated[
        bool, typer.Option("--orcaflex", help="write OrcaFlex's text model, the only format so far")
    ] = True,
    settings: SetOption = None,
    force: ForceOption = False,
) -> None:
    """Write a scene as the OrcaFlex text model of its riser.

    The command ``export`` lists everything that the model leaves out or represents differently.
    """
    from riserstudy.export.orcaflex import write_deck

    file = scene_of(scene, settings)
    check_output(output, ("deck",), file.files, force)
    deck = write_deck(file)
    with whole_file(output) as partial:
        partial.write_text(deck.text, "utf-8")
    for line in deck.left_out:
        print(f"left out: {line}")
    print(
        f"{output} is written. {len(deck.left_out)} inputs of the scene are left out or written differently"
    )


def _refuse_wamit_options(length: str | None, first_column: FirstColumn | None) -> None:
    """Refuse options that change nothing for a file that is not WAMIT's."""
    for option, value in (("--length", length), ("--first-column", first_column)):
        if value is not None:
            raise InputError(option, value, "has no effect on this file", ONLY_WAMIT)


def _import_operators(
    source: Path, output: Path, length: str | None, first_column: FirstColumn | None, force: bool
) -> None:
    """Write the table of RAOs from a file of WAMIT or Capytaine."""
    from riserstudy.importers.capytaine import from_capytaine
    from riserstudy.importers.operators import lines_of_scene, write_table
    from riserstudy.importers.wamit import from_wamit

    if not source.is_file():
        raise InputError(source, "", "No such file or directory", "give the path of an existing file")
    check_output(output, ("table of operators",), [source], force)
    if source.suffix == ".nc":
        _refuse_wamit_options(length, first_column)
        operators = from_capytaine(source)
    elif length is None:
        allowed = "give ULEN of the .gdf file, for example --length '1 m'"
        found = "missing, but WAMIT multiplies rotations by this length"
        raise InputError("--length", "", found, allowed)
    else:
        allowed = "give a length above 0, such as '1 m'"
        ulen = quantity("--length", length, "m", allowed)
        if not ulen > 0.0:
            raise InputError("--length", length, "the length is not above 0", allowed)
        operators = from_wamit(source, ulen, first_column.value if first_column else None)
    write_table(operators, output)
    for line in operators.left_out:
        print(f"left out: {line}")
    print(f"{output} is written; in a scene: {lines_of_scene(operators, output)}")
    print("Motions refer to the origin of the body's axes: enter this origin as platform.centre_of_rotation")


def new(folder: Annotated[Path, typer.Argument(help="folder to make", metavar="FOLDER"), Writes()]) -> None:
    """Make a folder for your own study, with a Snakefile, a configuration and an example to edit."""
    from riserstudy.study.new import new_study

    new_study(folder)
    way = shlex.quote(str(folder))
    print(f"{folder} is ready: `cd {way}`, then `snakemake`; README.md there explains the next steps.")


def schema(
    kind: Annotated[
        str, typer.Argument(help="kind of file: scene, study, config or claims", metavar="[KIND]")
    ] = "scene",
) -> None:
    """Print the JSON schema of scene, study, configuration or claims files, for editors."""
    from riserstudy.files.chapters import own_chapters
    from riserstudy.grading import claims_schema
    from riserstudy.study.schemas import schemas

    if kind not in (known := schemas(own_chapters()) | {"claims": claims_schema}):
        raise InputError(
            "schema", kind, "this name is not a kind of input file", f"use one of {', '.join(known)}"
        )
    print(json.dumps(known[kind](), indent=2))
