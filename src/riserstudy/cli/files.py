"""Make files: draw, import, new, schema."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from riserstudy.cli.shared import SceneArgument, SetOption, check_writable, scene_of
from riserstudy.errors import InputError


def draw(
    scene: SceneArgument,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="drawing (PNG, PDF or SVG)", metavar="OUT.png")
    ],
    settings: SetOption = None,
) -> None:
    """Draw a scene to scale: what is there, what it is free to do, what acts on it."""
    file = scene_of(scene, settings)
    check_writable(output, scene)
    if output.suffix not in (".png", ".pdf", ".svg"):
        allowed = "allowed are .png, .pdf and .svg"
        raise InputError("--output", str(output), f"no drawing {output.suffix!r}", allowed)
    from riserstudy.figures import save
    from riserstudy.schematic import schematic

    save(schematic(file.scene()), output)


def import_deck(
    deck: Annotated[Path, typer.Argument(help="OrcaFlex text model", metavar="DECK.yml")],
    output: Annotated[
        Path, typer.Option("-o", "--output", help="scene to write", metavar="SCENE.yaml")
    ],
) -> None:
    """Make a scene of a deck: the OrcaFlex text model of a vertical riser.

    Everything that is not in the scene is named; what would make it another riser is refused.
    """
    from riserstudy.scene.orcaflex import as_text, read_deck

    deck_scene = read_deck(deck)
    check_writable(output, deck)
    output.write_text(as_text(deck_scene, deck), "utf-8")
    for line in deck_scene.left_out:
        print(f"left out: {line}")
    print(f"{output} is written; {len(deck_scene.left_out)} entries of the deck are not in it")


def new(folder: Annotated[Path, typer.Argument(help="folder to make", metavar="FOLDER")]) -> None:
    """Make a folder for a study of one's own: Snakefile, configuration, an example to change."""
    from riserstudy.study.new import new_study

    new_study(folder)
    print(f"{folder} is ready: `cd {folder}`, then `snakemake`; README.md there goes on from here.")


def schema(
    kind: Annotated[str, typer.Argument(help="scene, study or config", metavar="[KIND]")] = "scene",
) -> None:
    """Print the JSON schema of scene, study or configuration files, for editors."""
    from riserstudy.study.schemas import schemas

    if kind not in (known := schemas()):
        raise InputError("schema", kind, "no kind of file", f"allowed are {', '.join(known)}")
    print(json.dumps(known[kind], indent=2))
