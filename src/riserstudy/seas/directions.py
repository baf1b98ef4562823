"""Directions of a record as headings of a scene, evenly round the turn, with rows between two of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.study.in_sea import heading_values

if TYPE_CHECKING:
    import xarray as xr

FloatArray = NDArray[np.float64]
FROM = "wave_from_direction"
FEWEST = 4  # headings between which a response is interpolated: of fewer those in between are nothing alike
CLOSE = 1e-9  # of the way between two headings, within which a row has one of them


class Between(NamedTuple):
    """Headings that the rows of a record lie between."""

    lower: NDArray[np.int64]  # (rows,) number of the heading; -1 where a row has no direction
    share: FloatArray  # (rows,) of the way to the next heading; 0: the row has the lower one

    def weight(self, heading: int, sectors: int) -> FloatArray:
        """What a heading counts in each row, (rows,): those of the two beside a row add up to one."""
        following = (self.lower + 1) % sectors
        own = np.where(self.lower == heading, 1.0 - self.share, 0.0)
        before = np.where((self.lower >= 0) & (following == heading), self.share, 0.0)
        return np.asarray(own + before)

    def inside(self, heading: int) -> NDArray[np.bool_]:
        """Rows between a heading and the next, (rows,), with neither of them."""
        return np.asarray((self.lower == heading) & (self.share > 0.0))


class Directions(NamedTuple):
    """How directions of a record become headings: evenly round the turn, the first along the scene's x.

    Parameters
    ----------
    sectors : so many headings.
    x_towards : bearing that x points to, clockwise from north (rad).
    """

    sectors: int
    x_towards: float

    @property
    def headings(self) -> list[float]:
        """Headings of the waves, from x towards y (rad)."""
        return [k * 2.0 * math.pi / self.sectors for k in range(self.sectors)]

    @property
    def interpolated(self) -> bool:
        """Whether rows between two headings take from both; of fewer than four they have the nearest."""
        return self.sectors >= FEWEST

    def between(self, record: xr.Dataset) -> Between:
        """Which headings each row lies between; the last and the first are neighbours.

        Waves from a bearing go to the opposite one, and headings turn the other way than bearings do.

        Raises
        ------
        InputError
            When the record has no directions.
        """
        if FROM not in record:
            there = ", ".join(sorted(map(str, record.data_vars)))
            raise InputError("RECORD", FROM, "not in the record", f"there are {there}")
        towards = np.radians(record[FROM].values) + math.pi
        place = (self.x_towards - towards) * self.sectors / (2.0 * math.pi)
        known = np.isfinite(place)
        place = np.where(known, place, 0.0)
        if not self.interpolated:
            place = np.round(place)
        nearest = np.round(place)
        place = np.where(np.abs(place - nearest) <= CLOSE, nearest, place)
        lower = np.floor(place)
        sector = (lower % self.sectors).astype(np.int64)
        return Between(np.where(known, sector, -1), place - lower)

    def scenes(self, file: SceneFile) -> list[SceneFile]:
        """The scene in waves of each heading.

        Raises
        ------
        InputError
            When it has no irregular sea, or headings that it cannot have.
        """
        files = [file.with_values(one, "--sectors") for one in heading_values(file, self.sectors)]
        for one in files:
            one.resolved()  # refuses what cannot be meant before anything runs
        return files

    def middle(self, file: SceneFile, heading: int) -> SceneFile:
        """The scene in waves half-way between a heading and the next.

        Raises
        ------
        InputError
            When it has no irregular sea, or headings that it cannot have.
        """
        values = heading_values(file, 2 * self.sectors)[2 * heading + 1]
        return file.with_values(values, "--sectors")
