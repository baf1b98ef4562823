"""A vessel on a thread that hardly pulls it, and what moves it: closed forms of rigid bodies apply."""

from __future__ import annotations

from typing import Any

from riserstudy import load_scene, simulate

ALONE = """\
title: a platform on a thread
riser:
  - name: thread
    length: 1000 m
    outer_diameter: 0.5 m
    inner_diameter: 0.45 m
    young_modulus: 1100 Pa
    shear_modulus: %s
    mass: 0.001 kg/m
    submerged_weight: 0 N/m
bottom: {hold: wellhead, elevation: 0 m}
top: {x: vessel, z: held, elevation: 1009 m}
vessel:
  mass: 1e7 kg
  sway: {added_mass: 1e7 kg}
  yaw: {inertia: 2e10 kg*m^2, added_inertia: 1e10 kg*m^2}
  thrusters:
    {gain: 1e9 N/m, command: 1e5 m, saturation: 1 MN, lag: 8 s, yaw: {gain: 4e5 N*m/rad, command: 2 deg}}
analysis: {duration: 60 s, output: {interval: 0.5 s}, mesh: {elements: 4}, step: 0.05 s}
"""


def vessel_scene(tmp_path, shear="79 GPa", **overrides: Any):
    """The scene with a shear modulus of its thread, and other values set by path."""
    file = tmp_path / "alone.yaml"
    file.write_text(ALONE % shear)
    return load_scene(file, **overrides)


def alone(tmp_path, shear="79 GPa", **overrides: Any):
    """A run of the scene."""
    return simulate(vessel_scene(tmp_path, shear, **overrides))
