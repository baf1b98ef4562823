"""A folder for your study, ready for ``snakemake``."""

from __future__ import annotations

import shutil
from pathlib import Path

from riserstudy.errors import InputError

TEMPLATE = Path(__file__).with_name("template")


def new_study(folder: Path) -> None:
    """Write a Snakefile, a configuration, an example of a scene and a study, and schemas for editors.

    Raises InputError when the folder is not empty, or cannot be made.
    """
    from riserstudy.study.schemas import schema_files

    allowed = "give the name of a new or empty folder"
    try:
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise InputError("new", str(folder), "the folder already contains files", allowed)
        try:
            shutil.copytree(TEMPLATE, folder, dirs_exist_ok=True)
            schemas = folder / "config/schemas"
            schemas.mkdir()
            for name, text in schema_files().items():
                (schemas / name).write_text(text, "utf-8")
        except OSError:  # as on a full disk: remove everything, so a second call is possible
            _empty(folder)
            raise
    except OSError as error:
        reason = error.strerror or "cannot be made"
        raise InputError("new", str(folder), reason, allowed) from None


def _empty(folder: Path) -> None:
    for part in folder.iterdir() if folder.is_dir() else ():
        shutil.rmtree(part) if part.is_dir() else part.unlink()
