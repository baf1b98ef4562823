"""Motions and flow: platform and current."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Annotated, Generic, Literal, Self, TypeVar

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import ALONG_X, NOT_NEGATIVE, POSITIVE, Positive
from riserstudy.scene.rao import Response
from riserstudy.scene.sea import WindDrift
from riserstudy.scene.water import Water

SMOOTH = 1e-6  # sine of a phase below which a motion starts without a jump


class Harmonic(Strict):
    """amplitude sin(2 pi t / period + phase), grown by a half cosine over the ramp. Absent: 0."""

    amplitude: float
    period: Annotated[u.Time, POSITIVE]
    phase: u.Angle | None = None
    ramp: Annotated[u.Time, POSITIVE] | None = None

    @property
    def jolts(self) -> list[float]:
        """Times (s) at which velocity or acceleration jumps: start and end of the half cosine."""
        if self.ramp is None:
            return [0.0]
        phase = self.phase or 0.0
        ends = 2.0 * math.pi * self.ramp / self.period + phase
        return [t for t, at in ((0.0, phase), (self.ramp, ends)) if abs(math.sin(at)) > SMOOTH]

    @property
    def sudden(self) -> bool:
        """Whether it starts from rest with a speed."""
        starts = self.ramp is None and self.amplitude > 0.0
        return starts and abs(math.cos(self.phase or 0.0)) > SMOOTH


class Translation(Harmonic):
    """Harmonic surge, sway or heave of the platform: amplitude sin(2 pi t / period + phase)."""

    amplitude: Annotated[u.Length, NOT_NEGATIVE]


class Tilt(Harmonic):
    """Harmonic roll, pitch or yaw of the platform: amplitude sin(2 pi t / period + phase)."""

    amplitude: Annotated[u.Angle, NOT_NEGATIVE]


class Cruise(Strict):
    """Cruise of the platform at a constant speed, by default along x.

    Over the time ``ramp``, the speed of a cruise increases linearly from zero to ``speed``. Without ``ramp``,
    the platform has its full speed from the start.
    """

    speed: u.Speed
    heading: u.Angle | None = None
    ramp: Annotated[u.Time, POSITIVE] | None = None

    @property
    def jolts(self) -> list[float]:
        """Times at which velocity or acceleration jumps (s)."""
        return [0.0, self.ramp] if self.ramp else [0.0]

    @property
    def sudden(self) -> bool:
        """Whether it starts from rest with a speed."""
        return self.ramp is None and self.speed != 0.0


class Instant(Strict):
    """One point of a time series."""

    time: u.Time
    value: float


class Moved(Instant):
    """One point of a time series of surge, sway or heave."""

    value: u.Length


class Tilted(Instant):
    """One point of a time series of roll, pitch or yaw."""

    value: u.Angle


P = TypeVar("P", bound=Instant)


class TimeSeries(Strict, Generic[P]):
    """A platform motion as a cubic spline through points, listed here or in a CSV table ``{file: name.csv}``.

    Before the first and after the last point of a time series, the position of the platform is constant. If
    one interval between points is much longer than its neighbours, the spline can exceed all points. The
    engine refuses a spline that exceeds all points by more than half of the range of their values. If all
    values of a sway, roll or yaw are zero, no simulation in three dimensions is required.
    """

    points: Annotated[list[P], Field(min_length=4)]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if any(a.time >= b.time for a, b in pairwise(self.points)):
            raise Misfit(
                "points", "the times do not increase from point to point", "order the points by time"
            )
        return self


class Position(Strict):
    """Rest position of the platform, relative to the point above the well; by default zero."""

    surge: u.Length | None = None
    sway: u.Length | None = None
    heave: u.Length | None = None
    roll: u.Angle | None = None
    pitch: u.Angle | None = None
    yaw: u.Angle | None = None


class Centre(Strict):
    """Position of the platform's centre of rotation with the platform at rest.

    Without ``x`` and ``y``, the centre of rotation is vertically above the well, even if the riser's top has
    an ``offset``. If the top has an ``offset``, usually set ``x`` to this offset. The key ``position`` also
    moves the centre of rotation.
    """

    x: u.Length | None = None
    y: u.Length | None = None
    elevation: u.Length


TRANSLATIONS = ("surge", "sway", "heave")
TILTS = ("roll", "pitch", "yaw")
Shift = Translation | Annotated[list[Translation], Field(min_length=1)] | TimeSeries[Moved]
Turn = Tilt | Annotated[list[Tilt], Field(min_length=1)] | TimeSeries[Tilted]


class Platform(Strict):
    """Prescribed platform motion: harmonic, a sum of harmonics, or a time series.

    A platform motion that is not given is zero. By default, a harmonic motion has phase 0 and no ramp. Roll
    is a rotation about x, pitch about y, and yaw about z. With a positive pitch, the platform's vertical axis
    leans towards +x.

    In a scene with a ``vessel``, the motions of the ``platform`` are the first-order (wave-frequency) motions
    of the vessel, and the centre of rotation drifts with the vessel. Phases of response amplitude operators
    (RAOs) are evaluated at the initial position of the vessel, even if the vessel drifts. A run prints a
    warning if the vessel drifts by more than a tenth of the wavelength in the direction of the waves of the
    scene. With a ``vessel``, the engine refuses the key ``cruise``, and surge or sway in ``position``; the
    key ``top.offset`` gives the initial position of the vessel.

    Response amplitude operators (RAOs) refer to a hull along x. With RAOs, the engine therefore refuses yaw
    in ``position``, and a ``vessel`` whose heading is not along x.
    """

    position: Position | None = None
    surge: Shift | None = None
    sway: Shift | None = None
    heave: Shift | None = None
    roll: Turn | None = None
    pitch: Turn | None = None
    yaw: Turn | None = None
    centre_of_rotation: Centre | None = None
    cruise: Cruise | None = None
    response: Response | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        given = self.response.moving if self.response else []
        turns = [t for t in TILTS if getattr(self, t) or getattr(self.position, t, None) or t in given]
        if turns and self.centre_of_rotation is None:
            raise Misfit("", f"{turns[0]} requires centre_of_rotation", "add it")
        return self

    @property
    def harmonics(self) -> list[tuple[str, Harmonic]]:
        """All harmonic motions with their names."""
        rows = []
        for name in (*TRANSLATIONS, *TILTS):
            motion = getattr(self, name)
            for one in motion if isinstance(motion, list) else [motion]:
                if isinstance(one, Harmonic):
                    rows.append((name, one))
        return rows

    @property
    def jolts(self) -> list[float]:
        """Times at which velocity or acceleration of a motion jumps (s)."""
        moving = [motion for _, motion in self.harmonics]
        times = [t for motion in (*moving, self.cruise) if motion for t in motion.jolts]
        if self.response:
            times += [0.0, self.response.ramp or 0.0]
        return times

    @property
    def sudden(self) -> list[tuple[str, str]]:
        """Keys by which a motion starts with a speed, each with the motion; time series are not included."""
        names = [(name, name) for name, motion in self.harmonics if motion.sudden]
        if self.cruise and self.cruise.sudden:
            names.append(("cruise", "surge"))
        if self.response and self.response.ramp is None:
            names += [("response", motion) for motion in self.response.moving]
        return names


TURN = math.tau * (1.0 + 1e-9)  # rad, a full turn with room for rounding


class Point(Strict):
    """One point of a current profile, at an elevation, or at a depth below the mean water level.

    Two points of a current profile at equal elevations or depths define a jump of the speed. Points by
    elevation are listed upwards: the first of two points at one elevation gives the speed below the jump.
    Points by depth are listed downwards: the first of two points at one depth gives the speed above the jump.
    Points without ``direction`` have the heading of the current.
    """

    elevation: u.Length | None = None
    depth: Annotated[u.Length, NOT_NEGATIVE] | None = None
    speed: u.Speed
    direction: u.Angle | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.elevation is None) == (self.depth is None):
            raise Misfit("", "elevation or depth is required, not both", "give one of them")
        _within_a_turn("direction", self.direction)
        return self


def _within_a_turn(name: str, angle: float | None) -> None:
    """Check that an angle is at most a turn, and so no number of degrees in a column of radians."""
    if angle is not None and abs(angle) > TURN:
        raise Misfit(
            "", f"{name} {math.degrees(angle):.4g} deg is more than a full turn", "give at most 360 deg"
        )


class Shape(Strict):
    """A current profile by a formula, from the seabed to the surface, with the speed at the surface.

    The relative speed of the current is the speed divided by ``surface_speed``. With ``shape: power``, the
    relative speed is (height above the seabed / water depth)^power. With ``shape: exponential``, the relative
    speed is exp(-depth below the surface / scale). With ``shape: layer``, the speed is uniform down to the
    depth ``layer`` below the surface, then decreases linearly to zero at the depth ``vanishes``. By default,
    the key ``water`` gives the elevations of seabed and surface.
    """

    shape: Literal["uniform", "power", "exponential", "layer"]
    surface_speed: u.Speed
    seabed: u.Length | None = None
    surface: u.Length | None = None
    power: Positive | None = None
    scale: Annotated[u.Length, POSITIVE] | None = None
    layer: Annotated[u.Length, NOT_NEGATIVE] | None = None
    vanishes: Annotated[u.Length, POSITIVE] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.seabed is not None and self.surface is not None and self.seabed >= self.surface:
            raise Misfit("", "seabed is not below surface", "correct their elevations")
        owners = {"power": "power", "scale": "exponential", "layer": "layer", "vanishes": "layer"}
        for name, needed in owners.items():
            if (getattr(self, name) is not None) != (self.shape == needed):
                given = self.shape != needed
                found = f"{name} does not apply to" if given else f"{name} is required by"
                remedy = f"remove it, or write 'shape: {needed}'" if given else "add it"
                raise Misfit("", f"{found} 'shape: {self.shape}'", remedy)
        if self.layer is not None and self.vanishes is not None and self.layer >= self.vanishes:
            raise Misfit(
                "",
                f"layer {self.layer:g} m is not less than the depth where the current vanishes",
                f"give less than {self.vanishes:g} m",
            )
        return self


class Combined(Strict):
    """The sum of several current profiles, such as tide and drift."""

    sum: Annotated[list[Shape | WindDrift], Field(min_length=1)]


class Current(Strict):
    """Steady current in the sea.

    By default, the current flows along x, and acts from the start of a run without a ramp. The key
    ``headings`` states whether the headings of a current are directions that the current flows to
    (``towards``, the default) or comes from (``from``). The key ``headings`` also applies to the
    ``direction`` of points of the profile. Give a ``direction`` at all points of a current profile, or at no
    point. If the direction of the current varies with depth, the engine interpolates the x and y components
    of the velocity linearly between points. The key ``beyond`` of a current is required if the profile does
    not cover the riser. Outside the profile, the current has the speed of the nearest point of the profile
    (``hold``) or no speed (``zero``).
    """

    profile: Annotated[list[Point], Field(min_length=2)] | Shape | WindDrift | Combined
    heading: u.Angle | None = None
    headings: Literal["towards", "from"] | None = None
    beyond: Literal["hold", "zero"] | None = None
    ramp: Annotated[u.Time, POSITIVE] | None = None

    @property
    def towards(self) -> float:
        """Direction that it flows to, from x towards y (rad)."""
        return (self.heading or 0.0) + (math.pi if self.headings == "from" else 0.0)

    @property
    def turns(self) -> bool:
        """Whether its direction changes with elevation."""
        if isinstance(self.profile, list):
            return self.profile[0].direction is not None
        return any(isinstance(part, WindDrift) and part.component == "both" for part in self.parts)

    @property
    def directions(self) -> list[float]:
        """Direction (rad, from x towards y) that it flows to at each row of `table`; empty without points."""
        points = self.profile if isinstance(self.profile, list) else []
        turn = math.pi if self.headings == "from" else 0.0
        angles = [self.towards if p.direction is None else p.direction + turn for p in points]
        return angles[::-1] if self.by_depth else angles

    @property
    def leaves_plane(self) -> str:
        """The key by which it flows out of the plane of x and z; "" where it stays in the plane."""
        if not self.turns:
            return "heading" if abs(math.sin(self.heading or 0.0)) > ALONG_X else ""
        across = any(abs(math.sin(angle)) > ALONG_X for angle in self.directions)
        return "profile" if across or not isinstance(self.profile, list) else ""

    def table(self, water: Water | None) -> tuple[list[float], list[float]]:
        """Increasing elevations (m) and their speeds (m/s), of a profile by points."""
        points = self.profile if isinstance(self.profile, list) else []
        if self.by_depth:
            points = points[::-1]
        surface = (water and water.surface) or 0.0
        z = [surface - (p.depth or 0.0) if p.elevation is None else p.elevation for p in points]
        return z, [point.speed for point in points]

    @property
    def by_depth(self) -> bool:
        """Whether its points are given by depth below the mean water level."""
        return isinstance(self.profile, list) and self.profile[0].depth is not None

    @property
    def parts(self) -> list[Shape | WindDrift]:
        """Named profiles whose sum is the profile; empty where it is given by points."""
        if isinstance(self.profile, list):
            return []
        return self.profile.sum if isinstance(self.profile, Combined) else [self.profile]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        points = self.profile if isinstance(self.profile, list) else []
        directed = {point.direction is not None for point in points}
        if len(directed) > 1:
            raise Misfit(
                "profile", "only some lines have a direction", "give direction in every line or in none"
            )
        _within_a_turn("heading", self.heading)
        if True in directed and self.heading is not None:
            found = "the points of the profile already have directions"
            raise Misfit("heading", found, "remove heading, or the directions")
        if self.headings is not None and self.heading is None and directed != {True}:
            raise Misfit(
                "headings",
                f"{self.headings!r} has no effect on a current without heading or directions",
                "remove headings, or add heading",
            )
        if len({point.depth is None for point in points}) > 1:
            raise Misfit(
                "profile",
                "some lines have an elevation, others a depth",
                "give elevation in every line, or depth in every line",
            )
        for name in ("elevation", "depth"):
            values = [x for point in points if (x := getattr(point, name)) is not None]
            if any(a > b for a, b in pairwise(values)) or any(
                a == b for a, b in zip(values, values[2:], strict=False)
            ):
                raise Misfit(
                    "profile",
                    f"the {name}s do not increase from point to point",
                    f"order the points by {name}, with at most two points (a jump) at one {name}",
                )
        return self
