"""What others rely on: names, dimensions, units and attributes of a run's dataset."""

import json

import numpy as np
import pytest
import xarray as xr

from riserstudy import simulate
from riserstudy.dataset.label import coordinates
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.scene.load import SceneFile

PIPE = {
    "name": "riser",
    "length": "300 m",
    "outer_diameter": "0.5334 m",
    "inner_diameter": "0.4826 m",
    "young_modulus": "206 GPa",
    "mass": "900 kg/m",
    "submerged_weight": "1 kN/m",
    "drag": {"coefficient": 1.1, "diameter": "1 m"},
}
GAS = {"area": "0.1 m^2", "pressure": "40 bar absolute", "volume": "3 m^3", "exponent": 1.4}
RIG = {"count": 3, "mid_stroke": "riser in equilibrium", "gas": GAS, "damping": "1 kN*s/m"}
RIGGED = {
    "title": "rigged",
    "water": {"density": "1025 kg/m^3"},
    "riser": [PIPE],
    "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": {"stiffness": "30 kN*m/deg"}},
    "top": {"x": "platform", "z": "free", "rotation": {"stiffness": "10 kN*m/deg"}, "tensioners": RIG},
    "platform": {
        "surge": {"amplitude": "2 m", "period": "10 s", "ramp": "10 s"},
        "heave": {"amplitude": "1 m", "period": "10 s", "ramp": "10 s"},
    },
    "analysis": {
        "duration": "20 s",
        "output": {"interval": "0.5 s"},
        "mesh": {"elements": 20},
        "step": "0.1 s",
    },
}
PLAIN_TOP = {"x": "platform", "z": "free", "rotation": "free", "tension": "1200 kN"}
PLAIN = RIGGED | {"title": "plain", "top": PLAIN_TOP}
AXIAL = RIGGED | {
    "title": "axial",
    "riser": [{k: PIPE[k] for k in PIPE if k != "drag"}],
    "top": {"z": "free", "tensioners": RIG},
    "platform": {"heave": {"amplitude": "1 m", "period": "10 s", "ramp": "10 s"}},
}
STATIC = {k: v for k, v in PLAIN.items() if k != "platform"} | {
    "title": "static",
    "top": PLAIN_TOP | {"x": "held"},
    "current": {
        "profile": [{"elevation": "0 m", "speed": "0 m/s"}, {"elevation": "300 m", "speed": "1 m/s"}]
    },
    "analysis": {"mesh": {"elements": 20}},
}
SCENES = {"rigged": RIGGED, "plain": PLAIN, "axial": AXIAL, "static": STATIC}

HISTORY, NODES = ("time", "s"), ("s_node",)
COMMON = {"effective_tension": "N", "z": "m"}
EXPECTED = {
    "rigged": {
        **dict.fromkeys(("x", "z", "effective_tension", "bending_moment"), HISTORY),
        **dict.fromkeys(("ufj_angle", "lfj_angle", "stroke"), ("time",)),
        **dict.fromkeys(("tensioner_stroke", "tensioner_force"), ("time", "cylinder")),
    },
    "plain": {
        **dict.fromkeys(("x", "z", "effective_tension", "bending_moment"), HISTORY),
        **dict.fromkeys(("ufj_angle", "lfj_angle", "stroke"), ("time",)),
    },
    "axial": {
        **dict.fromkeys(("z", "effective_tension"), HISTORY),
        "stroke": ("time",),
        **dict.fromkeys(("tensioner_stroke", "tensioner_force"), ("time", "cylinder")),
    },
    "static": {
        **dict.fromkeys(("x", "z", "effective_tension", "bending_moment"), ("s",)),
        **dict.fromkeys(("ufj_angle", "lfj_angle"), ()),
    },
}
UNITS = {
    "time": "s",
    "s": "m",
    "s_node": "m",
    "x": "m",
    "z": "m",
    "effective_tension": "N",
    "bending_moment": "N m",
    "ufj_angle": "rad",
    "lfj_angle": "rad",
    "stroke": "m",
    "tensioner_stroke": "m",
    "tensioner_force": "N",
}


@pytest.fixture(scope="module")
def runs():
    return {name: simulate(SceneFile("test.yaml", tree)) for name, tree in SCENES.items()}


@pytest.fixture(params=SCENES)
def run(request, runs):
    return request.param, runs[request.param]


