"""A warning if a platform moves so far that the phase of its motions no longer agrees with the wave."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.sea import components_of, wave_numbers
from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.forcing import TimeSeries
from riserstudy.scene.resolve import Resolved

FAR = 0.1  # motion from which on there is a warning, as a share of the wavelength


def lost_phase(scene: Resolved, arrays: dict[str, NDArray[np.float64]]) -> list[RunWarning]:
    """Warnings about a vessel, or a surge or sway by points, that moves along the waves of the scene.

    Motions in waves keep the phase of the platform's initial position, but loads on the riser have the phase
    of the riser's present position. ``arrays``: outputs of the run, of which low-frequency surge and sway are
    used, (time,) each (m).
    """
    wave, platform = scene.wave, scene.platform
    if wave is None or platform is None or scene.water is None or scene.gravity is None:
        return []
    if scene.vessel:
        away = [arrays.get(f"low_frequency_{name}", np.zeros(1)) for name in ("surge", "sway")]
        path = "vessel"
    elif platform.response and not platform.response.wave:
        away = [_by_points(getattr(platform, name)) for name in ("surge", "sway")]
        path = "platform"
    else:
        return []
    heading = wave.heading or 0.0
    far = abs(math.cos(heading)) * _farthest(away[0]) + abs(math.sin(heading)) * _farthest(away[1])
    if scene.vessel and len(away[0]) == len(away[1]):
        far = _farthest(math.cos(heading) * away[0] + math.sin(heading) * away[1])
    amplitude, frequency, _ = components_of(wave)
    middle = (amplitude**2 * frequency).sum() / (amplitude**2).sum()
    length = math.tau / float(wave_numbers(np.array([middle]), scene.water, scene.gravity)[0])
    if far <= FAR * length:
        return []
    text = (
        "{path}: moves {far:.3g} m along waves with a length of {length:.3g} m, but its motions in waves "
        "keep the phase of its initial position. After {most:.2g} m, do not use the phase between "
        "these motions and the wave loads on the riser"
    )
    return [warning("lost_phase", text, {"path": path, "far": far, "length": length, "most": FAR * length})]


def _by_points(motion: object) -> NDArray[np.float64]:
    """Distances (m) from the rest position of a time series; zero for other, first-order motions."""
    if not isinstance(motion, TimeSeries):
        return np.zeros(1)
    return np.array([point.value for point in motion.points])


def _farthest(away: NDArray[np.float64]) -> float:
    return float(abs(away).max())
