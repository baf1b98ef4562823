"""Figures with what they are linked to: claims, scenes, datasets, files and the command that draws them."""

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

COLOURS = 192  # of a figure on the page, chosen so that none is far from what it was


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
    label: str  # "Chang 2020, Fig. 8"
    heading: str  # label and what the figure says
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


def picture_of(path: Path) -> Picture:
    """A PNG, with the words that it carries, as a smaller file for the page."""
    with Image.open(path) as image:
        texts = {str(key): str(value) for key, value in getattr(image, "text", {}).items()}
        plain = Image.new("RGB", image.size, "white")
        plain.paste(image, mask=image.getchannel("A") if image.mode == "RGBA" else None)
    if (
        rows := int(texts.get(HEAD_ROWS, 0))
    ) < plain.height:  # the page has the title as its heading
        plain = plain.crop((0, rows, plain.width, plain.height))
    coverage = Image.Quantize.MAXCOVERAGE
    few = plain.quantize(COLOURS, method=coverage, dither=Image.Dither.NONE).convert("RGB")
    data = io.BytesIO()
    few.save(data, "WEBP", lossless=True, quality=80, method=4)
    address = "data:image/webp;base64," + base64.b64encode(data.getvalue()).decode()
    return Picture(
        address, plain.width, plain.height, texts.get("Title", ""), texts.get("Description", "")
    )


def labels(names: Iterable[str], short: str, *, printed: bool) -> dict[str, str]:
    """How figures of a chapter are called: by their number in the paper, others of a paper S1, S2 and so on.

    Parameters
    ----------
    names : of the figures, in the order of the chapter.
    short : the chapter's short name.
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
    """What stands above a figure: its label and what it says."""
    return f"{label}: {title}" if title else label


def belongs(claim: Claim, name: str) -> bool:
    """Whether a claim is about a printed figure."""
    return number_of(name) in figures_in(claim.figure)


def claims_by_figure(
    claims: Iterable[Claim],
    names: list[str],
    rests: Mapping[tuple[str, ...], set[str]],
    reads: Mapping[str, set[str]],
    sources_of: Mapping[tuple[str, ...], set[str]],
    listed: Mapping[str, Sequence[str]],
) -> dict[str, list[Claim]]:
    """Claims of each figure of a chapter: those that name it, else those that rest on what it shows.

    A figure that the paper does not print has, besides, those that rest on all that it shows; where there is
    none, those that rest on some of what it shows. A figure whose entry lists claims has these alone. Claims
    that no figure has by then are linked to those that show something of the runs behind them.

    Parameters
    ----------
    rests : datasets by paper and id of a claim.
    reads : datasets by figure.
    behind : simulated datasets by dataset.
    listed : ids of claims by figure, where its entry lists some.
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


def _strictly(
    claim: Claim, names: list[str], rest: set[str], reads: Mapping[str, set[str]]
) -> list[str]:
    """Figures that a claim names, with added ones that show nothing but what it rests on."""
    own = [name for name in names if belongs(claim, name)]
    if not own:
        return [name for name in names if rest & reads.get(name, set())]
    added = [name for name in names if number_of(name) is None]
    return own + [name for name in added if reads.get(name) and reads[name] <= rest]


def _runs(datasets: set[str], sources_of: Mapping[tuple[str, ...], set[str]]) -> set[str]:
    return set().union(*(sources_of.get((name,), set()) for name in datasets))
