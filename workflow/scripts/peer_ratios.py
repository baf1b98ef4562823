"""Draw the table of ratios of the page on other simulators, so that picture and table agree."""

from __future__ import annotations

import itertools
import re
from pathlib import Path
from typing import NamedTuple

from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, headline, key_below, panels

ROOT = Path(__file__).resolve().parents[2]
PAGE, PICTURE = ROOT / "docs/peers.md", ROOT / "docs/images/peers.png"
MARKS = "sD^o"


class Ratio(NamedTuple):
    """Run time of a simulator divided by riserstudy's at one level of error; None if it is not reached."""

    scene: str
    quantity: str
    level: str
    simulator: str
    times: float | None


def ratios(page: str) -> list[Ratio]:
    """Read every cell of the table; a cell with an em dash or words in place of a number has no ratio."""
    head = re.search(r"^\| +\| level \|(.*)\|$", page, re.M)
    if not head:
        raise LookupError("no table with a column 'level'")
    simulators = [name.strip() for name in head[1].split("|")]
    found = []
    for line in page[head.end() :].strip().splitlines()[1:]:
        if not line.startswith("|"):
            break
        first, level, *cells = (cell.strip() for cell in line.strip("|").split("|"))
        scene, quantity = first.split(", ")
        for simulator, cell in zip(simulators, cells, strict=True):
            number = re.fullmatch(r"[\d.]+", cell)
            times = float(cell) if number else None
            found.append(Ratio(scene, quantity, level, simulator, times))
    return found


def drawing(found: list[Ratio]) -> Figure:
    """Draw the ratios at every level, one row per scene, quantity and level."""
    rows = list(dict.fromkeys((one.scene, one.quantity, one.level) for one in found))
    simulators = list(dict.fromkeys(one.simulator for one in found))
    figure, (ax,) = panels(height=4.6)
    timed = [one for one in found if one.times is not None]
    for colour, mark, simulator in zip(COLOURS, MARKS, simulators, strict=False):
        of = [one for one in timed if one.simulator == simulator]
        places = [rows.index((one.scene, one.quantity, one.level)) for one in of]
        ax.plot([one.times or 0.0 for one in of], places, mark, color=colour, ms=6, label=simulator)
    ax.axvline(1.0, color="black", linewidth=1.2)
    ax.annotate(
        "riserstudy", (1.0, 1.0), xycoords=("data", "axes fraction"), xytext=(0, 3),
        textcoords="offset points", ha="center", fontsize="small",
    )  # fmt: skip
    for k, (row, following) in enumerate(itertools.pairwise(rows)):
        if row[0] != following[0]:
            ax.axhline(k + 0.5, color="0.6", linewidth=0.6)
    ax.set_xscale("log")
    ax.xaxis.set_major_formatter("{x:g}")
    ax.set_yticks(range(len(rows)), [f"{scene} {of}, {level}" for scene, of, level in rows])
    ax.set_ylim(len(rows) - 0.5, -0.5)
    ax.set_xlabel("run time / riserstudy's run time, at equal error")
    key_below(figure, ax, 4)
    faster = [one for one in timed if one.times is not None and one.times < 1.0]
    who = " and ".join(dict.fromkeys(f"the {one.simulator}" for one in faster)) or "none"
    headline(figure, f"At equal error only {who} is faster, in {len(faster)} of {len(timed)} comparisons")
    return figure


if __name__ == "__main__":
    drawing(ratios(PAGE.read_text("utf-8"))).savefig(PICTURE, dpi=110)
