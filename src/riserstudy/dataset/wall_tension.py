r"""Conversion of wall tension of another program to effective tension, by the pressures of the run's scene.

.. math:: T_e = T_w + p_o A_o - p_i A_i

Pressures are hydrostatic gauge pressures at the elevations of the run.

References
----------
Sparks 1984, The influence of tension, pressure and weight on pipe and riser deformations and stresses,
Journal of Energy Resources Technology 106(1).
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.geometry import levels
from riserstudy.scene.pressures import pressures
from riserstudy.scene.quantities import wall_lacks
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import Section

SAME = 1e-6  # share of the riser's length within which two places are equal


class Added(NamedTuple):
    """The difference of effective and wall tension, and notes on its computation."""

    force: FloatArray  # p_o A_o - p_i A_i (N), in the requested shape; NaN where two walls meet
    notes: list[str]  # a line each
    left_out: tuple[str, ...] = ()  # notes on places without a force, a line each


class Walls:
    """Walls, pressures and elevations of a run.

    Parameters
    ----------
    run : one point, with ``z`` over ``s``, and over ``time`` if it is dynamic.
    scene : scene of this point.
    path, title : file and name of the column, for errors.
    """

    def __init__(self, run: xr.Dataset, scene: Resolved, path: Path, title: str):
        self._scene, self._path, self._title = scene, path, title
        self._ends, self._notes = np.array(scene.borders), list[str]()
        self._time, self._s, self._z = self._elevations(run)

    def over_time(self, place: float, time: FloatArray) -> Added:
        """Force at a place (m from the lower end) at times (s), (n,)."""
        force = self._force(np.array([place]))[..., 0]
        if np.isnan(force).any():
            found = f"two sections with different walls meet at {place:g} m"
            raise self._refused(found, "give a place 1 mm above or below")
        if self._time is not None:
            force = np.interp(time, self._time, force)
        return Added(np.broadcast_to(force, time.shape), self._places_in_words([place]))

    def along(self, places: FloatArray) -> Added:
        """Force at places (m from the lower end), (n,), at the mean elevation over time."""
        force = self._force(places)
        notes = self._places_in_words(list(places))
        if self._time is not None:
            spread = 0.5 * float(np.nanmax(np.ptp(force, axis=0)))
            notes.append(
                f"pressures along the riser are those at its mean elevation; over time they differ by up to "
                f"{1e-3 * spread:.3g} kN"
            )
            force = force.mean(axis=0)
        met = places[np.isnan(force)]
        left_out = (f"left out where walls of two sections meet: {_list(met)} m",) if len(met) else ()
        return Added(force, notes, left_out)

    def _elevations(self, run: xr.Dataset) -> tuple[FloatArray | None, FloatArray, FloatArray]:
        """Times (s; None if static), stations (m), and elevations (m), (time, station) or (station,)."""
        low = levels(self._scene, 0)
        if "z" in run and "s" in run["z"].dims:
            z = run["z"].transpose(..., "s")
            time = run["time"].values.astype(float) if "time" in z.dims else None
            return time, run["s"].values.astype(float), z.values.astype(float)
        if low is None:
            found = "the run has no elevations, from which pressures are computed"
            raise self._refused(found, "compare effective_tension instead")
        self._notes.append("the run has no elevations, so those of the unstretched riser are used")
        return None, self._ends, low[0] + self._ends

    def _force(self, places: FloatArray) -> FloatArray:
        """p_o A_o - p_i A_i (N) at places, (..., n)."""
        stations = np.unique(np.concatenate([self._ends, places]))
        filled = [k for k, section in enumerate(self._scene.riser) if section.contents]
        needed = [*places, *(self._ends[[filled[0], filled[-1] + 1]] if filled else [])]
        near = SAME * self._ends[-1]
        if min(needed) < self._s[0] - near or max(needed) > self._s[-1] + near:
            found = f"the run has elevations only from {self._s[0]:g} to {self._s[-1]:g} m"
            allowed = "add stations at the ends of the contents to the scene, or compare effective_tension"
            raise self._refused(found, allowed)
        z = np.apply_along_axis(lambda one: np.interp(stations, self._s, one), -1, self._z)
        at = np.searchsorted(stations, self._ends)
        sections = [slice(at[k], at[k + 1] + 1) for k in range(len(self._scene.riser))]
        inside, outside = pressures(self._scene, sections, z)
        own = np.searchsorted(stations, places)
        areas = np.array([self._areas(place) for place in places])
        force: FloatArray = outside[..., own] * areas[:, 0] - inside[..., own] * areas[:, 1]
        return force

    def _areas(self, place: float) -> tuple[float, float]:
        """Areas of outer and inner circle (m2) at a place; NaN where two walls meet."""
        found = {self._discs(section) for section in self._sections(place)}
        return found.pop() if len(found) == 1 else (math.nan, math.nan)

    def _sections(self, place: float) -> list[Section]:
        near = SAME * self._ends[-1]
        inside = [
            section
            for section, low, high in zip(self._scene.riser, self._ends[:-1], self._ends[1:], strict=True)
            if low - near <= place <= high + near
        ]
        if not inside:
            allowed = f"give a place from 0 m to {self._ends[-1]:g} m"
            raise self._refused(f"{place:g} m is not on the riser", allowed)
        return inside

    def _discs(self, section: Section) -> tuple[float, float]:
        lacks = wall_lacks(self._scene, section)
        if self._scene.water is None:
            lacks.append("water")
        if lacks:
            found = "is wall tension, which cannot be converted to effective tension: the scene lacks "
            found += " and ".join(lacks)
            allowed = "compute T_e = T_w + p_o A_o - p_i A_i yourself, and name the column effective_tension"
            raise self._refused(found, allowed)
        if section.pipe_shares[0] != 1.0:
            found = f"lines of section {section.name!r} carry a part of its wall tension"
            raise self._refused(found, "compare effective_tension instead")
        outer, inner = section.outer_diameter or 0.0, section.inner_diameter or 0.0
        return 0.25 * math.pi * outer**2, 0.25 * math.pi * inner**2

    def _places_in_words(self, places: list[float]) -> list[str]:
        """Notes on the sign convention and on the walls at the places."""
        water = self._scene.water.density if self._scene.water else 0.0
        walls = dict.fromkeys(
            f"{s.name}: {s.outer_diameter:g} by {s.inner_diameter:g} m, contents {s.contents.density:g} kg/m³"
            for place in places
            for s in self._sections(place)
            if s.contents
        )
        return [
            "wall tension is compared as effective tension, T_e = T_w + p_o A_o - p_i A_i, with gauge "
            f"pressures of columns at rest: water {water:g} kg/m³; {'; '.join(walls)}",
            *self._notes,
        ]

    def _refused(self, found: str, allowed: str) -> InputError:
        return InputError(self._path, self._title, found, allowed)


def _list(places: FloatArray) -> str:
    first = ", ".join(f"{place:g}" for place in places[:6])
    return f"{first} and {len(places) - 6} more" if len(places) > 6 else first
