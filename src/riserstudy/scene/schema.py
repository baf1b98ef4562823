"""JSON schema of scene files, for editors: the models, with an origin allowed at every value."""

from __future__ import annotations

from typing import Any

from riserstudy.scene.models import Scene
from riserstudy.scene.origin import COMPANIONS, NEEDED
from riserstudy.scene.tables import PLACES

DIALECT = "https://json-schema.org/draft/2020-12/schema"
TABLE = {
    "type": "object",
    "description": "a CSV table beside the scene file",
    "properties": {"file": {"type": "string"}},
    "required": ["file"],
    "additionalProperties": False,
}


def scene_schema() -> dict[str, Any]:
    """The schema as plain data."""
    schema = Scene.model_json_schema()
    models = schema["$defs"] | {"Scene": schema}
    for model in models.values():
        fields = model.get("properties", {})
        for name, field in fields.items():
            fields[name] = _with_origins(field)
    for place in PLACES:
        fields = models[place.model or place.way[-1].capitalize()]["properties"]
        fields[place.name]["anyOf"].append(TABLE)
    for status in COMPANIONS:
        schema["$defs"][status.capitalize()] = _origin(status)
    return {"$schema": DIALECT, **schema}


def _with_origins(field: dict[str, Any]) -> dict[str, Any]:
    about = {key: value for key, value in field.items() if key in ("title", "default")}
    plain = {key: value for key, value in field.items() if key not in about}
    choices = plain.pop("anyOf", [plain]) if set(plain) <= {"anyOf"} else [plain]
    wrapped = [{"$ref": f"#/$defs/{status.capitalize()}"} for status in COMPANIONS]
    return {"anyOf": [*choices, *wrapped], **about}


def _origin(status: str) -> dict[str, Any]:
    kinds = {"range": {"type": "array", "minItems": 2, "maxItems": 2}, "options": {"type": "array"}}
    companions = {name: kinds.get(name, {"type": "string"}) for name in sorted(COMPANIONS[status])}
    return {
        "type": "object",
        "description": f"a value that is {status}",
        "properties": {status: {}, **companions},
        "required": [status, *NEEDED[status]],
        "additionalProperties": False,
    }
