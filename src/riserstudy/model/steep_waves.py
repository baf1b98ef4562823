"""Regular waves that would break: Airy's theory gives them velocities, but no sea has them."""

from __future__ import annotations

import math

from riserstudy.model.sea import wave_number
from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sea import Storm, Swell
from riserstudy.scene.units import GRAVITY

STEEPEST = 0.142  # height over length of the steepest wave in deep water
DEEP = 20.0  # w^2 d / g from which tanh kd is 1


def breaking(scene: Resolved) -> list[RunWarning]:
    """Warnings about regular waves that are higher than waves of their period can be.

    References
    ----------
    DNV-RP-C205, 3.4.6: the largest height is 0.142 L tanh(k d), with the length L and the wave number k.
    """
    found = []
    for path, wave in waves_of(scene).items():
        if not isinstance(wave, Swell):
            continue
        height, most = wave.wave_height, highest(scene, wave.period)
        if height > most:
            text = (
                "{path}: a height of {height:.3g} m is above {most:.3g} m, at which waves of {period:g} s "
                "break. Give a smaller height or a longer period"
            )
            values = {"path": path, "height": height, "most": most, "period": wave.period}
            found.append(warning("breaking_wave", text, values))
    return found


def waves_of(scene: Resolved) -> dict[str, Swell | Storm]:
    """Waves and seas of a scene, by path."""
    response = scene.platform and scene.platform.response
    waves = {"wave": scene.wave, "platform.response.wave": response and response.wave}
    return {path: wave for path, wave in waves.items() if wave}


def highest(scene: Resolved, period: float) -> float:
    """Height of the highest waves of a period (m); of deep water in a scene without levels of the sea."""
    frequency, gravity = 2.0 * math.pi / period, scene.gravity or GRAVITY
    depth, sea = math.inf, scene.water
    if sea and sea.surface is not None and sea.seabed is not None:
        depth = sea.surface - sea.seabed
    if frequency**2 * depth / gravity > DEEP:
        return STEEPEST * 2.0 * math.pi * gravity / frequency**2
    number = wave_number(frequency, depth, gravity)
    return STEEPEST * 2.0 * math.pi / number * math.tanh(number * depth)
