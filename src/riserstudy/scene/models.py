"""The scene: a riser and what acts on it.

Every section is present or absent; what is absent is not simulated. Fields hold SI once read. No field has
a default that changes physics: an absent section stands for an absent effect, and its docstring says so.
"""

from __future__ import annotations

import math
from typing import Annotated, Self

from pydantic import Field, model_validator

from riserstudy.scene import units as u
from riserstudy.scene.analysis import Analysis
from riserstudy.scene.base import ALONG_X, POSITIVE, Strict
from riserstudy.scene.buoyancy import Buoyancy
from riserstudy.scene.disconnect import Disconnect
from riserstudy.scene.ends import Body, Bottom, TensionLoss, Top
from riserstudy.scene.forcing import Current, Platform, Shape, Water
from riserstudy.scene.geometry import closes, covered
from riserstudy.scene.limits import Limit
from riserstudy.scene.limits import fits as limits_fit
from riserstudy.scene.riser import Section
from riserstudy.scene.sea import IrregularSea, RegularWave
from riserstudy.scene.soil import Soil
from riserstudy.scene.vessel import Vessel
from riserstudy.scene.weight import weighed


class Scene(Strict):
    """A riser and what acts on it. ``paper`` makes plain values published; without it, given."""

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
    analysis: Analysis

    @model_validator(mode="after")
    def _fits(self) -> Self:
        return self.fitted()

    def fitted(self) -> Self:
        """The scene, once its checked parts are seen to fit together; ValueError where they do not."""
        wet = [s for s in self.riser if s.drag or s.tangential_drag or s.added_mass]
        if wet and self.water is None:
            raise ValueError(f"riser section {wet[0].name!r} has drag or added mass: needs water")
        if self.current and self.water is None:
            raise ValueError("current needs water")
        in_water = any(s.drag for s in self.riser) or (self.vessel and self.vessel.hull_drag)
        if self.current and not in_water:
            raise ValueError("current needs a riser section with drag, or a vessel with hull_drag")
        self._fits_the_sea()
        if any(s.contents for s in self.riser) and self.gravity is None:
            raise ValueError("contents need gravity")
        rig = self.top.tensioners
        if rig and rig.piston_mass and self.gravity is None:
            raise ValueError("pistons need gravity")
        if any(body.displaced_volume is not None or body.density for body in self.bodies) and (
            self.gravity is None or self.water is None
        ):
            raise ValueError("a body's displaced_volume or density needs gravity and water")
        if self.bottom.hold == "free" and self.top.z == "free" and not self.top.tensioners:
            raise ValueError("both ends are free: hold one, or hang the top on tensioners")
        if self.analysis.duration and not (
            all(s.mass for s in self.riser) or self.top.body or self.bottom.body
        ):
            raise ValueError("dynamics need mass: give every section its mass, or an end a body")
        if self.top.tension_loss and self.analysis.duration is None:
            raise ValueError("top.tension_loss needs analysis.duration: statics are before it")
        if self.lateral and self.top.x is None:
            raise ValueError(f"top.x is needed, because of {self.lateral}")
        bending = [bool(s.young_modulus or s.bending_stiffness) for s in self.riser]
        if any(bending) and not all(bending):
            raise ValueError("riser: give bending stiffness to all sections or to none")
        if len({s.structural_damping for s in self.riser}) > 1:
            raise ValueError("riser: structural_damping must be the same in all sections")
        if self.top.z != "free" and self.bottom.hold == "free" and self.top.elevation is None:
            raise ValueError("a riser that hangs needs top.elevation")
        if self.platform is None and "platform" in (self.top.x, self.top.z):
            raise ValueError("top is on the platform: needs platform")
        joint = self.top.telescopic_joint
        if joint and not all(bending):
            raise ValueError("a telescopic_joint needs bending stiffness in the riser")
        self._fits_vessel_and_soil(all(bending))
        self._starts_gently()
        length = sum(section.total_length for section in self.riser) + (
            joint.length if joint else 0.0
        )
        stations = (self.analysis.output and self.analysis.output.stations) or []
        for s in stations:
            if not 0.0 <= s <= length * (1.0 + 1e-9):
                raise ValueError(
                    f"analysis.output.stations: {s:g} m is not on the riser; "
                    f"allowed is from 0 to {length:g} m"
                )
        closes(self)
        covered(self)
        limits_fit(self)
        self._fits_disconnect()
        return self._loaded()._weighed()._carried()._valved()._with_rigid_body()

    def _fits_disconnect(self) -> None:
        if self.disconnect is None:
            return
        a = self.analysis
        if self.bottom.hold != "wellhead":
            raise ValueError("disconnect needs 'bottom.hold: wellhead', which lets go")
        if a.duration is None or not self.disconnect.at < a.duration:
            raise ValueError("disconnect.at must be before the end of analysis.duration")
        if a.method == "explicit" or a.solver:
            raise ValueError("disconnect needs an implicit method of lumped masses")
        if self.vessel and self.vessel.coupling:
            raise ValueError("disconnect does not go with vessel.coupling; leave coupling out")
        if self.bottom.body and self.bottom.body.reach:
            raise ValueError("disconnect needs a body at a point: leave out bottom.body's reach")
        if self.disconnect.valve and (self.top.tension is None or self.top.tension_loss):
            raise ValueError(
                "disconnect.valve needs top.tension, without a tension_loss of its own"
            )

    def _valved(self) -> Self:
        """The scene with the tension that valves leave after the release."""
        release = self.disconnect
        if release is None or release.valve is None or not self.top.tension:
            return self
        left = 1.0 - release.valve.hold * self._hanging[0] / self.top.tension
        if not left > 0.0:
            raise ValueError(
                f"disconnect.valve: {release.valve.hold:g} of the {self._hanging[0]:.4g} N that hang is no "
                f"less than top.tension, {self.top.tension:.4g} N"
            )
        share = (1.0 - (release.valve.failed or 0.0)) * left
        loss = TensionLoss.model_construct(share=share, at=release.at, over=release.valve.over)
        return self.model_copy(update={"top": self.top.model_copy(update={"tension_loss": loss})})

    @property
    def _hanging(self) -> tuple[float, float]:
        """Weight in water (N) and mass (kg) of riser, contents and bodies."""
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
    def bodies(self) -> list[Body]:
        """What is attached to the riser's ends."""
        return [end.body for end in (self.bottom, self.top) if end.body]

    def _carried(self) -> Self:
        """The scene with the straight lines of tensioners that are set to the weight on them."""
        rig = self.top.tensioners
        if rig is None or rig.carried is None:
            return self
        if self.bottom.hold != "free":
            raise ValueError("tensioners.carried needs a riser that hangs: 'bottom.hold: free'")
        if self.gravity is None:
            raise ValueError("tensioners.carried needs gravity")
        weight, mass = self._hanging
        if weight <= 0.0:
            raise ValueError(f"tensioners.carried: {weight:g} N hangs on them; must be above 0 N")
        top = self.top.model_copy(update={"tensioners": rig.carrying(weight, mass)})
        return self.model_copy(update={"top": top})

    def _loaded(self) -> Self:
        """The scene with the weights and the top tension that a buoyant factor stands for."""
        if self.buoyancy is None:
            return self
        if self.gravity is None or not all(s.mass for s in self.riser):
            raise ValueError("buoyancy needs gravity, and the mass of every section")
        if any(s.submerged_weight is not None for s in self.riser) or self.top.tension is not None:
            raise ValueError("give buoyancy, or submerged_weight and top.tension, not both")
        if self.top.z != "free" or self.top.tensioners:
            raise ValueError("buoyancy gives the top tension: needs 'z: free' without tensioners")
        riser, tension = self.buoyancy.loads(self.riser, self.gravity)
        top = self.top.model_copy(update={"tension": tension})
        return self.model_copy(update={"riser": riser, "top": top})

    def _weighed(self) -> Self:
        """The scene with the weights that follow from masses, diameters and contents."""
        riser = weighed(self)
        return self if riser is self.riser else self.model_copy(update={"riser": riser})

    def _with_rigid_body(self) -> Self:
        """The scene with a section below the riser for the body that turns with its end."""
        body = self.bottom.body
        if body is None or not body.reach:
            return self
        rigid = self.riser[0].rigid(body.name, body.reach)
        return self.model_copy(update={"riser": [rigid, *self.riser]})

    def _fits_vessel_and_soil(self, bends: bool) -> None:
        if (self.vessel is None) != (self.top.x != "vessel"):
            raise ValueError("vessel and 'top.x: vessel' go together")
        if self.vessel and self.platform:
            raise ValueError(
                "give platform, which moves as told, or vessel, which is free; not both"
            )
        turning = self.vessel and self.vessel.yaw and self.spatial
        if turning and self.analysis.method == "explicit":
            raise ValueError(
                "vessel.yaw: explicit stepping does not know the forces of a turning hull; "
                "take an implicit method"
            )
        if self.vessel and self.vessel.coupling:
            self.vessel.coupling.fits(self.analysis)
            self._fits_an_exchange()
        if self.vessel and self.vessel.hull_drag and self.water is None:
            raise ValueError("vessel.hull_drag needs water")
        if (self.bottom.hold == "foot") != (self.soil is not None):
            raise ValueError("soil and 'bottom.hold: foot' go together")
        if self.soil and self.riser[0].outer_diameter is None:
            raise ValueError("soil needs the outer_diameter of the lowest section")
        joints = [s for s in self.riser if s.flex_joint_below]
        if joints and (not bends or len(joints) > 1 or self.riser[0].flex_joint_below):
            raise ValueError(
                "flex_joint_below: one, between sections that bend; the lower end has bottom.rotation"
            )
        if self.riser[0].guide_below and self.bottom.hold != "free":
            raise ValueError(
                "riser[0].guide_below: the bottom is held there; guide a section above"
            )
        gauged = self.analysis.output and self.analysis.output.stress_in
        if gauged and gauged not in [s.name for s in self.riser if s.young_modulus]:
            raise ValueError(
                f"analysis.output.stress_in: no section {gauged!r} with young_modulus and diameters"
            )

    def _starts_gently(self) -> None:
        """Accuracy is not asked for where an end starts with a speed.

        It sends waves of all lengths along the riser: what is not damped is nothing to refine to.
        """
        a = self.analysis
        chosen = a.duration is not None and a.mesh is None and any(s.mass for s in self.riser)
        damped = all(s.structural_damping for s in self.riser)
        later = a.output and a.output.start
        release = self.disconnect
        if release and release.over is None and chosen and not damped:
            raise ValueError(
                "disconnect lets go at once: tensions of an undamped riser then have no peak that a finer "
                "mesh and step would settle; give disconnect.over, structural_damping, or analysis.mesh and "
                "step"
            )
        if self.platform is None or not chosen or (damped and later):
            return
        for line, motion in self.platform.sudden:
            if (self.top.z if motion == "heave" else self.top.x) == "platform":
                raise ValueError(
                    f"platform.{line} starts from rest with a speed: moments and tensions then have no "
                    "peaks that a finer mesh and step would settle; give it a ramp, or "
                    "structural_damping and a later analysis.output.start, or analysis.mesh and step"
                )

    def _fits_an_exchange(self) -> None:
        """What is exchanged is the force of the string's end: nothing else may act there across."""
        top = self.top
        if top.telescopic_joint:
            return
        for name in ("body", "lateral_force", "tensioners"):
            if getattr(top, name) is not None:
                raise ValueError(
                    f"vessel.coupling: top.{name} acts on the platform beside the riser; put a "
                    "telescopic_joint between, or leave coupling out"
                )

    def _fits_the_sea(self) -> None:
        response = self.platform and self.platform.response
        if response and response.wave is None and self.wave is None:
            raise ValueError("platform.response needs a wave, of its own or of the scene")
        levels = self.water and None not in (self.water.surface, self.water.seabed)
        if self.wave:
            if not levels:
                raise ValueError("wave needs water.surface and water.seabed")
            if self.gravity is None:
                raise ValueError("wave needs gravity")
            if not any(s.drag or s.added_mass for s in self.riser):
                raise ValueError("wave needs a riser section with drag or added mass")
            if any(s.added_mass and s.added_mass.direction for s in self.riser):
                raise ValueError("a wave needs added_mass across the pipe: leave out its direction")
        if self.current and self.current.by_depth and (self.water and self.water.surface) is None:
            raise ValueError("current.profile: depths need water.surface")
        for part in self.current.parts if self.current else []:
            own = isinstance(part, Shape) and None not in (part.seabed, part.surface)
            if not own and not levels:
                raise ValueError("current.profile needs water.surface and water.seabed")

    @property
    def shortest_period(self) -> float | None:
        """Shortest period of platform and waves (s)."""
        platform = self.platform or Platform()
        periods = [motion.period for _, motion in platform.harmonics]
        swell = platform.response and platform.response.wave
        periods += [wave.shortest_period for wave in (self.wave, swell) if wave]
        return min(periods, default=None)

    @property
    def jolts(self) -> list[float]:
        """Times from the start on at which accelerations jump (s), in order.

        At the start they do where statics do not hold what acts then.
        """
        a = self.analysis
        found = self.platform.jolts if self.platform else []
        sudden = self.vessel or (self.wave and self.wave.ramp is None)
        if sudden or a.start not in (None, "equilibrium"):
            found.append(0.0)
        if self.disconnect:
            found.append(self.disconnect.at)
        return sorted({t for t in found if t < (a.duration or 0.0)})

    @property
    def lateral(self) -> str:
        """The line of the scene that calls for lateral freedom, "" when none does."""
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
            "platform.response": platform.response
            and ({"surge", "pitch"} & set(platform.response.moving) or None),
            "platform.cruise": platform.cruise,
            "top.offset": self.top.offset,
            "top.tensioners.failed": (self.top.tensioners and self.top.tensioners.pulls_aside)
            or None,
            "top.lateral_force": self.top.lateral_force,
            "riser.lateral_load": [s for s in self.riser if s.lateral_load] or None,
        }
        named = next((name for name, value in reasons.items() if value is not None), "")
        return named or self.spatial

    @property
    def spatial(self) -> str:
        """The line of the scene that calls for motion out of the plane of x and z, "" when none does."""
        platform = self.platform or Platform()
        reasons = {
            f"platform.{where}{name}": getattr(of, name, None)
            for where, of in (("position.", platform.position), ("", platform))
            for name in ("sway", "roll", "yaw")
        }
        moving = platform.response.moving if platform.response else []
        if {"sway", "roll", "yaw"} & set(moving):
            reasons["platform.response"] = moving
        if self.top.tensioners and not self.top.tensioners.even_sided:
            reasons["top.tensioners"] = "uneven"
        if self.current and (line := self.current.leaves_plane):
            reasons[f"current.{line}"] = True
        for name, what in (("platform.cruise", platform.cruise), ("wave", self.wave)):
            if what and abs(math.sin(what.heading or 0.0)) > ALONG_X:
                reasons[f"{name}.heading"] = what.heading
        if self.vessel and self.vessel.turned:
            reasons[self.vessel.turned] = True
        return next((name for name, value in reasons.items() if value is not None), "")