def test_names_and_dimensions_are_those_of_the_contract(run):
    name, found = run
    for variable, dimensions in EXPECTED[name].items():
        assert found[variable].dims == dimensions, variable
    absent = set(UNITS) - set(EXPECTED[name]) - {"time", "s", "s_node"}
    assert not absent & set(found.variables)


def test_envelopes_stand_at_all_nodes(run):
    name, found = run
    if name == "static":
        return
    for variable, dimensions in EXPECTED[name].items():
        if dimensions == HISTORY:
            for end in ("_max", "_min", "_static"):
                assert found[variable + end].dims == NODES
            # envelopes are taken at every step, so they hold all outputs
            over = found[variable].max("time").values <= found[variable + "_max"].values + 1e-6
            assert over.all()


def test_a_statics_only_run_has_no_time(runs):
    assert "time" not in runs["static"].dims
    assert "time" not in runs["static"].variables


def test_every_variable_has_units_and_a_name(run):
    for variable, array in run[1].variables.items():
        assert array.attrs.get("units"), variable
        assert array.attrs.get("long_name"), variable
        base = variable.removesuffix("_max").removesuffix("_min").removesuffix("_static")
        if base in UNITS:
            assert array.attrs["units"] == UNITS[base]


def test_nothing_is_an_object_or_complex_or_undefined(run):
    for variable, array in run[1].variables.items():
        assert array.dtype.kind in "fiuU", variable
        assert array.dtype.kind != "f" or np.isfinite(array).all()


def test_coordinates_rise(run):
    for variable in {"time", "s", "s_node"} & set(run[1].variables):
        assert (np.diff(run[1][variable]) > 0.0).all()
    assert float(run[1]["s"][0]) == 0.0
    assert float(run[1]["s"][-1]) == pytest.approx(300.0)


def test_attributes_tell_effects_audit_error_and_provenance(run):
    name, found = run
    assert found.attrs["title"] == name
    assert found.attrs["Conventions"].startswith("CF-")
    effects = json.loads(found.attrs["effects"])
    absent = json.loads(found.attrs["effects_off"])
    assert "axial elasticity" in effects
    assert not set(effects) & set(absent)
    assert all(effects.values())
    estimate = json.loads(found.attrs["error_estimate"])
    assert all(0.0 <= value < 1.0 for value in estimate.values())
    provenance = json.loads(found.attrs["provenance"])
    assert provenance["scene"] == SCENES[name]
    assert provenance["plain_values"] == "given"
    assert provenance["engine"]
    if name != "static":
        audit = json.loads(found.attrs["audit"])
        assert audit["unexplained_share"] < 1e-3
        assert found.attrs["newton_iterations"] >= found.attrs["steps"]
    if "tensioner_stroke" in found:
        assert found.attrs["largest_stroke"] == pytest.approx(float(np.abs(found["tensioner_stroke"]).max()))
    assert found.attrs["smallest_tension"] <= float(found["effective_tension"].min()) + 1e-6


def test_a_dataset_survives_its_file(run, tmp_path):
    name, found = run
    write_dataset(found, tmp_path / "run.nc")
    assert [p.name for p in tmp_path.iterdir()] == ["run.nc"]
    with xr.open_dataset(tmp_path / "run.nc") as back:
        xr.testing.assert_identical(back.load(), found)


def test_stroke_is_the_extension_from_the_static_state(runs):
    found = runs["rigged"]
    # the platform rises: cylinders and telescopic joint grow longer together
    grown = found["tensioner_stroke"].isel(cylinder=0)
    np.testing.assert_allclose(found["stroke"], grown - grown[0], atol=1e-12)
    assert float(found["stroke"][0]) == 0.0
    heave = np.sin(2 * np.pi * found["time"] / 10.0)
    heave = heave * np.where(found["time"] < 10, 0.5 * (1 - np.cos(np.pi * found["time"] / 10)), 1)
    rise = found["z"].isel(s=-1) - found["z_static"].isel(s_node=-1)
    np.testing.assert_allclose(found["stroke"], heave - rise, atol=1e-10)


