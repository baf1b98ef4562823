"""Waves, and the drift that wind makes of the sea's surface."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import POSITIVE, WHOLE, Positive


class Wave(Strict):
    """What regular wave and irregular sea share.

    Absent heading: along x. Absent ramp: all at once, after a rest at t = 0.
    """

    heading: u.Angle | None = None
    ramp: Annotated[u.Time, POSITIVE] | None = None
    above_mean_level: Literal["none", "constant", "stretched"]


class Swell(Strict):
    """Regular waves of an amplitude, or a height of twice that. Absent phase: 0."""

    height: Annotated[u.Length, POSITIVE] | None = None
    amplitude: Annotated[u.Length, POSITIVE] | None = None
    period: Annotated[u.Time, POSITIVE]
    phase: u.Angle | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.height is None) == (self.amplitude is None):
            raise ValueError("needs one of height and amplitude")
        return self

    @property
    def shortest_period(self) -> float:
        """Its period (s)."""
        return self.period


class RegularWave(Swell, Wave):
    """A regular Airy wave, of an amplitude, or a height of twice that.

    Its surface is amplitude cos(k x - 2 pi t / period + phase); absent phase: 0. Absent heading: along
    x. Absent ramp: all at once, after a rest at t = 0. Above the mean level there is no wave, that at
    the mean level up to the surface (constant), or the profile is stretched (Wheeler).
    """


class Storm(Strict):
    """A JONSWAP spectrum: components of equal energy, with random phases by a seed."""

    significant_height: Annotated[u.Length, POSITIVE]
    peak_period: Annotated[u.Time, POSITIVE]
    peak_enhancement: Annotated[float, Field(ge=1, le=20)]
    components: Annotated[int, Field(ge=2, le=10000), WHOLE]
    seed: Annotated[int, Field(ge=0), WHOLE]

    @property
    def shortest_period(self) -> float:
        """Half the peak period: shorter waves hold a tenth of the energy (s)."""
        return 0.5 * self.peak_period


class IrregularSea(Storm, Wave):
    """A sea with a JONSWAP spectrum: components of equal energy, with random phases by a seed.

    Absent heading: along x. Absent ramp: all at once, after a rest at t = 0. Above the mean level as for
    a regular wave.
    """


class WindDrift(Strict):
    """Ekman's drift of deep water under a steady wind.

    Surface speed is surface_factor W / sqrt(sin latitude); over the friction depth,
    depth_factor W / sqrt(sin latitude), the drift turns by half a turn and falls to a 23rd. At the surface
    it goes 45 degrees off the wind, and turns away from it with depth. The riser feels its part along the
    wind, that across it (which carries all of the transport), its magnitude, or both parts: then the
    current's heading is that of the wind, and the drift turns to the right of it in the northern
    ``hemisphere``, to the left in the southern.
    """

    wind_speed: Annotated[u.Speed, POSITIVE]
    latitude: Annotated[u.Angle, POSITIVE]
    surface_factor: Positive
    depth_factor: Annotated[u.Time, POSITIVE]
    component: Literal["along the wind", "across the wind", "magnitude", "both"]
    hemisphere: Literal["northern", "southern"] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.component == "both") != (self.hemisphere is not None):
            raise Misfit(
                "hemisphere",
                "does not fit together",
                "'northern' or 'southern' goes with 'component: both'",
            )
        return self
