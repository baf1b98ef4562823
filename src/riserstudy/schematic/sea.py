"""Water, waves, current and seabed of a schematic."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.sea import current_velocity, wave_number
from riserstudy.scene.sea import Swell
from riserstudy.schematic.facts import degrees, metres, wave_text
from riserstudy.schematic.geometry import Geometry
from riserstudy.schematic.labels import WATER
from riserstudy.schematic.view import View

SURFACE_SPEED = "current.profile.surface_speed"
ARROWS = 11  # most arrows of a current profile
CURRENT_WIDTH = 0.3  # length of the arrow of the largest speed, as a share of the window
PLACES = 2000  # points of a line of the surface
BEFORE = 0.12  # distance between riser and arrows, as a share of the window


def sea(view: View, geometry: Geometry) -> None:
    """Draw the water, its surface and the ground."""
    left, right, low, _ = view.window
    surface, seabed = geometry.surface, geometry.seabed
    if surface is not None and low < surface:
        floor = seabed if seabed is not None else low
        x = np.linspace(left, right, PLACES)
        style: dict[str, Any] = {"color": "#e8f2fa", "linewidth": 0.0, "zorder": 0.0}
        view.ax.fill_between(x, max(low, floor), _level(geometry, x), **style)
        view.line([left, right], [surface, surface], color=WATER, linewidth=0.7, zorder=1.0)
        text = f"mean water level, {metres(surface)}{geometry.mark('water.surface')}"
        view.name(text, (right, surface), WATER, whole=True)
    if seabed is not None and low < seabed:
        soil = geometry.scene.soil
        word, level = ("mudline", "soil.mudline") if soil else ("seabed", "water.seabed")
        view.ax.axhspan(low, seabed, color="#efe7da", zorder=0.0)
        view.line([left, right], [seabed, seabed], color="#7a6a4f", linewidth=0.9, zorder=1.0)
        text = f"{word}, {metres(seabed)}{geometry.mark(level)}"
        view.name(text, (right, seabed), whole=True)
    wave(view, geometry)
    current(view, geometry)


def wave(view: View, geometry: Geometry) -> None:
    """Draw the surface of a wave to scale; for a sea, a wave of its significant height and peak period."""
    drawn, waves, surface = _wave(geometry), geometry.scene.wave, geometry.surface
    if drawn is None or waves is None or surface is None:
        return
    amplitude, number = drawn
    left, right, _, _ = view.window
    x = np.linspace(left, right, PLACES)
    view.line(list(x), list(_level(geometry, x)), color=WATER, linewidth=0.9)
    crest = (right - 0.1 * (right - left), surface + amplitude)
    text = f"{wave_text(waves, geometry)}, {2.0 * math.pi / number:.3g} m long"
    heading = waves.heading
    if heading:
        text += f", towards {degrees(heading)}"
    view.name(text, crest, WATER, whole=True)


def _wave(geometry: Geometry) -> tuple[float, float] | None:
    """Return amplitude (m) and wave number (1/m) of the drawn wave; None without one."""
    scene, surface, seabed = geometry.scene, geometry.surface, geometry.seabed
    if scene.wave is None or surface is None or seabed is None or scene.gravity is None:
        return None
    if isinstance(scene.wave, Swell):
        height, period = scene.wave.height, scene.wave.period
        amplitude = 0.5 * height if height else scene.wave.amplitude or 0.0
    else:
        amplitude, period = 0.5 * scene.wave.significant_height, scene.wave.peak_period
    return amplitude, wave_number(2.0 * math.pi / period, surface - seabed, scene.gravity)


def _level(geometry: Geometry, x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the elevation of the water surface (m) at x (m), with the wave if there is one."""
    amplitude, number = _wave(geometry) or (0.0, 0.0)
    return (geometry.surface or 0.0) + amplitude * np.cos(number * x)


def current(view: View, geometry: Geometry) -> None:
    """Draw the current over elevation as arrows, in the whole view."""
    scene = geometry.scene
    if scene.current is None or not view.whole:
        return
    left, right, low, high = view.window
    z, (speed, aside) = current_velocity(scene.current, scene.water)
    inside = (z >= low) & (z <= high)
    largest = float(np.hypot(speed, aside).max())
    if not largest or not inside.any():
        return
    width = right - left
    middle = float(np.mean(geometry.line[1]))
    scale = CURRENT_WIDTH * width / largest
    rightwards = speed[int(np.argmax(np.abs(speed)))] > 0.0
    foot = middle - BEFORE * width - (CURRENT_WIDTH * width if rightwards else 0.0)
    view.line([foot, foot], [z[inside][0], z[inside][-1]], color=WATER, linewidth=0.6)
    tips = foot + scale * speed[inside]
    view.line(list(tips), list(z[inside]), color=WATER, linewidth=0.6)
    levels = np.linspace(z[inside][0], z[inside][-1], ARROWS)
    ends = foot + scale * np.interp(levels, z, speed)
    drawn = [(x, level) for x, level in zip(ends, levels, strict=True) if abs(x - foot) > 0.01 * width]
    for tip in drawn:
        view.arrow((foot, tip[1]), tip, WATER)
    assumed = geometry.assumes("current.profile", excluded=SURFACE_SPEED)
    profile = " (profile assumed)" if assumed else ""
    # a profile that is assumed as a whole may have a given speed
    mark = geometry.mark(SURFACE_SPEED) if SURFACE_SPEED in geometry.assumed else ""
    speed_of = f"{largest:.3g} m/s{mark}"
    text = f"current: up to {speed_of}{profile}; arrows have a separate scale"
    if scene.current.turns:
        text += "; its direction changes with depth (drawn: part along x)"
    elif scene.current.towards:
        text += f"; towards {degrees(scene.current.towards % (2.0 * math.pi))} (drawn: part along x)"
    text += geometry.remark("current")
    # labelled at the second arrow from the top: the labels of the surface are at the first
    view.name(text, ([(foot, levels[-1]), *drawn])[-2], WATER, whole=True)
