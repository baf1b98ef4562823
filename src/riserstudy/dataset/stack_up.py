"""The stack-up of a riser, like a tally: joints, dry and submerged weights, and the load on the hook."""

from __future__ import annotations

import math
from typing import NamedTuple

from riserstudy.dataset.table import Cell, Table
from riserstudy.scene.ends import Body
from riserstudy.scene.geometry import levels
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import Section

COLUMNS = {
    "section": "", "joints": "", "length": "m", "upper end": "m", "outer diameter": "m",
    "inner diameter": "m", "mass": "kg/m", "dry weight a joint": "kN", "wet weight a joint": "kN",
    "dry weight": "kN", "wet weight": "kN", "lines, dry": "kN", "modules, dry": "kN",
    "lift of modules": "kN", "hook load": "kN", "wet weight, bore empty": "kN", "uplift": "kN",
    "contents": "kN", "wet weight from the top": "kN", "with contents from the top": "kN",
}  # fmt: skip


class Piece(NamedTuple):
    """A section or a body; weights in kN, None if they are not known."""

    about: list[Cell]  # name to mass
    joints: int | None
    dry: float | None
    empty: float | None  # submerged weight with an empty bore
    flood: float  # sea water in the bore
    inside: float  # contents
    parts: list[Cell]  # lines, modules, lift

    @property
    def wet(self) -> float | None:
        """Submerged weight with the bore flooded (kN)."""
        return None if self.empty is None else self.empty + self.flood


def stack_up(scene: Resolved) -> Table:
    """The riser from the top down, with sums.

    ``wet weight`` is the submerged weight with the bore flooded with sea water up to the surface, as when
    joints hang on the hook. ``hook load`` is the sum of the wet weights from its line downwards, when these
    joints are made up. ``wet weight, bore empty`` excludes everything inside the bore. ``contents`` are the
    contents in the scene. The last column is the decrease of tension from the top to this line. For a section
    without contents, the weight in the scene includes the fluid in its bore. Weights are those of pipe,
    modules and lines together; above the water, they are weights in air. ``uplift`` is the difference of dry
    weight and submerged weight with an empty bore. The lift of modules is a net lift, beyond their own
    weight. A telescopic joint above the ring hangs on the deck and is not included. ``scene``: the riser;
    masses in kg, lengths in m.
    """
    pieces = _pieces(scene)
    hook: list[float | None] = []
    for piece in reversed(pieces):
        below = hook[-1] if hook else 0.0
        hook.append(None if below is None or piece.wet is None else below + piece.wet)
    rows: list[list[Cell]] = []
    wet = full = 0.0
    for piece, load in zip(pieces, reversed(hook), strict=True):
        wet += piece.wet or 0.0
        full += (piece.empty or 0.0) + piece.inside
        each = [
            None if weight is None or not piece.joints else weight / piece.joints
            for weight in (piece.dry, piece.wet)
        ]
        lost = None if piece.dry is None or piece.empty is None else piece.dry - piece.empty
        rows.append([
            *piece.about, *each, piece.dry, piece.wet, *piece.parts, load, piece.empty, lost, piece.inside,
            wet, full,
        ])  # fmt: skip
    return Table(list(COLUMNS), list(COLUMNS.values()), rows)


def _pieces(scene: Resolved) -> list[Piece]:
    """Bodies and sections from the top down."""
    upper = _upper_end(scene)
    pieces = [_body(scene, scene.top.body, upper)] if scene.top.body else []
    for k in range(len(scene.riser) - 1, len(scene.riser) - len(scene.sections) - 1, -1):
        pieces.append(_section(scene, k, upper))
        upper = None if upper is None else round(upper - scene.riser[k].total_length, 9) + 0.0
    return pieces + ([_body(scene, scene.bottom.body, upper)] if scene.bottom.body else [])


def _body(scene: Resolved, body: Body, at: float | None) -> Piece:
    gravity, water = scene.gravity or 0.0, scene.water.density if scene.water else 0.0
    dry = body.mass * gravity / 1e3 if gravity else None
    wet = None if body.weightless else body.weight(gravity, water) / 1e3
    about: list[Cell] = [body.name, None, None, at, None, None, None]
    return Piece(about, None, dry, wet, 0.0, 0.0, [None] * 3)


def _section(scene: Resolved, k: int, upper: float | None) -> Piece:
    section, gravity = scene.riser[k], scene.gravity or 0.0
    length, each = section.total_length, section.submerged_weight
    joints = section.joints.count if section.joints else None
    total = gravity * length / 1e3
    about: list[Cell] = [
        section.name, joints, length, upper, section.outer_diameter, section.inner_diameter, section.mass,
    ]  # fmt: skip
    return Piece(
        about,
        joints,
        section.mass * total if section.mass and gravity else None,
        None if each is None else each * length / 1e3,
        _flooding(scene, k) * total,
        section.contents_mass * total,
        _parts(section, gravity),
    )


def _flooding(scene: Resolved, k: int) -> float:
    """Mean mass of the sea water in the bore of a section (kg/m), if its weight excludes the bore's contents.

    Sea water fills the bore up to the surface.
    """
    section, ends = scene.riser[k], levels(scene, k)
    if scene.water is None or section.contents is None:
        return 0.0
    surface, wet = scene.water.surface, 1.0
    if ends is not None and surface is not None:
        wet = min(max((surface - ends[0]) / (ends[1] - ends[0]), 0.0), 1.0)
    return wet * scene.water.density * 0.25 * math.pi * (section.inner_diameter or 0.0) ** 2


def _parts(section: Section, gravity: float) -> list[Cell]:
    """Dry weight of lines and of modules, and net lift of modules (kN); None without them."""
    total = gravity * section.total_length / 1e3
    lines = total * sum(x.all_mass for x in section.lines) if section.lines else None
    count = section.joints.count if section.joints else 1
    modules = gravity * count * section.modules.mass / 1e3 if section.modules else None
    lift = section.buoyancy_lift
    return [lines, modules, None if lift is None else lift * section.total_length / 1e3]


def _upper_end(scene: Resolved) -> float | None:
    """Elevation of the upper end of the unstretched riser (m)."""
    if scene.bottom.elevation is not None:
        upper = scene.bottom.elevation + sum(s.total_length for s in scene.sections)
        return round(upper, 9) + 0.0  # without rounding errors of sums
    return scene.top.elevation
