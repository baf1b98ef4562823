"""Axial: a case, and the plain version."""

from __future__ import annotations

from plain import axial
from surroundings import SEGMENTS, Case

from riserstudy.effects.axial import Axial

CASES = {Axial: Case(lambda d: Axial(8e8 * SEGMENTS))}

PLAIN = {Axial: [("string", axial)]}
