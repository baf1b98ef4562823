"""Equilibria, compared with closed forms and second methods."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from chapters.numerics import closed_forms as known
from chapters.numerics.validation_row import (
    CLOSED,
    FOURTH,
    SECOND,
    Files,
    Row,
    frequencies_of,
    hung,
    pipe_of,
    simulated,
)
from riserstudy.scene.load import SceneFile


def column(_: Files) -> Iterator[Row]:
    """A column that buckles under its own weight: the weight at which its lowest frequency is zero."""
    length, bending = 60.0, 2e8

    def square(weight: float) -> float:
        tree = {
            "title": "column",
            "riser": [
                {
                    "name": "column",
                    "length": f"{length} m",
                    "axial_stiffness": "1e13 N",
                    "bending_stiffness": f"{bending} N*m^2",
                    "mass": "500 kg/m",
                    "submerged_weight": f"{weight!r} N/m",
                    "lateral_load": "1e-9 N/m",
                }
            ],
            "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "fixed"},
            "top": {"x": "free", "z": "free", "rotation": "free"},
            "analysis": {"mesh": {"elements": 120}},
        }
        return frequencies_of(SceneFile("validation", tree), "lateral", 1)[0] ** 2

    exact = known.self_buckling()
    weights = [share * exact * bending / length**3 for share in (0.98, 0.99)]
    one, two = map(square, weights)
    vanishes = weights[1] + (weights[1] - weights[0]) * two / (one - two)
    by = "9/4 of the square of the first zero of J₋₁/₃ (Greenhill)"
    because = "the linear extrapolation of the squared frequency to zero, from 98 and 99 % of this weight"
    value = vanishes * length**3 / bending
    yield Row("column under its own weight", "w L³ / EI", "1", CLOSED, by, exact, value, 1e-4, because)


def own_weight(files: Files) -> Iterator[Row]:
    """A beam whose tension increases upward by its own weight."""
    length, axial, bending = pipe_of(files["S4a"])
    weight, mass, top = 1500.0, 1006.0, 1000e3
    file = files["S4a"].with_values(
        {
            "riser[0].submerged_weight": f"{weight} N/m",
            "top.tension": f"{top} N",
            "riser[0].young_modulus": None,
            "riser[0].outer_diameter": None,
            "riser[0].inner_diameter": None,
            "riser[0].axial_stiffness": f"{100.0 * axial!r} N",
            "riser[0].bending_stiffness": f"{bending!r} N*m^2",
        },
        "validation",
    )
    exact = known.beam_on_varying_tension(length, top - weight * length, weight, bending, mass, 32)
    lowest = frequencies_of(file, "lateral", 1)[0]
    case, by = (
        "beam under its own weight and top tension",
        "(EI y′′)′′ - (T y′)′ = m ω² y, by Chebyshev collocation",
    )
    because = "the strain of the stiff pipe, 0.00006 %, and rounding of the fourth derivative"
    yield Row(case, "frequency 1", "rad/s", SECOND, by, exact, lowest, 1e-5, because)


def loaded_beam(files: Files) -> Iterator[Row]:
    """A beam under tension and a uniform load, so small that slopes stay small."""
    length, axial, bending = pipe_of(files["S4b"])
    tension = 2275e3
    stretch = 1.0 + tension / axial
    exact = known.taut_beam_under_load(length, tension / stretch, bending / stretch**2, 1.0)
    run = simulated(files["S4b"], {"riser[0].lateral_load": "1 N/m"})
    case, by = "beam under tension and a uniform load", "EI w′′′′ - T w′′ = q"
    because = FOURTH
    x = float(run["x"].max())
    moment = float(abs(run["bending_moment"]).sel(s=0.5 * length, method="nearest"))
    yield Row(case, "displacement", "m", CLOSED, by, exact.displacement, x, 1e-6, because)
    reference = stretch * exact.moment
    yield Row(case, "moment", "N m", CLOSED, by, reference, moment, 1e-6, because)


def cantilever(files: Files) -> Iterator[Row]:
    """A cantilever with a large deflection, compared with the elastica."""
    length, _, bending = pipe_of(files["S4c"])
    along, across = known.elastica_tip(length, bending, 324054.15)
    tip = simulated(files["S4c"]).isel(s=-1)
    case, by = "cantilever with a large deflection", "elastica (curve of a bent rod), by elliptic integrals"
    because = "the stretch of the pipe, 0.004 %, which the elastica neglects"
    yield Row(case, "tip across", "m", CLOSED, by, across, float(tip["x"]), 1e-4, because)
    yield Row(case, "tip along", "m", CLOSED, by, along, float(tip["z"]), 1e-4, because)


def cable(files: Files) -> Iterator[Row]:
    """An elastic catenary."""
    exact = known.elastic_catenary(850.0, 1000.0, 5e8, 700.0, 300.0)
    run = simulated(files["S4e"])
    upper = float(run["effective_tension"].isel(s=-1))
    case, by = "elastic catenary", "Irvine, Cable Structures, 1981"
    because = "the error of 200 straight segments, which is of second order in their length"
    yield Row(case, "tension at the upper end", "N", CLOSED, by, exact.upper, upper, 2e-5, because)


def current(files: Files) -> Iterator[Row]:
    """A riser in static equilibrium in a current that is uniform over depth."""
    length, axial, bending = pipe_of(files["S1"])
    flow = known.Flow(length, axial, bending, 141.264, 0.5 * 1025.0 * 1.22, 1.0, 2275e3)
    exact = known.rod_in_current(flow)
    profile = [{"elevation": f"{z} m", "speed": "1 m/s"} for z in (0, 600)]
    run = simulated(files["S1"], {"current.profile": profile})
    case, by = ("static riser in a uniform current", "boundary value problem of the rod, by collocation")
    because = "the error of 200 segments"
    x, moment = float(run["x"].max()), float(np.abs(run["bending_moment"]).max())
    yield Row(case, "displacement", "m", SECOND, by, exact.displacement, x, 1e-4, because)
    yield Row(case, "moment", "N m", SECOND, by, exact.moment, moment, 1e-4, because)


def towed(_: Files) -> Iterator[Row]:
    """A string in a steady current: at one angle, weight and normal drag are in equilibrium."""
    water = {"density": "1025 kg/m^3"}
    profile = [{"elevation": f"{z} m", "speed": "1 m/s"} for z in (-400, 10)]
    file = hung(
        axial_stiffness="1e13 N", submerged_weight="500 N/m", drag={"coefficient": 1.0, "diameter": "1 m"}
    ).with_values({"water": water, "current.profile": profile}, "validation")
    run = simulated(file)
    x, z = (float(run[name].isel(s=0)) for name in "xz")
    exact = known.towed_angle(500.0, 0.5 * 1025.0, 1.0)
    by = "w sin α = q cos² α"
    case = "string hanging in a current"
    because = "rounding only, because any mesh gives the exact angle"
    yield Row(case, "angle", "rad", CLOSED, by, exact, math.atan2(abs(x), -z), 1e-6, because)
