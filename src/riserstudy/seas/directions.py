"""Directions of a record as headings of a scene, in sectors of equal width."""

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

FROM = "wave_from_direction"


class Directions(NamedTuple):
    """How directions of a record become headings: by sectors, and by where the scene's x points.

    Parameters
    ----------
    sectors : so many, the first about x.
    x_towards : bearing that x points to, clockwise from north (rad).
    """

    sectors: int
    x_towards: float

    @property
    def headings(self) -> list[float]:
        """Heading of the waves in the middle of each sector, from x towards y (rad)."""
        return [k * 2.0 * math.pi / self.sectors for k in range(self.sectors)]

    def sector_of(self, record: xr.Dataset) -> NDArray[np.int64]:
        """Sector of each row, (rows,); -1 where it has no direction.

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
        heading = self.x_towards - towards
        sector = np.round(heading * self.sectors / (2.0 * math.pi))
        known = np.isfinite(sector)
        return np.where(known, np.where(known, sector, 0.0) % self.sectors, -1).astype(np.int64)

    def scenes(self, file: SceneFile) -> list[SceneFile]:
        """The scene in waves of each sector's heading.

        Raises
        ------
        InputError
            When it has no irregular sea, or headings that it cannot have.
        """
        files = [file.with_values(one, "--sectors") for one in heading_values(file, self.sectors)]
        for one in files:
            one.resolved()  # refuses what cannot be meant before anything runs
        return files
