"""The same riser in CableDyn: cubic Hermite finite elements, generalised-alpha.

Everything of the scene is represented. A line type has one diameter for weight, drag and added mass:
it is the one whose buoyancy leaves the scene's weight in water, and the coefficients are scaled to
give the scene's drag and added mass. The riser lies deeper, since CableDyn's water ends at z = 0.

Run by the standalone driver, which keeps factors over steps of a smooth motion; through the library
(``CableDyn.step``) the same settings took 1.5 times as long. Its time is that of the process less that
of a run of one step, so that start-up and statics do not count; writing the positions does.
"""

from __future__ import annotations

import resource
import subprocess
import tempfile
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
import scene

BOTTOM = -600.0
RHO_INF = 0.8
TOLERANCE = 1e-3  # of a Newton correction; 1e-2 tells in the displacement, 1e-4 costs 10 % more
# Refining further leaves 0.055 % of the displacement.
LADDER = [
    (6, 0.3, {}),
    (9, 0.2, {}),
    (14, 0.1, {}),
    (36, 0.1, {}),
    (72, 0.1, {}),
    (36, 0.025, {}),
    (72, 0.05, {}),
    (72, 0.025, {}),
]


def available() -> str | None:
    """Why this peer cannot run, or None."""
    try:
        from cabledyn import CableDynDriver

        CableDynDriver().version()
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return None


def deck(
    elements: int,
    step: float,
    duration: float,
    moments: bool,
    rho_inf: float,
    height: float | None = None,
    driven_by: str = "motion.dat motionFile",
) -> str:
    """The input file, the top at a height (m) over the bottom; CableDyn counts nodes from the top."""
    volume = (scene.MASS - scene.WEIGHT / scene.GRAVITY) / scene.WATER_DENSITY
    diameter = np.sqrt(4.0 * volume / np.pi)
    drag = scene.DRAG / (0.5 * scene.WATER_DENSITY * diameter)
    added = scene.ADDED_MASS / (scene.WATER_DENSITY * volume)
    top = BOTTOM + (height or scene.static_height(scene.LENGTH))
    wanted = ["L1N{}px", *(["BendMom1N{}"] if moments else [])]
    channels = "\n".join(name.format(j) for name in wanted for j in range(1, elements + 2))
    return f"""--- CableDyn Input File ---
Scene S2c
--- LINE TYPES ---
TypeName Diam MassDenInAir EA BA/-zeta EI Cd_n Cd_t Ca_n Ca_t
(-) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
riser {diameter:.12g} {scene.MASS} {scene.AXIAL_STIFFNESS} 0.0 {scene.BENDING_STIFFNESS} \
{drag:.12g} 0.0 {added:.12g} 0.0
--- POINTS ---
ID Type X Y Z Mass Vol CdA Ca
(-) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed 0.0 0.0 {BOTTOM} 0 0 0 0
2 Coupled 0.0 0.0 {top:.12g} 0 0 0 0
--- LINES ---
ID NodeA NodeB Outputs
(-) (-) (-) (-)
1 2 1 -
--- SECTIONS ---
LineID LineType Length NumSegs
(-) (-) (m) (-)
1 riser {scene.LENGTH} {elements}
--- OPTIONS ---
{scene.GRAVITY} g
{scene.WATER_DENSITY} rhoW
{step} dtM
{duration:.10g} TMax
{driven_by}
dynamic_solver {TOLERANCE} 1e-14 30 12 {rho_inf}
--- OUTPUTS ---
{channels}
--- need this line ---
"""


def motion(times: np.ndarray) -> str:
    """The motion of the top, one row a step."""
    top = BOTTOM + scene.static_height(scene.LENGTH)
    return "".join(
        f"{t:.10g} 2 {x:.12g} 0 {top:.12g} {v:.12g} 0 0 {a:.12g} 0 0\n"
        for t, x, v, a in zip(times, *scene.top_motion(times), strict=True)
    )


def driven(path: Path) -> float:
    """Processor time (s) of the driver on an input file; results stand beside it."""
    from cabledyn import CableDynDriver

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [CableDynDriver().executable, path, path.with_suffix("")], capture_output=True, text=True
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        said = (done.stderr or done.stdout).strip().splitlines()
        raise RuntimeError(f"CableDyn: {said[-1] if said else done.returncode}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def run(elements: int, step: float, moments: bool = False, rho_inf: float = RHO_INF) -> dict[str, Any]:
    """Simulate S2c with uniform elements and steps (s); CableDyn tells moments without their sign."""
    from cabledyn import read_output

    def process(folder: Path, steps: int) -> float:
        times = step * np.arange(steps + 1)
        path = folder / f"{steps}.dat"
        path.write_text(deck(elements, step, times[-1], moments, rho_inf))
        (folder / "motion.dat").write_text(motion(times))
        return driven(path)

    steps = round(scene.DURATION / step)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        once = min(process(folder, 1) for _ in range(2))
        seconds = process(folder, steps) - once
        history = read_output(folder / f"{steps}.out")
    nodes = np.linspace(0.0, scene.LENGTH, elements + 1)
    place = range(elements + 1, 0, -1)
    all_x = np.column_stack([history.column(f"L1N{j}px") for j in place])
    x = scene.resample(history.time, all_x @ scene.lagrange(nodes, scene.STATIONS).T)
    result = {
        "time": scene.TIMES,
        "x": x,
        "seconds": seconds,
        "meta": {
            "scheme": f"generalised-alpha, rho_inf {rho_inf}, tolerance {TOLERANCE}",
            "step": step,
            "version": metadata.version("cabledyn"),
            "failed": not (np.abs(x) < scene.BOUND).all(),
        },
    }
    if moments:
        moment = np.column_stack([history.column(f"BendMom1N{j}") for j in place])
        result |= {"moment": scene.signed(moment, all_x, nodes), "moment_s": nodes}
    return result
