"""Input that cannot be meant: one message with file, field, what was found and what is allowed."""

from pathlib import Path

import pytest

from riserstudy import load_scene
from riserstudy.errors import InputError
from riserstudy.scene.load import read_scene

SCENES = Path(__file__).parents[2] / "config" / "scenes"
SURGE, HEAVE, CHANG = (SCENES / "bench/s2.yaml", SCENES / "bench/s3.yaml", SCENES / "chang2020/heave.yaml")
LIU = SCENES / "liu2020/heave.yaml"
DRIVE_OFF = SCENES / "liu2017/ref_0.yaml"
RIG = {"count": 1, "mid_stroke": "riser unstretched"}
STROKE = {"shortest": "-7 m", "longest": "20 m", "stop_stiffness": "1e9 N/m"}
POINTS = [{"time": f"{t} s", "value": "0 m"} for t in (0, 1, 1, 2)]
PROFILE = [{"elevation": f"{z} m", "speed": "1 m/s"} for z in (0, 100, 50)]
MESH = {"elements": 10}
WATER = {"density": "1025 kg/m^3", "seabed": "0 m", "surface": "533 m"}
WAVE = {"height": "6 m", "period": "8 s", "above_mean_level": "none"}
COUPLING = "vessel.coupling"


def turns(**values):
    return {"scheme": "staggered", "interval": "1 s"} | values


