"""Motion over time, compared with closed forms, other methods and conservation laws."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from chapters.numerics import closed_forms as known
from chapters.numerics import references
from chapters.numerics.validation_row import CLOSED, CONSERVED, SECOND, Files, Row, held_below, simulated
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.simulation.tolerance import DISPLACEMENT, MOMENT

SURGE = {"analysis.duration": "60 s", "analysis.output": {"interval": "0.25 s"}}

UNITS = {"displacement": "m", "moment": "N m"}


def _envelope(file: SceneFile) -> dict[str, float]:
    run = simulated(file)
    names = {"displacement": "x_absmax", "moment": "bending_moment_absmax"}
    return {name: float(run[key].max()) for name, key in names.items()}


def wave(_: Files) -> Iterator[Row]:
    """A bar loses half of the pull at its top: a wave travels down and doubles when it is reflected."""
    stiffness, mass, pull = 8e9, 320.0, 2e6
    section = {"length": "1800 m", "axial_stiffness": f"{stiffness} N", "mass": f"{mass} kg/m"}
    loss = {"share": 0.5, "at": "0.05 s", "over": "0.2 s"}
    analysis = {"duration": "0.7 s", "output": {"interval": "0.01 s"}, "step": "0.5 ms"}
    analysis |= {"mesh": {"elements": 360}}
    run = simulated(held_below(section, {"tension": f"{pull} N", "tension_loss": loss}, analysis))
    top = run["z"].isel(s=-1)
    fall = float(top[0] - top.sel(time=0.6, method="nearest"))
    exact = known.fall_of_a_bar(0.5 * pull, stiffness, mass, 0.6 - 0.15)
    case = "bar whose top loses half of its tension"
    because = "the error of 360 segments, for a wave front that lasts 0.2 s"
    by = "ΔF t / √(EA m), until the reflected wave returns"
    yield Row(case, "fall of its top in 0.6 s", "m", CLOSED, by, exact, fall, 1e-6, because)
    below = float(run["effective_tension"].isel(s=0, time=-1))
    by = "T - 2 ΔF, after reflection of the wave at the foot"
    yield Row(case, "tension at its foot", "N", CLOSED, by, 0.0, below, 1e-5, because, pull)


def decay(_: Files) -> Iterator[Row]:
    """Free oscillation of a mass on a spring that dissipates in proportion to its rate of strain."""
    length, stiffness, mass, ratio = 100.0, 343e6, 749e3, 0.03
    frequency = math.sqrt(stiffness / length / mass)
    damping = {"ratio": ratio, "at_period": f"{2.0 * math.pi / frequency!r} s"}
    section: dict[str, Any] = {"length": f"{length} m", "axial_stiffness": f"{stiffness} N"}
    section["structural_damping"] = damping
    body = {"name": "mass", "mass": f"{mass} kg"}
    loss = {"share": 1.0, "at": "0.5 s", "over": "0.5 s"}
    analysis = {"duration": "30 s", "output": {"interval": "0.01 s"}, "step": "0.01 s"}
    top = {"body": body, "tension": "1 MN", "tension_loss": loss}
    run = simulated(held_below(section, top, analysis | {"mesh": {"elements": 1}}))
    z = run["z"].isel(s=-1).values - length
    peaks = _tops(z[100:])
    decrement = math.log(peaks[0] / peaks[5]) / 5.0
    exact = known.decrement(ratio)
    case, by = "mass on a damped spring (Kelvin, Voigt)", "2 π ζ / √(1 - ζ²)"
    because = "the error, of second order, of time steps of 1/300 of the period"
    yield Row(case, "logarithmic decrement", "1", CLOSED, by, exact, decrement, 3e-4, because)


def _tops(values: NDArray[np.float64]) -> list[float]:
    """Peak values of an oscillation, from the parabola through three points."""
    middle = np.flatnonzero((values[1:-1] > values[:-2]) & (values[1:-1] >= values[2:])) + 1
    tops = []
    for k in middle:
        a, b, c = values[k - 1 : k + 2]
        tops.append(float(b + (a - c) ** 2 / (8.0 * (2.0 * b - a - c))))
    return tops


def methods(files: Files) -> Iterator[Row]:
    """Surge by different time-stepping methods, with different steps."""
    alike = "the time-stepping errors of both runs, with time steps of 0.02 and 0.1 s"
    lumped = "the lumped masses of the explicit method, whose error is of second order in the segment length"
    for name, elements, sets, tolerances, because in (
        ("ESDIRK4", 40, {"analysis.step": "0.1 s"}, (5e-5, 2e-4), alike),
        ("explicit", 160, {"analysis.step": "0.4 ms"}, (1e-4, 2e-3), lumped),
    ):
        mesh = {"analysis.mesh": {"elements": elements}, "analysis.step": "0.02 s"}
        base = files["S2c"].with_values(SURGE | mesh, "validation")
        ours = _envelope(base)
        other = _envelope(base.with_values({"analysis.method": name} | sets, "validation"))
        case = f"surge, generalised-α and {name}"
        for (quantity, unit), tolerance in zip(UNITS.items(), tolerances, strict=True):
            by = f"{name}, on the same mesh"
            one, two = other[quantity], ours[quantity]
            yield Row(case, quantity, unit, SECOND, by, one, two, tolerance, because)


def hermite(files: Files) -> Iterator[Row]:
    """A small surge by lumped masses and by the Hermite beam, whose codes are independent."""
    small = SURGE | {"platform.surge.amplitude": "0.2 m", "analysis.mesh": {"elements": 80}}
    small |= {"analysis.step": "0.02 s"}
    lumped = files["S2"].with_values(small, "validation")
    beam = lumped.with_values(
        {"analysis.solver": "hermite", "analysis.method": {"beta": 0.25, "gamma": 0.5}}, "validation"
    )
    one, other = _envelope(lumped), _envelope(beam)
    for quantity, unit in UNITS.items():
        case, by = "small surge, lumped masses and finite elements", "finite elements (Hermite beam)"
        because = "the strain of 0.03 % and the slopes of 0.17°, which the beam model neglects"
        yield Row(case, quantity, unit, SECOND, by, other[quantity], one[quantity], 1e-3, because)


def energy(files: Files) -> Iterator[Row]:
    """Energy residual of a run, relative to the exchanged energy."""
    for name, elements, step in (("S2c", 40, "0.02 s"), ("S3", 40, "5 ms")):
        sets = SURGE | {"analysis.mesh": {"elements": elements}, "analysis.step": step}
        run = simulated(files[name], sets)
        share = float(json.loads(run.attrs["audit"])["unexplained_share"])
        case, by = f"energy of {name}", "work = stored + dissipated"
        because = "the numerical integration of the energies over time"
        yield Row(case, "relative energy residual", "1", CONSERVED, by, 0.0, share, 1e-4, because, 1.0)


def histories(files: Files, stored: Mapping[str, Path]) -> Iterator[Row]:
    """Whole histories of scenes by other programs, compared with runs at the default accuracy."""
    for name, path in stored.items():
        other = references.stored(path)
        short = {"analysis.duration": "60 s", "analysis.output": {"interval": "0.1 s"}}
        scene = files[name].with_values(short, "validation").resolved()
        requested = {"displacement": DISPLACEMENT, "moment": MOMENT, "tension": MOMENT}
        for quantity, error in other.errors(run(scene)).items():
            case, because = f"scene {name} over the whole run", "the errors that the default tolerance allows"
            yield Row(
                case, f"largest difference of {quantity}", "1", SECOND,
                other.code, 0.0, error, requested[quantity], because, 1.0,
            )  # fmt: skip
