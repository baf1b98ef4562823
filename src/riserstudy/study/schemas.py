"""JSON schemas of scene, study and configuration files, for editors; made from the models."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

from pydantic.json_schema import models_json_schema

from riserstudy.scene.schema import DIALECT, scene_schema
from riserstudy.study.config import Config
from riserstudy.study.measured import models_of
from riserstudy.study.models import StudyFile


def study_schema(papers: Iterable[str] = ()) -> dict[str, Any]:
    """Schema of study files; with the fields of datasets that the chapters of ``papers`` measure."""
    schema = {"$schema": DIALECT, **StudyFile.model_json_schema()}
    definitions = schema["$defs"]
    # fields that a chapter's model adds
    definitions["MeasuredModel"]["additionalProperties"] = True
    rules = [rule for paper in papers if (rule := _measured_rule(paper, definitions))]
    return schema | ({"allOf": rules} if rules else {})


def _measured_rule(paper: str, definitions: dict[str, Any]) -> dict[str, Any]:
    """Schema of the entries below ``measured`` for a paper; its models are added to ``definitions``."""
    models = models_of(paper)
    if not models:
        return {}
    inputs = [(model, "validation") for model in models.values()]
    references, made = models_json_schema(inputs, ref_template=f"#/$defs/{paper}.{{model}}")  # type: ignore[arg-type]
    definitions |= {f"{paper}.{name}": model for name, model in made["$defs"].items()}
    fields = {name: references[model, "validation"] for name, model in models.items()}
    measured = {"properties": fields, "additionalProperties": False}
    return {"if": {"properties": {"paper": {"const": paper}}}, "then": {"properties": {"measured": measured}}}


def config_schema() -> dict[str, Any]:
    """Schema of the configuration."""
    return {"$schema": DIALECT, **Config.model_json_schema()}


def schemas(papers: Iterable[str] = ()) -> dict[str, Callable[[], dict[str, Any]]]:
    """Functions that return each schema as plain data, by the kind of file.

    ``papers``: papers whose chapters may have models of measured datasets.
    """
    study = partial(study_schema, papers)
    return {"scene": scene_schema, "study": study, "config": config_schema}


def schema_files(papers: Iterable[str] = ()) -> dict[str, str]:
    """Content of each schema, by the name of its file; ``papers`` as in `schemas`."""
    return {
        f"{kind}.schema.json": json.dumps(make(), indent=2) + "\n" for kind, make in schemas(papers).items()
    }
