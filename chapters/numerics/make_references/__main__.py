"""``python -m chapters.numerics.make_references [STUDY[/CASE] ...]``, which `make references` runs."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Annotated

import typer

from chapters.numerics.make_references.compute import compute
from riserstudy.errors import RiserStudyError


def main(
    only: Annotated[list[str] | None, typer.Argument(help="a study, or study/case")] = None,
    again: Annotated[bool, typer.Option("--again", help="compute those that could be used, too")] = False,
    processes: Annotated[int, typer.Option(help="at a time")] = os.cpu_count() or 1,
) -> None:
    """Compute the reference solutions that the studies of the engine compare with."""
    try:
        compute(Path("config"), only or [], again, processes)
    except RiserStudyError as error:
        print(f"riserstudy: {error}", file=sys.stderr)
        raise typer.Exit(error.exit_code) from None


if __name__ == "__main__":
    typer.run(main)
