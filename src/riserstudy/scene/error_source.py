"""The file that an error belongs to: the scene, layer or table that set the wrong value."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import Any, get_args

from pydantic import BaseModel

from riserstudy.errors import InputError
from riserstudy.scene.models import Scene
from riserstudy.scene.paths import meets, within, without_indices


def attribute_error(error: InputError, layers: dict[str, str], tables: dict[str, str]) -> InputError:
    """The same error, located at the file that set the value.

    Where this file is not certain, the error names the scene together with all files that may have set it.

    Parameters
    ----------
    layers : names of the layers that override values of the scene, by path.
    tables : files that replace values, by path.
    """
    every = layers | tables
    if error.also:
        return _between(error, every)
    missing = error.found == "missing"
    above = [path for path in every if within(error.field, path)]
    if above and not (missing and error.field not in above):
        where = every[max(above, key=len)]
    else:
        place = error.field.rpartition(".")[0] if missing else error.field
        below = [path for path in every if within(path, place)] if place else []
        where = _together(error, {every[path] for path in above or below or ([] if error.field else layers)})
    return InputError(where, error.field, error.found, error.allowed)


def _between(error: InputError, every: dict[str, str]) -> InputError:
    """An error about several fields, located at the scene together with each file that set one of them."""
    places = (error.field, *error.also)
    files = {file for path, file in every.items() if any(meets(place, path) for place in places)}
    where = _together(error, files)
    return InputError(where, error.field, error.found, error.allowed, error.also)


def _together(error: InputError, files: set[str]) -> str:
    """The scene's file, with the files and layers that set values in it."""
    return f"{error.where} with {', '.join(sorted(files))}" if files else error.where


@lru_cache(1024)
def is_known(path: str) -> bool:
    """Whether a scene can have something at a dotted path."""
    models: list[type[BaseModel]] = [Scene]
    for name in without_indices(path).split("."):
        if not models:  # below plain data, any name is possible
            return True
        kinds = [m.model_fields[name].annotation for m in models if name in m.model_fields]
        if not kinds:
            return False
        models = [model for annotation in kinds for model in _models(annotation)]
    return True


def _models(annotation: Any) -> Iterator[type[BaseModel]]:
    """Models among the alternatives of an annotation."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _models(part)
