"""Write a tuned mesh, time step and method into the study file, without changing the rest of it."""

from __future__ import annotations

import io
import os
import shutil
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap

from riserstudy.errors import InputError
from riserstudy.folders import whole_file
from riserstudy.inputs.plain_yaml import MOST_BYTES
from riserstudy.inputs.text import read_text
from riserstudy.study.study import Study, scene_file
from riserstudy.study.tune import Tuned


def write_tuned(path: Path, study: Study, tuned: Tuned, about: dict[str, Any]) -> None:
    """Write tuned settings into a study's ``set``, and the record of tuning into its ``tuned``.

    ``about``: fields of ``tuned`` to write. Raises InputError when the file may not be written. Raises
    SimulationError when it cannot be written, as on a full disk. The file is then not changed.
    """
    yaml = _yaml()
    tree = yaml.load(read_text(path, MOST_BYTES))
    entry = tree["studies"][study.name]
    if "set" not in entry:
        entry.insert(list(entry).index("axes"), "set", CommentedMap())
    _put(entry["set"], study, tuned.setting.analysis)
    if "tuned" not in entry:
        entry.insert(list(entry).index("set") + 1, "tuned", None)
    entry["tuned"] = _flow(about)
    text = io.StringIO()
    yaml.dump(tree, text)
    if not os.access(path, os.W_OK):
        raise InputError(path, "", "Permission denied", "make it writable")
    with whole_file(path) as partial:
        partial.write_text(text.getvalue(), "utf-8")
        shutil.copymode(path, partial)


def _put(sets: Any, study: Study, analysis: dict[str, Any]) -> None:
    """Set mesh, step and method at the place of the study's present values: in its analysis, or by path."""
    nested = sets.get("analysis")
    inside = isinstance(nested, dict)
    for name, value in analysis.items():
        # a part of the mesh set by its path would override the whole mesh
        for stale in [p for p in sets if p.startswith(f"analysis.{name}.")]:
            del sets[stale]
        if inside:
            sets.pop(f"analysis.{name}", None)
            nested[name] = _flow(value)
        else:
            sets[f"analysis.{name}"] = _flow(value)
    if inside:
        nested.pop("accuracy", None)
        sets.pop("analysis.accuracy", None)
        return
    sets.pop("analysis.accuracy", None)
    if "accuracy" in (scene_file(study.config / study.model.scene).tree.get("analysis") or {}):
        sets["analysis.accuracy"] = None


def _flow(value: Any) -> Any:
    """Mappings on one line."""
    if not isinstance(value, dict):
        return value
    made = CommentedMap({key: _flow(one) for key, one in value.items()})
    made.fa.set_flow_style()
    return made


def _yaml() -> YAML:
    """A reader and writer that keeps comments, quotes and long lines."""
    yaml = YAML()
    yaml.preserve_quotes, yaml.width = True, 1_000_000
    yaml.indent(mapping=2, sequence=4, offset=2)
    null = "tag:yaml.org,2002:null"
    yaml.representer.add_representer(type(None), lambda r, _: r.represent_scalar(null, "null"))
    return yaml