def test_cylinders_share_the_pull_that_holds_the_riser(runs):
    found = runs["rigged"]
    pull = found["tensioner_force"]
    assert found.sizes["cylinder"] == 3
    np.testing.assert_allclose(pull, pull.isel(cylinder=0, drop=True).expand_dims(cylinder=3).T)
    at_rest = float(found["tensioner_force_static"].sum())
    assert at_rest == pytest.approx(3 * 0.1 * 40e5, rel=1e-9)
    assert float(found["effective_tension_static"][-1]) == pytest.approx(at_rest, rel=1e-9)


def test_flex_joints_carry_stiffness_times_angle(runs):
    found = runs["rigged"]
    moment = found["bending_moment"]
    scale = float(np.abs(found["lfj_angle"]).max())
    bottom = moment.isel(s=0) / (30e3 * 180 / np.pi)
    np.testing.assert_allclose(bottom, found["lfj_angle"], atol=2e-3 * scale)
    top = moment.isel(s=-1) / (10e3 * 180 / np.pi)
    scale = float(np.abs(found["ufj_angle"]).max())
    np.testing.assert_allclose(-top, found["ufj_angle"], atol=2e-3 * scale)


def test_angles_of_hinges_are_those_of_the_shape(runs):
    found = runs["plain"]
    fine = found.isel(s=slice(0, 2))
    slope = np.arctan2(fine["x"].diff("s"), fine["z"].diff("s")).isel(s=0)
    # the end angle differs from its segment's by a sixth of the curvature over it
    assert float(np.abs(found["lfj_angle"] - slope).max()) < 0.02


def test_stations_are_where_they_were_asked_for():
    stations = ["20 m", "171 m"]
    analysis = RIGGED["analysis"] | {"output": {"interval": "0.5 s", "stations": stations}}
    found = simulate(SceneFile("test.yaml", RIGGED | {"analysis": analysis}))
    assert found["s"].values.tolist() == [20.0, 171.0]
    assert found.sizes["s_node"] == 21
    whole = simulate(SceneFile("test.yaml", RIGGED))
    apart = float(abs(found["x"] - whole["x"].interp(s=found["s"], method="cubic")).max())
    assert apart < 1e-3 * float(abs(whole["x"]).max())


def test_a_station_at_a_node_is_that_node_to_the_last_bit():
    whole = simulate(SceneFile("test.yaml", RIGGED))
    nodes = whole["s"].values[[3, 12]]
    output = {"interval": "0.5 s", "stations": [f"{s!r} m" for s in nodes.tolist()]}
    analysis = RIGGED["analysis"] | {"output": output}
    found = simulate(SceneFile("test.yaml", RIGGED | {"analysis": analysis}))
    for name in ("x", "z", "effective_tension", "bending_moment"):
        np.testing.assert_array_equal(found[name], whole[name].sel(s=nodes))


@pytest.mark.parametrize(
    "value", [np.nan, np.inf, -np.inf, 5e-324, 1e-310, 1.7e308, -1.7e308, 0.0, -0.0, 3.0]
)
def test_every_number_survives_being_stored(tmp_path, value):
    """In a small and a large array, which are stored in different ways."""
    rng = np.random.default_rng(1)
    values = rng.standard_normal(3000)
    values[::7] = value
    dataset = xr.Dataset({"large": ("n", values), "small": ("k", values[:50])})
    write_dataset(dataset, tmp_path / "a.nc")
    found = xr.load_dataset(tmp_path / "a.nc")
    for name in ("large", "small"):
        kept = dataset[name].values[::7]
        np.testing.assert_array_equal(found[name].values[::7], kept)
        np.testing.assert_allclose(found[name], dataset[name], rtol=1e-9)


def test_a_node_is_found_by_its_arclength():
    """130 equal segments add up to 533.0000000000013 m."""
    s = np.append(0.0, np.cumsum(np.full(130, 533.0 / 130)))
    assert s[-1] != 533.0
    found = xr.Dataset(coords=coordinates({"s": s[::10], "s_node": s, "time": s / 7.0}))
    for name in ("s", "s_node"):
        assert float(found[name].sel({name: 533.0})) == 533.0
    np.testing.assert_array_equal(found["time"], s / 7.0)


def test_stroke_does_not_need_a_station_at_the_top():
    analysis = PLAIN["analysis"] | {"output": {"interval": "0.5 s", "stations": ["20 m"]}}
    assert "stroke" in simulate(SceneFile("test.yaml", PLAIN | {"analysis": analysis}))
