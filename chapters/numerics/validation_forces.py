"""Forces of gas springs and of water, compared with closed forms."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from chapters.numerics import closed_forms as known
from chapters.numerics.validation_row import CLOSED, Files, Row, simulated
from riserstudy.scene.load import SceneFile

GAS = {"area": 0.1, "pressure": 150e5, "volume": 3.0, "exponent": 1.4}

REACH = 4.0  # m


def _pulled(reach: float) -> SceneFile:
    """A very stiff pipe, held below; the platform rises and extends the cylinders by ``reach`` (m)."""
    chamber: dict[str, Any] = {"area": f"{GAS['area']} m^2", "pressure": f"{GAS['pressure']} Pa absolute"}
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
    """Gas cylinders that a heaving platform extends."""
    run = simulated(_pulled(REACH))
    stroke = run["tensioner_stroke"].isel(cylinder=0).values
    force = run["tensioner_force"].isel(cylinder=0).values
    last = run["time"].values >= 40.0  # the ramp is over, the amplitude is constant
    top = int(np.argmax(np.where(last, stroke, -np.inf)))
    case, by = "gas cylinder extended by heave", "p V^n = const., from mid-stroke"
    because = "the stretch of the pipe, 0.00001 mm; one output is at the platform's highest position"
    exact = known.gas_pull(**GAS, reach=REACH)
    yield Row(case, "pull", "N", CLOSED, by, exact, float(force[top]), 1e-6, because)
    lift = slice(top - 100, top + 1)  # a quarter of a period, from mid-stroke
    work = float(np.trapezoid(force[lift], stroke[lift]))
    done = known.gas_work(**GAS, reach=REACH)
    because = "the error of numerical integration over 100 output times"
    yield Row(
        case,
        "work from mid-stroke to the top",
        "J",
        CLOSED,
        "integral of the pull over the stroke",
        done,
        work,
        1e-5,
        because,
    )


HIGH, LOW = known.Chamber(0.205, 2.08e6, 9.38), known.Chamber(0.246, 0.15e6, 2.25)


def two_chambers(_: Files) -> Iterator[Row]:
    """A direct-acting cylinder with gas on both sides of its piston, extended by 3 m, and by 3 m ± 1 cm."""
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
        run = simulated(file.with_values(values, "validation"))
        return tuple(  # type: ignore[return-value]
            float(run[f"tensioner_{name}_static"].isel(cylinder=0)) for name in ("force", "stroke")
        )

    (less, shorter), (pull, _middle), (more, longer) = (pulled(reach + d) for d in (-aside, 0.0, aside))
    exact, stiffness = known.two_chambers(HIGH, LOW, 1.4, reach)
    case, by = "direct-acting tensioner extended by 3 m", "p V^n = const. in both chambers"
    because = "the stretch of the pipe, 0.0001 mm"
    yield Row(case, "pull", "N", CLOSED, by, exact, pull, 1e-6, because)
    slope = (more - less) / (longer - shorter)
    because = "the error of the finite difference over 2 cm, which is of second order"
    yield Row(case, "stiffness", "N/m", CLOSED, by, stiffness, slope, 1e-5, because)


PILE = {"diameter": 1.0, "height": 2.0, "period": 8.0, "depth": 60.0}


def morison(_: Files) -> Iterator[Row]:
    """A pile in a small wave, so stiff that it does not move."""
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
    by = "Morison's formula with Airy's wave, up to the mean water level"
    because = "the error of 240 segments, which is of second order in their length"
    for name, loads, exact in (
        ("inertia", {"added_mass": {"coefficient": 1.0}}, known.pile_by_inertia(1.0, **PILE)),
        ("drag", {"drag": {"coefficient": 1.0}}, known.pile_by_drag(1.0, **PILE)),
    ):
        section = {f"riser[0].{key}": load | {"diameter": across} for key, load in loads.items()}
        run = simulated(SceneFile("validation", tree).with_values(section, "validation"))
        moment = float(np.abs(run["bending_moment"].isel(s=0)).max())
        case = f"stiff pile in a wave, {name} alone"
        yield Row(case, "moment at its foot", "N m", CLOSED, by, exact, moment, 2e-4, because)


def terminal(_: Files) -> Iterator[Row]:
    """A platform that a steady force drives off, until the drag nearly equals the force."""
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
    run = simulated(SceneFile("validation", tree)).isel(time=-1)
    speed, way = known.driven(force, drag, mass + added, time)
    case, by = "platform driven to its terminal speed", "√(F/c) tanh(t √(F c) / m)"
    because = "the pull of the thin riser in the model, a few newtons"
    now = float(run["platform_speed_x"])
    yield Row(case, "speed after 400 s", "m/s", CLOSED, by, speed, now, 1e-5, because)
    distance = float(run["platform_surge"])
    yield Row(
        case, "distance after 400 s", "m", CLOSED, "integral of this speed", way, distance, 1e-5, because
    )
