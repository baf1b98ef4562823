"""Headings of a record, the sea states simulated in each, and sea states half-way between two headings."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.records.numerals import duration
from riserstudy.records.words import counted
from riserstudy.scene.load import SceneFile
from riserstudy.seas.between_headings import Half, states_between
from riserstudy.seas.cover import Cover, check_most, corners, cover, first, least
from riserstudy.seas.directions import Between, Directions
from riserstudy.seas.mesh_of_seas import MeshOfSeas, checked, estimated, mesh_of_seas, on_mesh
from riserstudy.seas.record import interval_of_rows, with_peak_period
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.sea_states import SeaStates, sea_states
from riserstudy.study.in_sea import sea_of

if TYPE_CHECKING:
    import xarray as xr

Notify = Callable[[str], None]
ANY = 1.0  # a gamma (1) for periods of which only the rows with a value matter
PRICED = 2  # number of runs from which the total time is estimated


class Effort(NamedTuple):
    """Extent of the simulations."""

    seeds: int = 5  # number of runs for each sea state: 1, or 5 and more
    error: float = 0.05  # tolerance of the response between sea states, as in `cover`
    most: int = 400  # largest number of sea states for each heading
    cores: int = 1


class Heading(NamedTuple):
    """A scene in waves of one heading, and its weights in the rows of the record."""

    angle: float  # deg; NaN: the heading of the scene
    file: SceneFile
    of: SeaStates
    weight: FloatArray  # (rows,) its weight in each row of the record
    half: Half | None = None  # absent: no row is between it and the next heading


class Part(NamedTuple):
    """Waves of one heading, and the riser's responses to the sea states of a record."""

    heading: Heading
    riser: RiserResponse
    cover: Cover
    deviation: FloatArray  # (n, limits) standard errors at the cover's sea states
    # (n, limits) Gumbel scale of extremes of an interval, at the cover's sea states
    scale: FloatArray
    # absent: runs have the scene's prescribed mesh, or each run refines its mesh
    mesh: MeshOfSeas | None
    # (limits,) estimated error of runs with the scene's mesh or tolerance, relative to the allowable or the
    # demand
    estimated: FloatArray

    @property
    def mesh_error(self) -> FloatArray:
        """Largest error of demands by mesh and step, (limits,), relative to the allowable or the demand."""
        return self.estimated + self.mesh.error if self.mesh else self.estimated


def headings(file: SceneFile, record: xr.Dataset, directions: Directions | None) -> list[Heading]:
    """The scene in each heading, with its weights in the rows of a record; some may have no rows.

    Raises InputError when the scene or the record lacks inputs.
    """
    of = sea_states(with_peak_period(record, sea_of(file).peak_enhancement))
    known = of.state_of_row >= 0
    if directions is None:
        return [Heading(math.nan, file, of, known.astype(float))]
    between = directions.between(record)
    found = []
    for k, scene in enumerate(directions.scenes(file)):
        weight = np.where(known, between.weight(k, directions.sectors), 0.0)
        angle = math.degrees(directions.headings[k])
        found.append(
            Heading(
                angle, scene, _of_heading(of, weight > 0.0), weight, _half(k, file, of, between, directions)
            )
        )
    return found


def _of_heading(of: SeaStates, rows: NDArray[np.bool_]) -> SeaStates:
    """Sea states of some rows, with the corners of the record added if they are few or on a line."""
    those = of.among(rows)
    if not len(those.states):
        return those
    try:
        corners(those.states)
    except InputError:
        return of.among(rows, corners(of.states))
    return those


def _half(
    number: int, file: SceneFile, of: SeaStates, between: Between, directions: Directions
) -> Half | None:
    """Waves half-way between a heading and the next; None if the record has no row between them."""
    rows = between.inside(number) & (of.state_of_row >= 0)
    if not rows.any():
        return None
    angle = math.degrees(directions.headings[number]) + 180.0 / directions.sectors
    scene = directions.middle(file, number)
    following = (number + 1) % directions.sectors
    return Half(angle, scene, states_between(of, rows), rows, following)


def simulate(heading: Heading, record: xr.Dataset, effort: Effort, notify: Notify) -> Part:
    """Simulate sea states of one heading, until the response between them is known within the tolerance.

    Raises InputError when the scene lacks inputs, the sea states are on a line, or their largest number is
    too small from the start. Raises SimulationError when this number does not suffice.
    """
    check_most([heading.of], effort.most)
    if not math.isnan(heading.angle):
        notify(f"heading {heading.angle:g} deg: {counted(int(heading.of.rows.sum()), 'row')}")
    accurate = RiserResponse(heading.file, effort.seeds, interval_of(record), effort.cores)
    mesh = mesh_of_seas(accurate, heading.of, effort.error, notify)
    riser = _meshed(accurate, mesh)
    notify(_price(heading.of, riser, effort))
    found = cover(heading.of, riser, riser.allowed, effort.error, effort.most, notify=notify)
    none = np.full(len(riser.limits), math.nan)
    deviation, scale = (
        np.array([of.get((h, t), none) for h, t in found.states.tolist()])
        for of in (riser.deviation, riser.scale)
    )
    if mesh:
        also = checked(accurate, riser, found)
        mesh = mesh._replace(error=np.maximum(mesh.error, also))
    return Part(heading, riser, found, deviation, scale, mesh, estimated(accurate, heading.of, found))


def _meshed(riser: RiserResponse, mesh: MeshOfSeas | None) -> RiserResponse:
    """The riser with a mesh; not changed without one."""
    if mesh is None:
        return riser
    file = on_mesh(riser.file, mesh.values)
    return RiserResponse(file, riser.seeds, riser.interval, riser.cores)


def riser_half_way(half: Half, part: Part) -> RiserResponse:
    """The riser in waves half-way between a heading and the next, on the mesh of the heading."""
    of = part.riser
    return _meshed(RiserResponse(half.file, of.seeds, of.interval, of.cores), part.mesh)


def _price(of: SeaStates, riser: RiserResponse, effort: Effort) -> str:
    """Smallest time for a heading, in words, from one run."""
    chosen, count = first(of), least(of)
    runs = count * effort.seeds
    each = riser.seconds(of.states[chosen[-PRICED:]])
    seconds = runs * each / effort.cores
    known = f" of {duration(each)}, {duration(seconds)} on {counted(effort.cores, 'core')}"
    time = "" if math.isnan(each) else known
    return (
        f"at least {count} sea states, {counted(runs, 'run')}{time}, minus stored runs; at most {effort.most}"
    )


def interval_of(record: xr.Dataset) -> float:
    """Time between rows of a record with a sea state (s), for which each of these rows stands.

    It is longer than the interval between heights if the record has a period in every third row only. Raises
    InputError when the record has no heights and periods.
    """
    interval = float(record.attrs["interval_hours"])
    known = sea_states(with_peak_period(record, ANY)).state_of_row >= 0
    if not known[np.isfinite(record["significant_wave_height"].values)].all():
        interval = interval_of_rows(record["time"].values[known], interval)
    return interval * 3600.0
