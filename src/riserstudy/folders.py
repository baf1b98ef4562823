"""Where caches live, and files that are whole or not there."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

PACKAGE = Path(__file__).parent
CHAPTERS = "riserstudy.chapters"


def cache_folder() -> Path:
    """Folder of point store and compiled kernels: RISERSTUDY_CACHE, or ``.cache`` of the checkout."""
    if moved := os.environ.get("RISERSTUDY_CACHE"):
        return Path(moved)
    checkout = PACKAGE.parents[1]
    return (checkout if (checkout / "pyproject.toml").exists() else Path.cwd()) / ".cache"


def workflow_folder() -> Path:
    """Folder of Snakefile and rules: within the package that a wheel installs, else the checkout."""
    shipped = PACKAGE / "shipped"
    return shipped if shipped.exists() else PACKAGE.parents[1]


def chapter_modules(paper: str, part: str) -> list[str]:
    """Modules of one part of a paper's chapter: ``figures``, ``derived`` or ``claims``.

    A part is a file of that name or a folder of files. The folder ``chapters`` where one works comes
    before the package's.
    """
    for root, package in ((Path("chapters"), "chapters"), (PACKAGE / "chapters", CHAPTERS)):
        place = root / paper / part
        if place.with_suffix(".py").exists():
            return [f"{package}.{paper}.{part}"]
        if place.is_dir():
            names = sorted(path.stem for path in place.glob("*.py") if path.stem != "__init__")
            return [f"{package}.{paper}.{part}.{name}" for name in names]
    return []


def write_whole(target: Path, content: bytes) -> None:
    """Write a file under another name in the same folder, then rename it."""
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
        Path(name).replace(target)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def remembered(name: str, make: Callable[[], Any]) -> Any:
    """Plain data that takes long to make, kept in the cache; the name says all that it depends on."""
    kept = cache_folder() / f"{name}.json"
    with suppress(OSError, ValueError):
        return json.loads(kept.read_text("utf-8"))
    made = make()
    with suppress(OSError):  # where nothing can be kept, it is made each time
        kept.parent.mkdir(parents=True, exist_ok=True)
        write_whole(kept, json.dumps(made).encode())
    return made
