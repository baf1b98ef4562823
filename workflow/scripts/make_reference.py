"""Write what is made from the models: the reference page of scene files and their JSON schema."""

from __future__ import annotations

import json
from pathlib import Path

from riserstudy.scene.reference import scene_reference
from riserstudy.scene.schema import scene_schema

ROOT = Path(__file__).resolve().parents[2]


def made() -> dict[Path, str]:
    """Content of every file."""
    return {
        ROOT / "docs/scene.md": scene_reference(),
        ROOT / "workflow/schemas/scene.schema.json": json.dumps(scene_schema(), indent=2) + "\n",
    }


if __name__ == "__main__":
    for path, content in made().items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, "utf-8")
