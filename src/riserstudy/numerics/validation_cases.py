"""What the engine computes, compared with what is known: closed forms, second methods, conservation laws.

Each case runs the engine and names its references, which ``closed_forms`` computes without it. Tolerances
are what the closed form leaves out, or what the mesh may err by, and say which.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.numerics import closed_forms as known
from riserstudy.numerics import references
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.modes import modes_of
from riserstudy.simulation.refine import run
from riserstudy.simulation.simulate import simulate
from riserstudy.simulation.tolerance import DISPLACEMENT, MOMENT

if TYPE_CHECKING:
    import xarray as xr

FOURTH = "200 segments, fourth order"
CLOSED, SECOND, CONSERVED = "closed form", "second method", "conservation law"
Files = Mapping[str, SceneFile]


class Row(NamedTuple):
    """One quantity and its reference.

    ``tolerance`` is relative to ``scale``, which is the reference's own size where it is not given.
    """

    name: str
    quantity: str
    unit: str
    kind: str
    by: str
    reference: float
    value: float
    tolerance: float
    because: str
    scale: float | None = None

    @property
    def error(self) -> float:
        """Difference over the scale."""
        return abs(self.value - self.reference) / (self.scale or abs(self.reference))


Case = Callable[[Files], Iterator[Row]]


def _pipe(file: SceneFile) -> tuple[float, float, float]:
    """Length (m), axial stiffness EA (N) and bending stiffness EI (N m2) of a scene's steel pipe."""
    section = file.scene().riser[0]
    young, outer, inner = section.young_modulus, section.outer_diameter, section.inner_diameter
    if young is None or outer is None or inner is None:
        raise ValueError("the scene's riser is no pipe")
    area, second = math.pi / 4.0 * (outer**2 - inner**2), math.pi / 64.0 * (outer**4 - inner**4)
    return section.total_length, young * area, young * second


def _run(file: SceneFile, sets: Mapping[str, Any] | None = None) -> xr.Dataset:
    """A scene simulated, with values set on it."""
    return simulate(file.with_values(dict(sets or {}), "validation"), progress=False)


def _frequencies(file: SceneFile, motion: str, count: int) -> list[float]:
    """Natural frequencies of one kind (rad/s), the lowest first."""
    modes = modes_of(file.scene(), 15)
    of = modes["frequency"].values[modes["motion"].values == motion]
    return [2.0 * math.pi * float(f) for f in of[:count]]


def taut_beam(files: Files) -> Iterator[Row]:
    """A beam under tension in vacuum."""
    length, axial, bending = _pipe(files["S4a"])
    tension, mass = 2275e3, 1006.0
    stretch = 1.0 + tension / axial
    frequencies = _frequencies(files["S4a"], "lateral", 5)
    for mode in (1, 5):
        exact = known.taut_beam_frequency(
            mode, length, tension / stretch, bending / stretch**2, mass
        )
        case, number = "beam under tension", f"frequency {mode}"
        by = "k √((T + EI k²) / m), k = n π / L, lengths before stretching"
        because = FOURTH
        yield Row(case, number, "rad/s", CLOSED, by, exact, frequencies[mode - 1], 1e-6, because)


def bar(files: Files) -> Iterator[Row]:
    """Axial waves of a hung bar."""
    frequencies = _frequencies(files["S4d"], "axial", 3)
    for mode in (1, 3):
        exact = known.bar_frequency(mode, 1800.0, 8.3505393e9, 318.0)
        case, by = "hung bar", "(n - 1/2) π / L √(EA / m)"
        number = f"axial frequency {mode}"
        yield Row(case, number, "rad/s", CLOSED, by, exact, frequencies[mode - 1], 1e-6, FOURTH)


def _hung(**section: Any) -> SceneFile:
    """Something that hangs from a held top and is free below."""
    pipe = {"name": "hung", "length": "300 m", "mass": "320 kg/m"} | section
    tree = {
        "title": "hung",
        "riser": [pipe],
        "bottom": {"hold": "free"},
        "top": {"x": "held", "z": "held", "elevation": "0 m"},
        "analysis": {"mesh": {"elements": 400}},
    }
    return SceneFile("validation", tree)


