"""Find the keys that a part of an input file may have, to correct the spelling of an unknown key."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import get_close_matches
from typing import Any, get_args

from pydantic import BaseModel

UNKNOWN_KEY = "correct its spelling or remove it; `riserstudy schema` prints the allowed keys"


def remedy_for(model: type[BaseModel], place: Sequence[object]) -> str:
    """Return the remedy for an unknown key: the allowed key of similar spelling, if there is one.

    ``place``: fields and indices from the whole data of the model to the unknown key, which is the last.
    """
    key = str(place[-1])
    similar = get_close_matches(key, allowed_keys(model, place[:-1]), n=1)
    if not similar:
        return UNKNOWN_KEY
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
