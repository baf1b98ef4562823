"""The error for an unknown key, with the allowed key of similar spelling."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import get_close_matches
from typing import Any, get_args

from pydantic import BaseModel

from riserstudy.errors import InputError

REMEDY = "correct its spelling or remove it; `riserstudy schema` prints the allowed keys"


def unknown_key(source: object, field: str, model: type[BaseModel], place: Sequence[object]) -> InputError:
    """Return the error for an unknown key of a file.

    Parameters
    ----------
    field : path of the key in the file.
    place : fields and indices from the whole data of the model to the unknown key, which is the last.
    """
    return InputError(source, field, "unknown key", _remedy(model, place))


def _remedy(model: type[BaseModel], place: Sequence[object]) -> str:
    """Return the remedy: the allowed key of similar spelling, if there is one."""
    key = str(place[-1])
    similar = get_close_matches(key, allowed_keys(model, place[:-1]), n=1)
    if not similar:
        return REMEDY
    return f"write {similar[0]}, or remove the key; `riserstudy schema` prints the allowed keys"


def allowed_keys(model: type[BaseModel], place: Sequence[object]) -> list[str]:
    """Return the keys of a place; of all its alternatives, where it can have one of several forms."""
    models = [model]
    for step in place:
        fields = [field for each in models for name, field in _fields(each) if name == step]
        if fields:  # other steps are indices, keys of tables or names of alternatives
            models = [each for field in fields for each in _models(field.annotation)]
    return sorted({name for each in models for name, _ in _fields(each)})


def _fields(model: type[BaseModel]) -> Iterator[tuple[str, Any]]:
    for name, field in model.model_fields.items():
        yield field.alias or name, field


def _models(annotation: Any) -> list[type[BaseModel]]:
    """Return the models in an annotation, also those in lists, tables and alternatives."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for part in get_args(annotation) for model in _models(part)]