def chain(_: Files) -> Iterator[Row]:
    """A hanging chain."""
    file = _hung(axial_stiffness="1e12 N", submerged_weight="2700 N/m", lateral_load="1e-9 N/m")
    frequencies = _frequencies(file, "lateral", 2)
    for mode in (1, 2):
        exact = known.hanging_chain_frequency(mode, 300.0, 2700.0, 320.0)
        case, by = "hanging chain", "j₀ₙ / 2 √(w / (m L)) (Bernoulli)"
        because = "second order at the free end, where tension vanishes; rounding of the large EA"
        yield Row(
            case,
            f"frequency {mode}",
            "rad/s",
            CLOSED,
            by,
            exact,
            frequencies[mode - 1],
            2e-5,
            because,
        )


def column(_: Files) -> Iterator[Row]:
    """A column that buckles under its own weight: the weight at which its frequency vanishes."""
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
        return _frequencies(SceneFile("validation", tree), "lateral", 1)[0] ** 2

    exact = known.self_buckling()
    weights = [share * exact * bending / length**3 for share in (0.98, 0.99)]
    one, two = map(square, weights)
    vanishes = weights[1] + (weights[1] - weights[0]) * two / (one - two)
    by = "9/4 of the square of the first zero of J₋₁/₃ (Greenhill)"
    because = "the square of the frequency falls all but straight over the last hundredths"
    value = vanishes * length**3 / bending
    yield Row(
        "column under its own weight", "w L³ / EI", "1", CLOSED, by, exact, value, 1e-4, because
    )


def own_weight(files: Files) -> Iterator[Row]:
    """A beam whose tension grows by its weight."""
    length, axial, bending = _pipe(files["S4a"])
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
    lowest = _frequencies(file, "lateral", 1)[0]
    case, by = (
        "beam under its own weight and top tension",
        "(EI y′′)′′ - (T y′)′ = m ω² y, Chebyshev",
    )
    because = "the strain of the stiff pipe, 6e-7, and rounding of the fourth derivative"
    yield Row(case, "frequency 1", "rad/s", SECOND, by, exact, lowest, 1e-5, because)


def loaded_beam(files: Files) -> Iterator[Row]:
    """A beam under tension and an even load, so small that slopes stay small."""
    length, axial, bending = _pipe(files["S4b"])
    tension = 2275e3
    stretch = 1.0 + tension / axial
    exact = known.taut_beam_under_load(length, tension / stretch, bending / stretch**2, 1.0)
    run = _run(files["S4b"], {"riser[0].lateral_load": "1 N/m"})
    case, by = "beam under tension and an even load", "EI w′′′′ - T w′′ = q"
    because = FOURTH
    x = float(run["x"].max())
    moment = float(abs(run["bending_moment"]).sel(s=0.5 * length, method="nearest"))
    yield Row(case, "displacement", "m", CLOSED, by, exact.displacement, x, 1e-6, because)
    reference = stretch * exact.moment
    yield Row(case, "moment", "N m", CLOSED, by, reference, moment, 1e-6, because)


def cantilever(files: Files) -> Iterator[Row]:
    """The elastica."""
    length, _, bending = _pipe(files["S4c"])
    along, across = known.elastica_tip(length, bending, 324054.15)
    tip = _run(files["S4c"]).isel(s=-1)
    case, by = "cantilever bent far over", "the elastica, by elliptic integrals"
    because = "the pipe stretches by 4e-5, the elastica does not"
    yield Row(case, "tip across", "m", CLOSED, by, across, float(tip["x"]), 1e-4, because)
    yield Row(case, "tip along", "m", CLOSED, by, along, float(tip["z"]), 1e-4, because)


def cable(files: Files) -> Iterator[Row]:
    """An elastic catenary."""
    exact = known.elastic_catenary(850.0, 1000.0, 5e8, 700.0, 300.0)
    run = _run(files["S4e"])
    upper = float(run["effective_tension"].isel(s=-1))
    case, by = "elastic catenary", "Irvine, Cable Structures, 1981"
    because = "200 straight segments, second order"
    yield Row(case, "tension at the upper end", "N", CLOSED, by, exact.upper, upper, 2e-5, because)


