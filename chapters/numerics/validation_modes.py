"""Natural frequencies, compared with closed forms."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from chapters.numerics import closed_forms as known
from chapters.numerics.validation_row import CLOSED, FOURTH, Files, Row, frequencies_of, hung, pipe_of


def taut_beam(files: Files) -> Iterator[Row]:
    """A beam under tension in vacuum."""
    length, axial, bending = pipe_of(files["S4a"])
    tension, mass = 2275e3, 1006.0
    stretch = 1.0 + tension / axial
    frequencies = frequencies_of(files["S4a"], "lateral", 5)
    for mode in (1, 5):
        exact = known.taut_beam_frequency(mode, length, tension / stretch, bending / stretch**2, mass)
        case, number = "beam under tension", f"frequency {mode}"
        by = "k √((T + EI k²) / m), k = n π / L, unstretched lengths"
        because = FOURTH
        yield Row(case, number, "rad/s", CLOSED, by, exact, frequencies[mode - 1], 1e-6, because)


def bar(files: Files) -> Iterator[Row]:
    """Axial vibration of a bar that hangs from a held top."""
    frequencies = frequencies_of(files["S4d"], "axial", 3)
    for mode in (1, 3):
        exact = known.bar_frequency(mode, 1800.0, 8.3505393e9, 318.0)
        case, by = "hung bar", "(n - 1/2) π / L √(EA / m)"
        number = f"axial frequency {mode}"
        yield Row(case, number, "rad/s", CLOSED, by, exact, frequencies[mode - 1], 1e-6, FOURTH)


def chain(_: Files) -> Iterator[Row]:
    """A hanging chain."""
    file = hung(axial_stiffness="1e12 N", submerged_weight="2700 N/m", lateral_load="1e-9 N/m")
    frequencies = frequencies_of(file, "lateral", 2)
    for mode in (1, 2):
        exact = known.hanging_chain_frequency(mode, 300.0, 2700.0, 320.0)
        case, by = "hanging chain", "j₀ₙ / 2 √(w / (m L)) (Bernoulli)"
        because = "the mesh error, which is of second order at the free end without tension, and rounding"
        yield Row(case, f"frequency {mode}", "rad/s", CLOSED, by, exact, frequencies[mode - 1], 2e-5, because)


def pendulum(_: Files) -> Iterator[Row]:
    """A body below a very stiff rod."""
    body = {"name": "body", "mass": "140 t", "submerged_weight": "1.2 MN", "centre_below": "3 m"}
    sets: dict[str, Any] = {"gravity": "9.81 m/s^2", "water": {"density": "1025 kg/m^3"}, "bottom.body": body}
    sets |= {"top.rotation": "free", "analysis.mesh.elements": 32, "riser[0].length": "30 m"}
    file = hung(axial_stiffness="1e12 N", bending_stiffness="1e11 N*m^2", mass="300 kg/m")
    file = file.with_values(sets | {"riser[0].submerged_weight": "0 N/m"}, "validation")
    exact = known.compound_pendulum(30.0, 300.0, 1.2e6, 140e3, 3.0)
    lowest = frequencies_of(file, "lateral", 1)[0]
    case, by = "body below a rod", "√(W (L + a) / (M (L + a)² + m L³ / 3))"
    yield Row(case, "frequency", "rad/s", CLOSED, by, exact, lowest, 1e-5, "the bending of the rod, 0.0003 %")
