"""What others rely on in the datasets of the drive-off chapter, and the soil that its scenes stand in."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.liu2017 import derived
from chapters.liu2017.derived import driveoff
from riserstudy.effects.soil import py_of_clay
from riserstudy.model.mesh import even
from riserstudy.model.soil import springs, ultimate_resistance
from riserstudy.scene.load import load_scene, read_scene
from riserstudy.simulation.refine import run as simulate
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

CONFIG = Path(__file__).parents[3] / "config"
PAPER = "liu2017"
FILE = read_studies(CONFIG, PAPER)
WITH = ("ref_0", "ref_180", "sat_0", "sat_180")
CASES = (*WITH, *(f"{name}_no_riser" for name in WITH))
UNITS = {
    "platform_surge": "m",
    "riser_force_x": "N",
    "riser_reaction_x": "N",
    "ufj_angle": "rad",
    "lfj_angle": "rad",
    "stroke": "m",
    "conductor_stress": "Pa",
    "wellhead_moment": "N m",
}
TENSION = 3.02e6  # N, printed
REF = CONFIG / "scenes" / PAPER / "ref_0.yaml"


def run(name):
    """A drive-off of 40 s on a coarse mesh."""
    coarse = {
        "analysis.duration": "40 s",
        "analysis.step": "0.5 s",
        "analysis.mesh": {"elements": 60},
        "analysis.output": {"interval": "2 s"},
    }
    if name in WITH:
        coarse["analysis.output"]["stress_in"] = "conductor"
    model = FILE.studies[name]
    study = Study(PAPER, name, model.replaced(set=model.set | coarse), CONFIG, "preview", None, FILE.readings)
    return dataset_of(study, results_of(study, 1, lambda text: None)[0])


@cache
def made() -> xr.Dataset:
    """The dataset of all cases."""
    assert list(FILE.derived["driveoff"].reads) == list(CASES)
    return driveoff(**{name: run(name) for name in CASES})


def test_all_cases_are_there_under_their_names_with_their_units():
    assert list(made()["case"].values) == list(CASES)
    for name, unit in UNITS.items():
        assert made()[name].dims == ("case", "time"), name
        assert made()[name].attrs["units"] == unit, name
        assert made()[name].attrs["long_name"], name


def test_every_case_drives_off_towards_its_own_positive_x():
    surge = made()["platform_surge"]
    assert (surge.isel(time=-1) > 20.0).all()
    assert (abs(surge.isel(time=0)) < 1e-9).all()


def test_the_riser_pulls_back_with_the_part_of_its_tension_along_x():
    """With the platform ahead the angle is positive, and the force -T sin(angle) against the drive-off."""
    found = made().sel(case=list(WITH))
    np.testing.assert_allclose(found["riser_force_x"], -TENSION * np.sin(found["ufj_angle"]), rtol=1e-12)
    assert (found["riser_force_x"].isel(time=-1) < -0.1 * TENSION).all()
    shear = abs(found["riser_force_x"] - found["riser_reaction_x"]).max()
    assert float(shear) < 0.03 * TENSION


def test_without_a_riser_there_is_no_force_and_nothing_of_the_riser():
    alone = made().sel(case=list(CASES[4:]))
    for name in ("riser_force_x", "riser_reaction_x"):
        assert (alone[name] == 0.0).all()
    for name in ("ufj_angle", "lfj_angle", "stroke", "conductor_stress", "wellhead_moment"):
        assert alone[name].isnull().all(), name
        assert made()[name].sel(case=list(WITH)).notnull().all(), name


def test_strokes_and_stresses_are_of_the_size_and_sign_of_a_drive_off():
    last = made().sel(case="ref_0").isel(time=-1)
    assert 0.0 < float(last["stroke"]) < 10.0
    assert 0.0 < float(last["conductor_stress"]) < 4e8


@pytest.mark.parametrize("depth, by_hand", [(1.0, 20.081e3), (5.0, 82.486e3), (60.0, 765.35e3)])
def test_ultimate_resistance_is_matlocks_in_closed_numbers(depth, by_hand):
    """min(3 s_u + g z + J s_u z / D, 9 s_u) D with s_u of 4.5, 10.5 and 93 kPa; the last flows around."""
    clay = load_scene(REF).resolved().soil.resistance
    found = ultimate_resistance(clay, np.array([depth]), 0.9144)
    assert found[0] == pytest.approx(by_hand, rel=1e-4)


def test_springs_of_the_scene_yield_as_the_clay_and_at_its_y50():
    """y50 = 2.5 e50 D is 45.7 mm; half of p_u acts there, all of it at eight times that."""
    scene = load_scene(REF).resolved()
    soil = springs(scene.soil, scene.riser, even(scene, 1000), scene.bottom.elevation)
    assert soil.y50 == pytest.approx(np.full(len(soil.y50), 45.72e-3))
    z = np.linspace(0.0, 70.0, 7001)
    strength = 3e3 + 1.5e3 * z
    law = np.minimum(3 * strength + 6e3 * z + 0.5 * strength * z / 0.9144, 9 * strength) * 0.9144
    assert soil.ultimate.sum() == pytest.approx(np.trapezoid(law, z), rel=1e-3)
    for y, share in ((45.72e-3, 0.5), (8 * 45.72e-3, 1.0)):
        force, _, _ = py_of_clay.py_func(soil, 0, y)
        assert force == pytest.approx(share * soil.ultimate[0])


STEEL, WATER = 7850.0, 1025.0  # kg/m3


@pytest.mark.parametrize("reading, section", [("lmrp_and_bop", 1), ("conductor_wall", 0)])
def test_weight_and_length_go_with_the_mass_that_is_sampled(reading, section):
    """Steel weighs 1 - 1025/7850 of its mass in water, and the upper flex joint stays L above the BOP."""
    for sets in FILE.readings[reading].values():
        scene = read_scene(REF).with_values(sets, "test").resolved()
        part = scene.riser[section]
        assert part.submerged_weight == pytest.approx(part.mass * 9.81 * (1 - WATER / STEEL), rel=2e-5)
        assert scene.top.elevation - scene.riser[1].length == pytest.approx(1327.0)
        if section == 0:
            wall = np.pi / 4 * (part.outer_diameter**2 - part.inner_diameter**2)
            assert part.mass == pytest.approx(STEEL * wall, rel=2e-5)


def test_the_joint_goes_no_further_than_its_printed_limit():
    """At the stop the riser's own stiffness, a tenth of the stop's, takes the rest."""
    sets = {"analysis.mesh.elements": 60, "analysis.step": "0.1 s", "analysis.duration": "90 s"}
    run_to_stop = simulate(read_scene(REF).with_values(sets, "test").resolved(), estimated=False).arrays
    assert 9.9 < run_to_stop["stroke"].max() < 10.0
    assert run_to_stop["effective_tension"][:, -1].max() > 1.2 * TENSION


def test_samples_nearest_to_the_printed_time_are_a_share_of_all_and_one_at_least(monkeypatch):
    times = [20.0, np.inf, 49.0, 80.0, 50.5, np.inf]
    both = xr.DataArray(
        [[[time], [0.0]] for time in times],
        dims=("sample", "heading", "limit"),
        coords={"heading": ["along", "against"], "limit": ["upper flex joint"]},
    )
    found = xr.Dataset({"limit_time": both}, {"sample": np.arange(len(times))})
    monkeypatch.setattr(derived, "open_drive_off", lambda *_: found)
    nothing = xr.Dataset()
    half = derived.open_as_printed(nothing, nothing, deadline=50.0, one_in=2)
    assert half["sample"].values.tolist() == [0, 2, 4]
    assert derived.open_as_printed(nothing, nothing, 50.0, 12)["sample"].values.tolist() == [4]
