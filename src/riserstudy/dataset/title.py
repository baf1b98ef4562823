"""Titles of the datasets of a paper: the paper and, for some, the dataset, then the caption."""

from __future__ import annotations


def titled(caption: str, paper: str, name: str = "") -> str:
    """The title of a dataset; ``name``: its name, if the title gives it."""
    return f"{paper} {name}: {caption}" if name else f"{paper}: {caption}"
