r"""Fatigue damage of the wall over a run: stress round the wall, rainflow counting, the sum of Miner.

.. math:: \sigma(\varphi) = \frac{T_w}{A}
          - \frac{r}{I}\,(\cos\varphi\, M\cdot e_2 - \sin\varphi\, M\cdot e_1),
          \qquad T_w = T_e + p_i A_i - p_o A_o

at places around the wall that rotate with the pipe: e_1 and e_2 are the axes x and y after the smallest
rotation from the vertical to the tangent. If a scene is rotated about the vertical, its damage is therefore
rotated, too. The range of a cycle, with its stress concentration and thickness, lasts N cycles by the S-N
curve, and

.. math:: D = \sum_i \frac{n_i}{N_i},\qquad \dot D = D / T_{sim}

Cycles are counted by the rainflow method. Its residue, which no later load closes, is counted as half cycles,
as in ASTM E1049. Mean stress has no effect, as in curves of welds.

References
----------
Amzallag and others 1994, Standardization of the rainflow counting method for fatigue analysis,
International Journal of Fatigue 16, 287-293; ASTM E1049, Standard practices for cycle counting in fatigue
analysis. The library fatpack counts the cycles.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import fatpack
import numpy as np

from riserstudy.errors import SimulationError
from riserstudy.model.mesh import Mesh
from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.records.numerals import at_most
from riserstudy.scene.fatigue import Detail, Fatigue, SNCurve
from riserstudy.scene.limits import ENDS, place_of
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation import vortex_vibration
from riserstudy.simulation.curve import between_nodes
from riserstudy.simulation.sampling_error import standard_error
from riserstudy.simulation.wall_stress import Wall, nodes_of, pressures, wall_of

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts

YEAR = 365.25 * 86400.0  # s
MEGA = 1e6  # Pa in the unit of S-N curves
NONE = 1e-6  # negligible damage per year, whose errors are ignored: a life of a million years
CUT_OFF = 0.1  # share of damage lost between outputs from which on a run is refused
ORDER = 4.0  # factor by which halving the output interval reduces the loss of damage at peaks


class Cycles(NamedTuple):
    """Stress ranges (Pa) and their counts, 1 or one half, both (n,)."""

    ranges: FloatArray
    counts: FloatArray


def rainflow(stress: FloatArray) -> Cycles:
    """Cycles of a history (times,), Pa: closed cycles, and half cycles of the residue."""
    points = turning_points(stress)
    if len(points) < 2:
        return Cycles(np.empty(0), np.empty(0))
    closed, left = fatpack.find_rainflow_cycles(points.tolist())
    whole = np.abs(closed[:, 1] - closed[:, 0]) if len(closed) else np.empty(0)
    half = np.abs(np.diff(left))
    counts = np.concatenate([np.ones(len(whole)), np.full(len(half), 0.5)])
    return Cycles(np.concatenate([whole, half]), counts)


def turning_points(values: FloatArray) -> FloatArray:
    """First and last of some values (n,), and the local extremes between them, in their unit."""
    moved = np.append(True, np.diff(values) != 0.0)
    steps = values[moved]
    turns = np.diff(steps[:-1]) * np.diff(steps[1:]) < 0.0
    inner = np.concatenate([[True], turns, [True]]) if len(steps) > 1 else np.ones(len(steps), bool)
    return np.asarray(steps[inner])


def damage(cycles: Cycles, curve: SNCurve, concentration: float, thickness: float) -> float:
    """Palmgren and Miner's sum (1) of cycles of nominal stress, for a thickness (m)."""
    ranges = cycles.ranges[cycles.ranges > 0.0]
    if not len(ranges):
        return 0.0
    size = np.log10(ranges * (concentration * curve.times(thickness) / MEGA))
    lines = [a - m * size for m, a in zip(curve.exponents, curve.log_a, strict=True)]
    return float((cycles.counts[cycles.ranges > 0.0] * 10.0 ** -np.max(lines, axis=0)).sum())


def since(scene: Resolved) -> float:
    """Time from which on cycles are counted (s): after all ramps, and after the build-up of vibrations.

    Raises SimulationError when the run ends before this time.
    """
    a = scene.analysis
    if a.duration is None or a.output is None:
        raise TypeError("fatigue without time")  # excluded by the caller
    start = max(a.output.start or 0.0, scene.built_up, vortex_vibration.since(scene) or 0.0)
    if a.duration <= start:
        raise SimulationError(
            f"fatigue: stress cycles are counted after the ramps, from {start:.4g} s, but the run ends at "
            f"{a.duration:.4g} s; give a longer analysis.duration"
        )
    return start


