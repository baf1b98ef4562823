"""Write a tuned mesh, time step and method into the study file, without changing the rest of it."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Any

from ruamel.yaml.nodes import MappingNode

from riserstudy.errors import InputError
from riserstudy.files.whole import whole_file
from riserstudy.inputs.plain_yaml import MOST_BYTES
from riserstudy.inputs.text import read_text
from riserstudy.inputs.yaml_edits import Edit, applied, in_braces, in_lines, line_of, pairs_of, tree_of
from riserstudy.study.study import Study, scene_file
from riserstudy.study.tune import Tuned


def write_tuned(path: Path, study: Study, tuned: Tuned, about: dict[str, Any]) -> None:
    """Write tuned settings into a study's ``set``, and the record of tuning into its ``tuned``.

    ``about``: fields of ``tuned`` to write. Raises InputError when the file may not be written. Raises
    SimulationError when it cannot be written, as on a full disk. The file is then not changed.
    """
    text = read_text(path, MOST_BYTES)
    entry = pairs_of(pairs_of(tree_of(text))["studies"].value)[study.name].value
    edits = _edits(text, entry, study, tuned.setting.analysis, line_of("tuned", about))
    if not os.access(path, os.W_OK):
        raise InputError(path, "", "the file is read-only", "allow writing to it")
    with whole_file(path) as partial:
        partial.write_text(applied(text, edits), "utf-8", newline="")
        shutil.copymode(path, partial)


def _edits(text: str, entry: MappingNode, study: Study, analysis: dict[str, Any], record: str) -> list[Edit]:
    """Return the edits of a study's entry. ``record``: line of its ``tuned``, which follows ``set``."""
    held = pairs_of(entry)
    found = held["set"].value if "set" in held else None
    sets = found if isinstance(found, MappingNode) else None
    changes, edits = _of_sets(text, sets, study, analysis)
    if entry.flow_style or (sets and sets.flow_style):
        both = {"set": f"set: {in_braces(text, sets, changes)}", "tuned": record}
        if not entry.flow_style:
            return in_lines(text, entry, both, "set")
        return [Edit(entry.start_mark.index, entry.end_mark.index, in_braces(text, entry, both))]
    if sets:
        edits += in_lines(text, sets, changes)
        return edits + in_lines(text, entry, {"tuned": record}, "set")
    lines = "".join(f"\n  {line}" for line in changes.values() if line is not None)
    above = [*held][: [*held].index("axes")]
    return in_lines(text, entry, {"set": f"set:{lines}", "tuned": record}, above[-1] if above else None)


def _of_sets(
    text: str, sets: MappingNode | None, study: Study, analysis: dict[str, Any]
) -> tuple[dict[str, str | None], list[Edit]]:
    """Return the changes of ``set`` by path, and the edits of an ``analysis`` in lines within it.

    Mesh, step and method are set where the study sets its present values: in its analysis, or by path.
    """
    held = pairs_of(sets) if sets else {}
    # a part of the mesh set by its path would override the whole mesh
    changes: dict[str, str | None] = {
        path: None for path in held if any(path.startswith(f"analysis.{name}.") for name in analysis)
    }
    nested = held["analysis"].value if "analysis" in held else None
    if isinstance(nested, MappingNode):
        changes |= {f"analysis.{name}": None for name in (*analysis, "accuracy")}
        inside = {name: line_of(name, value) for name, value in analysis.items()} | {"accuracy": None}
        if not nested.flow_style:
            return changes, in_lines(text, nested, inside)
        return changes | {"analysis": f"analysis: {in_braces(text, nested, inside)}"}, []
    changes |= {(path := f"analysis.{name}"): line_of(path, value) for name, value in analysis.items()}
    of_scene = scene_file(study.config / study.model.scene).tree.get("analysis") or {}
    changes["analysis.accuracy"] = line_of("analysis.accuracy", None) if "accuracy" in of_scene else None
    return changes, []
