"""Figures with what they are linked to: claims, scenes, datasets, files and the command that draws them."""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from PIL import Image

from riserstudy.report.claims import Claim

_PRINTED = re.compile(r"fig0*(\d+)")
_NUMBERS = re.compile(r"(?<![\w.])(\d+)[a-z]?(?: to (\d+))?")
COLOURS = 192  # of a figure on the page, chosen so that none is far from what it was
SMALL = 420  # pixels across, of a picture beside words


class Picture(NamedTuple):
    """An image as the page holds it."""

    address: str
    width: int
    height: int
    title: str  # that it carries, "" where none
    alt: str


class Figure(NamedTuple):
    """One figure of a chapter."""

    paper: str
    name: str
    heading: str
    caption: str
    picture: Picture
    files: list[tuple[str, str]]  # what a file is, and its path beside the page
    reads: list[tuple[str, str]]  # datasets and their paths
    claims: list[Claim]
    scenes: list[tuple[str, str]]  # title and anchor
    command: str

    @property
    def anchor(self) -> str:
        """Where it stands on the page."""
        return f"{self.paper}-{self.name}"


def picture_of(path: Path, across: int | None = None) -> Picture:
    """A PNG, with the words that it carries, as a smaller image for the page."""
    with Image.open(path) as image:
        said = {str(key): str(value) for key, value in getattr(image, "text", {}).items()}
        plain = Image.new("RGB", image.size, "white")
        plain.paste(image, mask=image.getchannel("A") if image.mode == "RGBA" else None)
    if across and plain.width > across:
        plain = plain.resize((across, round(plain.height * across / plain.width)))
    coverage = Image.Quantize.MAXCOVERAGE
    few = plain.quantize(COLOURS, method=coverage, dither=Image.Dither.NONE).convert("RGB")
    shown = plain if across else few
    data = io.BytesIO()
    shown.save(data, "WEBP", lossless=not across, quality=80, method=4)
    address = "data:image/webp;base64," + base64.b64encode(data.getvalue()).decode()
    return Picture(
        address, plain.width, plain.height, said.get("Title", ""), said.get("Description", "")
    )


def heading(name: str, title: str) -> str:
    """How a figure is headed: by its number in the paper and what it says, else by its name."""
    printed = _PRINTED.fullmatch(name)
    if title and not printed:
        return title  # the name is that of a file
    plain = f"Figure {printed[1]}" if printed else name.replace("_", " ").capitalize()
    return f"{plain}: {title}" if title else plain


def belongs(claim: Claim, name: str) -> bool:
    """Whether a claim is about a printed figure."""
    printed = _PRINTED.fullmatch(name)
    named = [(int(low), int(high or low)) for low, high in _NUMBERS.findall(claim.figure)]
    return printed is not None and any(low <= int(printed[1]) <= high for low, high in named)


def claims_by_figure(
    claims: Iterable[Claim],
    names: list[str],
    rests: dict[tuple[str, ...], set[str]],
    reads: dict[str, set[str]],
) -> dict[str, list[Claim]]:
    """Claims of each figure of a chapter: those that name it, else those that rest on what it shows.

    A figure that the paper does not print has, besides, those that rest on all that it shows.

    Parameters
    ----------
    rests : datasets by paper and id of a claim.
    reads : datasets by figure.
    """
    claims_of: dict[str, list[Claim]] = {name: [] for name in names}
    for claim in claims:
        behind = rests.get((claim.paper, claim.id), set())
        own = [name for name in names if belongs(claim, name)]
        if own:
            added = [name for name in names if not _PRINTED.fullmatch(name)]
            own += [name for name in added if reads.get(name) and reads[name] <= behind]
        else:
            own = [name for name in names if behind & reads.get(name, set())]
        for name in own:
            claims_of[name].append(claim)
    return claims_of