def current(files: Files) -> Iterator[Row]:
    """A riser at rest in a current that is the same at all depths."""
    length, axial, bending = _pipe(files["S1"])
    flow = known.Flow(length, axial, bending, 141.264, 0.5 * 1025.0 * 1.22, 1.0, 2275e3)
    exact = known.rod_in_current(flow)
    profile = [{"elevation": f"{z} m", "speed": "1 m/s"} for z in (0, 600)]
    run = _run(files["S1"], {"current.profile": profile})
    case, by = (
        "riser at rest in an even current",
        "the rod as a boundary value problem, by collocation",
    )
    because = "200 segments"
    x, moment = float(run["x"].max()), float(np.abs(run["bending_moment"]).max())
    yield Row(case, "displacement", "m", SECOND, by, exact.displacement, x, 1e-4, because)
    yield Row(case, "moment", "N m", SECOND, by, exact.moment, moment, 1e-4, because)


def towed(_: Files) -> Iterator[Row]:
    """A string in a steady current: weight and normal drag balance at one angle."""
    water = {"density": "1025 kg/m^3"}
    profile = [{"elevation": f"{z} m", "speed": "1 m/s"} for z in (-400, 10)]
    file = _hung(
        axial_stiffness="1e13 N",
        submerged_weight="500 N/m",
        drag={"coefficient": 1.0, "diameter": "1 m"},
    ).with_values({"water": water, "current.profile": profile}, "validation")
    run = _run(file)
    x, z = (float(run[name].isel(s=0)) for name in "xz")
    exact = known.towed_angle(500.0, 0.5 * 1025.0, 1.0)
    by = "w sin α = q cos² α"
    case = "string that hangs in a current"
    yield Row(
        case, "angle", "rad", CLOSED, by, exact, math.atan2(abs(x), -z), 1e-6, "exact on any mesh"
    )


def pendulum(_: Files) -> Iterator[Row]:
    """A body below a rod that does not bend."""
    body = {"name": "body", "mass": "140 t", "submerged_weight": "1.2 MN", "centre_below": "3 m"}
    sets: dict[str, Any] = {
        "gravity": "9.81 m/s^2",
        "water": {"density": "1025 kg/m^3"},
        "bottom.body": body,
    }
    sets |= {"top.rotation": "free", "analysis.mesh.elements": 32, "riser[0].length": "30 m"}
    file = _hung(axial_stiffness="1e12 N", bending_stiffness="1e11 N*m^2", mass="300 kg/m")
    file = file.with_values(sets | {"riser[0].submerged_weight": "0 N/m"}, "validation")
    exact = known.compound_pendulum(30.0, 300.0, 1.2e6, 140e3, 3.0)
    lowest = _frequencies(file, "lateral", 1)[0]
    case, by = "body below a rod", "√(W (L + a) / (M (L + a)² + m L³ / 3))"
    yield Row(case, "frequency", "rad/s", CLOSED, by, exact, lowest, 1e-5, "the rod bends by 3e-6")


GAS = {"area": 0.1, "pressure": 150e5, "volume": 3.0, "exponent": 1.4}
REACH = 4.0  # m


def _pulled(reach: float) -> SceneFile:
    """A pipe that hardly stretches, held below, its platform lifted: the cylinders reach so far."""
    chamber: dict[str, Any] = {
        "area": f"{GAS['area']} m^2",
        "pressure": f"{GAS['pressure']} Pa absolute",
    }
    chamber |= {"volume": f"{GAS['volume']} m^3", "exponent": GAS["exponent"]}
    tree = {
        "title": "cylinders of gas",
        "riser": [{"name": "rod", "length": "100 m", "axial_stiffness": "1e15 N", "mass": "1 t/m"}],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {
            "z": "free",
            "tensioners": {"count": 4, "mid_stroke": "riser in equilibrium", "gas": chamber},
        },
        "platform": {"heave": {"amplitude": f"{reach} m", "period": "20 s", "ramp": "20 s"}},
        "analysis": {
            "duration": "60 s",
            "output": {"interval": "0.05 s"},
            "mesh": {"elements": 1},
            "step": "0.05 s",
        },
    }
    return SceneFile("validation", tree)


