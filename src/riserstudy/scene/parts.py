"""The parts of a scene as in its file, and properties that follow from them."""

from __future__ import annotations

import math
from itertools import accumulate
from typing import Annotated, Any

from pydantic import Field, field_validator

from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.analysis import Analysis
from riserstudy.scene.base import ALONG_X, POSITIVE
from riserstudy.scene.buoyant_factor import Buoyancy
from riserstudy.scene.disconnect import Disconnect
from riserstudy.scene.ends import Body, Bottom, Top
from riserstudy.scene.fatigue import Fatigue
from riserstudy.scene.forcing import Current, Platform, TimeSeries
from riserstudy.scene.limits import Limit
from riserstudy.scene.riser import RigidBody, Section
from riserstudy.scene.sea import IrregularSea, RegularWave, Storm, Swell
from riserstudy.scene.soil import Soil
from riserstudy.scene.vessel import Vessel
from riserstudy.scene.water import Water


class Parts(Strict):
    """A riser, its supports and its loads, part by part."""

    title: str
    paper: str | None = None
    note: str | None = None
    gravity: Annotated[u.Acceleration, POSITIVE] | None = None
    water: Water | None = None
    riser: Annotated[list[Section], Field(min_length=1)]
    buoyancy: Buoyancy | None = None
    bottom: Bottom
    top: Top
    platform: Platform | None = None
    vessel: Vessel | None = None
    soil: Soil | None = None
    current: Current | None = None
    wave: RegularWave | IrregularSea | None = None
    limits: Annotated[list[Limit], Field(min_length=1)] | None = None
    disconnect: Disconnect | None = None
    fatigue: Fatigue | None = None
    analysis: Analysis

    @field_validator("riser", mode="after")
    @classmethod
    def _know_their_lines(cls, riser: list[Section]) -> list[Section]:
        for k, section in enumerate(riser):
            section.stands_at(f"riser[{k}]")
        return riser

    @property
    def lowest_riser_section(self) -> int:
        """Index of the riser's lowest section: the one above the inner flex joint, 0 without a joint.

        Sections below it are the stack and the conductor, which stand on the seabed and do not hang.
        """
        jointed = (k for k, section in enumerate(self.riser) if section.flex_joint_below)
        return next(jointed, 0)

    @property
    def borders(self) -> list[float]:
        """Unstretched arclengths of the ends of sections (m), from the lower end on, (sections + 1,)."""
        return list(accumulate((section.total_length for section in self.riser), initial=0.0))

    @property
    def riser_sections(self) -> list[Section]:
        """Sections of the riser itself, without stack and conductor below its flex joint."""
        return self.riser[self.lowest_riser_section :]

    @property
    def sections(self) -> list[Section]:
        """Sections as in the scene's file, without the section that represents a rigid body below them."""
        return [section for section in self.riser if not isinstance(section, RigidBody)]

    @property
    def bodies(self) -> list[Body]:
        """Bodies attached to the riser's ends."""
        return [end.body for end in (self.bottom, self.top) if end.body]

    @property
    def ground(self) -> float | None:
        """Elevation (m) below which there is no water: the mudline, or else the seabed; None if unknown."""
        if self.soil:
            return self.soil.mudline
        return self.water.seabed if self.water else None

    @property
    def ring_weight(self) -> float:
        """Submerged weight (N) of the body at the riser's upper end, such as a tension ring; 0 without."""
        body, water = self.top.body, self.water.density if self.water else 0.0
        return body.weight(self.gravity or 0.0, water) if body else 0.0

    @property
    def hanging(self) -> tuple[float, float]:
        """Submerged weight (N) and mass (kg) of riser, contents and bodies together."""
        gravity, water = self.gravity or 0.0, self.water.density if self.water else 0.0
        weight = sum(body.weight(gravity, water) for body in self.bodies)
        mass = sum(body.mass for body in self.bodies)
        for section in self.riser:
            inside = section.contents_mass
            length = section.total_length
            weight += ((section.submerged_weight or 0.0) + inside * gravity) * length
            mass += ((section.mass or 0.0) + inside) * length
        return weight, mass

    @property
    def drains(self) -> bool:
        """Whether contents drain during a run."""
        return bool(self.analysis.duration and self.disconnect and self.disconnect.drain)

    @property
    def shortest_period(self) -> float | None:
        """Shortest period of platform motions and waves (s); None without them."""
        motions = self.platform.harmonics if self.platform else []
        periods = [motion.period for _, motion in motions]
        return min([*periods, *(wave.shortest_period for wave in self.waves.values())], default=None)

    @property
    def shortest_regular_period(self) -> float | None:
        """Shortest period of harmonic motions and regular waves (s); None without them."""
        return min(self.regular_periods, default=None)

    @property
    def regular_periods(self) -> list[float]:
        """Periods of harmonic motions and regular waves (s)."""
        motions = self.platform.harmonics if self.platform else []
        periods = [motion.period for _, motion in motions if motion.amplitude]
        return periods + [wave.period for wave in self.waves.values() if isinstance(wave, Swell)]

    @property
    def waves(self) -> dict[str, Swell | Storm]:
        """Waves of the response of its platform, and on the riser, by path."""
        response = self.platform and self.platform.response
        there = {"platform.response.wave": response and response.wave, "wave": self.wave}
        return {path: wave for path, wave in there.items() if wave}

    @property
    def irregular_waves(self) -> dict[str, Storm]:
        """Irregular seas among its waves, by path."""
        return {path: wave for path, wave in self.waves.items() if isinstance(wave, Storm)}

    @property
    def jolts(self) -> list[float]:
        """Times from the start on at which accelerations jump (s), in order.

        They jump at the start where the initial static state does not balance the loads at t = 0.
        """
        a = self.analysis
        times = self.platform.jolts if self.platform else []
        sudden = self.vessel or (self.wave and self.wave.ramp is None)
        if sudden or a.start not in (None, "equilibrium"):
            times.append(0.0)
        times += self.events
        return sorted({t for t in times if t < (a.duration or 0.0)})

    @property
    def built_up(self) -> float:
        """Time at which the last ramp that the scene gives has ended (s)."""
        platform = self.platform or Platform()
        response = platform.response
        moving = [motion for _, motion in platform.harmonics]
        vortices = (section.viv for section in self.riser)
        growing = (*moving, platform.cruise, response, self.wave, self.current, *vortices)
        return max((part.ramp or 0.0 for part in growing if part), default=0.0)

    @property
    def events(self) -> list[float]:
        """Times at which a part of the system changes, such as a disconnect (s), in order."""
        release, loss, rig = self.disconnect, self.top.tension_loss, self.top.tensioners
        times = [release.at] if release else []
        if release and release.recoil_valve and (shut := release.recoil_valve.isolation):
            times.append(release.at + shut.after)
        if loss and loss.over is None:
            times.append(loss.at)
        if rig and rig.failing:
            times.append(rig.failing.at)
        return sorted(set(times))

    @property
    def lower_joint_until(self) -> float:
        """Time at which a disconnect opens the flex joint at the riser's lower end (s); infinite without."""
        inner = any(section.flex_joint_below for section in self.riser)
        return self.disconnect.at if self.disconnect and not inner else math.inf

    @property
    def connected_until(self) -> float:
        """Time at which a disconnect ends the operations of a connected riser (s); infinite without."""
        return self.disconnect.at if self.disconnect else math.inf

    @property
    def lateral(self) -> str:
        """The key of the scene that requires lateral freedom, "" when none does."""
        platform = self.platform or Platform()
        reasons = {
            "current": self.current,
            "wave": self.wave,
            "platform.position.surge": platform.position and platform.position.surge,
            "platform.position.pitch": platform.position and platform.position.pitch,
            "platform.surge": platform.surge,
            "vessel": self.vessel,
            "soil": self.soil,
            "platform.pitch": platform.pitch,
            "platform.response": {"surge", "pitch"} & self._response or None,
            "platform.cruise": platform.cruise,
            "top.offset": self.top.offset,
            **{name: True for name, (_, aside) in self._pulls.items() if aside},
            "top.lateral_force": self.top.lateral_force,
            "riser.lateral_load": [s for s in self.riser if s.lateral_load] or None,
        }
        named = next((name for name, value in reasons.items() if value is not None), "")
        return named or self.spatial

    @property
    def spatial(self) -> str:
        """The key of the scene that requires motion out of the plane of x and z, "" when none does."""
        platform = self.platform or Platform()
        reasons = {
            f"platform.{where}{name}": _moving(getattr(of, name, None))
            for where, of in (("position.", platform.position), ("", platform))
            for name in ("sway", "roll", "yaw")
        }
        if aside := {"sway", "roll", "yaw"} & self._response:
            reasons["platform.response"] = aside
        reasons |= {name: True for name, (even, _) in self._pulls.items() if not even}
        if self.current and (line := self.current.leaves_plane):
            reasons[f"current.{line}"] = True
        for name, part in (("platform.cruise", platform.cruise), ("wave", self.wave)):
            if part and abs(math.sin(part.heading or 0.0)) > ALONG_X:
                reasons[f"{name}.heading"] = part.heading
        if self.vessel and self.vessel.turned:
            reasons[self.vessel.turned] = True
        if any(section.viv for section in self.riser):
            reasons["riser.viv"] = True  # across the flow
        return next((name for name, value in reasons.items() if value is not None), "")

    @property
    def _response(self) -> set[str]:
        """Motions of the platform in its waves; those whose operators are zero in these waves are none.

        A limit on y counts in waves from all directions, so it needs all motions in each of them.
        """
        response = self.platform.response if self.platform else None
        if response is None:
            return set()
        aside = any(limit.output == "y" for limit in self.limits or [])
        return set(response.moving if aside else response.moves_in(response.wave or self.wave))

    @property
    def _pulls(self) -> dict[str, tuple[bool, bool]]:
        """Whether cylinders pull evenly on both sides of the plane, and whether along x, by stage of a run.

        The key of the scene names the stage: cylinders may fail, and valves stay open after a release. An
        open valve has twice the share of a closed one here: any other share gives the same answer.
        """
        rig, release = self.top.tensioners, self.disconnect
        if rig is None:
            return {}
        open_ones = (release and release.recoil_valve and release.recoil_valve.failed) or []
        valves = [2.0 if c in open_ones else 1.0 for c in range(rig.count)]
        stages = {"top.tensioners": [rig.working]}
        if rig.failing:
            stages["top.tensioners.failing"] = [rig.still_working]
        if open_ones:
            each = [
                [v * w for v, w in zip(valves, of, strict=True)] for of in (rig.working, rig.still_working)
            ]
            stages["disconnect.recoil_valve.failed"] = each
        return {
            name: (all(map(rig.is_even_sided, of)), any(map(rig.pulls_aside, of)))
            for name, of in stages.items()
        }


def _moving(motion: Any) -> Any:
    """A motion; None for a record whose values are all zero."""
    still = isinstance(motion, TimeSeries) and not any(point.value for point in motion.points)
    return None if still else motion
