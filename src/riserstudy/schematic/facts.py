"""Texts for each part of a scene: its numbers, its degrees of freedom, and its loads."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from matplotlib.ticker import EngFormatter

from riserstudy.scene.ends import Body, FlexJoint, Rotation
from riserstudy.scene.forcing import TILTS, Harmonic, Platform
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import Section
from riserstudy.scene.sea import Storm, Swell
from riserstudy.scene.tensioners import Tensioners
from riserstudy.scene.weight import is_dry
from riserstudy.schematic.geometry import Geometry
from riserstudy.schematic.labels import UNBROKEN

DEGREE = math.pi / 180.0
TONNE = 1000.0  # kg


def amount(value: float, unit: str) -> str:
    """Return a number with four digits and its unit, or thousands of the unit if that is shorter."""
    text = EngFormatter(unit)(float(f"{value:.4g}"))
    return text.replace(" ", UNBROKEN)


def like(value: float, larger: float, unit: str) -> str:
    """Return a number with four digits, in thousands of its unit if a larger number nearby uses them."""
    if abs(value) < 1e3 <= abs(larger) < 1e6:
        return f"{value / 1e3:.4g}{UNBROKEN}k{unit}".replace("-", "−")
    return amount(value, unit)


def metres(value: float, sign: str = "") -> str:
    """Return a length or elevation (m) with a minus sign, and thousands separated from five digits on."""
    text = f"{value:{sign},.6g}" if abs(value) >= 10_000 else f"{value:{sign}.6g}"
    return text.replace("-", "−").replace(",", UNBROKEN) + f"{UNBROKEN}m"


def mass(value: float) -> str:
    """Return a mass (kg) in tonnes, or in kilograms below one tonne."""
    tonnes = float(f"{value / TONNE:.4g}")
    if tonnes < 1.0:
        return f"{value:.3g}{UNBROKEN}kg"
    return f"{tonnes:,.10g}".replace(",", UNBROKEN if tonnes >= 10_000 else "") + f"{UNBROKEN}t"


def degrees(value: float) -> str:
    """Return an angle (rad) in degrees."""
    return f"{value / DEGREE:.4g}°"


def sentence(parts: Iterable[str]) -> str:
    """Return the parts that are not empty, in one line."""
    return ", ".join(part for part in parts if part)


def spring_text(section: Section, of_stiffness: str = "", of_length: str = "") -> str:
    """Return name, stiffness and length of a section that is only a spring, each with its remark."""
    stiffness = amount((section.axial_stiffness or 0.0) / section.total_length, "N/m")
    length = metres(section.total_length)
    return f"{section.name}: k = {stiffness}{of_stiffness}, {length} long{of_length}"


def section_text(section: Section, geometry: Geometry, path: str) -> str:
    """Return name, size, stiffness, mass and weight of the section at a path, its contents and surroundings.

    Without gravity in the scene the weight of the contents is left out.
    """

    def mark(of: str) -> str:
        return geometry.mark(f"{path}.{of}")

    size = metres(section.total_length) + mark("length")
    if section.joints:
        size = f"{section.joints.count} × {section.joints.length:.4g} m{mark('joints')}"
    outer, inner = section.outer_diameter, section.inner_diameter
    pipe = f"{1000 * outer:.4g} mm{mark('outer_diameter')}" if outer else ""
    if outer and inner:
        pipe += f" × {500 * (outer - inner):.3g} mm wall{mark('inner_diameter')}"
    drag = section.drag
    return f"{section.name}: " + sentence(
        [
            size,
            pipe,
            _marked("EA", section.axial_stiffness, "N", mark("axial_stiffness")),
            _marked("EI", section.bending_stiffness, "N m²", mark("bending_stiffness")),
            f"{mass(section.mass)}/m{mark('mass')}" if section.mass else "",
            _weight_text(section, geometry.scene, mark),
            f"drag diameter {drag.diameter:.3g} m{mark('drag.diameter')}" if drag else "",
            "drag along the pipe" if section.tangential_drag else "",
            _marked("line load", section.lateral_load, "N/m", mark("lateral_load")),
        ]
    )


def _marked(name: str, value: float | None, unit: str, mark: str) -> str:
    """Return a named quantity with its mark; empty without a value."""
    return f"{name} {amount(value, unit)}{mark}" if value else ""


def _states_contents(other: Section, section: Section) -> bool:
    """Return whether the label of another, longer section has the density of these contents."""
    if other.contents is None or section.contents is None or other.total_length <= section.total_length:
        return False
    return bool(other.contents.density == section.contents.density)


def _weight_text(section: Section, scene: Resolved, mark: Callable[[str], str]) -> str:
    """Return the weight per length with contents, which the tension carries, and without."""
    weight, full, gravity = section.submerged_weight, section.contents, scene.gravity
    filled = 0.0
    if weight is not None and full is not None and gravity is not None:
        filled = weight + gravity * section.contents_mass
    empty = f"{like(weight, filled, 'N')}/m{mark('submerged_weight')}" if weight else ""
    where = "" if scene.water is None else " in air" if is_dry(scene, section) else " in water"
    if full is None:
        return f"{empty}{where}" if empty else ""
    inside = f"contents of {full.density:.4g} kg/m³{mark('contents.density')}"
    if any(_states_contents(other, section) for other in scene.riser):
        inside = "contents"
    if weight is None or gravity is None:
        return sentence([f"{empty}{where} without contents" if empty else "", inside])
    return sentence(
        [f"{like(filled, weight, 'N')}/m{where} with {inside}", f"{empty} without" if empty else ""]
    )


def tension_text(geometry: Geometry, tension: float) -> str:
    """Return the constant tension (N) at the top, and with a buoyancy its ratio to the carried weight."""
    scene = geometry.scene
    text = f"tension {amount(tension, 'N')}{geometry.mark('top.tension')}"
    if scene.buoyancy is None or scene.gravity is None:
        return text
    carried = sum(
        ((part.submerged_weight or 0.0) + scene.gravity * part.contents_mass) * part.total_length
        for part in scene.riser
    )
    if carried <= 0.0:
        return text
    ratio = f"{tension / carried:.3g}{geometry.mark('buoyancy.tension_ratio')}"
    return f"{text}, {ratio} times the weight in water of riser and contents"


def rotation_text(rotation: Rotation | None) -> str:
    """Return the rotational support of an end, in words."""
    if rotation == "fixed":
        return "clamped"
    if rotation in (None, "free") or isinstance(rotation, str):
        return "turns freely"
    return f"flex joint, {joint_text(rotation.stiffness)}"


def joint_text(stiffness: float, mark: str = "") -> str:
    """Return the stiffness of a flex joint with its mark."""
    return f"{amount(stiffness * DEGREE, 'N m')}/°{mark}"


def body_text(body: Body, geometry: Geometry, path: str) -> str:
    """Return the text of a concentrated mass at a path."""
    scene = geometry.scene
    density = scene.water.density if scene.water else 0.0
    weight = body.weight(scene.gravity or 0.0, density)
    heavy = f"{amount(weight, 'N')}{geometry.mark(f'{path}.submerged_weight')} in water"
    massive = f"{mass(body.mass)}{geometry.mark(f'{path}.mass')}"
    return f"{body.name}: " + sentence([massive, heavy if weight and density else ""])


def top_text(geometry: Geometry) -> str:
    """Return the support of the upper end; its remark follows its name."""
    scene, top, remark = geometry.scene, geometry.scene.top, geometry.remark("top")
    ways = {"platform": "follows the platform", "held": "held", "free": "free"}
    x = {"vessel": "surges with the platform"}.get(top.x or "", ways.get(top.x or "", ""))
    if not scene.lateral:
        return f"upper end{remark}: {ways[top.z]}"
    mark = geometry.mark("top.offset")
    away = f"{top.offset:.4g} m{mark} from above the lower end" if top.offset else ""
    on_it = "x, y and z follow the platform" if scene.spatial else "x and z follow the platform"
    both = on_it if top.x == top.z == "platform" else ""
    apart = "" if both else f"x {x}, z {ways[top.z]}"
    # a flex joint has a label of its own
    turning = "" if isinstance(top.rotation, FlexJoint) else rotation_text(top.rotation)
    return f"upper end{remark}: " + sentence([both, apart, away, turning])


def bottom_text(scene: Resolved, remark: str = "") -> str:
    """Return the support of the lower end; ``remark`` follows its name."""
    bottom = scene.bottom
    if bottom.hold == "free":
        return f"lower end{remark}: free"
    held = {"wellhead": "held", "foot": "held in z, in x by soil"}[bottom.hold]
    turns = scene.lateral and not isinstance(bottom.rotation, FlexJoint)
    return f"lower end{remark}: {held}" + (f", {rotation_text(bottom.rotation)}" if turns else "")


def freedom_text(scene: Resolved) -> str:
    """Return the directions of motion that the scene needs."""
    if scene.spatial:
        return "motion in three dimensions"
    if scene.lateral:
        return "motion in the x–z plane"
    return "motion along the axis only"


def tensioner_text(rig: Tensioners, geometry: Geometry) -> str:
    """Return number and law of the tensioners."""

    def mark(*of: str) -> str:
        return geometry.mark(*(f"top.tensioners.{one}" for one in of))

    gas, both, line = rig.gas, rig.two_chamber_gas, rig.linear
    law = ""
    if gas:
        pull = f"{amount(gas.area * gas.pressure, 'N')}{mark('gas.area', 'gas.pressure')}"
        law = f"gas, {pull} each at mid-stroke"
    elif both:
        pulls = both.high.area * both.high.pressure - both.low.area * both.low.pressure
        chambers = [f"two_chamber_gas.{c}.{of}" for c in ("high", "low") for of in ("area", "pressure")]
        law = f"gas on both sides, {amount(pulls, 'N')}{mark(*chambers)} each at mid-stroke"
        if both.pistons:
            each = "each" if both.pistons.counted == "each" else "in all"
            law += f", less pistons of {mass(both.pistons.mass)} {each}{mark('two_chamber_gas.pistons')}"
    elif line:
        law = f"{amount(line.tension, 'N')}{mark('linear.tension')} and "
        law += f"{amount(line.stiffness, 'N/m')}{mark('linear.stiffness')}"
        law += " each" if rig.count > 1 else ""
    failed = f"{len(rig.failed)} failed" if rig.failed else ""
    made_linear = "made linear" if rig.linearised else ""
    damped = _marked("damper", rig.damper, "N s/m", mark("damping"))
    stops = f"stops at {_either_way(rig.stroke.shortest, rig.stroke.longest)}" if rig.stroke else ""
    stops += mark("stroke.shortest", "stroke.longest") if stops else ""
    cylinders = ("as one cylinder" if rig.count == 1 else f"{rig.count} cylinders") + mark("count")
    return sentence([f"tensioners: {cylinders}", law, made_linear, damped, stops, failed])


def _either_way(low: float, high: float) -> str:
    """Return two positions (m) on a stroke, as one number if they are at equal distances from mid-stroke."""
    return f"±{metres(high)}" if low == -high else f"{metres(low)} and {metres(high, '+')}"


def platform_texts(platform: Platform, geometry: Geometry) -> list[str]:
    """Return the platform's prescribed motions, one text each."""
    texts = []
    for name, motion in platform.harmonics:
        path = f"platform.{name}"
        texts.append(f"{name} {_harmonic(name, motion, geometry)}{geometry.remark(path)}")
    for name in ("surge", "sway", "heave", "roll", "pitch", "yaw"):
        if hasattr(getattr(platform, name), "points"):
            texts.append(f"{name} by a time series")
        away = getattr(platform.position, name, None)
        if away:
            mark = geometry.mark(f"platform.position.{name}")
            texts.append(f"rests at {name} {_size(name, away)}{mark}")
    response, cruise = platform.response, platform.cruise
    if response:
        texts.append(f"{', '.join(response.moving)} by response to waves")
    if cruise:
        heading = f" towards {degrees(cruise.heading)}" if cruise.heading else ""
        mark = geometry.mark("platform.cruise.speed")
        texts.append(f"cruises at {cruise.speed:.3g} m/s{mark}{heading}")
    return texts


