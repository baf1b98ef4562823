"""Small scenes that isolate one effect, and the motions of an oscillator that they are compared with."""

from __future__ import annotations

import numpy as np

from riserstudy import load_scene, simulate


def simulated(folder, text, values=None):
    """The run of a scene's text with values by their paths."""
    file = folder / "scene.yaml"
    file.write_text(text)
    return simulate(load_scene(file, **(values or {})))


def after_a_step(time, frequency, ratio):
    """Motion of an oscillator after a step of its load, divided by the static deflection."""
    damped = frequency * np.sqrt(1.0 - ratio**2)
    swing = np.cos(damped * time) + ratio * frequency / damped * np.sin(damped * time)
    return 1.0 - np.exp(-ratio * frequency * time) * swing
