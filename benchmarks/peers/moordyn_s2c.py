"""The same riser in MoorDyn: lumped masses, explicit Runge-Kutta or fixed-point implicit steps, 3-D.

Everything of the scene is represented; the few liberties:

- A line type has one diameter for weight, drag and added mass: it is the one whose buoyancy leaves the
  scene's weight in water, and the coefficients are scaled to give the scene's drag and added mass. The
  riser lies deeper, since MoorDyn's water ends at z = 0.
- The top moves in straight pieces of ``COUPLING`` seconds, ends exact: MoorDyn extrapolates linearly
  within a coupling step.
- Start: MoorDyn's own stationary solver, whose remaining tension error is ``threshIC``.
- Moments are EI times MoorDyn's curvature, which has no sign; that of the shape is taken.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
import scene

BOTTOM = -600.0
COUPLING = 0.01  # s; at 0.05 s the corners of the path spoil the moments near the top
SCHEME = "RK2"
DAMPING_RATIO = 0.7  # axial, of critical for one segment
LADDER = [(19, 0.01, {}), (42, 0.005, {}), (99, 0.002, {}), (204, 0.00077, {})]


def available() -> str | None:
    """Why this peer cannot run, or None."""
    try:
        import moordyn  # noqa: F401
    except (ImportError, OSError) as error:
        return f"{type(error).__name__}: {error}"
    return None


def deck(
    elements: int, step: float, scheme: str, damping_ratio: float, height: float | None = None, more: str = ""
) -> str:
    """The input file, the top at a height (m) over the bottom."""
    volume = (scene.MASS - scene.WEIGHT / scene.GRAVITY) / scene.WATER_DENSITY
    diameter = np.sqrt(4.0 * volume / np.pi)
    drag = scene.DRAG / (0.5 * scene.WATER_DENSITY * diameter)
    added = scene.ADDED_MASS / (scene.WATER_DENSITY * volume)
    top = BOTTOM + (height or scene.static_height(scene.LENGTH))
    return f"""--- MoorDyn Input File ---
Scene S2c
---------------------- LINE TYPES ----------------------
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
riser {diameter:.12g} {scene.MASS} {scene.AXIAL_STIFFNESS} {-damping_ratio} \
{scene.BENDING_STIFFNESS} {drag:.12g} {added:.12g} 0.0 0.0
---------------------- POINTS ----------------------
ID Attachment X Y Z Mass Volume CdA Ca
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed 0.0 0.0 {BOTTOM} 0 0 0 0
2 Coupled 0.0 0.0 {top:.12g} 0 0 0 0
---------------------- LINES ----------------------
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
1 riser 1 2 {scene.LENGTH} {elements} -
---------------------- OPTIONS ----------------------
0 writeLog
1 disableOutput
{step:.12g} dtM
{scheme} tScheme
{scene.GRAVITY} g
{scene.WATER_DENSITY} rho
1000.0 WtrDpth
1e-5 threshIC
{more}---------------------- need this line ----------------------
"""


@contextmanager
def quiet() -> Iterator[None]:
    """Send what the library writes to standard output nowhere."""
    sys.stdout.flush()
    kept = os.dup(1)
    with Path(os.devnull).open("w") as nowhere:
        os.dup2(nowhere.fileno(), 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)


def run(
    elements: int,
    step: float,
    moments: bool = False,
    scheme: str = SCHEME,
    damping_ratio: float = DAMPING_RATIO,
) -> dict[str, Any]:
    """Simulate S2c with the largest step that is at most ``step`` (s) and divides the coupling step."""
    import moordyn

    substeps = int(np.ceil(COUPLING / step - 1e-9))
    count = round(scene.DURATION / COUPLING)
    times = COUPLING * np.arange(count + 1)
    top = np.zeros((count + 1, 3))
    top[:, 0] = scene.top_motion(times)[0]
    top[:, 2] = BOTTOM + scene.static_height(scene.LENGTH)
    places, speeds = top.tolist(), (np.diff(top, axis=0) / COUPLING).tolist()
    # A hair longer than the fraction, so that rounding leaves no tiny last step.
    text = deck(elements, COUPLING / substeps * (1.0 + 1e-9), scheme, damping_ratio)
    nodes = np.linspace(0.0, scene.LENGTH, elements + 1)
    at_stations = scene.lagrange(nodes, scene.STATIONS).T
    near = np.flatnonzero(at_stations.any(axis=1)).tolist()
    near = list(range(elements + 1)) if moments else near
    every = round(scene.OUTPUT_STEP / COUPLING)
    x = np.zeros((scene.TIMES.size, len(near)))
    moment = np.zeros((scene.TIMES.size, elements + 1))
    with tempfile.TemporaryDirectory() as folder, quiet():
        path = Path(folder, "s2c.txt")
        path.write_text(text)
        system = moordyn.Create(str(path))
        moordyn.Init(system, places[0], [0.0] * 3)
        line = moordyn.GetLine(system, 1)
        started = time.process_time()
        for i in range(count):
            moordyn.Step(system, places[i], speeds[i], times[i], COUPLING)
            if (i + 1) % every == 0:
                row = (i + 1) // every
                x[row] = [moordyn.GetLineNodePos(line, j)[0] for j in near]
                if moments:
                    moment[row] = [moordyn.GetLineNodeCurv(line, j) for j in range(elements + 1)]
        seconds = time.process_time() - started
        moordyn.Close(system)
    all_x, x = x, x @ at_stations[near]
    result = {
        "time": scene.TIMES,
        "x": x,
        "seconds": seconds,
        "meta": {
            "scheme": scheme,
            "step": COUPLING / substeps,
            "version": metadata.version("moordyn"),
            "damping_ratio": damping_ratio,
            "failed": not (np.abs(x) < scene.BOUND).all(),
        },
    }
    if moments:
        moment = scene.signed(moment * scene.BENDING_STIFFNESS, all_x, nodes)
        result |= {"moment": moment, "moment_s": nodes}
    return result
