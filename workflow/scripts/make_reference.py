"""Write what is made from the models: reference page and JSON schema of scene files, platforms' tables."""

from __future__ import annotations

import json
from pathlib import Path

from riserstudy.scene.reference import scene_reference
from riserstudy.scene.schema import scene_schema
from riserstudy.semisubmersible import read_units, table

ROOT = Path(__file__).resolve().parents[2]


def made() -> dict[Path, str]:
    """Content of every file."""
    platforms = ROOT / "config/platforms"
    units = read_units(platforms / "semisubmersibles.yaml")
    return {
        **{platforms / f"{name}.csv": table(unit) for name, unit in units.items()},
        ROOT / "docs/scene.md": scene_reference(),
        ROOT / "workflow/schemas/scene.schema.json": json.dumps(scene_schema(), indent=2) + "\n",
    }


if __name__ == "__main__":
    for path, content in made().items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, "utf-8")
