"""config/false_claims/<paper>.yaml: false claims, each derived from a value or claim that a paper publishes.

If the grader accepts one of them, it is wrong. The share that it accepts is its rate of false positives.
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
from riserstudy.grading.words_of_size_file import read_words
from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.strict import Strict
from riserstudy.inputs.validate import check, refuse_other_paper

#: kind of falsification; with the last four, form and content are nearly those of the published claim
How = Literal["opposite", "magnitude", "sign", "factor", "limit", "cases"]
SUBTLE = ("sign", "factor", "limit", "cases")


class Falsified(Strict):
    """A published value or claim with one change that makes it false.

    ``of``: ID of the published value or claim. ``how``: kind of the falsification: the opposite of the whole
    (``opposite``), a value far from the true one (``magnitude``), one wrong ``sign``, a ``factor`` near two,
    a wrong ``limit``, or exchanged ``cases``.

    One or more of the following. ``published`` and ``with`` replace the number and the options. ``check``
    replaces the function; ``with`` then replaces all its options. ``exchanged``: pairs of variables, or of
    arguments of the check, that are exchanged. ``relabelled``: two values of an axis that are exchanged.
    ``reversed``: axes with values in reverse order. ``negated``: variables with the opposite sign.
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
        """Convert pairs in files, which are lists of two."""
        if not isinstance(tree, dict):
            return tree
        pairs: dict[str, Any] = {}
        if isinstance(swapped := tree.get("exchanged"), list):
            pairs["exchanged"] = [_pair(one) for one in swapped]
        if isinstance(swapped := tree.get("relabelled"), dict):
            pairs["relabelled"] = {axis: _pair(one) for axis, one in swapped.items()}
        return tree | pairs

    @model_validator(mode="after")
    def _changes_something(self) -> Self:
        changes = (self.options, self.exchanged, self.relabelled, self.reversed, self.negated)
        if self.published is None and not any(changes):
            raise Misfit(
                "",
                "the false claim changes nothing",
                "give published, with, exchanged, relabelled, reversed or negated",
            )
        return self

    @property
    def subtle(self) -> bool:
        """Whether its form and content are nearly those of the published value or claim."""
        return self.how in SUBTLE

    def item(self, printed: Item) -> Item:
        """The published value or claim with the falsification, and without further cases."""
        options = self.options if self.check else printed.options | self.options
        changed: dict[str, Any] = {
            "id": self.id,
            "statement": self.statement,
            "check": self.check or printed.check,
            "options": options,
            "further_cases": {},
            "note": "",
        }
        if self.published is not None:
            changed["published"] = self.published
        return printed.replaced(**changed)


def _pair(value: object) -> object:
    """A list as a pair; anything else unchanged, so that it is refused."""
    return tuple(value) if isinstance(value, list) else value


class FalseClaims(Strict):
    """All false claims about a paper."""

    paper: str
    claims: list[Falsified] = Field(min_length=1)


def false_claims_path(config: Path, paper: str) -> Path:
    """The file of false claims about a paper."""
    return config / "false_claims" / f"{paper}.yaml"


def read_false_claims(config: Path, paper: str, printed: PublishedFile) -> list[Falsified]:
    """False claims about a paper; empty without a file.

    Raises InputError when the file is invalid, an ID occurs twice, or a claim is not derived from a gradable
    item.
    """
    path = false_claims_path(config, paper)
    if not path.exists():
        return []
    file = check(FalseClaims, read_yaml(path, keep=True), path)
    refuse_other_paper(file.paper, path)
    claims = file.claims
    _refuse_misplaced(path, claims, printed)
    items = {item.id: item for item in printed.items}
    words = cache(partial(read_words, config))
    false = []
    for one in claims:
        false.append(one.replaced(options=looked_up(one.options, printed, words)))
        refuse_check(path, paper, false[-1].item(items[one.of]))
    return false


def _refuse_misplaced(path: Path, claims: Sequence[Falsified], printed: PublishedFile) -> None:
    items = {item.id: item for item in printed.items if item.check}
    seen: set[str] = set()
    for one in claims:
        if one.id in seen or one.id in items:
            raise InputError(path, one.id, "this ID occurs twice", "give each item a different ID")
        seen.add(one.id)
        if one.of not in items:
            allowed = "use one of " + ", ".join(items)
            raise InputError(path, f"{one.id}.of", f"{one.of!r} is not a graded item", allowed)
        if (one.published is not None) and items[one.of].published is None:
            found = f"has no effect, since {one.of} is a claim without a number"
            raise InputError(path, f"{one.id}.published", found, "remove it")
