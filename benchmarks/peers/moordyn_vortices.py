"""The riser of ``config/scenes/bench/vortices.yaml`` in MoorDyn, with its own synchronisation model.

Everything of the scene is represented; the few liberties:

- A line type has one diameter for weight, drag, added mass and lift: coefficients and the frequencies of
  shedding are scaled to give the scene's. The riser lies deeper, since MoorDyn's water ends at z = 0.
- The top is held at the height that riserstudy finds at rest; the scene pulls it with a constant tension.
- Phases begin as MoorDyn has them, and lift acts without a ramp; both are over when statistics begin.
- Lift does not act on the nodes at the ends.
"""

from __future__ import annotations

import tempfile
import time
from importlib import metadata
from pathlib import Path

import numpy as np

from peers.moordyn_s2c import DAMPING_RATIO, SCHEME, available, quiet
from riserstudy.scene.resolve import Resolved

__all__ = ["LADDER", "available", "run", "version"]

LADDER = [(60, 0.0025), (120, 0.00125)]  # segments and steps (s)
Arrays = dict[str, np.ndarray]


def version() -> str:
    """Of the peer."""
    return f"MoorDyn {metadata.version('moordyn')}"


def deck(scene: Resolved, elements: int, step: float, height: float) -> str:
    """The input file; the top at a height (m) over the bottom."""
    section, water = scene.riser[0], scene.water
    volume = section.mass - section.submerged_weight / scene.gravity  # of water, kg/m
    diameter = np.sqrt(4.0 * volume / (np.pi * water.density))
    scale = diameter / section.viv.diameter
    drag = section.drag.coefficient * section.drag.diameter / diameter
    added = section.added_mass.coefficient * (section.added_mass.diameter / diameter) ** 2
    low, free, high = section.viv.frequencies
    if not np.isclose(high - free, free - low):
        raise ValueError("MoorDyn's range of frequencies is even about the free one")
    return f"""--- MoorDyn ---
vortices
--- LINE TYPES ---
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx Cl dF cF
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-) (-) (-) (-)
riser {diameter:.12g} {section.mass} {section.axial_stiffness} {-DAMPING_RATIO} \
{section.bending_stiffness} {drag:.12g} {added:.12g} 0.0 0.0 {section.viv.coefficient / scale:.12g} \
{scale * (high - free):.12g} {scale * free:.12g}
--- POINTS ---
ID Attachment X Y Z Mass Volume CdA Ca
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed 0.0 0.0 {-water.surface} 0 0 0 0
2 Coupled 0.0 0.0 {height - water.surface:.12g} 0 0 0 0
--- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
1 riser 1 2 {section.length} {elements} -
--- OPTIONS ---
0 writeLog
1 disableOutput
{step:.12g} dtM
{SCHEME} tScheme
{scene.gravity} g
{water.density} rho
{water.surface + 1.0} WtrDpth
1e-5 threshIC
1 Currents
--- need this line ---
"""


def current(scene: Resolved) -> str:
    """The file of the current, held above the riser."""
    places = [(point.elevation, point.speed) for point in scene.current.profile]
    places.append((scene.water.surface, places[-1][1]))
    rows = "".join(f"{z - scene.water.surface:.12g} {u:.12g} 0 0\n" for z, u in places)
    return f"current\nof the benchmark\nz ux uy uz\n{rows}"


def run(scene: Resolved, elements: int, step: float, height: float) -> tuple[Arrays, float]:
    """Histories at the outputs and nodes, and the processor time of stepping (s).

    Parameters
    ----------
    height : of the top over the bottom (m).
    """
    import moordyn

    interval, length = scene.analysis.output.interval, scene.riser[0].length
    count = round(scene.analysis.duration / interval)
    x, y = np.zeros((2, count + 1, elements + 1))
    top = [0.0, 0.0, height - scene.water.surface]
    with tempfile.TemporaryDirectory() as folder, quiet():
        Path(folder, "riser.txt").write_text(deck(scene, elements, step, height))
        Path(folder, "current_profile.txt").write_text(current(scene))
        system = moordyn.Create(str(Path(folder, "riser.txt")))
        moordyn.Init(system, top, [0.0] * 3)
        line = moordyn.GetLine(system, 1)
        started = time.process_time()
        for i in range(count):
            moordyn.Step(system, top, [0.0] * 3, i * interval, interval)
            for j in range(elements + 1):
                x[i + 1, j], y[i + 1, j], _ = moordyn.GetLineNodePos(line, j)
        seconds = time.process_time() - started
        moordyn.Close(system)
    nodes = np.linspace(0.0, length, elements + 1)
    return {"time": interval * np.arange(count + 1), "x": x, "y": y, "s": nodes}, seconds
