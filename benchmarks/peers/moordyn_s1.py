"""Scene S1 with its top held, in MoorDyn: the line of S2c, stepped until drag has brought it to rest.

MoorDyn's own stationary solver ends with a straight line, since it knows no current.
"""

from __future__ import annotations

import tempfile
import time
from importlib import metadata
from pathlib import Path
from typing import Any

import current
import numpy as np
from scene import BENDING_STIFFNESS, LENGTH

from peers import moordyn_s2c
from peers.moordyn_s2c import BOTTOM, DAMPING_RATIO, SCHEME, deck, quiet

LADDER = [
    (10, 0.02, {"duration": 40.0}),
    (19, 0.01, {"duration": 50.0}),
    (42, 0.005, {"duration": 75.0}),
    (99, 0.002, {"duration": 100.0}),
]
CALL = 0.5  # s between calls
available = moordyn_s2c.available


def run(elements: int, step: float, duration: float) -> dict[str, Any]:
    """The equilibrium on uniform elements; moments come without their sign."""
    import moordyn

    text = deck(elements, step, SCHEME, DAMPING_RATIO, current.HEIGHT, "1 Currents\n")
    profile = "current\nof scene S1\nz ux uy uz\n" + "".join(
        f"{BOTTOM + z:.12g} {speed:.12g} 0 0\n"
        for z, speed in ((0.0, 0.0), (LENGTH, current.SURFACE_SPEED), (-BOTTOM, current.SURFACE_SPEED))
    )
    with tempfile.TemporaryDirectory() as folder, quiet():
        path = Path(folder, "s1.txt")
        path.write_text(text)
        Path(folder, "current_profile.txt").write_text(profile)
        system = moordyn.Create(str(path))
        top = [0.0, 0.0, BOTTOM + current.HEIGHT]
        moordyn.Init(system, top, [0.0] * 3)
        started = time.process_time()
        for i in range(round(duration / CALL)):
            moordyn.Step(system, top, [0.0] * 3, i * CALL, CALL)
        seconds = time.process_time() - started
        line = moordyn.GetLine(system, 1)
        x = np.array([moordyn.GetLineNodePos(line, j)[0] for j in range(elements + 1)])
        bent = np.array([moordyn.GetLineNodeCurv(line, j) for j in range(elements + 1)])
        moordyn.Close(system)
    s = np.linspace(0.0, LENGTH, elements + 1)
    return {
        "s": s,
        "x": x,
        "moment_s": s,
        "moment": BENDING_STIFFNESS * bent,
        "seconds": seconds,
        "meta": {
            "scheme": f"{SCHEME} for {duration:g} s",
            "step": step,
            "version": metadata.version("moordyn"),
            "failed": False,
        },
    }