def gas(_: Files) -> Iterator[Row]:
    """Cylinders of gas that are drawn out by a heaving platform."""
    run = _run(_pulled(REACH))
    stroke = run["tensioner_stroke"].isel(cylinder=0).values
    force = run["tensioner_force"].isel(cylinder=0).values
    last = run["time"].values >= 40.0  # from here on the amplitude is whole
    top = int(np.argmax(np.where(last, stroke, -np.inf)))
    case, by = "cylinder of gas drawn out by heave", "p V^n = const., from mid-stroke"
    because = "the pipe stretches by 1e-8 m; the platform's highest place falls on an output"
    exact = known.gas_pull(**GAS, reach=REACH)
    yield Row(case, "pull", "N", CLOSED, by, exact, float(force[top]), 1e-6, because)
    lift = slice(top - 100, top + 1)  # a quarter of a period, from mid-stroke
    work = float(np.trapezoid(force[lift], stroke[lift]))
    done = known.gas_work(**GAS, reach=REACH)
    because = "trapezia between 100 outputs"
    yield Row(case, "work of a lift", "J", CLOSED, "∫ of the pull", done, work, 1e-5, because)


HIGH, LOW = known.Chamber(0.205, 2.08e6, 9.38), known.Chamber(0.246, 0.15e6, 2.25)


def two_chambers(_: Files) -> Iterator[Row]:
    """A direct-acting cylinder with gas on both sides of its piston, drawn out and pushed in a little."""
    reach, aside = 3.0, 0.01

    def pulled(lift: float) -> tuple[float, float]:
        file = _pulled(lift)
        law: dict[str, Any] = {"exponent": 1.4}
        for name, of in (("high", HIGH), ("low", LOW)):
            law[name] = {"area": f"{of.area} m^2", "pressure": f"{of.pressure} Pa absolute"}
            law[name] |= {"volume": f"{of.volume} m^3"}
        values = {"top.tensioners.gas": None, "top.tensioners.two_chamber_gas": law}
        values |= {"platform": {"position": {"heave": f"{lift} m"}}, "analysis.duration": None}
        values |= {"analysis.output": None, "analysis.step": None}
        run = _run(file.with_values(values, "validation"))
        return tuple(  # type: ignore[return-value]
            float(run[f"tensioner_{name}_static"].isel(cylinder=0)) for name in ("force", "stroke")
        )

    (less, shorter), (pull, _middle), (more, longer) = (
        pulled(reach + d) for d in (-aside, 0.0, aside)
    )
    exact, stiffness = known.two_chambers(HIGH, LOW, 1.4, reach)
    case, by = "direct-acting tensioner drawn out by 3 m", "p V^n = const. in both chambers"
    because = "the pipe stretches by 1e-7 m"
    yield Row(case, "pull", "N", CLOSED, by, exact, pull, 1e-6, because)
    slope = (more - less) / (longer - shorter)
    because = "a difference over 2 cm, second order"
    yield Row(case, "stiffness", "N/m", CLOSED, by, stiffness, slope, 1e-5, because)


PILE = {"diameter": 1.0, "height": 2.0, "period": 8.0, "depth": 60.0}


def morison(_: Files) -> Iterator[Row]:
    """A pile so stiff that only the water moves, in a small wave."""
    depth, across = f"{PILE['depth']} m", f"{PILE['diameter']} m"
    tree = {
        "title": "pile",
        "gravity": "9.81 m/s^2",
        "water": {"density": "1025 kg/m^3", "surface": depth, "seabed": "0 m"},
        "riser": [
            {
                "name": "pile",
                "length": depth,
                "axial_stiffness": "1e13 N",
                "bending_stiffness": "1e14 N*m^2",
                "mass": "1 t/m",
                "submerged_weight": "0 N/m",
            }
        ],
        "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "fixed"},
        "top": {"x": "free", "z": "free"},
        "wave": {
            "height": f"{PILE['height']} m",
            "period": f"{PILE['period']} s",
            "above_mean_level": "none",
            "ramp": "8 s",
        },
        "analysis": {
            "duration": "32 s",
            "output": {"interval": "0.1 s", "start": "16 s"},
            "mesh": {"elements": 240},
            "step": "0.05 s",
        },
    }
    by = "Morison's formula to the mean level, Airy's wave"
    because = "240 segments, second order"
    for name, loads, exact in (
        ("inertia", {"added_mass": {"coefficient": 1.0}}, known.pile_by_inertia(1.0, **PILE)),
        ("drag", {"drag": {"coefficient": 1.0}}, known.pile_by_drag(1.0, **PILE)),
    ):
        section = {f"riser[0].{key}": load | {"diameter": across} for key, load in loads.items()}
        run = _run(SceneFile("validation", tree).with_values(section, "validation"))
        moment = float(np.abs(run["bending_moment"].isel(s=0)).max())
        case = f"stiff pile in a wave, {name} alone"
        yield Row(case, "moment at its foot", "N m", CLOSED, by, exact, moment, 2e-4, because)


