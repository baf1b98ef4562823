"""JSON schemas of scene, study and configuration files, for editors; made from the models."""

from __future__ import annotations

import json
from typing import Any

from riserstudy.scene.schema import DIALECT, scene_schema
from riserstudy.study.config import Config
from riserstudy.study.models import StudyFile


def schemas() -> dict[str, dict[str, Any]]:
    """Each schema as plain data, by the kind of file."""
    return {
        "scene": scene_schema(),
        "study": {"$schema": DIALECT, **StudyFile.model_json_schema()},
        "config": {"$schema": DIALECT, **Config.model_json_schema()},
    }


def schema_files() -> dict[str, str]:
    """Content of each schema, by the name of its file."""
    return {
        f"{kind}.schema.json": json.dumps(schema, indent=2) + "\n"
        for kind, schema in schemas().items()
    }
