"""Whose fault it is: the file, layer or table that set what a scene cannot have."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import Any, get_args

from pydantic import BaseModel

from riserstudy.errors import InputError
from riserstudy.scene.models import Scene
from riserstudy.scene.paths import within, without_indices


def blamed(error: InputError, layers: dict[str, str], tables: dict[str, str]) -> InputError:
    """The same fault, told of who set the value, or of the scene together with those who may have.

    Parameters
    ----------
    layers : who set values on top of a scene, by their path.
    tables : files that stand in for values, by their path.
    """
    every = layers | tables
    missing = error.found == "missing"
    above = [path for path in every if within(error.field, path)]
    if above and not (missing and error.field not in above):
        where = every[max(above, key=len)]
    else:
        others = above or _below(error, every) or ([] if error.field else [*layers])
        names = ", ".join(sorted({every[path] for path in others}))
        where = f"{error.where} with {names}" if names else error.where
    return InputError(where, error.field, error.found, error.allowed)


def _below(error: InputError, paths: Iterable[str]) -> list[str]:
    """Paths of what a fault is about as a whole: below its place, or in parts that it speaks of."""
    place = error.field.rpartition(".")[0] if error.found == "missing" else error.field
    if place:
        return [path for path in paths if within(path, place)]
    return [path for path in paths if re.split(r"\W", path)[0] in error.found]


@lru_cache(1024)
def is_known(path: str) -> bool:
    """Whether a scene can have something at a dotted path."""
    models: list[type[BaseModel]] = [Scene]
    for name in without_indices(path).split("."):
        if not models:  # below plain data anything may stand
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
