"""The folders and modules of chapters: the code of one paper each, in the folder where one works."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from importlib import import_module
from pathlib import Path
from types import ModuleType


def chapter_modules(paper: str, part: str) -> list[str]:
    """Return the modules of one part of a paper's chapter: ``figures``, ``derived``, ``claims`` and so on.

    A part is a file of that name or a folder of files, in ``chapters`` of the current folder.
    """
    place = Path("chapters") / paper / part
    if place.with_suffix(".py").exists():
        return [f"chapters.{paper}.{part}"]
    names = sorted(path.stem for path in place.glob("*.py") if path.stem != "__init__")
    return [f"chapters.{paper}.{part}.{name}" for name in names]


def variables_of_chapter(paper: str) -> Path:
    """File of the names, units and labels that a chapter of the folder where one works defines."""
    return Path("chapters") / paper / "variables.yaml"


def own_chapters() -> list[str]:
    """Return the papers that have a chapter in the current folder."""
    return sorted(path.name for path in Path("chapters").glob("*") if path.is_dir())


def import_of_chapter(module: str) -> ModuleType:
    """Import a module of a chapter from the current folder, even if it is not in Python's path."""
    here = str(Path.cwd())
    if not {here, ""} & {*sys.path}:
        sys.path.append(here)
    return import_module(module)


def chapter_files(paper: str, files: Iterable[Path]) -> list[str]:
    """Return the source files that belong to a paper's chapter, as paths relative to the current folder."""
    here = Path.cwd()
    chapter = here / "chapters" / paper
    return sorted(str(file.relative_to(here)) for file in files if file.is_relative_to(chapter))
