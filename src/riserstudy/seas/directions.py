"""Directions of a record as headings of a scene, at equal angles, with rows between two headings."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.load import SceneFile
from riserstudy.seas.sea_states import without_waves
from riserstudy.study.in_sea import heading_paths, heading_values

if TYPE_CHECKING:
    import xarray as xr

FROM = "wave_from_direction"
# smallest number of headings for interpolation: with fewer, adjacent responses differ too much
FEWEST = 4
CLOSE = 1e-9  # share of the angle between two headings within which a row has one of them


class Between(NamedTuple):
    """The headings between which each row of a record is."""

    lower: NDArray[np.int64]  # (rows,) index of the lower heading; -1 for rows without a direction
    share: FloatArray  # (rows,) position between the lower (0) and the next heading (1)

    def weight(self, heading: int, sectors: int) -> FloatArray:
        """Weight of a heading in each row, (rows,): the weights of the two adjacent headings sum to one."""
        following = (self.lower + 1) % sectors
        own = np.where(self.lower == heading, 1.0 - self.share, 0.0)
        before = np.where((self.lower >= 0) & (following == heading), self.share, 0.0)
        return np.asarray(own + before)

    def inside(self, heading: int) -> NDArray[np.bool_]:
        """Rows strictly between a heading and the next, (rows,)."""
        return np.asarray((self.lower == heading) & (self.share > 0.0))


class Directions(NamedTuple):
    """Conversion of a record's directions to headings at equal angles, the first along the scene's x.

    Parameters
    ----------
    sectors : number of headings.
    x_towards : bearing of the x axis, clockwise from north (rad).
    """

    sectors: int
    x_towards: float

    @property
    def headings(self) -> list[float]:
        """Headings of the waves, from x towards y (rad)."""
        return [k * 2.0 * math.pi / self.sectors for k in range(self.sectors)]

    @property
    def interpolated(self) -> bool:
        """Whether rows between two headings are interpolated; with fewer than four headings, they are not."""
        return self.sectors >= FEWEST

    def between(self, record: xr.Dataset) -> Between:
        """The headings between which each row is; the last and the first heading are adjacent.

        Waves from a bearing travel to the opposite bearing, and headings increase in the opposite sense of
        bearings. Calm rows, without waves, may lack a direction; they have the most frequent lower heading.
        Raises InputError when the record has no directions.
        """
        check_directions(record, "RECORD", FROM, "add this column")
        towards = np.radians(record[FROM].values) + math.pi
        place = (self.x_towards - towards) * self.sectors / (2.0 * math.pi)
        known = np.isfinite(place)
        place = np.where(known, place, 0.0)
        if not self.interpolated:
            # half-way between two headings, the following one, so that no heading has more ties than others
            place = np.floor(place + 0.5 + CLOSE)
        nearest = np.round(place)
        place = np.where(np.abs(place - nearest) <= CLOSE, nearest, place)
        lower = np.floor(place)
        sector = (lower % self.sectors).astype(np.int64)
        sector[~known] = -1
        calm = without_waves(record) & ~known
        if known.any() and calm.any():
            sector[calm] = np.bincount(sector[known]).argmax()
        return Between(sector, place - lower)

    def scenes(self, file: SceneFile) -> list[SceneFile]:
        """The scene in waves of each heading.

        Raises InputError when it has no irregular sea, or cannot have these headings.
        """
        files = [file.with_values(one, "--sectors") for one in heading_values(file, self.sectors)]
        for one in files:
            one.resolved()  # refuses invalid scenes before any run
        return files

    def middle(self, file: SceneFile, heading: int) -> SceneFile:
        """The scene in waves half-way between a heading and the next.

        Raises InputError when it has no irregular sea, or cannot have these headings.
        """
        values = heading_values(file, 2 * self.sectors)[2 * heading + 1]
        return file.with_values(values, "--sectors")


def check_directions(record: xr.Dataset, where: str, field: str, allowed: str) -> None:
    """Check that a record has directions. Raises InputError, with the place and remedy, if it does not."""
    if FROM not in record:
        there = ", ".join(sorted(map(str, record.data_vars)))
        raise InputError(where, field, f"the record has no directions; it has {there}", allowed)


def directions_that_count(
    directions: Directions | None, file: SceneFile, record: xr.Dataset
) -> Directions | None:
    """The directions, unless the scene is equal in all headings, because its operators have no headings.

    Raises InputError when the record has no directions, or the scene has no irregular sea.
    """
    if directions is None or heading_paths(file):
        return directions
    directions.between(record)  # refuses a record without directions
    return None