class Part(NamedTuple):
    """A detail on one section: its nodes, and the properties that give its stress."""

    detail: int
    nodes: range
    wall: Wall | None  # None for a stress per moment
    shares: tuple[float, float]  # of tension and moment
    radius: float  # m
    thickness: float  # m


def enter(scene: Resolved, mesh: Mesh, arrays: Arrays, facts: RunFacts) -> None:
    """Add damage per year along the riser, ``damage_rate``, and each detail's largest value to a run.

    The array is (details, angles, nodes), 1/year, NaN at nodes without the detail. Raises SimulationError
    when the run is too short.
    """
    of = scene.fatigue
    if of is None:
        return
    start = since(scene)
    first = int(np.searchsorted(arrays["time"], start))
    time = float(arrays["time"][-1] - arrays["time"][min(first, len(arrays["time"]) - 1)])
    if not time > 0.0:
        raise SimulationError(
            f"fatigue: stress cycles are counted from {start:.4g} s, but fewer than two outputs follow; "
            "give a longer analysis.duration"
        )
    histories = {name: arrays[name][first:] for name in USED if name in arrays}
    sides = _Sides(scene, mesh, histories, of.angles)
    every = [*parts(scene, mesh, of)]
    rates = np.full((len(of.details), of.angles, len(arrays["s_node"])), np.nan)
    for node in range(rates.shape[-1]):
        here = [part for part in every if node in part.nodes]
        for angle in range(of.angles):
            twin = sides.twin(angle)
            found = _at(here, of, sides, node, angle) if twin == angle else rates[:, twin, node]
            rates[:, angle, node] = found * (YEAR / time if twin == angle else 1.0)
    arrays["damage_rate"] = rates
    facts["fatigue"] = []
    by_chance = [0.0]
    for k, detail in enumerate(of.details):
        angle, node = map(int, np.unravel_index(int(np.nanargmax(rates[k])), rates.shape[1:]))
        here = [part for part in every if part.detail == k and node in part.nodes]
        often, seldom = (_at(here, of, sides, node, angle, slice(None, None, step))[k] for step in (1, 2))
        if often > NONE * time / YEAR and "sampling_error" in facts:
            outputs = len(histories["time"])
            each = partial(_of_block, here, of, sides, node, angle, k)
            by_chance.append(float(standard_error(each, outputs).max()) * outputs / often)
        facts["fatigue"].append({
            "detail": detail.name,
            "since": start,
            "time": time,
            "largest_rate": float(rates[k, angle, node]),
            "s": float(arrays["s_node"][node]),
            "angle": 360.0 * angle / of.angles,
            "safety_factor": detail.safety_factor,
            "error_of_outputs": _lost(often, seldom) if rates[k, angle, node] >= NONE else 0.0,
        })  # fmt: skip
    if "sampling_error" in facts:
        facts["sampling_error"]["damage"] = max(by_chance)


def _of_block(
    here: list[Part], of: Fatigue, sides: _Sides, node: int, angle: int, detail: int, block: slice
) -> FloatArray:
    """Damage of a detail at a place by a block of outputs, divided by their number (1)."""
    found = _at(here, of, sides, node, angle, block)[[detail]]
    return np.asarray(found / (block.stop - block.start))


def _at(
    here: list[Part], of: Fatigue, sides: _Sides, node: int, angle: int, which: slice = slice(None)
) -> FloatArray:
    """Damage (1) of all details at a place, by some of the outputs; NaN for details that are not there.

    Where two walls meet, it is the larger damage.
    """
    found = np.full(len(of.details), np.nan)
    counted: dict[Any, Cycles] = {}
    for part in here:
        detail = of.details[part.detail]
        alike = (part.wall, part.shares, part.radius, detail.stress_per_moment)
        if alike not in counted:
            counted[alike] = rainflow(sides.stress(part, detail, node, angle)[which])
        worth = damage(counted[alike], detail.curve.numbers, detail.stress_concentration, part.thickness)
        found[part.detail] = np.fmax(found[part.detail], worth)
    return found


def _lost(often: float, seldom: float) -> float:
    """Share of damage that outputs miss, from the damage by all outputs and by every second output."""
    return abs(often - seldom) / (ORDER - 1.0) / often


def too_large() -> SimulationError:
    """The error for a run whose histories at all nodes do not fit into memory."""
    return SimulationError(
        "fatigue: stress histories at all nodes do not fit into memory; give a longer "
        "analysis.output.interval, fewer segments, or several shorter runs with other seeds"
    )


