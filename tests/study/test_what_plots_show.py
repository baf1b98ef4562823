"""What plots can show is told before anything is run; what cannot be known then, by the plot."""

from pathlib import Path

import pytest
import xarray as xr
from ruamel.yaml import YAML

from riserstudy.errors import InputError
from riserstudy.figures.envelope import envelope
from riserstudy.figures.time_series import time_series
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.study.read import read_studies

SCENES = Path(__file__).parents[2] / "config/scenes"
SCENE = SCENES / "bench/s2c.yaml"
MOVING = {"duration": "2 s", "output": {"interval": "1 s"}, "mesh": {"elements": 4}, "step": "1 s"}


def read(folder, figure=None, keep=None, axis=None, analysis=MOVING, scene=SCENE):
    """The study file of one study with one figure, or with what is drawn where none is asked for."""
    config = folder / "config"
    (config / "studies").mkdir(parents=True)
    study = {"scene": "s2c.yaml", "caption": "a", "set": {"analysis": analysis}, "keep": keep}
    study["axes"] = {"kind": axis or {"one": {}, "other": {"gravity": "9.8 m/s^2"}}}
    tree = {"paper": "own", "studies": {"runs": study}}
    if figure:
        tree["figures"] = {"shown": {"caption": "b", "reads": ["runs"], **figure}}
    (config / "s2c.yaml").write_bytes(scene.read_bytes())
    with (config / "studies/own.yaml").open("w") as file:
        YAML(typ="safe").dump(tree, file)
    return read_studies(config, "own").figures


@pytest.mark.parametrize(
    "plot, quantity, keep, said",
    [
        ("lines", "moment", None, "'moment' is not an output of a study"),
        ("lines", "stroke", ["x"], "'stroke' is not stored; add it to keep of 'runs', which has x"),
        ("lines", "x_max", ["x_min"], "'x_max' is not stored"),
        ("lines", "tensioner_force", None, "whose scene has no top.tensioners"),
        ("lines", "y", None, "whose scene has no load or motion out of the plane"),
        ("lines", "platform_surge", None, "whose scene has no vessel"),
        ("time series", "x_max", None, "'x_max' has no time history"),
        ("time series", "shear_force", None, "'shear_force' has no time history"),
        ("time series", "largest_bending_moment", None, "is a single number per point"),
        ("envelope", "lfj_angle", None, "has no values along the riser"),
        ("envelope", "bending_moment", ["bending_moment"], "is not stored"),
        ("envelope", "x_min", ["x_max"], "'x_min' is not stored"),
        ("lines", "z", ["z_max"], "'z' is not stored"),
        ("lines", "x_static", ["x"], "'x_static' is not stored"),
        ("lines", "von_mises_stress", None, "no section with diameters and contents"),
        ("lines", "thrust_y_static", None, "has no value in static equilibrium"),
        ("lines", "stroke_static", None, "has no value in static equilibrium"),
        ("envelope", "effective_tension_absmax", None, "its sign has a meaning"),
    ],
)
def test_what_a_plot_cannot_show_is_refused_at_planning(tmp_path, plot, quantity, keep, said):
    with pytest.raises(InputError) as refused:
        read(tmp_path, {"plot": plot, "of": [quantity]}, keep)
    assert refused.value.where.endswith("config/studies/own.yaml")
    assert "figures.shown.of" in str(refused.value)
    assert said in str(refused.value)


@pytest.mark.parametrize("quantity", [n for n, of in QUANTITIES.items() if of.is_array and not of.history])
def test_what_has_no_history_is_refused_as_a_series(tmp_path, quantity):
    with pytest.raises(InputError, match=f"'{quantity}' has no time history"):
        read(tmp_path, {"plot": "time series", "of": [quantity]})


@pytest.mark.parametrize("quantity", [n for n, of in QUANTITIES.items() if of.is_array and not of.along])
def test_what_has_no_values_along_the_riser_is_refused_as_an_envelope(tmp_path, quantity):
    with pytest.raises(InputError, match=f"'{quantity}' has no values along the riser"):
        read(tmp_path, {"plot": "envelope", "of": [quantity]})


