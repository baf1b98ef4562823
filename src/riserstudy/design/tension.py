r"""Minimum tension of a drilling riser at all of its points, by the formula of API RP 16Q.

.. math:: T_{SRmin} = W_s f_{wt} - B_n f_{bt} + A_i (d_m H_m - d_w H_w),\quad
          T_{min} = \frac{T_{SRmin} N}{R_f \cos\varphi\,(N - n)}

W_s is the submerged weight of the steel above a point, including a body at the tension ring. B_n is the net
lift of the buoyancy modules above it, and A_i the bore. d and H are unit weight and height of the columns of
mud and sea above it. N is the number of tensioner units, and n the number of failed units. If the bore
varies, the columns are summed section by section.

R_f has two conventions. It is the ratio of vertical tension to setting, 0.90 to 0.95, without a fleet angle;
or it is the remaining share after friction, with a separate fleet angle.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from riserstudy.records.arrays import FloatArray
from riserstudy.scene.geometry import span
from riserstudy.scene.pressures import mud_above_the_riser
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import Section


class Tolerances(NamedTuple):
    """Tolerance factors on given weights; 1 for weights that were measured."""

    weight: float  # f_wt, of steel
    buoyancy: float  # f_bt, of modules


class Rig(NamedTuple):
    """Tensioner units, and the reduction from their setting to the vertical tension."""

    units: int
    failed: int
    tension_ratio: float  # R_f
    fleet_angle: float  # rad, of lines from the vertical; 0 if the ratio includes it


class Governing(NamedTuple):
    """The point that governs the minimum tension."""

    tension: float  # T_SRmin (N)
    # lower end of the section with this index; for the number of sections, the riser's upper end
    end: int


class Columns(NamedTuple):
    """Weights and lifts above points of the riser, from the bottom up, each (points,)."""

    elevation: FloatArray  # m
    steel: FloatArray  # submerged weight, with the body at the upper end (N)
    lift: FloatArray  # net lift of modules (N)
    mud: FloatArray  # weight of the mud column in the bore (N)
    water: FloatArray  # weight of a sea-water column in the bore (N)


def carrying_tension(
    steel: ArrayLike, lift: ArrayLike, columns: ArrayLike, tolerances: Tolerances
) -> FloatArray:
    """T_SRmin (N) from weight of steel, lift of modules, and weights of the mud and sea columns (N)."""
    weight = np.asarray(steel) * tolerances.weight - np.asarray(lift) * tolerances.buoyancy
    return np.asarray(weight + np.asarray(columns))


def setting(tension: float, rig: Rig) -> float:
    """Tension setting (N) that gives a vertical tension (N) without the failed units."""
    working = rig.units - rig.failed
    ratio = rig.tension_ratio * math.cos(rig.fleet_angle)
    return tension * rig.units / (ratio * working)


def lacks(scene: Resolved) -> list[str]:
    """Fields that a scene lacks for the minimum tension; empty if it has all.

    Sections below the riser's flex joint are not counted, so they may lack any.
    """
    missing = [] if scene.gravity is not None else ["gravity"]
    if scene.water is None or scene.water.surface is None:
        missing.append("water.surface")
    if span(scene) is None:
        missing.append("bottom.elevation")
    for section in scene.riser_sections:
        missing += _lacks_of(section)
    return missing


def _lacks_of(section: Section) -> list[str]:
    fields = ("buoyancy_lift", "contents")
    return [f"{field} of section {section.name!r}" for field in fields if getattr(section, field) is None]


def columns_above(scene: Resolved) -> Columns:
    """Weights and lifts above the ends of sections.

    Raises ValueError when the scene does not tell it: what it lacks.
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
        # a given submerged weight includes the buoyancy of the bore
        _from_above(net + lift + water) + scene.ring_weight,
        _from_above(lift),
        _from_above(mud) + above,
        _from_above(water),
    )


def needed(scene: Resolved, tolerances: Tolerances) -> FloatArray:
    """T_SRmin (N) at the ends of sections, from the bottom up, (sections + 1,); it is linear between them.

    Below the flex joint, it is NaN from the highest section down that lacks an input. Raises ValueError when
    the scene does not tell it: what it lacks.
    """
    of = columns_above(scene)
    found = carrying_tension(of.steel, of.lift, of.mud - of.water, tolerances)
    unknown = [k for k, section in enumerate(scene.riser) if _lacks_of(section)]
    found[: max(unknown, default=-1) + 1] = math.nan
    return found


def governing(scene: Resolved, tolerances: Tolerances) -> Governing:
    """The largest T_SRmin of the riser, without the stack and conductor below its flex joint.

    Raises ValueError when the scene does not give it: what it lacks.
    """
    first = scene.lowest_riser_section
    along = needed(scene, tolerances)[first:]
    k = int(along.argmax())
    return Governing(float(along[k]), first + k)


def _from_above(values: FloatArray) -> FloatArray:
    """Sums of the values above each end."""
    return np.concatenate([np.cumsum(values[::-1])[::-1], [0.0]])