USED = ("time", "z", "x", "y", "effective_tension", "bending_moment", "mesh_moment")


def parts(scene: Resolved, mesh: Mesh, of: Fatigue) -> Iterator[Part]:
    """The parts of all details, section by section."""
    names = [section.name for section in scene.riser]
    for k, detail in enumerate(of.details):
        where = place_of(detail.at)
        for name in detail.sections(names):
            section = scene.riser[names.index(name)]
            nodes = range(len(mesh.s))[nodes_of(mesh, names.index(name))]
            if where.startswith(ENDS[0]):
                nodes = nodes[:1]
            elif where.startswith(ENDS[1]):
                nodes = nodes[-1:]
            if detail.face is None:
                yield Part(k, nodes, None, (0.0, 1.0), 0.0, detail.thickness or 0.0)
                continue
            wall = wall_of(section)
            radius = wall.outer if detail.face == "outside" else wall.inner
            thickness = detail.thickness or wall.outer - wall.inner
            yield Part(k, nodes, wall, section.pipe_shares, radius, thickness)


class _Sides:
    """Stresses around the wall at nodes, from histories of a run."""

    def __init__(self, scene: Resolved, mesh: Mesh, histories: Arrays, angles: int) -> None:
        self.tension = histories["effective_tension"]
        self.inside, self.outside = pressures(scene, mesh, histories["z"])
        self.angles = angles
        self.components = _components(histories)

    def twin(self, angle: int) -> int:
        """Index of the first place around the wall with the same stress: in a plane, both sides are equal."""
        return angle if self.components[1] is not None else min(angle, self.angles - angle)

    def stress(self, part: Part, detail: Detail, node: int, angle: int) -> FloatArray:
        """History (times,) of the nominal stress of a detail (Pa)."""
        phi = math.tau * angle / self.angles
        first, second = self.components
        bent = math.cos(phi) * first[:, node]
        if second is not None:
            bent = bent - math.sin(phi) * second[:, node]
        if part.wall is None:
            return np.asarray(-(detail.stress_per_moment or 0.0) * bent)
        wall, (axial, bending) = part.wall, part.shares
        own = axial * self.tension[:, node] + math.pi * (
            self.inside[:, node] * wall.inner**2 - self.outside[:, node] * wall.outer**2
        )
        return np.asarray(own / wall.area - bending * bent * (part.radius / wall.second_moment))


def _components(histories: Arrays) -> tuple[FloatArray, FloatArray | None]:
    """Moments about the axes y and x that rotate with the pipe, (times, nodes) each; only one in a plane."""
    if "mesh_moment" not in histories:
        still = np.zeros_like(histories["effective_tension"])
        return histories.get("bending_moment", still), None
    moment = np.moveaxis(histories["mesh_moment"], 1, 0)
    way = np.stack([np.gradient(histories[axis], axis=1) for axis in "xyz"])
    a, b, c = way / np.linalg.norm(way, axis=0)
    mx, my, mz = moment
    # e = v - (t.v) / (1 + t.z) (z + t), for v = x and v = y
    along = (mz + a * mx + b * my + c * mz) / (1.0 + c)
    return my - b * along, mx - a * along


def refuse_coarse(scene: Resolved, facts: RunFacts) -> None:
    """Check that outputs are frequent enough for the peaks of stress.

    Raises SimulationError when outputs miss a tenth of a detail's damage; the message gives the largest
    output interval.
    """
    for row in facts.get("fatigue", []):
        if row["error_of_outputs"] > CUT_OFF and scene.analysis.output:
            interval = scene.analysis.output.interval
            needed = interval * math.sqrt(0.5 * CUT_OFF / row["error_of_outputs"])
            raise SimulationError(
                f"fatigue: outputs every {interval:g} s miss about {100 * row['error_of_outputs']:.0f} % of "
                f"the damage of {row['detail']!r}; give an analysis.output.interval of {at_most(needed, 2)} s"
            )


def apart(coarse: Arrays, fine: Arrays) -> float:
    """Relative difference of the damage of two runs: the largest over all details.

    For each detail, differences at the nodes of the coarse run at all angles, and the difference of the
    largest damage, are divided by the largest damage of the detail.
    """
    low, up = coarse["damage_rate"], fine["damage_rate"]
    found = 0.0
    for one, other in zip(low, up, strict=True):
        most = float(np.nanmax(other))
        if most < NONE:
            continue
        there = between_nodes(fine["s_node"], other, coarse["s_node"])
        off = np.abs(there - one)
        largest = abs(most - float(np.nanmax(one)))
        found = max(found, largest / most, float(np.nanmax(off)) / most)
    return found
