"""From a YAML file to a checked scene: read safely, take origins off, apply overrides, validate."""

from __future__ import annotations

import hashlib
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from riserstudy.digests import digest
from riserstudy.errors import InputError
from riserstudy.folders import remembered
from riserstudy.scene.blame import blamed, is_known
from riserstudy.scene.check import check
from riserstudy.scene.models import Scene
from riserstudy.scene.origin import Origin, unwrap
from riserstudy.scene.tables import files_of_tables, fill_in_tables, names_of_tables
from riserstudy.scene.text import read_text

MOST_BYTES = 1_000_000  # of an input file
DEEPEST = 20  # nesting levels
MANY = 1000  # brackets, which may be nested; the reader's time grows as their square
# What tags, anchors and aliases begin with, where a value may begin.
_SPECIAL = re.compile(r"(?:^|[\s\ufeff,\[{:?-])[!&*]")
_STEP = re.compile(r"[A-Za-z_]\w*(\[\d{1,6}\])*")  # of a dotted path


@dataclass(frozen=True)
class SceneFile:
    """A scene as its file says it: plain tree, origins, and where it came from.

    ``layers``: who set values on top of the file, by their path. ``held``: texts of its tables by name, where
    it comes out of a dataset; absent: its tables are files.
    """

    source: str
    tree: dict[str, Any]
    origins: dict[str, Origin] = field(default_factory=dict)
    layers: dict[str, str] = field(default_factory=dict, compare=False)
    held: Mapping[str, str] | None = None

    def with_values(self, overrides: Mapping[str, Any], layer: str) -> SceneFile:
        """The same with values set by dotted path; ``layer`` names who sets them in errors.

        Raises
        ------
        InputError
            When a path leads nowhere, a value cannot be meant, or what is to be taken out is nothing that a
            scene can have.
        """
        touched = {first_step(path, layer) for path in overrides}
        tree = {k: _copied(v) if k in touched else v for k, v in self.tree.items()}
        origins = dict(self.origins)
        for path, value in overrides.items():
            plain, statuses, faults = unwrap(value, path)
            if faults:
                raise InputError(layer, *faults[0])
            if plain is None and not is_known(path):
                allowed = "see `riserstudy schema` for what is allowed"
                raise InputError(layer, path, "unknown key, which null would take out", allowed)
            _set(tree, path, plain, layer)
            origins = {k: v for k, v in origins.items() if not (k + ".").startswith(path + ".")}
            origins |= statuses
        layers = self.layers | dict.fromkeys(overrides, layer)
        return SceneFile(self.source, tree, origins, layers, self.held)

    @property
    def files(self) -> list[Path]:
        """Files that the scene reads: its own, and its tables."""
        tables = names_of_tables(self.tree) if self.held is None else ()
        return [Path(self.source), *(Path(self.source).parent / name for name in tables)]

    def scene(self) -> Scene:
        """The checked scene, in SI.

        Raises
        ------
        InputError
            With the first fault: the file or layer it is in, its field, what was found and what is allowed.
        """
        folder = Path(self.source).parent
        try:
            return check(Scene, fill_in_tables(self.tree, folder, self.held), self.source)
        except InputError as error:
            if error.where != self.source:
                raise
            files = files_of_tables(self.tree, folder) if self.held is None else ()
            raise blamed(error, self.layers, {p: str(file) for p, file in files}) from None


def _copied(tree: Any) -> Any:
    """A copy of plain data (five times as fast as ``copy.deepcopy``)."""
    if isinstance(tree, dict):
        return {key: _copied(value) for key, value in tree.items()}
    return [_copied(value) for value in tree] if isinstance(tree, list) else tree


def read_yaml(path: Path, *, keep: bool = False) -> Any:
    """A YAML file as plain data. Tags, aliases and duplicate keys are refused; nothing is executed.

    ``keep`` keeps what was read in the cache: reading that again is a hundred times as fast.
    """
    text = read_text(Path(path), MOST_BYTES)
    if not keep:
        return plain_yaml(text, path)
    name = f"yaml/{_reader()}-{hashlib.sha256(text.encode()).hexdigest()}"
    return remembered(name, lambda: plain_yaml(text, path))


@cache
def _reader() -> str:
    """What tells this way of reading from another."""
    return f"{version('ruamel.yaml')}-{digest([Path(__file__)])}"


def plain_yaml(text: str, source: object) -> Any:
    """Plain data of YAML text; ``source`` names it in errors.

    Raises
    ------
    InputError
        When it is not plain YAML: no YAML, tags, anchors, names given twice, or too deep.
    """
    reader = YAML(typ="safe", pure=True)
    reader.allow_duplicate_keys = False
    try:
        if _SPECIAL.search(text) or text.count("[") + text.count("{") > MANY:
            _scan(text, source)  # looking at every token takes as long as reading
        data = reader.load(text)
    except YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f"line {mark.line + 1}" if mark else ""
        problem = getattr(error, "problem", None) or "no YAML"
        raise InputError(source, where, str(problem), "allowed is plain YAML") from None
    except (RecursionError, ValueError) as error:
        raise InputError(source, "", f"cannot be read: {error}"[:200], "simplify it") from None
    fault = plain_fault(data)
    if fault:
        raise InputError(source, *fault)
    return data


