"""Scene S1 with its top held, in CableDyn: the elements of S2c, the driver's own equilibrium.

Time is that of the driver's process less that of telling its version.
"""

from __future__ import annotations

import tempfile
from importlib import metadata
from pathlib import Path
from typing import Any

import current
import numpy as np
from scene import LENGTH

from peers import cabledyn_s2c
from peers.cabledyn_s2c import BOTTOM, deck, driven

LADDER = [(n, None, {}) for n in (8, 12, 18, 36, 72)]
available = cabledyn_s2c.available


def run(elements: int, step: None) -> dict[str, Any]:
    """The equilibrium on uniform elements; moments come without their sign."""
    from cabledyn import read_output

    low, high = f"{BOTTOM} 0 0 0", f"{BOTTOM + LENGTH} {current.SURFACE_SPEED} 0 0"
    text = deck(elements, 0.1, 0.0, True, 0.8, current.HEIGHT, f"profile {low} {high} current")
    with tempfile.TemporaryDirectory() as name:
        path = Path(name, "s1.dat")
        path.write_text(text)
        seconds = driven(path) - min(driven(Path("--version")) for _ in range(2))
        found = read_output(path.with_suffix(".out"))
    place = range(elements + 1, 0, -1)
    s = np.linspace(0.0, LENGTH, elements + 1)
    return {
        "s": s,
        "x": np.array([found.column(f"L1N{j}px")[0] for j in place]),
        "moment_s": s,
        "moment": np.array([found.column(f"BendMom1N{j}")[0] for j in place]),
        "seconds": seconds,
        "meta": {"scheme": "Newton", "step": None, "version": metadata.version("cabledyn"), "failed": False},
    }