#: scene, path, value, field of the message, what else the message says
REFUSED = {
    # units
    "a bare number": (SURGE, "riser[0].mass", 1006, "riser[0].mass", "1006 has no unit; write"),
    "a bare number as text": (SURGE, "riser[0].mass", "1006", "riser[0].mass", "has no unit"),
    "a wrong dimension": (SURGE, "riser[0].length", "5 kg", "riser[0].length", "wrong dimension"),
    "an unknown unit": (SURGE, "riser[0].length", "5 cubits", "riser[0].length", "not known"),
    "words": (SURGE, "riser[0].length", "long", "riser[0].length", "does not start with a number"),
    "tonnes as a force": (SURGE, "top.tension", "232 t", "top.tension", "write tf"),
    "a stiffness without angle": (
        SURGE, "top.rotation", {"stiffness": "27 kN*m"}, "top.rotation.stiffness", "an angle, deg or rad",
    ),
    "an angle without unit": (SURGE, "platform.surge.phase", 1.0, "platform.surge.phase", "no unit"),
    "an angular speed for an angle": (
        SURGE, "platform.surge.phase", "1 rad/s", "platform.surge.phase", "dimension",
    ),
    "a pressure of unsaid kind": (
        CHANG, "top.tensioners.gas.pressure", "190.2 bar", "top.tensioners.gas.pressure",
        "neither 'absolute' nor 'gauge'",
    ),
    "a pressure below vacuum": (
        CHANG, "top.tensioners.gas.pressure", "-1.1 bar gauge", "top.tensioners.gas.pressure",
        "greater than 0",
    ),
    # numbers
    "NaN": (SURGE, "riser[0].mass", float("nan"), "riser[0].mass", "nan"),
    "NaN with a unit": (SURGE, "riser[0].mass", "nan kg/m", "riser[0].mass", "number"),
    "infinity": (SURGE, "top.tension", float("inf"), "top.tension", "inf"),
    "a size beyond all that is met": (
        SURGE, "riser[0].outer_diameter", "1e80 m", "riser[0].outer_diameter", "give at most 1e+30 m",
    ),
    "a number too large": (SURGE, "top.tension", "1e999 N", "top.tension", "not finite"),
    "a negative mass": (SURGE, "riser[0].mass", "-3 kg/m", "riser[0].mass", "greater than 0"),
    "text for a count": (CHANG, "top.tensioners.count", "4", "top.tensioners.count", "whole number"),
    "no cylinders": (CHANG, "top.tensioners.count", 0, "top.tensioners.count", "1"),
    "a billion cylinders": (CHANG, "top.tensioners.count", 10**9, "top.tensioners.count", "1000"),
    "half an element": (SURGE, "analysis.mesh", {"elements": 1.5}, "analysis.mesh.elements", "whole number"),
    "a spectral radius above one": (
        SURGE, "analysis.method", {"rho_inf": 2.0}, "analysis.method.rho_inf", "less than or equal to 1",
    ),
    "a spectral radius of words": (
        SURGE, "analysis.method", {"rho_inf": "high"}, "analysis.method.rho_inf", "number",
    ),
    "parameters of two methods": (
        SURGE, "analysis.method", {"rho_inf": 0.5, "beta": 0.25}, "analysis.method.beta", "unknown key",
    ),
    "half of a method": (SURGE, "analysis.method", {"beta": 0.25}, "analysis.method.gamma", "missing"),
    "a word for a joint": (SURGE, "top.rotation", "fixd", "top.rotation", "'free' or 'fixed'"),
    "one bad point of many": (
        SURGE, "platform.surge", {"points": [{"time": "0 s", "value": "1 kg"}] * 4},
        "platform.surge.points[0].value", "wrong dimension",
    ),
    # keys
    "an unknown key": (SURGE, "riser[0].colour", "red", "riser[0].colour", "unknown key"),
    "an unknown section": (SURGE, "moonpool", {}, "moonpool", "unknown key"),
    "a missing field": (SURGE, "title", None, "title", "missing"),
    "a missing section": (SURGE, "bottom", None, "bottom", "missing"),
    "a list that is none": (SURGE, "riser", "pipe", "riser", "list"),
    "a word not among those allowed": (SURGE, "top.x", "floating", "top.x", "'floating'"),
    # the sea
    "a wave on water of unsaid depth": (SURGE, "wave", WAVE, "wave", "add water.surface and water.seabed"),
    "a wave of two heights": (SURGE, "wave", WAVE | {"amplitude": "3 m"}, "wave", "height or amplitude"),
    "a wave that ends nowhere": (
        SURGE, "wave", {"height": "6 m", "period": "8 s"}, "wave.above_mean_level", "missing",
    ),
    "a sea above its bed": (
        SURGE, "water", WATER | {"seabed": "600 m"}, "water", "seabed is not below surface",
    ),
    "a drift of unsaid depth": (
        SURGE, "current", {"profile": {"sum": [{"shape": "uniform", "surface_speed": "1 m/s"}]}},
        "current.profile",
        "add water.surface",
    ),
    # geometry and physics
    "a pipe without wall": (SURGE, "riser[0].inner_diameter", "1 m", "riser[0]", "is not smaller than"),
    "two ways to stiffness": (SURGE, "riser[0].axial_stiffness", "1 GN", "riser[0]", "not both"),
    "two ways to length": (
        SURGE, "riser[0].joints", {"count": 3, "length": "10 m"}, "riser[0]", "length or joints",
    ),
    "contents without gravity": (
        SURGE, "riser[0].contents", {"density": "1 t/m^3"},
        "riser[0].contents", "gravity",
    ),
    "drag without water": (SURGE, "water", None, "riser[0].drag", "requires water"),
    "a stroke that closes the gas volume": (
        CHANG, "top.tensioners.stroke", STROKE, "top.tensioners", "less than 18.4",
    ),
    "a stroke that closes the low-pressure volume": (
        LIU, "top.tensioners.stroke.shortest", "-9.2 m", "top.tensioners", "more than -9.13",
    ),
    "a stroke that closes the high-pressure volume": (
        LIU, "top.tensioners.stroke.longest", "46 m", "top.tensioners", "less than 45.8",
    ),
    "a line over more than the low-pressure volume": (
        LIU, "top.tensioners.linearised", {"by": "least squares", "shortest": "-10 m", "longest": "8 m"},
        "top.tensioners", "at linearised.shortest -10 m no low-pressure gas volume is left",
    ),
    "a tangent where the gas volume is closed": (
        CHANG, "top.tensioners.linearised", {"by": "tangent", "at": "19 m"}, "top.tensioners",
        "at linearised.at 19 m no gas volume is left; give less than 18.4",
    ),
    "a chord of one end": (
        CHANG, "top.tensioners.linearised", {"by": "chord", "longest": "8 m"},
        "top.tensioners.linearised", "'by: chord' requires both shortest and longest",
    ),
    "a place on a chord": (
        CHANG, "top.tensioners.linearised",
        {"by": "chord", "shortest": "-8 m", "longest": "8 m", "at": "1 m"},
        "top.tensioners.linearised", "'at' has no effect with 'by: chord'",
    ),
    "a piston without gravity": (LIU, "gravity", None, "top.tensioners.piston_mass", "requires gravity"),
    "two laws of a tensioner": (
        CHANG, "top.tensioners.linear", {"tension": "1 MN", "stiffness": "1 kN/m"}, "top.tensioners",
        "of gas, two_chamber_gas, linear, table and carried",
    ),
    "a weight carried where it stands": (
        CHANG, "top.tensioners", {**RIG, "carried": {"doubles_over": "100 m"}}, "top.tensioners.carried",
        "hold: free",
    ),
    "a ratio of damping without a weight": (
        CHANG, "top.tensioners.damping", {"ratio": 0.1}, "top.tensioners", "damping.ratio applies to",
    ),
    "both ends free": (HEAVE, "top", {"z": "free"}, "bottom.hold", "both ends of the riser are free"),
    "a top on no platform": (SURGE, "platform", None, "top.x", "the scene has no platform"),
    "lateral motion with x unsaid": (SURGE, "top.x", None, "top.x", "missing, but the scene has lateral"),
    "a current that goes back down": (
        SURGE, "current", {"profile": PROFILE}, "current.profile", "the elevations do not increase",
    ),
    "a motion that goes back in time": (
        SURGE, "platform.surge", {"points": POINTS}, "platform.surge.points", "the times do not increase",
    ),
    # a platform that floats, and the ground
    "a top on no vessel": (DRIVE_OFF, "vessel", None, "vessel", "'top.x: vessel' requires it"),
    "a vessel that turns in its first-order motions": (
        DRIVE_OFF, "platform", {},
        "vessel.yaw", "constant heading",
    ),
    "a conductor's foot in no soil": (DRIVE_OFF, "soil", None, "soil", "'bottom.hold: foot'"),
    "a joint below the lowest section": (
        DRIVE_OFF, "riser[0].flex_joint_below", {"stiffness": "1 kN*m/deg"}, "riser[2].flex_joint_below",
        "2 sections have a flex joint",
    ),
    "a stress wanted nowhere": (
        DRIVE_OFF, "analysis.output.stress_in", "casing", "analysis.output.stress_in",
        "'casing' is not a section",
    ),
    "stops of a joint that are nowhere": (
        DRIVE_OFF, "top.telescopic_joint.stop", {"stiffness": "1 N/m"},
        "top.telescopic_joint.stop", "give stroke (outwards), collapse (inwards) or both",
    ),
    "a joint that collapses by more than its length": (
        DRIVE_OFF, "top.telescopic_joint.stop", {"collapse": "90 m", "stiffness": "1 N/m"},
        "top.telescopic_joint", "is not less than the length of the joint",
    ),
    "turns of no length": (DRIVE_OFF, "vessel.coupling", turns(interval="0 s"), COUPLING + ".interval", "0"),
    "turns of no known scheme": (
        DRIVE_OFF, "vessel.coupling", turns(scheme="loose"), COUPLING + ".scheme", "staggered",
    ),
    "a tolerance of turns that are not repeated": (
        DRIVE_OFF, "vessel.coupling", turns(tolerance="1 mm"), "vessel.coupling.tolerance",
        "'scheme: staggered', which does not iterate",
    ),
    "turns longer than the run": (
        DRIVE_OFF, "vessel.coupling", turns(interval="151 s"), "vessel.coupling.interval",
        "at most analysis.duration, 150 s",
    ),
    "a million turns": (
        DRIVE_OFF, "vessel.coupling", turns(interval="0.1 ms"),
        "vessel.coupling.interval", "1000000 intervals",
    ),
    # analysis
    "an accuracy of nothing": (SURGE, "analysis.accuracy", "0 %", "analysis.accuracy", "greater than 0"),
    "an accuracy below nothing": (SURGE, "analysis.accuracy", "-1 %", "analysis.accuracy", "greater"),
    "an accuracy of no number": (SURGE, "analysis.accuracy", "1.2.3 %", "analysis.accuracy", "percentage"),
    "an accuracy without per cent": (SURGE, "analysis.accuracy", 0.01, "analysis.accuracy", "percentage"),
    "a mesh without step": (SURGE, "analysis.mesh", MESH, "analysis", "only one of mesh and step"),
    "dynamics without output": (SURGE, "analysis.output", None, "analysis", "one of duration and output"),
    "time that runs back": (SURGE, "analysis.duration", "-1 s", "analysis.duration", "greater than 0"),
    "output after the end": (SURGE, "analysis.output.start", "200 s", "analysis", "after the end"),
    "one output": (SURGE, "analysis.output.interval", "2000 s", "analysis", "longer than the duration"),
    "too much output": (SURGE, "analysis.output.interval", "1 ns", "analysis", "outputs"),
    "a station beyond the riser": (
        SURGE, "analysis.output.stations", ["9 km"],
        "analysis.output.stations", "not on the riser",
    ),
    "no stations": (SURGE, "analysis.output.stations", [], "analysis.output.stations", "at least 1"),
    "stations out of order": (
        SURGE, "analysis.output.stations", ["9 m", "5 m"], "analysis.output", "the stations do not increase",
    ),
    # origins
    "an assumption without evidence": (
        SURGE, "riser[0].mass", {"assumed": "1 t/m"}, "riser[0].mass", "because",
    ),
    "a calibration to nothing": (SURGE, "riser[0].mass", {"calibrated": "1 t/m"}, "riser[0].mass", "to:"),
    "a range of one value": (
        SURGE, "riser[0].mass", {"assumed": "1 t/m", "because": "so", "range": ["1 t/m"]},
        "riser[0].mass.range", "two values",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_input_that_cannot_be_meant_is_refused_with_field_and_reason(case):
    path, field, value, place, reason = REFUSED[case]
    with pytest.raises(InputError) as refusal:
        load_scene(path, **{field: value})
    error = refusal.value
    assert error.exit_code == 2
    assert error.field == place
    assert reason in str(error)
    assert "\n" not in str(error)
    assert error.where in (str(path), "overrides", f"{path} with overrides")
    assert error.found
    assert error.allowed


STEPPED = {"analysis.mesh": MESH, "analysis.step": "0.25 s"}


#: what is set beside turns of platform and riser, what the message says
NOT_IN_TURNS = {
    "statics": (
        dict.fromkeys(("analysis.duration", "analysis.output", "analysis.step")), "add analysis.duration",
    ),
    "explicit stepping": (STEPPED | {"analysis.method": "explicit"}, "analysis.method explicit"),
    "stages": (STEPPED | {"analysis.method": "TR-BDF2"}, "analysis.method TR-BDF2"),
    "a beam of small slopes": (STEPPED | {"analysis.solver": "hermite"}, "analysis.solver hermite"),
    "a jolt": ({"analysis.start": "undeflected"}, "analysis.start: undeflected"),
    "steps that leave none to compare with": (
        STEPPED | {"analysis.step": "0.26 s"}, "at least 4 times analysis.step",
    ),
    "turns of too many steps": (
        STEPPED | {"analysis.step": "9 us"}, "more than 100000 time steps",
    ),
    "a body at the vessel": (
        {
            "top.telescopic_joint": None,
            "top.z": "free",
            "top.elevation": None,
            "top.tension": "3 MN",
            "top.body": {"name": "ring", "mass": "1 t"},
        },
        "top.body acts on it",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", NOT_IN_TURNS)
def test_what_platform_and_riser_cannot_do_in_turns_is_refused(case):
    values, reason = NOT_IN_TURNS[case]
    load_scene(DRIVE_OFF, **values)
    with pytest.raises(InputError, match=r"vessel\.coupling") as refusal:
        load_scene(DRIVE_OFF, **{**values, "vessel.coupling": turns()})
    assert reason in str(refusal.value)


def test_turns_of_four_steps_are_long_enough():
    load_scene(DRIVE_OFF, **STEPPED, **{"vessel.coupling": turns()})


@pytest.mark.parametrize(
    "path", ["riser[4].length", "riser[0.length", "riser]0[.length", "top..x", "", "top.x.y", "riser.x"]
)
def test_a_path_that_leads_nowhere_is_refused(path):
    with pytest.raises(InputError):
        load_scene(SURGE, **{path: "3 m"})


@pytest.mark.parametrize(
    "text, problem",
    [
        ("title: !!python/object/apply:os.system ['true']", "a YAML tag"),
        ("title: !custom x", "a YAML tag"),
        ("a: &one {b: 1}\nc: *one", "anchor"),
        ("title: a\ntitle: b", "title"),
        ("1: a", "is not text"),
        ("- a\n- b", "not a scene"),
        ("title: .nan", "nan"),
        ("title: [", "line"),
        ("", "not a scene"),
        ("a: 2020-01-01", "date"),
        ("a: " + "[" * 30 + "]" * 30, "nested"),
        ("a: " + "x" * 1_000_001, "larger than 1 MB"),
    ],
    ids=lambda text: text[:20].strip(),
)
def test_a_file_that_is_no_plain_yaml_is_refused(text, problem, tmp_path):
    file = tmp_path / "scene.yaml"
    file.write_text(text)
    with pytest.raises(InputError) as refusal:
        read_scene(file)
    assert problem in str(refusal.value)
    assert str(file) in str(refusal.value)


def test_a_tag_is_not_executed(tmp_path):
    mark = tmp_path / "executed"
    file = tmp_path / "scene.yaml"
    file.write_text(f"title: !!python/object/apply:pathlib.Path.touch [{str(mark)!r}]")
    with pytest.raises(InputError):
        read_scene(file)
    assert not mark.exists()


def test_what_is_no_text_is_refused(tmp_path):
    file = tmp_path / "scene.yaml"
    file.write_bytes(b"title: \xff\xfe")
    with pytest.raises(InputError, match="UTF-8"):
        read_scene(file)
    with pytest.raises(InputError, match="No such file"):
        read_scene(tmp_path / "absent.yaml")
    with pytest.raises(InputError):
        read_scene(tmp_path)
