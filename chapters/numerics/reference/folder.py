"""Paths of reference solutions; without numpy, because planning needs them."""

from __future__ import annotations

import re
from pathlib import Path

FOLDER, ENDING = "references", ".nc.gz"


def path_of(config: Path, study: str, case: str) -> Path:
    """Return the file path of the reference solution of a case."""
    name = re.sub(r"[^a-z0-9.]+", "_", case.lower()).strip("_")
    return config / FOLDER / study / f"{name}{ENDING}"


def references(config: Path, study: str) -> list[Path]:
    """Return the file paths of all reference solutions of a study."""
    return sorted((config / FOLDER / study).glob(f"*{ENDING}"))
