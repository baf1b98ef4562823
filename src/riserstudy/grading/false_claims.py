"""config/false_claims/<paper>.yaml: claims that a paper does not make, each made from one that it prints.

A grader that accepts one of them is wrong. How many it accepts is its rate of false positives.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, partial
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import Field, model_validator

from riserstudy.errors import InputError
from riserstudy.grading.models import InWords, Item, Option, PublishedFile
from riserstudy.grading.published import looked_up, refuse_check
from riserstudy.grading.words_file import read_words
from riserstudy.inputs.check import check
from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.strict import Strict

#: what is false of a claim; of the last four it has the form, and nearly the content, of what is printed
How = Literal["opposite", "magnitude", "sign", "factor", "limit", "cases"]
SUBTLE = ("sign", "factor", "limit", "cases")


class Falsified(Strict):
    """A printed number or claim with one thing changed that makes it false.

    ``of``: ID of the number or claim that it is made from. ``how``: what is false of it: the whole turned
    round (``opposite``), a size that is far off (``magnitude``), one ``sign``, a ``factor`` near two, a wrong
    ``limit``, ``cases`` that change places.

    Of the following one or more: ``published`` and ``with`` take the place of the number and the options;
    ``check`` that of the function, and then ``with`` of all its options. ``exchanged``: variables, or
    arguments of the check, that change places, a pair an entry. ``relabelled``: two values of an axis that
    change places. ``reversed``: axes whose values run the other way. ``negated``: variables whose sign is
    changed.
    """

    id: str
    of: str
    how: How
    statement: InWords
    published: float | None = None
    check: str | None = None
    options: dict[str, Option] = Field(default_factory=dict, alias="with")
    exchanged: list[tuple[str, str]] = Field(default_factory=list)
    relabelled: dict[str, tuple[str | float, str | float]] = Field(default_factory=dict)
    reversed: list[str] = Field(default_factory=list)
    negated: list[str] = Field(default_factory=list)

    @model_validator(mode="before")
    @classmethod
    def _pairs(cls, tree: object) -> object:
        """Lists of two as files have them."""
        if not isinstance(tree, dict):
            return tree
        pairs = {
            "exchanged": [tuple(pair) for pair in tree.get("exchanged", [])],
            "relabelled": {name: tuple(pair) for name, pair in tree.get("relabelled", {}).items()},
        }
        return tree | {name: value for name, value in pairs.items() if name in tree}

    @model_validator(mode="after")
    def _changes_something(self) -> Self:
        changes = (self.options, self.exchanged, self.relabelled, self.reversed, self.negated)
        if self.published is None and not any(changes):
            raise Misfit("", "nothing is changed", "name published, with, or what changes places")
        return self

    @property
    def subtle(self) -> bool:
        """Whether it has the form, and nearly the content, of what is printed."""
        return self.how in SUBTLE

    def item(self, printed: Item) -> Item:
        """The printed number or claim with what is false of it; without further cases."""
        options = self.options if self.check else printed.options | self.options
        changed: dict[str, Any] = {
            "id": self.id,
            "statement": self.statement,
            "check": self.check or printed.check,
            "options": options,
            "beside": {},
            "note": "",
        }
        if self.published is not None:
            changed["published"] = self.published
        return printed.model_copy(update=changed)


class FalseClaims(Strict):
    """All false claims about a paper."""

    paper: str
    claims: list[Falsified] = Field(min_length=1)


def false_claims_path(config: Path, paper: str) -> Path:
    """The file of a paper."""
    return config / "false_claims" / f"{paper}.yaml"


def read_false_claims(config: Path, paper: str, printed: PublishedFile) -> list[Falsified]:
    """False claims about a paper; none where there is no file.

    Raises
    ------
    InputError
        When the file cannot be meant, an ID occurs twice, or one is made from nothing that can be graded.
    """
    path = false_claims_path(config, paper)
    if not path.exists():
        return []
    claims = check(FalseClaims, read_yaml(path, keep=True), path).claims
    _refuse_misplaced(path, claims, printed)
    items = {item.id: item for item in printed.items}
    words = cache(partial(read_words, config))
    false = []
    for one in claims:
        false.append(one.model_copy(update={"options": looked_up(one.options, printed, words)}))
        refuse_check(path, paper, false[-1].item(items[one.of]))
    return false


def _refuse_misplaced(path: Path, claims: Sequence[Falsified], printed: PublishedFile) -> None:
    items = {item.id: item for item in printed.items if item.check}
    seen: set[str] = set()
    for one in claims:
        if one.id in seen or one.id in items:
            raise InputError(path, one.id, "occurs twice", "give each ID once")
        seen.add(one.id)
        if one.of not in items:
            allowed = "allowed are " + ", ".join(items)
            raise InputError(path, f"{one.id}.of", f"{one.of!r} is not graded", allowed)
        if (one.published is not None) and items[one.of].published is None:
            found = f"{one.of} is a claim, which has no number"
            raise InputError(path, f"{one.id}.published", found, "leave it out")
