"""Scene S3 in CableDyn: elements without bending, a free point of the end's mass, generalised-alpha.

The pipe hangs deeper than in the scene, since CableDyn's water ends at z = 0; volumes leave the weights in
water. It runs through the library, since the driver moves no deck with a free point.
"""

from __future__ import annotations

import tempfile
import time
from importlib import metadata
from pathlib import Path
from typing import Any

import heave
import numpy as np
from scipy.interpolate import CubicSpline

from peers import cabledyn_s2c

TOP = -50.0  # elevation of the top (m)
RHO_INF = 0.8
TOLERANCE = 1e-6  # of a Newton correction
# Finer meshes err more: the free point is stepped in turns with the line, and the last segment's share grows.
LADDER = [(4, 0.2, {}), (4, 0.1, {}), (4, 0.05, {}), (6, 0.025, {}), (6, 0.0125, {}), (8, 0.00625, {})]
available = cabledyn_s2c.available


def deck(elements: int, step: float, rho_inf: float) -> str:
    """The input file."""
    diameter = np.sqrt(4.0 * heave.VOLUME / np.pi)
    foot = TOP - heave.LENGTH - heave.stretch(heave.LENGTH)
    return f"""--- CableDyn Input File ---
Scene S3
--- LINE TYPES ---
TypeName Diam MassDenInAir EA BA/-zeta EI Cd_n Cd_t Ca_n Ca_t
(-) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
pipe {diameter:.12g} {heave.MASS} {heave.AXIAL_STIFFNESS} 0.0 0.0 0.0 0.0 0.0 0.0
--- POINTS ---
ID Type X Y Z Mass Vol CdA Ca
(-) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Coupled 0.0 0.0 {TOP} 0 0 0 0
2 Free 0.0 0.0 {foot:.12g} {heave.END_MASS} {heave.END_VOLUME:.12g} {heave.END_AREA} 0
--- LINES ---
ID NodeA NodeB Outputs
(-) (-) (-) (-)
1 1 2 -
--- SECTIONS ---
LineID LineType Length NumSegs
(-) (-) (m) (-)
1 pipe {heave.LENGTH} {elements}
--- OPTIONS ---
{heave.GRAVITY} g
1025.0 rhoW
{step} dtM
1.0 TMax
dynamic_solver {TOLERANCE} 1e-14 30 12 {rho_inf}
--- OUTPUTS ---
FairTen1
Point2pz
--- need this line ---
"""


def height(point: Any) -> float:
    """Elevation of a point (m)."""
    return float(np.ravel(point.position())[2])


def run(elements: int, step: float, rho_inf: float = RHO_INF) -> dict[str, Any]:
    """Simulate S3 with uniform elements and steps (s)."""
    from cabledyn import CableDyn

    steps = round(heave.DURATION / step)
    times = step * np.arange(steps + 1)
    bottom, pull = np.zeros(steps + 1), np.full(steps + 1, heave.STATIC_TOP)
    with tempfile.TemporaryDirectory() as name:
        path = Path(name, "s3.dat")
        path.write_text(deck(elements, step, rho_inf))
        with CableDyn(path) as model:
            q, still, _ = model.get_coupled_motion()
            top = next(k for k in range(0, len(q), 3) if abs(q[k + 2] - TOP) < 1e-6) + 2
            foot = model.point(2)
            bottom[0] = height(foot)
            moved = [np.tile(still, (steps + 1, 1)) for _ in range(3)]
            for array, values in zip(moved, heave.top_motion(times), strict=True):
                array[:, top] = values
            moved[0] += q
            started = time.process_time()
            for i in range(1, steps + 1):
                model.step(step, moved[0][i], moved[1][i], moved[2][i])
                bottom[i], pull[i] = height(foot), abs(model.calc_output()[top])
            seconds = time.process_time() - started
    bottom = CubicSpline(times, bottom - bottom[0])(heave.TIMES)
    return {
        "bottom": bottom,
        "top_tension": CubicSpline(times, pull)(heave.TIMES),
        "seconds": seconds,
        "meta": {
            "scheme": f"generalised-alpha, rho_inf {rho_inf}, tolerance {TOLERANCE}",
            "step": step,
            "version": metadata.version("cabledyn"),
            "failed": not (np.abs(bottom) < heave.BOUND).all(),
        },
    }