def _harmonic(name: str, motion: Harmonic, geometry: Geometry) -> str:
    size, period = (geometry.mark(f"platform.{name}.{of}") for of in ("amplitude", "period"))
    return f"±{_size(name, motion.amplitude)}{size} in {motion.period:.4g} s{period}"


def _size(name: str, value: float) -> str:
    return degrees(value) if name in TILTS else f"{value:.4g} m"


def vessel_texts(geometry: Geometry) -> list[str]:
    """Return the loads on a platform that is free to surge."""

    def mark(of: str) -> str:
        return geometry.mark(f"vessel.{of}")

    scene = geometry.scene
    vessel = scene.vessel
    if vessel is None:
        return []
    wind, drift, thrusters = vessel.wind, vessel.wave_drift, vessel.thrusters
    added = ""
    if vessel.added_mass:
        added = f" and {mass(vessel.added_mass)}{mark('added_mass')} of added mass"
    also = [way for way in ("sway", "yaw") if scene.spatial and getattr(vessel, way)]
    ways = " and ".join(["surge", *also]) if len(also) < 2 else "surge, sway and yaw"
    texts = [f"platform: free to {ways}, {mass(vessel.mass)}{mark('mass')}{added}"]
    if wind:
        speed = f"{wind.speed:.3g} m/s{mark('wind.speed')}"
        texts.append(f"wind {speed} towards {degrees(wind.heading or 0.0)}")
    if drift:
        force = f"{amount(drift.force, 'N')}{mark('wave_drift.force')}"
        texts.append(f"wave drift {force} towards {degrees(drift.heading or 0)}")
    if thrusters:
        pull = f"thrusters {amount(thrusters.gain, 'N/m')}{mark('thrusters.gain')}"
        most = _marked(", at most", thrusters.saturation, "N", mark("thrusters.saturation"))
        to = f"{thrusters.command:.4g} m{mark('thrusters.command')}"
        texts.append(f"{pull}{most}, towards x = {to}")
    return texts


def wave_text(wave: Swell | Storm, geometry: Geometry) -> str:
    """Return the text of a wave or a sea."""
    if isinstance(wave, Swell):
        height = wave.wave_height
        high, period = geometry.mark("wave.height", "wave.amplitude"), geometry.mark("wave.period")
        return f"wave: height {height:.3g} m{high}, {wave.period:.3g} s{period}"
    high, peak = (geometry.mark(f"wave.{of}") for of in ("significant_height", "peak_period"))
    size = f"significant height {wave.significant_height:.3g} m{high}"
    return f"sea: {size}, peak {wave.peak_period:.3g} s{peak}"
