r"""Minimum tension of a drilling riser at all of its points, by the formula of the trade.

.. math:: T_{SRmin} = W_s f_{wt} - B_n f_{bt} + A_i (d_m H_m - d_w H_w),\quad
          T_{min} = \frac{T_{SRmin} N}{R_f \cos\varphi\,(N - n)}

W_s is the weight in water of the steel above a point, with that of a body at the tension ring, B_n what
buoyancy modules above it lift, A_i the bore, d and H unit weight and height of the columns of mud and sea
above it, N the tensioner units and n those that failed. Where the bore changes, columns are counted section
by section.

R_f has two conventions: the vertical tension over the setting, 0.90 to 0.95, and no fleet angle; or
what friction leaves, with the fleet angle apart.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from riserstudy.scene.geometry import span
from riserstudy.scene.pressures import mud_above_the_riser
from riserstudy.scene.resolve import Resolved

FloatArray = NDArray[np.float64]


class Tolerances(NamedTuple):
    """By how much weights differ from those told: 1 where they were weighed."""

    weight: float  # f_wt, of steel
    buoyancy: float  # f_bt, of modules


class Rig(NamedTuple):
    """Tensioner units, and what of their setting pulls the riser up."""

    units: int
    failed: int
    tension_ratio: float  # R_f
    fleet_angle: float  # rad, of lines to the vertical; 0 where the ratio counts it


class Governing(NamedTuple):
    """Where the riser needs most tension."""

    tension: float  # T_SRmin (N)
    end: int  # lower end of the section of this index, the riser's upper end for one more


class Columns(NamedTuple):
    """What hangs above points of the riser, from the bottom up, each (points,)."""

    elevation: FloatArray  # m
    steel: FloatArray  # weight in water, that of the body at the upper end included (N)
    lift: FloatArray  # of modules (N)
    mud: FloatArray  # weight (N)
    water: FloatArray  # weight of the sea's column in the bore (N)


def carrying_tension(
    steel: ArrayLike, lift: ArrayLike, columns: ArrayLike, tolerances: Tolerances
) -> FloatArray:
    """T_SRmin (N) from weight of steel, lift of modules, and mud's column less the sea's (N)."""
    weight = np.asarray(steel) * tolerances.weight - np.asarray(lift) * tolerances.buoyancy
    return np.asarray(weight + np.asarray(columns))


def setting(tension: float, rig: Rig) -> float:
    """Tension setting (N) of which a vertical tension (N) is left with the failed units out."""
    working = rig.units - rig.failed
    ratio = rig.tension_ratio * math.cos(rig.fleet_angle)
    return tension * rig.units / (ratio * working)


def lacks(scene: Resolved) -> list[str]:
    """What a scene lacks for the minimum tension, by its fields; empty where it is all there."""
    missing = [] if scene.gravity is not None else ["gravity"]
    if scene.water is None or scene.water.surface is None:
        missing.append("water.surface")
    if span(scene) is None:
        missing.append("bottom.elevation")
    for section in scene.riser:
        if section.buoyancy_lift is None:
            missing.append(f"buoyancy_lift of section {section.name!r}")
        if section.contents is None:
            missing.append(f"contents of section {section.name!r}")
    return missing


def columns_above(scene: Resolved) -> Columns:
    """What hangs above each section's ends.

    Raises
    ------
    ValueError
        When the scene does not tell it: what it lacks.
    """
    missing, ends = lacks(scene), span(scene)
    if missing or ends is None or scene.water is None or scene.water.surface is None:
        raise ValueError("not evaluated: " + ", ".join(missing))
    gravity = scene.gravity or 0.0
    lengths = np.array([section.total_length for section in scene.riser])
    elevation = ends.bottom + np.concatenate([[0.0], np.cumsum(lengths)])
    wet = np.clip(scene.water.surface - elevation, 0.0, None)
    in_water = wet[:-1] - wet[1:]
    bore = np.array([0.25 * math.pi * (one.inner_diameter or 0.0) ** 2 for one in scene.riser])
    water = scene.water.density * gravity * bore * in_water
    mud = np.array([section.contents_mass for section in scene.riser]) * gravity * lengths
    net = np.array([section.submerged_weight or 0.0 for section in scene.riser]) * lengths
    lift = np.array([section.buoyancy_lift or 0.0 for section in scene.riser]) * lengths
    above = mud_above_the_riser(scene)
    return Columns(
        elevation,
        # a given weight has the bore displace water
        _from_above(net + lift + water) + weight_of_ring(scene),
        _from_above(lift),
        _from_above(mud) + above,
        _from_above(water),
    )


def weight_of_ring(scene: Resolved) -> float:
    """Weight in water (N) of the body at the riser's upper end, such as a tension ring; 0 without one."""
    if scene.top.body is None:
        return 0.0
    return scene.top.body.weight(scene.gravity or 0.0, scene.water.density if scene.water else 0.0)


def needed(scene: Resolved, tolerances: Tolerances) -> FloatArray:
    """T_SRmin (N) at the ends of sections, from the bottom up, (sections + 1,): straight between them.

    Raises
    ------
    ValueError
        When the scene does not tell it: what it lacks.
    """
    of = columns_above(scene)
    return carrying_tension(of.steel, of.lift, of.mud - of.water, tolerances)


def governing(scene: Resolved, tolerances: Tolerances) -> Governing:
    """The largest T_SRmin of the riser itself; stack and conductor below its flex joint stand.

    Raises
    ------
    ValueError
        When the scene does not give it: what it lacks.
    """
    first = scene.lowest_riser_section
    along = needed(scene, tolerances)[first:]
    k = int(along.argmax())
    return Governing(float(along[k]), first + k)


def _from_above(values: FloatArray) -> FloatArray:
    """Sums of what is above each end."""
    return np.concatenate([np.cumsum(values[::-1])[::-1], [0.0]])
