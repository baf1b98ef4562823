"""A small drawing of each effect, as SVG text for a page and the repository: 120 by 120 units, z upwards.

Black: the riser and solid parts; blue: water; orange: the action of the effect; grey: other parts.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from svg_strokes import SIZE, arrow, both_ways, box, dashpot, line, ring, turn, word, zigzag

STYLE = (
    "<style>*{fill:none;stroke-width:2;stroke-linejoin:round;stroke-linecap:round}"
    ".r{stroke:#1b2024;stroke-width:4}.p{stroke:#7b858e}.f{fill:#c3cad0;stroke:#7b858e}"
    ".w{stroke:#0072b2}.s{fill:#0072b2;opacity:.16;stroke:none}.e{stroke:#d55e00}.h{fill:#d55e00;stroke:none}"
    ".b{fill:#0072b2;stroke:none}.g{fill:#8a7a5c;opacity:.45;stroke:none}.d{stroke-dasharray:4 4}"
    "text{fill:#1b2024;stroke:none;font:11px sans-serif}"
    "@media (prefers-color-scheme:dark){.r{stroke:#e4e8ec}text{fill:#e4e8ec}}</style>"
)


def drawing(name: str) -> str:
    """Return the drawing of an effect.

    Raises
    ------
    KeyError
        When the effect has no drawing.
    """
    parts = "".join(_DRAWINGS[name])
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIZE} {SIZE}" role="img">'
        f"<title>{name}</title>{STYLE}{parts}</svg>\n"
    )


def file_of(name: str) -> str:
    """Return the file name of an effect's drawing, without folder."""
    return f"{name.replace(' ', '_')}.svg"


# parts of many drawings

PIPE = line("r", (60, 6), (60, 114))
LEANING = line("r", *((44 + 32 * (t / 20) ** 1.5, 8 + 104 * t / 20) for t in range(21)))
BOWED = line("r", *((46 + 26 * math.sin(math.pi * t / 20), 8 + 104 * t / 20) for t in range(21)))
SEA = box("s", 0, 0, 120, 92) + line("w", (0, 92), (120, 92))
BED = box("g", 0, 0, 120, 14)


def waves(height: float = 7.0, level: float = 88.0) -> str:
    """A water surface with waves."""
    return line("w", *((x, level + height * math.cos(2 * math.pi * x / 80)) for x in range(0, 121, 3)))


def rows(x: float, pairs: Iterable[tuple[float, float]], kind: str = "e") -> str:
    """Horizontal arrows that start at x, from pairs of height and length."""
    return "".join(arrow((x, z), (x + way, z), kind) for z, way in pairs)


def rig(z: float = 92.0) -> str:
    """A platform."""
    return box("f", 20, z, 80, 14)


def cylinder(left: float, low: float, high: float, kind: str = "p") -> str:
    """A cylinder whose rod points downwards."""
    middle = 0.5 * (low + high)
    return box(kind, left - 7, middle, 14, high - middle) + line(kind, (left, middle), (left, low))


HUNG = rig(98) + line("r", (60, 4), (60, 40)) + line("r", (34, 40), (86, 40))
PAIR = HUNG + cylinder(38, 40, 98) + cylinder(82, 40, 98)
ONE = rig(98) + line("r", (60, 4), (60, 36))
LET_GO = BED + box("f", 44, 14, 32, 22)

