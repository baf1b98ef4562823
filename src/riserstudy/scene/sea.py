"""Waves, and the drift that wind causes in the upper sea."""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import POSITIVE, WHOLE, Positive


class Wave(Strict):
    """Common fields of regular wave and irregular sea.

    Absent heading: along x. Absent ramp: the wave acts as a step from t = 0, on a riser at rest.
    """

    heading: u.Angle | None = None
    ramp: Annotated[u.Time, POSITIVE] | None = None
    above_mean_level: Literal["none", "constant", "stretched"]


class Swell(Strict):
    """Regular waves, given by their amplitude, or by their height (twice the amplitude).

    The default phase of a regular wave is 0.
    """

    height: Annotated[u.Length, POSITIVE] | None = None
    amplitude: Annotated[u.Length, POSITIVE] | None = None
    period: Annotated[u.Time, POSITIVE]
    phase: u.Angle | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.height is None) == (self.amplitude is None):
            raise Misfit("", "height or amplitude is required, not both", "give one of them")
        return self

    @property
    def wave_height(self) -> float:
        """Its height (m), also if the amplitude is given."""
        return self.height or 2.0 * (self.amplitude or 0.0)

    @property
    def shortest_period(self) -> float:
        """Its period (s)."""
        return self.period


class RegularWave(Swell, Wave):
    """A regular Airy wave, given by its amplitude, or by its height (twice the amplitude).

    The surface elevation is amplitude cos(k x - 2 pi t / period + phase). By default, a regular wave has the
    phase 0 and travels along x. By default, a regular wave acts from t = 0 without a ramp, on a riser in
    static equilibrium. The key ``above_mean_level`` defines the water velocities above the mean level:
    ``none`` (zero), ``constant`` (the velocity at the mean level), or ``stretched`` (Wheeler's stretched
    profile). A wave that is higher than 0.142 L tanh(k d) would break, and causes a warning, with the
    wavelength L, the wave number k and the water depth d.
    """


class Storm(Strict):
    """An irregular sea with a JONSWAP spectrum: a sum of regular waves of equal energy.

    The key ``components`` is the number of regular waves in the sum. The key ``seed`` selects one set of
    random phases.
    """

    significant_height: Annotated[u.Length, POSITIVE]
    peak_period: Annotated[u.Time, POSITIVE]
    peak_enhancement: Annotated[float, Field(ge=1, le=20)]
    components: Annotated[int, Field(ge=2, le=10000), WHOLE]
    seed: Annotated[int, Field(ge=0), WHOLE]

    @property
    def shortest_period(self) -> float:
        """Half the peak period (s): waves with shorter periods have a tenth of the energy."""
        return 0.5 * self.peak_period


class IrregularSea(Storm, Wave):
    """An irregular sea with a JONSWAP spectrum: a sum of regular waves of equal energy.

    The key ``components`` is the number of regular waves in the sum. The key ``seed`` selects one set of
    random phases. By default, the waves travel along x, and act from t = 0 without a ramp, on a riser in
    static equilibrium. The section RegularWave explains the key ``above_mean_level``.
    """


class WindDrift(Strict):
    """Ekman's drift of deep water under a steady wind.

    The speed of Ekman's drift at the surface is surface_factor W / sqrt(sin latitude), with the wind speed W.
    At the surface, the direction of the drift is 45 degrees from the wind. With increasing depth, the drift
    turns further away from the wind. At the friction depth, depth_factor W / sqrt(sin latitude), the drift is
    opposite to its direction at the surface, with 1/23 of its speed at the surface. The key ``component``
    selects the part of the drift that acts on the riser: along the wind, across the wind, the magnitude, or
    both parts. With ``component: both`` (both parts of the drift), the heading of the current is the heading
    of the wind. The drift turns to the right of the wind in the northern ``hemisphere``, and to the left in
    the southern hemisphere.
    """

    wind_speed: Annotated[u.Speed, POSITIVE]
    latitude: Annotated[u.Angle, Field(gt=0.0, le=0.5 * math.pi)]
    surface_factor: Positive
    depth_factor: Annotated[u.Time, POSITIVE]
    component: Literal["along the wind", "across the wind", "magnitude", "both"]
    hemisphere: Literal["northern", "southern"] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.component == "both") != (self.hemisphere is not None):
            raise Misfit(
                "hemisphere",
                *(
                    ("missing, but 'component: both' requires it", "write 'northern' or 'southern'")
                    if self.hemisphere is None
                    else (f"has no effect with 'component: {self.component}'", "remove it")
                ),
            )
        return self
