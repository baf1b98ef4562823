"""The folder of this package, and that of its workflow."""

from __future__ import annotations

from pathlib import Path

PACKAGE = Path(__file__).parent


def workflow_folder() -> Path:
    """Folder of Snakefile and rules: in an installed package, else in the checkout."""
    shipped = PACKAGE / "shipped"
    return shipped if shipped.exists() else PACKAGE.parents[1]
