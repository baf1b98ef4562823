"""The scene: a riser and what acts on it.

Every section is present or absent; what is absent is not simulated. Fields hold SI once read. No field has
a default that changes physics: an absent section stands for an absent effect, and its docstring says so.
"""

from __future__ import annotations

from typing import Self

from pydantic import model_validator

from riserstudy.scene.ends import TensionLoss
from riserstudy.scene.fitting import fit
from riserstudy.scene.forcing import Translation
from riserstudy.scene.parts import Parts
from riserstudy.scene.waterline import cut
from riserstudy.scene.weight import dressed, weighed


class Scene(Parts):
    """A riser and what acts on it. ``paper`` makes plain values published; without it, given."""

    @model_validator(mode="after")
    def _fits(self) -> Self:
        return self.fitted()

    def fitted(self) -> Self:
        """The scene with what follows from its parts; ValueError where they do not fit together."""
        fit(self)
        return (
            self._loaded()
            ._cut()
            ._weighed()
            ._dressed()
            ._carried()
            ._timed()
            ._valved()
            ._with_rigid_body()
        )

    def _timed(self) -> Self:
        """The scene with the time of the release that a phase of heave stands for."""
        release = self.disconnect
        if release is None or release.phase is None:
            return self
        heave = self.platform.heave if self.platform else None
        if not isinstance(heave, Translation):
            raise ValueError("disconnect.phase needs platform.heave, one harmonic")
        timed = release.timed(heave.period, heave.phase or 0.0)
        if not timed.at < (self.analysis.duration or 0.0):
            raise ValueError(
                f"disconnect: its phase comes at {timed.at:g} s, not before the end of analysis.duration"
            )
        return self.model_copy(update={"disconnect": timed})

    def _valved(self) -> Self:
        """The scene with the tension that valves leave after the release."""
        release = self.disconnect
        if release is None or release.valve is None or not self.top.tension:
            return self
        left = 1.0 - release.valve.hold * self.hanging[0] / self.top.tension
        if not left > 0.0:
            raise ValueError(
                f"disconnect.valve: {release.valve.hold:g} of the {self.hanging[0]:.4g} N that hang is no "
                f"less than top.tension, {self.top.tension:.4g} N"
            )
        share = (1.0 - (release.valve.failed or 0.0)) * left
        loss = TensionLoss.model_construct(share=share, at=release.at, over=release.valve.over)
        return self.model_copy(update={"top": self.top.model_copy(update={"tension_loss": loss})})

    def _carried(self) -> Self:
        """The scene with the straight lines of tensioners that are set to the weight on them."""
        rig = self.top.tensioners
        if rig is None or rig.carried is None:
            return self
        if self.bottom.hold != "free":
            raise ValueError("tensioners.carried needs a riser that hangs: 'bottom.hold: free'")
        if self.gravity is None:
            raise ValueError("tensioners.carried needs gravity")
        weight, mass = self.hanging
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
        if any(s.modules or s.lines for s in self.riser):
            raise ValueError("give buoyancy, or modules and lines of sections, not both")
        if any(s.submerged_weight is not None for s in self.riser) or self.top.tension is not None:
            raise ValueError("give buoyancy, or submerged_weight and top.tension, not both")
        if self.top.z != "free" or self.top.tensioners:
            raise ValueError("buoyancy gives the top tension: needs 'z: free' without tensioners")
        riser, tension = self.buoyancy.loads(self.riser, self.gravity)
        top = self.top.model_copy(update={"tension": tension})
        return self.model_copy(update={"riser": riser, "top": top})

    def _cut(self) -> Self:
        """The scene with sections cut where they leave the water, if their weights follow."""
        riser = cut(self)
        return self if riser is self.riser else self.model_copy(update={"riser": riser})

    def _weighed(self) -> Self:
        """The scene with the weights that follow from masses, diameters and contents."""
        riser = weighed(self)
        return self if riser is self.riser else self.model_copy(update={"riser": riser})

    def _dressed(self) -> Self:
        """The scene with what modules and lines add to the pipe."""
        riser = dressed(self)
        return self if riser is self.riser else self.model_copy(update={"riser": riser})

    def _with_rigid_body(self) -> Self:
        """The scene with a section below the riser for the body that turns with its end."""
        body = self.bottom.body
        if body is None or not body.reach:
            return self
        rigid = self.riser[0].rigid(body.name, body.reach)
        return self.model_copy(update={"riser": [rigid, *self.riser]})