_DRAWINGS: dict[str, list[str]] = {
    "added mass": [
        SEA,
        PIPE,
        box("s", 46, 20, 28, 60),
        box("e d", 46, 20, 28, 60),
        arrow((76, 50), (104, 50)),
    ],
    "axial damping": [
        line("r", (60, 6), (60, 34)),
        dashpot((60, 34), (60, 86)),
        line("r", (60, 86), (60, 114)),
        both_ways((90, 36), (90, 84)),
    ],
    "axial elasticity": [
        line("r", (60, 6), (60, 30)),
        zigzag((60, 30), (60, 90)),
        line("r", (60, 90), (60, 114)),
        both_ways((90, 36), (90, 84)),
    ],
    "bending": [BOWED, turn(60, 60, 44, 30, 70), turn(60, 60, 44, -30, -70)],
    "bending damping": [BOWED, dashpot((76, 60), (112, 60)), turn(52, 60, 44, 30, 70)],
    "clamp": [
        BED,
        line("r", *((60 + 30 * (t / 20) ** 2, 14 + 92 * t / 20) for t in range(21))),
        box("e", 44, 2, 32, 14),
    ],
    "constant tension": [PIPE, arrow((60, 70), (60, 114)), word("T", 68, 92)],
    "contents": [
        line("p", (46, 6), (46, 114)),
        line("p", (74, 6), (74, 114)),
        box("e", 48, 6, 24, 96),
        *(line("e", (52, z), (68, z)) for z in range(16, 100, 10)),
    ],
    "current": [SEA, PIPE, BED, rows(8, [(84, 44), (68, 38), (52, 31), (36, 23), (22, 14)], "w")],
    "drag": [
        SEA,
        PIPE,
        rows(8, [(76, 30), (52, 30), (28, 30)], "w"),
        rows(68, [(76, 34), (52, 34), (28, 34)]),
    ],
    "draining contents": [
        BED,
        line("p", (46, 40), (46, 114)),
        line("p", (74, 40), (74, 114)),
        box("e", 48, 40, 24, 34),
        arrow((60, 40), (60, 18)),
        arrow((60, 108), (60, 84), "w"),
    ],
    "end mass": [line("r", (60, 50), (60, 114)), box("e", 38, 18, 44, 32), word("M", 54, 30)],
    "end stops": [
        ONE,
        box("p", 46, 62, 28, 36),
        line("p", (60, 36), (60, 74)),
        line("p", (48, 74), (72, 74)),
        box("e", 48, 63, 4, 9),
        box("e", 68, 63, 4, 9),
        box("e", 48, 88, 4, 9),
        box("e", 68, 88, 4, 9),
    ],
    "fading moment": [
        LET_GO,
        line("r", (60, 36), (66, 112)),
        turn(61, 40, 26, 20, 100),
        line("e d", (88, 20), (112, 60)),
    ],
    "first-order motion": [
        waves(5, 60),
        box("f", 26, 56, 68, 22),
        both_ways((60, 82), (60, 116)),
        both_ways((4, 96), (42, 96)),
        turn(96, 92, 14, 200, 20),
    ],
    "flex joint": [
        BED,
        line("r", (60, 14), (60, 40)),
        ring("e", 60, 44, 6),
        line("r", (62, 50), (84, 112)),
        turn(60, 44, 30, 90, 70),
        line("p d", (60, 50), (60, 112)),
    ],
    "foreshortening": [
        BOWED,
        line("p d", (46, 8), (46, 112)),
        arrow((22, 112), (22, 96)),
        line("p d", (10, 112), (40, 112)),
        line("p d", (10, 96), (40, 96)),
    ],
    "gas tensioner": [
        PAIR,
        box("e", 100, 50, 14, 40),
        line("e", (89, 82), (100, 82)),
        arrow((60, 44), (60, 76)),
    ],
    "guide": [
        BED,
        LEANING,
        zigzag((54, 48), (14, 48)),
        zigzag((54, 48), (94, 48)),
        line("p", (14, 38), (14, 58)),
        line("p", (94, 38), (94, 58)),
    ],
    "heading control": [box("f", 38, 22, 44, 70), line("p d", (60, 22), (60, 112)), turn(60, 57, 46, 60, 90)],
    "in-line vortex-induced vibration": [
        SEA,
        ring("r", 40, 52, 12),
        rows(2, [(52, 20)], "w"),
        *(turn(x, z, 9, 0, s) for x, z, s in ((70, 66, 300), (86, 40, -300), (104, 66, 300))),
        both_ways((14, 24), (66, 24)),
    ],
    "inertia": [
        PIPE,
        arrow((66, 60), (104, 60)),
        word("m a", 74, 68),
        *(ring("f", 60, z, 6) for z in (24, 60, 96)),
    ],
    "inner flex joint": [
        line("r", (48, 6), (58, 56)),
        ring("e", 60, 60, 6),
        line("r", (64, 65), (88, 114)),
        turn(60, 60, 30, 64, 40),
    ],
    "lateral force": [PIPE, arrow((66, 108), (108, 108)), word("F", 84, 94)],
    "lateral freedom": [line("p d", (60, 6), (60, 114)), BOWED, both_ways((78, 60), (114, 60))],
    "lift gauge": [
        LET_GO,
        line("r", (60, 62), (60, 114)),
        line("e d", (24, 36), (96, 36)),
        line("e d", (24, 62), (96, 62)),
        both_ways((88, 37), (88, 61)),
    ],
    "line load": [PIPE, rows(14, [(z, 40) for z in range(16, 113, 16)])],
    "linear tensioner": [HUNG, zigzag((38, 40), (38, 98)), zigzag((82, 40), (82, 98))],
    "Munk moment": [
        box("s", 0, 0, 120, 120),
        f'<g transform="rotate(25 60 60)">{box("f", 44, 20, 32, 80)}</g>',
        rows(2, [(96, 26), (24, 26)], "w"),
        turn(60, 60, 48, 20, 70),
    ],
    "piston mass": [
        ONE,
        box("p", 44, 52, 32, 46),
        line("p", (60, 36), (60, 70)),
        box("e", 46, 70, 28, 12),
        word("m", 80, 72),
    ],
    "platform motion": [
        waves(4, 62),
        rig(66),
        LEANING.replace('class="r"', 'class="p"'),
        both_ways((22, 98), (98, 98)),
        both_ways((110, 60), (110, 96)),
    ],
    "platform position": [
        BED,
        rig(98),
        line("r", *((20 + 46 * (t / 20), 14 + 84 * (t / 20)) for t in range(21))),
        line("p d", (20, 14), (20, 98)),
        both_ways((20, 88), (62, 88)),
    ],
    "recoil valve": [
        cylinder(40, 10, 108),
        box("p", 84, 60, 20, 48),
        line("p", (47, 68), (60, 68)),
        line("p", (74, 68), (84, 68)),
        line("e", (60, 76), (74, 60), (74, 76), (60, 60), (60, 76)),
    ],
    "sliding tension": [
        rig(98),
        box("p", 48, 48, 24, 36),
        line("r", (60, 4), (60, 60)),
        line("p", (60, 72), (60, 98)),
        arrow((88, 50), (88, 92)),
        word("T", 96, 64),
    ],
    "soil": [
        box("g", 0, 0, 120, 60),
        line("r", (60, 6), (60, 60)),
        line("r", (60, 60), (70, 114)),
        *(zigzag((16, z), (58, z), turns=4, wide=4) for z in (14, 32, 50)),
        *(zigzag((104, z), (62, z), turns=4, wide=4) for z in (14, 32, 50)),
    ],
    "soil damping": [
        box("g", 0, 0, 120, 60),
        line("r", (60, 6), (60, 60)),
        line("r", (60, 60), (70, 114)),
        *(zigzag((104, z), (62, z), "p", turns=4, wide=4) for z in (14, 32, 50)),
        *(dashpot((16, z), (58, z)) for z in (14, 32, 50)),
    ],
    "stack contact": [
        LET_GO,
        line("r", (60, 52), (60, 114)),
        zigzag((50, 36), (50, 52), turns=2),
        zigzag((70, 36), (70, 52), turns=2),
        arrow((92, 76), (92, 42)),
    ],
    "stress gauge": [PIPE, box("e", 52, 48, 16, 24), line("e", (68, 60), (92, 60)), word("σ", 96, 56)],
    "support": [
        line("r", (60, 26), (60, 114)),
        line("e", (60, 26), (46, 8), (74, 8), (60, 26)),
        line("e", (38, 6), (82, 6)),
    ],
    "tabulated tensioner": [
        line("p", (16, 14), (16, 108)),
        line("p", (16, 14), (110, 14)),
        line("e", (20, 94), (38, 70), (62, 54), (104, 44)),
        *(ring("h", x, z, 3.5) for x, z in ((20, 94), (38, 70), (62, 54), (104, 44))),
    ],
    "tangential drag": [
        SEA,
        PIPE,
        *(arrow((x, 24), (x, 72), "w") for x in (36, 84)),
        arrow((60, 40), (60, 88)),
    ],
    "tension loss": [
        PIPE,
        line("e", (76, 104), (92, 104), (92, 62), (114, 62)),
        arrow((60, 80), (60, 114)),
        word("T(t)", 78, 44),
    ],
    "tensioner cylinders": [HUNG, cylinder(38, 40, 98, "e"), cylinder(82, 40, 98, "e")],
    "tensioner damping": [HUNG, dashpot((38, 40), (38, 98)), dashpot((82, 40), (82, 98))],
    "thrusters": [
        waves(3, 66),
        box("f", 20, 58, 80, 20),
        box("e", 78, 44, 14, 10),
        arrow((76, 49), (44, 49)),
        line("p d", (24, 16), (24, 40)),
        line("p d", (84, 16), (84, 40)),
        both_ways((24, 26), (84, 26)),
    ],
    "torsion": [line("r", (60, 10), (60, 110)), turn(60, 92, 24, 200, 340), turn(60, 28, 24, 160, 20)],
    "two-chamber gas tensioner": [
        ONE,
        box("p", 42, 46, 36, 52),
        line("p", (60, 36), (60, 72)),
        line("p", (44, 72), (76, 72)),
        arrow((68, 50), (68, 70)),
        arrow((52, 94), (52, 74), "w"),
        box("e", 90, 46, 14, 22),
        line("e", (78, 56), (90, 56)),
        box("w", 90, 76, 14, 18),
        line("w", (78, 84), (90, 84)),
    ],
    "vessel": [
        waves(4, 56),
        box("f", 18, 50, 84, 24),
        line("r", (60, 4), (60, 50)),
        both_ways((18, 92), (102, 92)),
        word("M", 54, 57),
    ],
    "vortex-induced vibration": [
        SEA,
        ring("r", 40, 52, 12),
        rows(2, [(52, 20)], "w"),
        *(turn(x, z, 9, 0, s) for x, z, s in ((70, 66, 300), (86, 40, -300), (104, 66, 300))),
        both_ways((40, 18), (40, 88)),
    ],
    "waterline": [
        SEA,
        line("r", (60, 6), (60, 92)),
        line("p", (60, 92), (60, 114)),
        line("e", (36, 92), (84, 92)),
        arrow((16, 110), (48, 94)),
    ],
    "wave": [
        box("s", 0, 0, 120, 84),
        waves(),
        turn(30, 62, 14, 90, -200),
        turn(30, 34, 8, 90, -200),
        turn(88, 62, 14, 90, -200),
        turn(88, 34, 8, 90, -200),
    ],
    "wave force": [
        box("s", 0, 0, 120, 84),
        waves(),
        PIPE,
        arrow((10, 66), (40, 66), "w"),
        arrow((10, 44), (30, 44), "w"),
        arrow((66, 66), (108, 66)),
        arrow((66, 44), (92, 44)),
    ],
    "weight": [PIPE, *(arrow((60, z), (60, z - 26)) for z in (106, 72, 38)), word("w", 72, 58)],
}