def terminal(_: Files) -> Iterator[Row]:
    """A platform alone that a steady force drives off, until drag is as large."""
    force, drag, mass, added, time = 4e5, 2.5e5, 4e7, 1e7, 400.0
    thread = {"name": "thread", "length": "1000 m", "axial_stiffness": "100 N"}
    thread |= {"mass": "0.001 kg/m", "submerged_weight": "0 N/m"}
    tree = {
        "title": "platform adrift",
        "water": {"density": "1025 kg/m^3", "surface": "1000 m", "seabed": "0 m"},
        "riser": [thread],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "vessel", "z": "held", "elevation": "1010 m"},
        "vessel": {
            "mass": f"{mass} kg",
            "added_mass": f"{added} kg",
            "hull_drag": f"{drag} N*s^2/m^2",
            "wave_drift": {"force": f"{force} N", "heading": "0 deg"},
        },
        "analysis": {
            "duration": f"{time} s",
            "output": {"interval": "1 s"},
            "mesh": {"elements": 4},
            "step": "0.5 s",
        },
    }
    run = _run(SceneFile("validation", tree)).isel(time=-1)
    speed, way = known.driven(force, drag, mass + added, time)
    case, by = "platform driven to its terminal speed", "√(F/c) tanh(t √(F c) / m)"
    because = "the thread that stands for a riser pulls with some newtons"
    now = float(run["platform_speed_x"])
    yield Row(case, "speed after 400 s", "m/s", CLOSED, by, speed, now, 1e-5, because)
    went = float(run["platform_surge"])
    yield Row(case, "way after 400 s", "m", CLOSED, "its integral", way, went, 1e-5, because)


SURGE = {"analysis.duration": "60 s", "analysis.output": {"interval": "0.25 s"}}


UNITS = {"displacement": "m", "moment": "N m"}


def _envelope(file: SceneFile) -> dict[str, float]:
    run = _run(file)
    names = {"displacement": "x_absmax", "moment": "bending_moment_absmax"}
    return {name: float(run[key].max()) for name, key in names.items()}


def _above(section: dict[str, Any], top: dict[str, Any], analysis: dict[str, Any]) -> SceneFile:
    """Something that is held below and moves up and down above."""
    tree = {
        "title": "held below",
        "riser": [{"name": "bar"} | section],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"z": "free"} | top,
        "analysis": analysis,
    }
    return SceneFile("validation", tree)


def wave(_: Files) -> Iterator[Row]:
    """Half of the pull at the top of a bar is lost: a wave runs down it and comes back doubled."""
    stiffness, mass, pull = 8e9, 320.0, 2e6
    section = {"length": "1800 m", "axial_stiffness": f"{stiffness} N", "mass": f"{mass} kg/m"}
    loss = {"share": 0.5, "at": "0.05 s", "over": "0.2 s"}
    analysis = {"duration": "0.7 s", "output": {"interval": "0.01 s"}, "step": "0.5 ms"}
    analysis |= {"mesh": {"elements": 360}}
    run = _run(_above(section, {"tension": f"{pull} N", "tension_loss": loss}, analysis))
    top = run["z"].isel(s=-1)
    fall = float(top[0] - top.sel(time=0.6, method="nearest"))
    exact = known.fall_of_a_bar(0.5 * pull, stiffness, mass, 0.6 - 0.15)
    case, because = "bar that loses half its pull", "360 segments; the front is 0.2 s long"
    by = "ΔF t / √(EA m), until the wave is back"
    yield Row(case, "fall of its top in 0.6 s", "m", CLOSED, by, exact, fall, 1e-6, because)
    below = float(run["effective_tension"].isel(s=0, time=-1))
    by = "T - 2 ΔF, once the wave has been thrown back at the foot"
    yield Row(case, "tension at its foot", "N", CLOSED, by, 0.0, below, 1e-5, because, pull)