def _scan(text: str, source: object) -> None:
    """Refuse what plain YAML has no need of, before anything is built from it."""
    depth = 0
    for token in YAML(typ="safe", pure=True).scan(text):
        kind, place = type(token).__name__, f"line {token.start_mark.line + 1}"
        if kind in ("AliasToken", "AnchorToken", "TagToken"):
            raise InputError(source, place, "a YAML tag, anchor or alias", "write it out")
        depth += kind.endswith("StartToken") - kind.endswith("EndToken")
        if depth > DEEPEST + 1:  # the stream itself counts as one
            raise InputError(source, place, "nested too deeply", f"allowed are {DEEPEST} levels")


def plain_fault(data: Any, path: str = "", depth: int = 0) -> tuple[str, str, str] | None:
    """The first place that is not plain data: path, what is found and what is allowed; None without one."""
    if depth > DEEPEST:
        return path, "nested too deeply", f"allowed are {DEEPEST} levels"
    if isinstance(data, dict):
        for key, value in data.items():
            here = f"{path}.{key}" if path else str(key)
            if not isinstance(key, str):
                return here, f"key {key!r} is no text", "allowed are names as keys"
            if fault := plain_fault(value, here, depth + 1):
                return fault
    elif isinstance(data, list):
        for k, value in enumerate(data):
            if fault := plain_fault(value, f"{path}[{k}]", depth + 1):
                return fault
    elif isinstance(data, float) and not math.isfinite(data):
        return path, repr(data), "allowed are finite numbers"
    elif not isinstance(data, str | int | float | bool | None):
        return path, f"a {type(data).__name__}", "allowed are text, numbers, lists and mappings"
    return None


@lru_cache(1024)
def _steps(path: str, layer: str) -> tuple[str | int, ...]:
    """Names and indices of a dotted path."""
    steps: list[str | int] = []
    for part in path.split("."):
        if not _STEP.fullmatch(part):
            allowed = "allowed are names and indices, as in riser[0].length"
            raise InputError(layer, path, f"{part!r} is no step of a path", allowed)
        name, *indices = part.replace("]", "").split("[")
        steps += [name, *map(int, indices)]
    return tuple(steps)


def first_step(path: str, layer: str) -> str:
    """The part of a scene that a path leads into.

    Raises
    ------
    InputError
        When it is no path.
    """
    return str(_steps(path, layer)[0])


def _set(tree: dict[str, Any], path: str, value: Any, layer: str) -> None:
    """Put a value at a dotted path (``riser[0].length``); null removes what is there."""
    *way, last = _steps(path, layer)
    here: Any = tree
    for step in way:
        if isinstance(here, dict) and step not in here and isinstance(step, str):
            here[step] = {}
        try:
            here = here[step]
        except (KeyError, IndexError, TypeError):
            raise InputError(
                layer, path, f"no {step!r} there", "allowed are paths of the scene"
            ) from None
    try:
        if value is None and isinstance(here, dict):
            here.pop(last, None)
        else:
            here[last] = value
    except (IndexError, TypeError):
        raise InputError(
            layer, path, f"no {last!r} there", "allowed are paths of the scene"
        ) from None


def read_scene(path: str | Path, *, keep: bool = False) -> SceneFile:
    """A scene file with its origins, not yet checked beyond being plain YAML; ``keep`` as above.

    Raises
    ------
    InputError
        When it cannot be read, is not plain YAML, or an origin cannot be meant.
    """
    data = read_yaml(Path(path), keep=keep)
    if not isinstance(data, dict):
        raise InputError(path, "", "no mapping", "a scene starts with names such as 'title:'")
    tree, origins, faults = unwrap(data)
    if faults:
        raise InputError(path, *faults[0])
    return SceneFile(str(path), tree, origins)


def load_scene(path: str | Path, **overrides: Any) -> SceneFile:
    """Read and check a scene file.

    Parameters
    ----------
    path : str or Path
        The YAML file.
    **overrides : dict
        Values by dotted path, given as ``**{"platform.heave.amplitude": "3 m"}``.

    Returns
    -------
    SceneFile
        The scene as its file and the overrides say it, for :func:`simulate` and :func:`sweep`.

    Raises
    ------
    InputError
        With file, field, what was found and what is allowed.
    """
    scene = read_scene(path).with_values(overrides, "overrides")
    scene.scene()
    return scene
