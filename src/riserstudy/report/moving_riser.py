"""A moving riser on the first screen, shown once: a small SVG that needs no library."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from typing import NamedTuple

import numpy as np

from riserstudy.figures.grid import evenly_spaced
from riserstudy.records.arrays import FloatArray
from riserstudy.report.motion import Motion
from riserstudy.schematic.geometry import Geometry

WIDTH, HEIGHT = 300.0, 240.0
SIDE, SKY, BED = 24.0, 40.0, 22.0  # margins at the sides, above and below
FRAMES, NODES = 48, 28  # most frames and nodes that are drawn
STANDS = 0.02  # share of the travel of the top that a fixed lower end may move
SECONDS = 5.0


class MovingRiser(NamedTuple):
    """The picture, its title, and the simulated time that it covers (s)."""

    svg: str
    title: str
    seconds: float
    stretched: float  # factor on horizontal distances, relative to vertical ones


def moving_riser(motions: Iterable[tuple[str, Motion]]) -> tuple[str, MovingRiser] | None:
    """Return chapter and run whose top travels farthest with a fixed lower end; None if there is none."""
    travelled = {
        paper: (_travel(motion.x[:, -1]), motion)
        for paper, motion in motions
        if motion.x.shape[1] > 2 and _travel(motion.x[:, 0]) <= STANDS * _travel(motion.x[:, -1])
    }
    if not travelled:
        return None
    paper = max(travelled, key=lambda one: travelled[one][0])
    return paper, _drawn(travelled[paper][1])


def _travel(x: FloatArray) -> float:
    return float(np.ptp(x))


def _drawn(motion: Motion) -> MovingRiser:
    frames = evenly_spaced(len(motion.time), FRAMES)
    nodes = evenly_spaced(motion.x.shape[1], NODES)
    x, z = motion.x[np.ix_(frames, nodes)], motion.z[np.ix_(frames, nodes)]
    rig_x = x[:, -1] if motion.platform is None else motion.platform[0][frames]
    geometry = Geometry(motion.scene)
    bed = geometry.seabed if geometry.seabed is not None else float(z.min())
    surface = geometry.surface if geometry.surface is not None else float(z[0, -1])
    level = (surface - bed) or 1.0
    low, high = min(float(x.min()), 0.0), max(float(x.max()), float(rig_x.max()))
    across = (WIDTH - 2.0 * SIDE) / ((high - low) or 1.0)
    up = (HEIGHT - SKY - BED) / level

    def place(at: FloatArray, height: FloatArray) -> str:
        return " ".join(
            f"{SIDE + across * (a - low):.1f},{HEIGHT - BED - up * (h - bed):.1f}"
            for a, h in zip(at, height, strict=True)
        )

    shapes = [place(*row) for row in zip(x, np.clip(z, bed, surface + 0.03 * level), strict=True)]
    rig = [f"{SIDE + across * (a - low):.1f} {SKY:.1f}" for a in rig_x]
    play = f'dur="{SECONDS:g}s" fill="freeze" begin="0.6s"'
    moving = f'<animate attributeName="points" {play} values="{";".join(shapes)}"/>'
    carried = (
        f'<animateTransform attributeName="transform" type="translate" {play} values="{";".join(rig)}"/>'
    )
    # on the side of the platform that has room where it ends
    ends_right = across * float(rig_x[-1] - low) > 0.5 * WIDTH - SIDE
    placed = 'x="-30" y="-8" text-anchor="end"' if ends_right else 'x="30" y="-8"'
    label = escape(motion.title)
    svg = f"""<svg viewBox="0 0 {WIDTH:g} {HEIGHT:g}" class="moving-riser" role="img" aria-label="{label}">
<rect class="water" x="0" y="{SKY:g}" width="{WIDTH:g}" height="{HEIGHT - SKY - BED:g}"/>
<rect class="bed" x="0" y="{HEIGHT - BED:g}" width="{WIDTH:g}" height="{BED:g}"/>
<polyline class="rest" points="{shapes[0]}"/>
<polyline class="riser" points="{shapes[-1]}">{moving}</polyline>
<g transform="translate({rig[-1]})">{carried}
<path class="rig" d="M-24-14H24V-6H18V4H10V-6H-10V4H-18V-6H-24ZM-5-14L-2-34H2L5-14Z"/>
<text {placed}>platform</text></g>
<text x="{WIDTH - 6:g}" y="{0.5 * (HEIGHT + SKY - BED):g}" text-anchor="end" class="named">riser</text>
<text x="{WIDTH - 6:g}" y="{HEIGHT - 7:g}" text-anchor="end">seabed, {level:.0f} m deep</text>
</svg>"""
    return MovingRiser(svg, motion.title, float(motion.time[-1] - motion.time[0]), across / up)
