"""From a YAML file to a checked scene: read safely, separate the origins, apply overrides, validate."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from riserstudy.errors import InputError
from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.unknown_key import REMEDY
from riserstudy.inputs.validate import check
from riserstudy.scene import paths
from riserstudy.scene.error_source import attribute_error, is_known
from riserstudy.scene.models import Scene
from riserstudy.scene.origin import Origin, unwrap
from riserstudy.scene.replaced_values import replaced
from riserstudy.scene.resolve import Resolved, resolve
from riserstudy.scene.tables import files_of_tables, fill_in_tables, names_of_tables


@dataclass(frozen=True)
class SceneFile:
    """A scene as written in its file: plain tree of values, origins, and the source.

    ``layers``: names of the layers that override values of the file, by path of the value. ``held``: texts of
    the tables by name, if the scene comes from a dataset; absent: its tables are files.
    """

    source: str
    tree: dict[str, Any]
    origins: dict[str, Origin] = field(default_factory=dict)
    layers: dict[str, str] = field(default_factory=dict, compare=False)
    held: Mapping[str, str] | None = None

    def with_values(self, overrides: Mapping[str, Any], layer: str) -> SceneFile:
        """A copy with values set by dotted path; errors call the source of these values ``layer``.

        Raises
        ------
        InputError
            When a path does not exist in the scene, an origin is malformed, null is to remove a key that no
            scene can have, or a later value replaces an earlier one.
        """
        if lost := replaced(overrides):
            found = f"{lost[1]!r}, which is set after it, replaces it"
            raise InputError(layer, lost[0], found, "remove one of the two")
        touched = {first_step(path, layer) for path in overrides}
        tree = {k: _copied(v) if k in touched else v for k, v in self.tree.items()}
        origins = dict(self.origins)
        for path, value in overrides.items():
            plain, statuses, faults = unwrap(value, path)
            if faults:
                raise InputError(layer, *faults[0])
            if plain is None and not is_known(path):
                found = "unknown key, which null therefore cannot remove"
                raise InputError(layer, path, found, REMEDY)
            try:
                paths.put(tree, path, plain)
            except LookupError as error:
                found = f"the scene has no item {error.args[0]!r} at this place"
                allowed = "correct the path; items of a list are counted from 0"
                raise InputError(layer, path, found, allowed) from None
            origins = {k: v for k, v in origins.items() if not paths.within(k, path)}
            origins |= statuses
        layers = self.layers | dict.fromkeys(overrides, layer)
        return SceneFile(self.source, tree, origins, layers, self.held)

    @property
    def files(self) -> list[Path]:
        """Files that the scene is read from: the scene file and its tables."""
        tables = names_of_tables(self.tree) if self.held is None else ()
        return [Path(self.source), *(Path(self.source).parent / name for name in tables)]

    @property
    def assumed(self) -> frozenset[str]:
        """Paths of the values that the scene assumes."""
        return frozenset(path for path, of in self.origins.items() if of.status == "assumed")

    @property
    def calibrated(self) -> frozenset[str]:
        """Paths of the values that were fitted to a published value."""
        return frozenset(path for path, of in self.origins.items() if of.status == "calibrated")

    def scene(self) -> Scene:
        """The checked scene as written, in SI units.

        Raises
        ------
        InputError
            With the first fault: its file or layer, its field, the value found and the allowed values.
        """
        folder = Path(self.source).parent
        try:
            return check(Scene, fill_in_tables(self.tree, folder, self.held), self.source)
        except InputError as error:
            if error.where == str(folder):  # the name of a table
                named = InputError(self.source, error.field, error.found, error.allowed)
                raise attribute_error(named, self.layers, {}) from None
            raise self._attributed(error) from None

    def resolved(self) -> Resolved:
        """The checked scene with all derived quantities, such as weights; computed once and kept.

        Raises InputError as ``scene``.
        """
        return self._resolved

    @cached_property
    def _resolved(self) -> Resolved:
        scene = self.scene()
        try:
            return resolve(scene)
        except Misfit as fault:
            error = InputError(self.source, fault.path, fault.found, fault.allowed, fault.also)
            raise self._attributed(error) from None

    def _attributed(self, error: InputError) -> InputError:
        """The error, located at the file that set the wrong value."""
        if error.where != self.source:
            return error
        files = files_of_tables(self.tree, Path(self.source).parent) if self.held is None else ()
        return attribute_error(error, self.layers, {p: str(file) for p, file in files})


def _copied(tree: Any) -> Any:
    """A copy of plain data (five times as fast as ``copy.deepcopy``)."""
    if isinstance(tree, dict):
        return {key: _copied(value) for key, value in tree.items()}
    return [_copied(value) for value in tree] if isinstance(tree, list) else tree


def first_step(path: str, layer: str) -> str:
    """The first name of a path, which is a part of the scene.

    Raises InputError when the text is not a path.
    """
    try:
        return str(paths.steps(path)[0])
    except ValueError as error:
        allowed = "write a path of names and indices, such as riser[0].length"
        found = f"{error.args[0]!r} is neither a name nor an index"
        raise InputError(layer, path, found, allowed) from None


def read_scene(path: str | Path, *, keep: bool = False) -> SceneFile:
    """A scene file with its origins; checked only to be plain YAML. ``keep`` caches the parsed data.

    A link stands for the file that it points to, whose folder has the tables of the scene. Raises InputError
    when the file cannot be read or is not plain YAML, or an origin is malformed.
    """
    data = read_yaml(Path(path), keep=keep)
    if not isinstance(data, dict):
        found = "this is not a scene"
        raise InputError(path, "", found, "write fields, each as 'name: value', such as 'title: my riser'")
    tree, origins, faults = unwrap(data)
    if faults:
        raise InputError(path, *faults[0])
    return SceneFile(_without_link(path), tree, origins)


def _without_link(path: str | Path) -> str:
    """The path of a readable file, or of the file that it points to if it is a symbolic link."""
    if not Path(path).is_symlink():
        return str(path)
    real = Path(path).resolve()
    return str(real) if Path(path).is_absolute() else os.path.relpath(real)


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
        The scene of the file with the overrides, for :func:`simulate` and :func:`sweep`.

    Raises
    ------
    InputError
        With the file, the field, the value found and the allowed values.
    """
    scene = read_scene(path).with_values(overrides, "overrides")
    scene.resolved()
    return scene
