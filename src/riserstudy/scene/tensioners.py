"""Tensioners: force law, damping, stroke and arrangement."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.alike import ROUNDING
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE, WHOLE
from riserstudy.scene.tensioners_by_weight import Carried, DampingRatio


class Chamber(Strict):
    """Gas on one side of a tensioner piston: the area on which it acts, and its state at mid-stroke.

    The engine converts a gauge pressure to an absolute pressure. The key ``outside`` is the external
    pressure, which acts on ``area`` against the gas. By default, ``outside`` is the atmospheric pressure if
    ``pressure`` is a gauge pressure. If ``pressure`` is absolute, ``outside`` is zero by default, because
    some published tensioner formulas neglect the external pressure.
    """

    area: Annotated[u.Area, POSITIVE]
    pressure: Annotated[u.Pressure, POSITIVE]
    volume: Annotated[u.Volume, POSITIVE]
    outside: Annotated[u.Pressure, NOT_NEGATIVE] | None = None

    @model_validator(mode="before")
    @classmethod
    def _atmosphere_around_a_gauge(cls, tree: Any) -> Any:
        if isinstance(tree, dict) and str(tree.get("pressure")).strip().endswith("gauge"):
            return {"outside": f"{u.ATMOSPHERE} Pa absolute", **tree}
        return tree

    @property
    def outside_force(self) -> float:
        """Force of the external pressure (N)."""
        return self.area * (self.outside or 0.0)


class Gas(Chamber):
    """One gas chamber per cylinder, with the pull F = A P (V / (V - A reach))^k - A outside.

    In the formula of the pull F, A is the area, k the exponent, and P and V are pressure and volume at
    mid-stroke. In the formula of the pull F, ``reach`` is the extension of the cylinder from mid-stroke, and
    ``outside`` is the external pressure.
    """

    exponent: Annotated[float, Field(gt=1)]


class Pistons(Strict):
    """Tensioner pistons with their rods, which move with the tension ring.

    With ``counted: once``, the key ``mass`` is the mass of all pistons together. With ``counted: each``, the
    key ``mass`` is the mass of one piston.
    """

    mass: Annotated[u.Mass, POSITIVE]
    counted: Literal["once", "each"]


class TwoChamberGas(Strict):
    """Two gas chambers per tensioner cylinder.

    The gas at high pressure pulls the tension ring up. The low-pressure gas and the weight of the pistons act
    against the high-pressure gas. The pull of a cylinder is the force of the high-pressure gas minus the
    force of the low-pressure gas and the weight of the pistons.

    Without ``pistons``, the weight and the mass of the pistons are zero.
    """

    high: Chamber
    low: Chamber
    exponent: Annotated[float, Field(gt=1)]
    pistons: Pistons | None = None

    @property
    def outside_force(self) -> float:
        """Net force of the external pressures (N): against the high pressure, along with the low one."""
        return self.high.outside_force - self.low.outside_force


class Linear(Strict):
    """Straight line for each tensioner cylinder: tension at mid-stroke and stiffness."""

    tension: Annotated[u.Force, POSITIVE]
    stiffness: Annotated[u.Stiffness, NOT_NEGATIVE]


class TableRow(Strict):
    """Row of a tensioner table: extension from mid-stroke (positive if longer) and pull of one cylinder."""

    reach: u.Length
    force: Annotated[u.Force, NOT_NEGATIVE]


class Linearised(Strict):
    """Straight line that replaces a tensioner's gas law: a tangent, a chord, or a least-squares line.

    A tangent touches the curve of the gas law at the extension ``at`` from mid-stroke, by default zero. A
    chord or a least-squares line is fitted to the curve over the stroke range from ``shortest`` to
    ``longest``.
    """

    by: Literal["tangent", "chord", "least squares"]
    at: u.Length | None = None
    shortest: u.Length | None = None
    longest: u.Length | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        ranged = self.by != "tangent"
        if ranged != (self.shortest is not None) or ranged != (self.longest is not None):
            found = "requires both shortest and longest" if ranged else "has no range"
            remedy = "give both" if ranged else "remove shortest and longest"
            raise Misfit("", f"'by: {self.by}' {found}", remedy)
        if ranged and self.at is not None:
            raise Misfit("", f"'at' has no effect with 'by: {self.by}'", "remove it, or write 'by: tangent'")
        if self.shortest is not None and self.longest is not None and self.shortest >= self.longest:
            raise Misfit(
                "",
                f"shortest {self.shortest:g} m is not less than longest {self.longest:g} m",
                "correct one of them",
            )
        return self


class Stroke(Strict):
    """Stops of a tensioner at two extensions from mid-stroke (negative if shorter), and their stiffness."""

    shortest: u.Length
    longest: u.Length
    stop_stiffness: Annotated[u.Stiffness, POSITIVE]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if not self.shortest < 0 < self.longest:
            raise Misfit(
                "",
                f"shortest {self.shortest:g} m and longest {self.longest:g} m do not enclose mid-stroke, 0 m",
                "give a negative shortest and a positive longest",
            )
        return self


class Arrangement(Strict):
    """Tensioner cylinders between evenly spaced points on the tension ring and on the deck.

    The key ``first_bearing`` is the bearing of the first cylinder, from +x towards +y. With ``first_bearing:
    half a spacing``, the direction +x is midway between two cylinders. The key ``deck_elevation`` is the
    elevation of the upper ends of the cylinders on the deck, with the platform at rest. The centre of the
    tensioner deck is vertically above the riser's top.
    """

    ring_radius: Annotated[u.Length, NOT_NEGATIVE]
    deck_radius: Annotated[u.Length, NOT_NEGATIVE]
    deck_elevation: u.Length
    first_bearing: u.Angle | Literal["half a spacing"]

    def bearings(self, count: int) -> list[float]:
        """Bearing of each cylinder (rad)."""
        spacing = 2.0 * math.pi / count
        first = self.first_bearing
        first = 0.5 * spacing if isinstance(first, str) else first
        return [first + spacing * c for c in range(count)]

    def inclination(self, ring: float) -> tuple[float, float]:
        """Cosine of the angle of the cylinders to the vertical, and their length (m).

        ``ring``: elevation of the ring (m), vertically below the centre of the deck.
        """
        up = self.deck_elevation - ring
        length = math.hypot(self.deck_radius - self.ring_radius, up)
        return up / length, length


def fault_of_numbers(numbers: list[int], count: int) -> tuple[str, str] | None:
    """The value found and the allowed values, if numbers are not those of different cylinders."""
    if any(c >= count for c in numbers):
        found = f"{numbers} names a cylinder that does not exist"
        return found, f"use numbers from 0 to {count - 1}, since there are {count} cylinders"
    if twice := [c for c in numbers if numbers.count(c) > 1]:
        return f"cylinder {twice[0]} occurs twice", "list each cylinder once"
    return None


class Failing(Strict):
    """Cylinders (numbered from 0) that fail during the run: they exert no force after the time ``at``."""

    at: Annotated[u.Time, POSITIVE]
    cylinders: Annotated[list[Annotated[int, Field(ge=0)]], Field(min_length=1)]


class Tensioners(Strict):
    """Equal tensioner cylinders between tension ring and deck.

    Damping and stops of the tensioner cylinders are optional.

    The key ``mid_stroke`` selects the state of the riser in which all cylinders are at mid-stroke: either the
    unstretched riser, or the equilibrium with the tension that the cylinders have at mid-stroke. In either
    state of the riser for ``mid_stroke``, the riser is vertical, in still water, at an offset of zero, and no
    cylinder has failed.

    Give exactly one law for the pull of a tensioner cylinder, by one of the keys ``gas``,
    ``two_chamber_gas``, ``linear``, ``carried`` or ``table``. The key ``linearised`` replaces a gas law by a
    straight line. The key ``table`` gives the pull of one cylinder as a function of its reach (its extension
    from mid-stroke). Between the rows of the table, the engine interpolates the pull smoothly and
    monotonically, or linearly with ``interpolation: linear``. Beyond the ends of the tensioner table, the
    pull continues linearly, and the run prints a warning.

    Without ``arrangement``, the tensioner cylinders are vertical. The key ``failed`` lists tensioner
    cylinders (numbered from 0) that exert no force from the start. The key ``failing`` lists tensioner
    cylinders that fail during the run.
    """

    count: Annotated[int, Field(ge=1, le=1000), WHOLE]
    mid_stroke: Literal["riser unstretched", "riser in equilibrium"]
    gas: Gas | None = None
    two_chamber_gas: TwoChamberGas | None = None
    linearised: Linearised | None = None
    linear: Linear | None = None
    table: Annotated[list[TableRow], Field(min_length=2)] | None = None
    interpolation: Literal["cubic", "linear"] | None = None
    carried: Carried | None = None
    damping: Annotated[u.Damping, NOT_NEGATIVE] | DampingRatio | None = None
    stroke: Stroke | None = None
    arrangement: Arrangement | None = None
    failed: list[Annotated[int, Field(ge=0)]] | None = None
    failing: Failing | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        failed, failing = self.failed or [], self.failing.cylinders if self.failing else []
        for path, numbers in (("failed", failed), ("failing.cylinders", failing)):
            if fault := fault_of_numbers(numbers, self.count):
                raise Misfit(path, *fault)
        if len(failed) == self.count:
            found = f"all {self.count} cylinders have failed"
            raise Misfit("failed", found, "leave at least one cylinder that works")
        if both := [c for c in failing if c in failed]:
            found = f"cylinder {both[0]} is also listed in 'failed'"
            raise Misfit("failing.cylinders", found, "list only cylinders that work at the start")
        laws = [self.gas, self.two_chamber_gas, self.linear, self.table, self.carried]
        if laws.count(None) != len(laws) - 1:
            given = "none" if laws.count(None) == len(laws) else "more than one"
            raise Misfit(
                "", f"{given} of gas, two_chamber_gas, linear, table and carried is given", "give exactly one"
            )
        if isinstance(self.damping, DampingRatio) and self.carried is None:
            found = "damping.ratio applies to tensioners with 'carried' only"
            raise Misfit("", found, "give damping as a value, such as '1 N*s/m'")
        if self.table:
            self._serves(self.table)
        elif self.interpolation:
            raise Misfit("interpolation", "has no effect without a table", "add table, or remove it")
        if self.linearised and self.any_gas is None:
            raise Misfit("", "linearised requires gas or two_chamber_gas", "add one of them")
        for part in ("stroke", "linearised"):
            for end in ("shortest", "longest", "at"):
                self._stays_open(f"{part}.{end}", getattr(getattr(self, part), end, None))
        return self

    def _serves(self, table: list[TableRow]) -> None:
        """Refuse a table that is not a force law, or does not cover the stroke."""
        reach, force = [row.reach for row in table], [row.force for row in table]
        for k in range(1, len(table)):
            if reach[k] <= reach[k - 1]:
                found = f"the reach {reach[k]:g} m in row {k + 1} is not greater than in the row before"
                raise Misfit("table", found, "order the rows by reach")
            if force[k] < force[k - 1]:
                raise Misfit(
                    "table",
                    f"the force decreases to {force[k]:g} N in row {k + 1}",
                    "give forces that do not decrease as the cylinder extends",
                )
        first, last = reach[0], reach[-1]
        if self.stroke:
            close = ROUNDING * (last - first)
            shortest, longest = self.stroke.shortest, self.stroke.longest
            if first > shortest + close or last < longest - close:
                raise Misfit(
                    "table",
                    f"covers a reach from {reach[0]:g} m to {reach[-1]:g} m only",
                    f"extend it to the whole stroke, {shortest:g} m to {longest:g} m",
                )
            first, last = shortest, longest
        if not first < 0 < last:
            found = f"covers a reach from {first:g} m to {last:g} m, without mid-stroke"
            raise Misfit("table", found, "give rows below and above a reach of 0 m")

    def _stays_open(self, part: str, reach: float | None) -> None:
        """Refuse an extension at which a gas volume would be zero or less."""
        pulling = self.pulling
        pushing = self.two_chamber_gas.low if self.two_chamber_gas else None
        if pulling is None or reach is None:
            return
        room = pulling.volume / pulling.area
        if reach >= room:
            raise Misfit(
                "",
                f"at {part} {reach:g} m no gas volume is left",
                f"give less than {room:g} m, or a larger gas volume",
            )
        if pushing and reach <= -pushing.volume / pushing.area:
            raise Misfit(
                "",
                f"at {part} {reach:g} m no low-pressure gas volume is left",
                f"give more than {-pushing.volume / pushing.area:g} m, or a larger volume",
            )

    def carrying(self, weight: float, mass: float, ring: float) -> Tensioners:
        """A copy with the linear law and damping that follow from the suspended weight (N) and mass (kg).

        ``ring``: elevation of the ring at mid-stroke (m), on which the inclination of the cylinders depends.
        """
        if self.carried is None:
            return self
        share, place = 1.0 / sum(self.working), self.arrangement
        cosine, length = place.inclination(ring) if place else (1.0, math.inf)
        pull = weight / cosine
        stiffness = self.carried.stiffness(pull)
        line = Linear.model_construct(tension=share * pull, stiffness=share * stiffness)
        damping = self.damping
        if isinstance(damping, DampingRatio):
            vertical = stiffness * cosine**2 + pull * (1.0 - cosine**2) / length
            damping = share * damping.damping(vertical, mass) / cosine**2
        return self.replaced(carried=None, linear=line, damping=damping)

    @property
    def damper(self) -> float:
        """Damping of one cylinder (N s/m), 0 without damping."""
        return self.damping if isinstance(self.damping, float) else 0.0

    @property
    def working(self) -> list[float]:
        """Share of the law that each cylinder pulls: 1, or 0 if it has failed."""
        return [0.0 if c in (self.failed or []) else 1.0 for c in range(self.count)]

    @property
    def still_working(self) -> list[float]:
        """Share of the law (1) that each cylinder pulls after those in ``failing`` have failed, too."""
        late = self.failing.cylinders if self.failing else []
        return [0.0 if c in late else share for c, share in enumerate(self.working)]

    def is_even_sided(self, shares: list[float]) -> bool:
        """Whether pulls with these shares (1) of one law, by cylinder, are symmetric about the x-z plane."""
        if self.arrangement is None:
            return True
        places = [
            (round(math.cos(b), 9), round(math.sin(b), 9) + 0.0, share)
            for b, share in zip(self.arrangement.bearings(self.count), shares, strict=True)
            if share
        ]
        return sorted(places) == sorted((x, -y + 0.0, share) for x, y, share in places)

    def pulls_aside(self, shares: list[float]) -> bool:
        """Whether pulls with these shares (1) of one law, by cylinder, have a resultant force along x."""
        if self.arrangement is None:
            return False
        bearings = self.arrangement.bearings(self.count)
        along = (share * math.cos(b) for b, share in zip(bearings, shares, strict=True))
        return abs(sum(along)) > 1e-9 * self.count

    @property
    def piston_mass(self) -> float:
        """Mass of the piston and rod of one cylinder (kg)."""
        pistons = self.two_chamber_gas.pistons if self.two_chamber_gas else None
        if pistons is None:
            return 0.0
        return pistons.mass / (self.count if pistons.counted == "once" else 1)

    @property
    def pulling(self) -> Chamber | None:
        """The chamber whose gas pulls the ring up."""
        return self.two_chamber_gas.high if self.two_chamber_gas else self.gas

    @property
    def any_gas(self) -> Gas | TwoChamberGas | None:
        """The gas law, of one chamber or two."""
        return self.gas or self.two_chamber_gas
