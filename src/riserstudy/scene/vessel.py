"""A freely floating platform and its forces: wind, wave drift, thrusters."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Literal, Self

from pydantic import model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.analysis import Analysis
from riserstudy.scene.base import ALONG_X, NOT_NEGATIVE, POSITIVE

# most exchanges of platform and riser; each costs about 100 us, and its time steps
MOST_TURNS = 1_000_000
MOST_STEPS_A_TURN = 100_000  # most time steps in an exchange, whose motions and forces are kept
# fewest time steps in an exchange: runs with two and four times the time step estimate the error
STEPS_A_TURN = 4


class Wind(Strict):
    """Wind force on the platform, C |u| u.

    In the formula of the wind force, C is the key ``drag``, and u is the velocity of the wind relative to the
    platform. By default, the wind of a scene blows towards +x.
    """

    drag: Annotated[u.QuadraticDrag, NOT_NEGATIVE]
    speed: u.Speed
    heading: u.Angle | None = None


class WaveDrift(Strict):
    """Mean second-order force of the waves. By default, the mean drift force of the waves acts along +x."""

    force: Annotated[u.Force, NOT_NEGATIVE]
    heading: u.Angle | None = None


class SidewaysThrust(Strict):
    """Gains of the thrusters across the hull.

    Without ``velocity_gain``, the thrusters do not damp the vessel's motion.
    """

    gain: Annotated[u.Stiffness, NOT_NEGATIVE]
    velocity_gain: Annotated[u.Damping, NOT_NEGATIVE] | None = None


class Turning(Strict):
    """Moment of the thrusters about the vertical axis, G (psi_c - psi) - D d psi/dt.

    In the formula of the moment, psi is the present yaw angle of the vessel, and psi_c is ``command``, the
    commanded yaw angle. The yaw angles psi and psi_c are measured from the vessel's initial heading. In the
    formula of the moment, G is the key ``gain``, and D is the key ``velocity_gain``. Without ``command``, the
    commanded yaw angle is zero. Without ``velocity_gain``, the thrusters do not damp the yaw of the vessel.
    Without ``saturation``, the moment of the thrusters is unlimited.
    """

    gain: Annotated[u.RotationalStiffness, NOT_NEGATIVE]
    command: u.Angle | None = None
    velocity_gain: Annotated[u.RotationalDamping, NOT_NEGATIVE] | None = None
    saturation: Annotated[u.Moment, POSITIVE] | None = None


class Thrusters(Strict):
    """Thrust G (x_c - x) - D v towards the commanded position x_c, measured from the point above the well.

    In the formula of the thrust, G is the key ``gain``, D is the key ``velocity_gain``, and x and v are the
    position and the velocity of the vessel. The gains of the thrusters apply along and across the hull in its
    initial position. The key ``command`` is the distance of the commanded position from the point above the
    well, and the key ``heading`` gives the direction of the commanded position. Without ``heading``, the
    commanded position is on the x axis. Without ``velocity_gain``, the thrusters do not damp the motion of
    the vessel. Without ``saturation``, the thrust is unlimited. With ``saturation``, the magnitude of the
    thrust is at most ``saturation`` in all directions. By default, the commanded position applies from the
    start. With the key ``rise``, the commanded distance increases in proportion to 1 - exp(-t / rise). By
    default, the thrust follows its formula without delay. With the key ``lag``, the thrust follows its
    formula with the time constant ``lag``. In a scene without the key ``sway`` of the vessel, the thrusters
    exert no thrust across the hull. Without the key ``yaw``, the thrusters exert no moment on the vessel.
    """

    gain: Annotated[u.Stiffness, NOT_NEGATIVE]
    command: u.Length
    heading: u.Angle | None = None
    velocity_gain: Annotated[u.Damping, NOT_NEGATIVE] | None = None
    saturation: Annotated[u.Force, POSITIVE] | None = None
    rise: Annotated[u.Time, POSITIVE] | None = None
    lag: Annotated[u.Time, POSITIVE] | None = None
    sway: SidewaysThrust | None = None
    yaw: Turning | None = None


class Sway(Strict):
    """Freedom of a vessel to move sideways.

    The added mass and the hull drag of a vessel across the hull are zero if they are not given.
    """

    added_mass: Annotated[u.Mass, NOT_NEGATIVE] | None = None
    hull_drag: Annotated[u.QuadraticDrag, NOT_NEGATIVE] | None = None


class Yaw(Strict):
    """Freedom of a vessel to rotate about the vertical axis through the riser's top.

    The moment of the hull drag on a rotating vessel is C |dpsi/dt| dpsi/dt, with the yaw angle psi and the
    key ``hull_drag`` (C). The added inertia and the hull drag of a rotating vessel are zero if they are not
    given.
    """

    inertia: Annotated[u.MomentOfInertia, POSITIVE]
    added_inertia: Annotated[u.MomentOfInertia, NOT_NEGATIVE] | None = None
    hull_drag: Annotated[u.RotationalDrag, NOT_NEGATIVE] | None = None


class Coupling(Strict):
    """Solution of platform and riser in turn, over intervals of time.

    With ``scheme: staggered``, the engine first moves the platform over each interval, with the riser's force
    at the start of the interval. With ``scheme: staggered``, the engine then simulates the riser with the
    computed platform motion. With ``scheme: iterated``, the engine repeats each interval with the new force
    of the riser, until the platform motion changes by less than ``tolerance``. The default of the key
    ``tolerance`` of ``coupling`` is the limit for corrections of positions in Newton's iteration.
    """

    scheme: Literal["staggered", "iterated"]
    interval: Annotated[u.Time, POSITIVE]
    tolerance: Annotated[u.Length, POSITIVE] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.tolerance is not None and self.scheme == "staggered":
            found = "has no effect with 'scheme: staggered', which does not iterate"
            raise Misfit("tolerance", found, "remove it, or write 'scheme: iterated'")
        return self

    def misfits(self, analysis: Analysis) -> Iterator[Misfit]:
        """Faults of an analysis in which platform and riser cannot be solved alternately."""
        if analysis.duration is None:
            found, also = "applies to dynamic runs only", ("analysis.duration",)
            yield Misfit("", found, "add analysis.duration, or remove coupling", also)
            return
        also = ("analysis",)
        if isinstance(analysis.method, str):
            found = f"does not work with analysis.method {analysis.method}"
            remedy = "use generalised-alpha (analysis.method.rho_inf) or Newmark's method (beta and gamma)"
            yield Misfit("", found, remedy, also)
        if analysis.solver:
            found = f"does not work with analysis.solver {analysis.solver}"
            yield Misfit("", found, "remove analysis.solver, or coupling", also)
        if analysis.start not in (None, "equilibrium"):
            found = f"does not work with 'analysis.start: {analysis.start}'"
            yield Misfit("", found, "write 'start: equilibrium', or remove analysis.start", also)
        path, interval, step = "interval", f"{self.interval:g} s", analysis.step
        if self.interval > analysis.duration:
            allowed = f"give at most analysis.duration, {analysis.duration:g} s"
            yield Misfit(path, f"{interval} is longer than the run", allowed, also)
        if analysis.duration / self.interval > MOST_TURNS:
            found = f"{interval} gives more than {MOST_TURNS} intervals in the run"
            yield Misfit(path, found, "give a longer interval", also)
        if step and self.interval / step > MOST_STEPS_A_TURN:
            found = f"{interval} contains more than {MOST_STEPS_A_TURN} time steps of {step:g} s"
            yield Misfit(path, found, "give a shorter interval", also)
        if step and STEPS_A_TURN * step > self.interval * (1.0 + 1e-9):
            found = f"{interval} is too short for the estimate of the error, which uses longer time steps"
            remedy = f"give at least {STEPS_A_TURN} times analysis.step, {STEPS_A_TURN * step:g} s"
            yield Misfit(path, found, remedy, also)


class Vessel(Strict):
    """A floating platform, whose motion is computed together with the motion of the riser.

    Added mass, hull drag, wind, wave drift and thrusters of a vessel are zero if they are not given. The hull
    drag depends on the velocity of the vessel relative to the surface current. Without ``sway``, the vessel
    moves only along x. Without ``yaw``, the vessel keeps its heading. Without ``heading``, the hull of the
    vessel is along x. If all loads act along x, the vessel does not sway or turn, and the engine omits sway
    and yaw. The engine solves vessel and riser as one system, or alternately with the key ``coupling``.

    The riser's top and the deck move with the sum of the slow motion of the vessel and the first-order
    (wave-frequency) motions, which the key ``platform`` gives. Hull drag, inertia and thrusters respond only
    to the slow motion. The mean wave drift acts on the vessel as a constant force. The outputs
    ``low_frequency_surge`` and ``low_frequency_sway`` give the slow motion. The outputs ``platform_surge``
    and ``platform_sway`` give the sum of slow and first-order motion.
    """

    mass: Annotated[u.Mass, POSITIVE]
    added_mass: Annotated[u.Mass, NOT_NEGATIVE] | None = None
    hull_drag: Annotated[u.QuadraticDrag, NOT_NEGATIVE] | None = None
    heading: u.Angle | None = None
    sway: Sway | None = None
    yaw: Yaw | None = None
    wind: Wind | None = None
    wave_drift: WaveDrift | None = None
    thrusters: Thrusters | None = None
    coupling: Coupling | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        thrusters = self.thrusters
        if self.yaw and self.sway is None:
            raise Misfit("", "yaw requires sway", "add sway")
        if thrusters and thrusters.sway and self.sway is None:
            raise Misfit("", "thrusters.sway requires a vessel that can sway", "add sway")
        if thrusters and thrusters.yaw and self.yaw is None:
            raise Misfit("", "thrusters.yaw requires a vessel that can yaw", "add yaw")
        if self.sway is None and (self.heading or _oblique(thrusters)):
            raise Misfit("", "a heading of the hull or of the thrusters' command requires sway", "add sway")
        return self

    @property
    def turned(self) -> str:
        """The key that makes it sway or turn, where it is free to; "" if none. Excludes current and waves."""
        if self.sway is None:
            return ""
        thrusters, yaw = self.thrusters, self.thrusters and self.thrusters.yaw
        reasons = {
            "vessel.heading": _oblique(self),
            "vessel.wind.heading": _oblique(self.wind),
            "vessel.wave_drift.heading": _oblique(self.wave_drift),
            "vessel.thrusters.heading": _oblique(thrusters),
            "vessel.thrusters.yaw.command": bool(yaw and yaw.command),
        }
        return next((name for name, given in reasons.items() if given), "")


def _oblique(of: Vessel | Wind | WaveDrift | Thrusters | None) -> bool:
    """Whether its heading is out of the plane of x and z."""
    return of is not None and abs(math.sin(of.heading or 0.0)) > ALONG_X
