"""Figures with their links: claims, scenes, datasets, files and the command that draws them."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from PIL import Image

from riserstudy.figures import HEAD_ROWS
from riserstudy.records.printed_figures import figures_in, number_of
from riserstudy.report.claims import Claim

COLOURS = 192  # of a figure on the page; the palette is chosen for the least change of colours


class Picture(NamedTuple):
    """An image in the form for the page."""

    address: str
    width: int
    height: int
    title: str  # title inside the image, "" without one
    alt: str


class Figure(NamedTuple):
    """One figure of a chapter."""

    paper: str
    name: str
    label: str  # "Chang 2020, Fig. 8"
    heading: str  # label and title
    caption: str
    picture: Picture
    files: list[tuple[str, str]]  # kind of a file, and its path relative to the page
    reads: list[tuple[str, str]]  # datasets and their paths
    claims: list[Claim]
    scenes: list[tuple[str, str]]  # title and anchor
    command: str

    @property
    def anchor(self) -> str:
        """Anchor on the page."""
        return f"{self.paper}-{self.name}"


def picture_of(path: Path) -> Picture:
    """Convert a PNG to a smaller file for the page, and return its texts, too."""
    with Image.open(path) as image:
        texts = {str(key): str(value) for key, value in getattr(image, "text", {}).items()}
        plain = Image.new("RGB", image.size, "white")
        plain.paste(image, mask=image.getchannel("A") if image.mode == "RGBA" else None)
    if (rows := int(texts.get(HEAD_ROWS, 0))) < plain.height:  # the page has the title as its heading
        plain = plain.crop((0, rows, plain.width, plain.height))
    coverage = Image.Quantize.MAXCOVERAGE
    few = plain.quantize(COLOURS, method=coverage, dither=Image.Dither.NONE).convert("RGB")
    data = io.BytesIO()
    few.save(data, "WEBP", lossless=True, quality=80, method=4)
    address = "data:image/webp;base64," + base64.b64encode(data.getvalue()).decode()
    return Picture(address, plain.width, plain.height, texts.get("Title", ""), texts.get("Description", ""))


def labels(names: Iterable[str], short: str, *, printed: bool) -> dict[str, str]:
    """Return the labels of a chapter's figures: the number in the paper; for others of a paper S1, S2, ...

    Parameters
    ----------
    names : names of the figures, in the order of the chapter.
    short : short name of the chapter.
    printed : whether the chapter is about a paper, whose own figures have numbers.
    """
    found, own = {}, 0
    for name in names:
        number = number_of(name)
        if number is not None:
            found[name] = f"{short}, Fig. {number}"
            continue
        own += 1
        found[name] = f"{short}, {'S' if printed else 'Fig. '}{own}"
    return found


def heading(label: str, title: str) -> str:
    """Return the heading of a figure: its label and its title."""
    return f"{label}: {title}" if title else label


def belongs(claim: Claim, name: str) -> bool:
    """Return whether a claim is about a figure that the paper prints."""
    return number_of(name) in figures_in(claim.figure)


def claims_by_figure(
    claims: Iterable[Claim],
    names: list[str],
    rests: Mapping[tuple[str, ...], set[str]],
    reads: Mapping[str, set[str]],
    sources_of: Mapping[tuple[str, ...], set[str]],
    listed: Mapping[str, Sequence[str]],
) -> dict[str, list[Claim]]:
    """Return the claims of each figure of a chapter.

    A claim belongs to the figures that it names. It belongs, too, to figures that the paper does not print
    and that read only datasets that the claim uses. A claim that names no figure belongs to every figure that
    reads one of its datasets. A figure whose entry lists claims has only these. A figure without claims by
    then gets all claims that use one of its datasets. A claim without a figure by then is linked to every
    figure that uses one of the claim's simulated datasets, directly or through derived datasets.

    Parameters
    ----------
    claims : graded numbers and claims.
    names : names of the figures.
    rests : datasets that a claim uses, by paper and id.
    reads : datasets that a figure reads, by its name.
    sources_of : simulated datasets from which a dataset is made, by its name.
    listed : ids of claims by figure, for figures whose entry lists claims.
    """
    graded = list(claims)
    rest = {claim.id: rests.get((claim.paper, claim.id), set()) for claim in graded}
    claims_of: dict[str, list[Claim]] = {name: [] for name in names}
    for claim in graded:
        for name in _strictly(claim, names, rest[claim.id], reads):
            claims_of[name].append(claim)
    for name in names:
        if ids := listed.get(name):
            claims_of[name] = [claim for claim in graded if claim.id in ids]
        elif not claims_of[name]:
            claims_of[name] = [c for c in graded if rest[c.id] & reads.get(name, set())]
    linked = {claim.id for of in claims_of.values() for claim in of}
    for claim in (c for c in graded if c.id not in linked):
        runs = _runs(rest[claim.id], sources_of)
        for name in names:
            if runs & _runs(reads.get(name, set()), sources_of):
                claims_of[name].append(claim)
    return claims_of


def _strictly(claim: Claim, names: list[str], rest: set[str], reads: Mapping[str, set[str]]) -> list[str]:
    """Return the figures that a claim names, and figures not in the paper that show only its datasets."""
    own = [name for name in names if belongs(claim, name)]
    if not own:
        return [name for name in names if rest & reads.get(name, set())]
    added = [name for name in names if number_of(name) is None]
    return own + [name for name in added if reads.get(name) and reads[name] <= rest]


def _runs(datasets: set[str], sources_of: Mapping[tuple[str, ...], set[str]]) -> set[str]:
    return set().union(*(sources_of.get((name,), set()) for name in datasets))