def decay(_: Files) -> Iterator[Row]:
    """A mass on a spring that dissipates in proportion to its rate of strain, let go."""
    length, stiffness, mass, ratio = 100.0, 343e6, 749e3, 0.03
    frequency = math.sqrt(stiffness / length / mass)
    damping = {"ratio": ratio, "at_period": f"{2.0 * math.pi / frequency!r} s"}
    section: dict[str, Any] = {"length": f"{length} m", "axial_stiffness": f"{stiffness} N"}
    section["structural_damping"] = damping
    body = {"name": "mass", "mass": f"{mass} kg"}
    loss = {"share": 1.0, "at": "0.5 s", "over": "0.5 s"}
    analysis = {"duration": "30 s", "output": {"interval": "0.01 s"}, "step": "0.01 s"}
    top = {"body": body, "tension": "1 MN", "tension_loss": loss}
    run = _run(_above(section, top, analysis | {"mesh": {"elements": 1}}))
    z = run["z"].isel(s=-1).values - length
    peaks = _tops(z[100:])
    decrement = math.log(peaks[0] / peaks[5]) / 5.0
    exact = known.decrement(ratio)
    case, by = "mass on a damped spring (Kelvin, Voigt)", "2 π ζ / √(1 - ζ²)"
    because = "steps of a 300th of the period, second order"
    yield Row(case, "decrement", "1", CLOSED, by, exact, decrement, 3e-4, because)


def _tops(values: NDArray[np.float64]) -> list[float]:
    """Values at the tops of a swing, by the parabola through three."""
    middle = np.flatnonzero((values[1:-1] > values[:-2]) & (values[1:-1] >= values[2:])) + 1
    tops = []
    for k in middle:
        a, b, c = values[k - 1 : k + 2]
        tops.append(float(b + (a - c) ** 2 / (8.0 * (2.0 * b - a - c))))
    return tops


def methods(files: Files) -> Iterator[Row]:
    """Surge by methods of stepping that share no step."""
    alike = "both errors in time, at steps of 0.02 and 0.1 s"
    lumped = "explicit stepping lumps masses: second order in the 160 segments"
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
    """A small surge by lumped masses and by the Hermite beam, which share no code."""
    small = SURGE | {"platform.surge.amplitude": "0.2 m", "analysis.mesh": {"elements": 80}}
    small |= {"analysis.step": "0.02 s"}
    lumped = files["S2"].with_values(small, "validation")
    beam = lumped.with_values(
        {"analysis.solver": "hermite", "analysis.method": {"beta": 0.25, "gamma": 0.5}},
        "validation",
    )
    one, other = _envelope(lumped), _envelope(beam)
    for quantity, unit in UNITS.items():
        case, by = "small surge, lumped masses and finite elements", "Hermite's beam"
        because = "the beam neither stretches nor turns: strain 3e-4, slopes 3e-3"
        yield Row(case, quantity, unit, SECOND, by, other[quantity], one[quantity], 1e-3, because)


def energy(files: Files) -> Iterator[Row]:
    """What the account of a run leaves unexplained of the energy that was exchanged."""
    for name, elements, step in (("S2c", 40, "0.02 s"), ("S3", 40, "5 ms")):
        sets = SURGE | {"analysis.mesh": {"elements": elements}, "analysis.step": step}
        run = _run(files[name], sets)
        share = float(json.loads(run.attrs["audit"])["unexplained_share"])
        case, by = f"energy of {name}", "work = stored + dissipated"
        because = "quadrature of the account over steps"
        yield Row(case, "share unexplained", "1", CONSERVED, by, 0.0, share, 1e-4, because, 1.0)


#: every case, in the order of the page
def histories(files: Files, stored: Mapping[str, Path]) -> Iterator[Row]:
    """Whole histories that other programs made of a scene, at the accuracy that a run has by default."""
    for name, path in stored.items():
        other = references.stored(path)
        short = {"analysis.duration": "60 s", "analysis.output": {"interval": "0.1 s"}}
        scene = files[name].with_values(short, "validation").scene()
        requested = {"displacement": DISPLACEMENT, "moment": MOMENT, "tension": MOMENT}
        for quantity, error in other.errors(run(scene)).items():
            case, because = f"{name} from beginning to end", "the default accuracy"
            yield Row(
                case, f"largest difference of {quantity}", "1", SECOND,
                other.about.removeprefix("stored: "), 0.0, error, requested[quantity], because, 1.0,
            )  # fmt: skip


CASES: tuple[Case, ...] = (
    taut_beam, own_weight, chain, bar, column, pendulum, loaded_beam, cantilever, cable, current, towed,
    wave, decay, gas, two_chambers, morison, terminal, methods, hermite, energy,
)  # fmt: skip
