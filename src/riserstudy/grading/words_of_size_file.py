"""config/published/words.yaml: meanings of words of size in claims, the same for all papers."""

from __future__ import annotations

from pathlib import Path
from typing import Self

from pydantic import Field, model_validator

from riserstudy.errors import InputError
from riserstudy.grading.word_of_size import Word
from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.percent import Percent
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.strict import Strict
from riserstudy.inputs.validate import check

NAME = "words.yaml"


class WordOfSize(Strict):
    """A bound of a change: ``at_least`` or ``at_most``; ``also``: words with the same bound."""

    at_least: Percent | None = None
    at_most: Percent | None = None
    also: list[str] = Field(default_factory=list)
    because: str

    @model_validator(mode="after")
    def _one_bound(self) -> Self:
        if (self.at_least is None) == (self.at_most is None):
            raise Misfit("", "at_least or at_most is required, not both", "give either at_least or at_most")
        return self


class WordsFile(Strict):
    """Words of size. ``no_difference``: share of the larger of two values below which they do not differ."""

    no_difference: Percent
    because: str
    words: dict[str, WordOfSize]

    @model_validator(mode="after")
    def _each_word_once(self) -> Self:
        names = [name for word, of in self.words.items() for name in (word, *of.also)]
        if twice := sorted({name for name in names if names.count(name) > 1}):
            raise Misfit("", f"the word {twice[0]!r} occurs twice", "define each word once")
        for word, of in self.words.items():
            if of.at_least is not None and of.at_least < self.no_difference:
                raise Misfit(
                    "",
                    f"words.{word}.at_least is smaller than no_difference",
                    f"give at least {self.no_difference:g}",
                )
        return self

    def word(self, name: str) -> Word:
        """A word by its name. Raises InputError when it is not in the table."""
        for first, of in self.words.items():
            if name in (first, *of.also):
                most = of.at_most is not None
                bound = (of.at_most if most else of.at_least) or 0.0
                return Word(name, bound, most, self.no_difference)
        known = sorted(word for first, of in self.words.items() for word in (first, *of.also))
        found = f"the word {name!r} is not defined"
        raise InputError(NAME, "words", found, f"use one of {', '.join(known)}")


def words_path(config: Path) -> Path:
    """The file of the words."""
    return config / "published" / NAME


def read_words(config: Path) -> WordsFile:
    """The table of words. Raises InputError when the table is missing or invalid."""
    path = words_path(config)
    if not path.exists():
        allowed = "create it with no_difference, because and words, as in riserstudy's own file"
        raise InputError(path, "words", "the file of words does not exist", allowed)
    return check(WordsFile, read_yaml(path, keep=True), path)
