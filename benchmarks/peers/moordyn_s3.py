"""Scene S3 in MoorDyn: a line with a free point of the end's mass, explicit Runge-Kutta, 3-D.

The pipe hangs deeper than in the scene, since MoorDyn's water ends at z = 0; volumes leave the weights in
water. The top moves in straight pieces of ``moordyn_s2c.COUPLING`` seconds, ends exact. Internal damping,
which explicit steps need, is a share of critical for one segment.
"""

from __future__ import annotations

import tempfile
import time
from importlib import metadata
from pathlib import Path
from typing import Any

import heave
import numpy as np

from peers import moordyn_s2c
from peers.moordyn_s2c import COUPLING, SCHEME, quiet

TOP = -50.0  # elevation of the top (m)
DAMPING_RATIO = 0.01
LADDER = [(4, 0.01, {}), (8, 0.01, {}), (16, 0.005, {}), (32, 0.0025, {})]
available = moordyn_s2c.available


def deck(elements: int, step: float, scheme: str, damping_ratio: float) -> str:
    """The input file."""
    diameter = np.sqrt(4.0 * heave.VOLUME / np.pi)
    foot = TOP - heave.LENGTH - heave.stretch(heave.LENGTH)
    return f"""--- MoorDyn Input File ---
Scene S3
---------------------- LINE TYPES ----------------------
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
pipe {diameter:.12g} {heave.MASS} {heave.AXIAL_STIFFNESS} {-damping_ratio} 0.0 0.0 0.0 0.0 0.0
---------------------- POINTS ----------------------
ID Attachment X Y Z Mass Volume CdA Ca
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Free 0.0 0.0 {foot:.12g} {heave.END_MASS} {heave.END_VOLUME:.12g} {heave.END_AREA} 0
2 Coupled 0.0 0.0 {TOP} 0 0 0 0
---------------------- LINES ----------------------
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
1 pipe 1 2 {heave.LENGTH} {elements} -
---------------------- OPTIONS ----------------------
0 writeLog
1 disableOutput
{step:.12g} dtM
{scheme} tScheme
{heave.GRAVITY} g
1025.0 rho
4000.0 WtrDpth
1e-6 threshIC
---------------------- need this line ----------------------
"""


def run(
    elements: int, step: float, scheme: str = SCHEME, damping_ratio: float = DAMPING_RATIO
) -> dict[str, Any]:
    """Simulate S3 with the largest step that is at most ``step`` (s) and divides the coupling step."""
    import moordyn

    substeps = int(np.ceil(COUPLING / step - 1e-9))
    count = round(heave.DURATION / COUPLING)
    times = COUPLING * np.arange(count + 1)
    top = np.zeros((count + 1, 3))
    top[:, 2] = TOP + heave.top_motion(times)[0]
    places, speeds = top.tolist(), (np.diff(top, axis=0) / COUPLING).tolist()
    # A hair longer than the fraction, so that rounding leaves no tiny last step.
    text = deck(elements, COUPLING / substeps * (1.0 + 1e-9), scheme, damping_ratio)
    every = round(heave.OUTPUT_STEP / COUPLING)
    bottom, pull = np.zeros(heave.TIMES.size), np.zeros(heave.TIMES.size)
    with tempfile.TemporaryDirectory() as folder, quiet():
        path = Path(folder, "s3.txt")
        path.write_text(text)
        system = moordyn.Create(str(path))
        moordyn.Init(system, places[0], [0.0] * 3)
        line = moordyn.GetLine(system, 1)
        bottom[0] = moordyn.GetLineNodePos(line, 0)[2]
        pull[0] = heave.STATIC_TOP  # forces come with the first step
        started = time.process_time()
        for i in range(count):
            push = moordyn.Step(system, places[i], speeds[i], times[i], COUPLING)
            if (i + 1) % every == 0:
                row = (i + 1) // every
                bottom[row] = moordyn.GetLineNodePos(line, 0)[2]
                pull[row] = -push[2]
        seconds = time.process_time() - started
        moordyn.Close(system)
    bottom -= bottom[0]
    # What moves the half segment at the top is not in the force.
    own = 0.5 * heave.MASS * heave.LENGTH / elements
    pull += own * heave.top_motion(heave.TIMES)[2]
    return {
        "bottom": bottom,
        "top_tension": pull,
        "seconds": seconds,
        "meta": {
            "scheme": scheme,
            "step": COUPLING / substeps,
            "version": metadata.version("moordyn"),
            "failed": not (np.abs(bottom) < heave.BOUND).all(),
        },
    }
