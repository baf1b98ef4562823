"""Labels and colours that figures of this chapter share."""

from __future__ import annotations

from riserstudy.figures.style import COLOURS

HEIGHT, TIME = "s from the bottom (m)", "time (s)"
DEFLECTION, STRESS, ANGLE = "deflection x (m)", "bending stress (MPa)", "angle (°)"
BLUE, RED, BLACK = COLOURS[0], COLOURS[1], COLOURS[6]