@pytest.mark.parametrize(
    "scene, plot, quantity, what",
    [
        ("bench/s4e", "lines", "bending_moment", "bending stiffness of every section"),
        ("bench/s4e", "envelope", "shear_force", "bending stiffness of every section"),
        ("bench/s4c", "lines", "ufj_angle", "top.x that is held"),
        ("mao_hangoff/steady", "lines", "lfj_angle", "a held lower end or a riser.flex_joint_below"),
    ],
)
def test_what_ends_and_strings_do_not_tell_is_refused(tmp_path, scene, plot, quantity, what):
    figure, file = {"plot": plot, "of": [quantity]}, SCENES / f"{scene}.yaml"
    with pytest.raises(InputError, match=f"whose scene has no .*{what}"):
        read(tmp_path, figure, None, {"one": {}, "other": {"note": "b"}}, {"mesh": {"elements": 4}}, file)


VESSEL = SCENES / "liu2017/ref_0.yaml"  # in the plane, with thrusters ahead alone


@pytest.mark.parametrize(
    "quantity, what",
    [
        ("platform_speed_y", "vessel with load or motion out of the plane"),
        ("riser_reaction_y_min", "vessel with load or motion out of the plane"),
        ("thrust_y", "vessel.thrusters and vessel.sway"),
        ("thrust_moment_absmax", "vessel.thrusters.yaw"),
    ],
)
def test_what_a_platform_in_the_plane_does_not_tell_is_refused(tmp_path, quantity, what):
    with pytest.raises(InputError, match=f"whose scene has no {what}"):
        read(tmp_path, {"plot": "lines", "of": [quantity]}, scene=VESSEL)


@pytest.mark.parametrize("quantity", ["platform_surge", "thrust_x", "environment_force_x_max"])
def test_what_it_tells_is_not(tmp_path, quantity):
    read(tmp_path, {"plot": "lines", "of": [quantity]}, scene=VESSEL)


@pytest.mark.parametrize(
    "plot, quantity, keep",
    [
        ("lines", "bending_moment", ["bending_moment_max"]),
        ("lines", "x_max", ["x"]),
        ("lines", "largest_bending_moment", ["x"]),
        ("envelope", "bending_moment", ["bending_moment_absmax"]),
        ("envelope", "shear_force", None),
        ("time series", "ufj_angle", None),
    ],
)
def test_what_it_can_show_is_not_refused(tmp_path, plot, quantity, keep):
    read(tmp_path, {"plot": plot, "of": [quantity]}, keep)


def test_what_one_label_of_an_axis_calls_for_is_there(tmp_path):
    sway = {"amplitude": "1 m", "period": "12 s"}
    axis = {"in the plane": {}, "out of it": {"platform.sway": sway}}
    read(tmp_path, {"plot": "lines", "of": ["y"]}, axis=axis)


def test_runs_at_rest_have_no_history(tmp_path):
    still = {"plot": "time series", "of": ["x"]}
    with pytest.raises(InputError, match="are static"):
        read(tmp_path, still, analysis={"mesh": {"elements": 4}})


def test_a_plot_that_fits_a_grid_is_drawn_only_of_what_is_kept(tmp_path):
    assert {one.plot for one in read(tmp_path / "all").values()} == {
        "lines", "envelope", "time series",
    }  # fmt: skip
    assert {one.plot for one in read(tmp_path / "one", keep=["ufj_angle"]).values()} == {
        "lines", "time series",
    }  # fmt: skip


@pytest.mark.parametrize("plot", [envelope, time_series])
def test_nothing_that_is_asked_for_is_left_out_in_silence(plot):
    values = xr.DataArray([[0.0, 1.0]], dims=("time", "s_node"), coords={"s_node": [0.0, 1.0]})
    dataset = xr.Dataset({"x": values, "x_max": values[0], "x_min": values[0]})
    with pytest.raises(InputError, match="no 'bending_moment'"):
        plot(dataset, ["x", "bending_moment"])
