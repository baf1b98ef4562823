"""Recorded results of a simulation: envelopes at all nodes, histories at stations, ends at every step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.solve.program import Packed


class Record(NamedTuple):
    """Outputs; q quantities per node: position, effective tension, bending moment (in space its magnitude).

    For risers that bend, the last of these quantities is the moment at the middle of the segment above each
    node, and for the top node the moment at the lower end of the top segment, above the jump at a tension
    ring. If requested, shear force above and below each node (it jumps at joints) and stress of the wall are
    the last of r rows. In space, moments and shear are magnitudes. Histories also have the moment's
    components, and so has the scratch, in v rows: the r rows, then three components of each magnitude.
    """

    time: np.ndarray  # (k,) output times (s)
    station: np.ndarray  # (j,) node indices of the histories
    history: np.ndarray  # (k, quantities of a node, j)
    # (n, 4) weights of the moments at nodes e - 1 to e + 2 in the moment at a middle
    middle: np.ndarray
    # (2, n, 4) the same for shear at a segment's lower and upper end (1/m), or empty
    shear: np.ndarray
    wall: np.ndarray  # (w, 6) radii outer, inner (m), area (m2), second moment (m4), two shares: `Section`
    wall_at: np.ndarray  # (w, 2) node, column of the contents or -1
    column: np.ndarray  # (c, 2) contents from the top down: weight (N/m3), level above (m) or NaN
    column_at: np.ndarray  # (c, 2) nodes of their upper and lower ends
    sea: np.ndarray  # (2,) weight (N/m3), elevation of the surface (m)
    largest: np.ndarray  # (r, n+1) envelopes from the first output on: q, then shear and stress
    smallest: np.ndarray  # (r, n+1) the same
    # end segment's tangent, moments of its end and inner node, length
    end: np.ndarray  # (k, 2, d + 2m + 1)
    top: np.ndarray  # (k, d) position of the top
    platform: np.ndarray  # (k, 6)
    probe: np.ndarray  # (k, probes)
    values: np.ndarray  # (v, n+1) scratch: the last step
    past: np.ndarray  # (2, v, n+1) scratch: the two steps before
    between: np.ndarray  # (v, n+1) scratch: an output between steps
    when: np.ndarray  # (3,) times of the last three steps (s)
    inside: np.ndarray  # (c,) scratch: pressure at the upper ends of columns (Pa)
    # (1,) number of steps since the start or the last event, at which forces may jump
    seen: np.ndarray
    written: np.ndarray  # (1,) number of recorded outputs
    # at each step: the values at ends and devices that outputs have, as long as there is room
    step_time: np.ndarray  # (t,) s
    step_end: np.ndarray  # (t, 2, d + 2m + 1)
    step_top: np.ndarray  # (t, d)
    step_platform: np.ndarray  # (t, 6)
    step_probe: np.ndarray  # (t, probes)
    steps: np.ndarray  # (1,) number of steps; more than the room if some steps are not recorded


class Section(NamedTuple):
    """Inputs for shear force and stress of the wall, as in `Record`."""

    shear: np.ndarray  # (2, n, 4) weights of moments (1/m)
    wall: np.ndarray  # (w, 6) radii (m), area (m2), second moment (m4), its shares of tension and moment
    wall_at: np.ndarray  # (w, 2) node, column
    column: np.ndarray  # (c, 2) weight (N/m3), level (m)
    column_at: np.ndarray  # (c, 2) nodes
    sea: np.ndarray  # (2,) weight (N/m3), elevation (m)


NO_SECTION = Section(
    np.zeros((2, 0, 4)),
    np.zeros((0, 6)),
    np.zeros((0, 2), np.int64),
    np.zeros((0, 2)),
    np.zeros((0, 2), np.int64),
    np.zeros(2),
)


def new_record(time, station, s, middle=None, section=NO_SECTION, room=0) -> Packed:
    """Empty record for the sizes of a state, frozen for compiled code.

    Parameters
    ----------
    middle, section : see `Record`; absent: moments at middles, shear and stress are not recorded.
    room : largest number of steps at which ends and devices are recorded.
    """
    d, m, n = len(s.dim), len(s.dof) - len(s.dim), len(s.l0)
    q, k = d + 1 + 2 * min(m, 1), len(time)
    sheared = int(section.shear.shape[1] > 0)
    rows = q + 2 * sheared + int(len(section.wall) > 0)
    v = rows + (6 + 6 * sheared) * (m == 3)
    width = d + 2 * m + 1
    record = Record(
        time=np.array(time, float),
        station=np.array(station, np.int64),
        history=np.zeros((k, d + (1, 2, 0, 5)[m], len(station))),
        middle=np.zeros((n, 4)) if middle is None else np.array(middle, float),
        **section._asdict(),
        largest=np.full((rows, n + 1), -np.inf),
        smallest=np.full((rows, n + 1), np.inf),
        end=np.zeros((k, 2, width)),
        top=np.zeros((k, d)),
        platform=np.zeros((k, 6)),
        probe=np.zeros((k, len(s.probe))),
        values=np.zeros((v, n + 1)),
        past=np.zeros((2, v, n + 1)),
        between=np.zeros((v, n + 1)),
        when=np.zeros(3),
        inside=np.zeros(len(section.column)),
        seen=np.zeros(1, np.int64),
        written=np.zeros(1, np.int64),
        step_time=np.zeros(room),
        step_end=np.zeros((room, 2, width)),
        step_top=np.zeros((room, d)),
        step_platform=np.zeros((room, 6)),
        step_probe=np.zeros((room, len(s.probe))),
        steps=np.zeros(1, np.int64),
    )
    return Packed(record)


def with_present_envelopes(record: Record) -> Record:
    """A record whose envelopes do not change when the march goes on."""
    return record._replace(largest=record.largest.copy(), smallest=record.smallest.copy())


def forget(record: Packed) -> None:
    """Keep only the last step, because forces have a kink or a jump there, due to an event."""
    record.value.seen[0] = min(record.value.seen[0], 1)
