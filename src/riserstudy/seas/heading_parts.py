"""Headings that a record has, the sea states simulated in each, and those half-way between two."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.seas.between_headings import Half, states_between
from riserstudy.seas.cover import HELD_OUT, Cover, corners, cover, first
from riserstudy.seas.directions import Between, Directions
from riserstudy.seas.mesh_of_seas import MeshOfSeas, checked, mesh_of_seas, on_mesh
from riserstudy.seas.record import with_peak_period
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.sea_states import SeaStates, sea_states
from riserstudy.study.in_sea import sea_of

if TYPE_CHECKING:
    import xarray as xr

FloatArray = NDArray[np.float64]
Notify = Callable[[str], None]
PRICED = 2  # runs by which the time of all is told


class Effort(NamedTuple):
    """How much is simulated."""

    seeds: int = 5  # runs of each sea state: 1, or 5 and more
    error: float = 0.05  # of the response between sea states, as `cover` has it
    most: int = 400  # sea states of a heading at most
    cores: int = 1


class Heading(NamedTuple):
    """A scene in waves of one heading, and the rows of the record that take from it."""

    angle: float  # deg; not a number: that of the scene
    file: SceneFile
    of: SeaStates
    weight: FloatArray  # (rows,) what it counts in each row of the record
    half: Half | None = None  # absent: no row lies between it and the next


class Part(NamedTuple):
    """Waves of one heading, and the riser's responses to those that a record has."""

    heading: Heading
    riser: RiserResponse
    cover: Cover
    deviation: FloatArray  # (n, limits) at the cover's sea states
    scale: FloatArray  # (n, limits) of extremes of an interval, at the cover's sea states
    mesh: MeshOfSeas | None  # absent: runs have the scene's own, or each finds one

    @property
    def mesh_error(self) -> FloatArray:
        """Largest difference of demands by the mesh, (limits,), over what is allowed or over the demand."""
        return self.mesh.error if self.mesh else np.zeros_like(self.cover.error)


def headings(file: SceneFile, record: xr.Dataset, directions: Directions | None) -> list[Heading]:
    """The scene in each heading, with the rows of a record that take from it; some may have none.

    Raises
    ------
    InputError
        When the scene or the record lacks what this needs.
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
                angle,
                scene,
                _of_heading(of, weight > 0.0),
                weight,
                _half(k, file, of, between, directions),
            )
        )
    return found


def _of_heading(of: SeaStates, rows: NDArray[np.bool_]) -> SeaStates:
    """Sea states of some rows, and the corners of the record where these are few, or lie on a line."""
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
    """Half-way between a heading and the next; None where the record has no row between them."""
    rows = between.inside(number) & (of.state_of_row >= 0)
    if not rows.any():
        return None
    angle = math.degrees(directions.headings[number]) + 180.0 / directions.sectors
    scene = directions.middle(file, number)
    following = (number + 1) % directions.sectors
    return Half(angle, scene, states_between(of, rows), rows, following)


def simulate(heading: Heading, record: xr.Dataset, effort: Effort, notify: Notify) -> Part:
    """Simulate sea states of one heading, until the response between them is known.

    Raises
    ------
    InputError
        When the scene lacks what this needs, or the sea states lie on a line.
    SimulationError
        When so many sea states do not suffice.
    """
    if not math.isnan(heading.angle):
        notify(f"heading {heading.angle:g} deg: {heading.of.rows.sum()} rows")
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
    return Part(heading, riser, found, deviation, scale, mesh)


def _meshed(riser: RiserResponse, mesh: MeshOfSeas | None) -> RiserResponse:
    """The riser on a mesh; as it is without one."""
    if mesh is None:
        return riser
    file = on_mesh(riser.file, mesh.values)
    return RiserResponse(file, riser.seeds, riser.interval, riser.cores)


def riser_half_way(half: Half, part: Part) -> RiserResponse:
    """The riser in waves half-way between a heading and the next, on the mesh of the heading."""
    of = part.riser
    return _meshed(RiserResponse(half.file, of.seeds, of.interval, of.cores), part.mesh)


def _price(of: SeaStates, riser: RiserResponse, effort: Effort) -> str:
    """What a heading takes at least, in words, by one run."""
    chosen = first(of)
    least = len(chosen) + HELD_OUT
    runs = least * effort.seeds
    each = riser.seconds(of.states[chosen[-PRICED:]])
    seconds = runs * each / effort.cores
    time = "" if math.isnan(each) else f" of {each:.2g} s, {seconds:.2g} s on {effort.cores} cores"
    return (
        f"at least {least} sea states, {runs} runs{time}, minus stored runs; at most {effort.most}"
    )


def interval_of(record: xr.Dataset) -> float:
    """Time between rows of a record (s)."""
    return float(record.attrs["interval_hours"]) * 3600.0
