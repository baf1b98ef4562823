"""What the checks of Mao's chapter take from runs."""

import json

import numpy as np
import pytest
import xarray as xr
from mao import CONFIG, FILE, PAPER, WORD, small

from chapters.mao_hangoff.claims.at_some_time import (
    FREE,
    STRICT,
    distance_of_fig10,
    moment_of_fig9,
    numbers_at_some_time,
)
from chapters.mao_hangoff.claims.errata import load_power, readings_near, variants
from chapters.mao_hangoff.claims.heave import harmonic, largest_at_0_degrees, lows_deeper_at_first
from chapters.mao_hangoff.claims.towed import change_arises_near_the_lmrp, change_near_the_lmrp, small_below
from chapters.mao_hangoff.hanging import hanging, largest_rise
from riserstudy.chapters import checks_of
from riserstudy.grading.published import read_published


def test_the_amplitude_is_freed_of_a_drift():
    t = np.arange(0.0, 130.5, 0.5)
    z = 0.02 * t + 1e-4 * t**2 + 1.5 * np.sin(2 * np.pi * t / 10.0 + 0.3)
    heave = xr.Dataset({"z": (("time", "s"), z[:, None])}, {"time": t, "s": [0.0]})
    heave.attrs["scene"] = json.dumps({"platform": {"heave": {"period": "10 s"}}})
    fit = harmonic(heave["z"].isel(s=0), heave)
    assert float(fit["amplitude"]) == pytest.approx(1.5, rel=1e-9)
    assert float(fit["drift"]) == pytest.approx(0.02 + 1e-4 * 200.0, rel=1e-9)
    assert float(fit["share"]) == pytest.approx(1.0)


def of_two_readings(heavy, light, moment):
    """Runs whose LMRP trails so far (m) with 140 and 120 t, and their moment (kN m), a column a reading."""
    x = np.zeros((2, 2, 2, 2))  # over reading, mass, time, s
    x[:, 0, 1, 0], x[:, 1, 1, 0] = -np.array(light), -np.array(heavy)
    dims = ("riser_weight", "lmrp_mass", "time", "s")
    bending = np.broadcast_to(1e3 * np.array(moment)[:, None, None, None], x.shape)
    coords = {"riser_weight": ["thin", "thick"], "lmrp_mass": [120.0, 140.0]}
    return xr.Dataset(
        {"x": (dims, x), "bending_moment": (dims, bending)}, coords | {"time": [0.0, 130.0], "s": [0.0, 1.0]}
    )


def test_a_distance_that_grows_with_the_square_of_the_speed_has_the_power_of_two():
    speeds = {"90 deg": -1.0}
    for angle, speed in ((0, 1.5), (45, 0.75), (135, -2.75), (180, -3.5)):
        speeds |= {f"{angle} deg, 2.5 m/s": 10.0, f"{angle} deg, 3 m/s": speed}
    x = np.zeros((len(speeds), 2, 2))
    x[:, 1, 0] = [-(speed**2) for speed in speeds.values()]
    coords = {"track": list(speeds), "time": [0.0, 130.0], "s": [0.0, 1.0]}
    runs = xr.Dataset({"x": (("track", "time", "s"), x)}, coords)
    sets = {name: {"current.profile.surface_speed": f"{v} m/s"} for name, v in speeds.items()}
    runs["track"].attrs["sets"] = json.dumps(sets)
    found = load_power(runs)
    assert found["power"] == pytest.approx(2.0)
    assert (found["slow"], found["fast"]) == (1.5, 3.5)


def test_a_rise_counts_from_still_water_wherever_the_record_starts():
    """Risers that start in the current are lifted by it already; those whose current grows are not."""
    grown = small("riser_length_runs")
    sudden = small("riser_length_runs", **{"current.ramp": None})
    at_first = {name: runs["z"].isel(s=0, time=0, drop=True) for name, runs in
                (("grown", grown), ("sudden", sudden))}  # fmt: skip
    np.testing.assert_allclose(at_first["grown"], hanging(grown), atol=1e-5)
    np.testing.assert_array_equal(hanging(grown), hanging(sudden))
    assert (at_first["sudden"] > hanging(sudden) + 1e-3).all()
    risen = largest_rise(sudden)
    assert (risen >= at_first["sudden"] - hanging(sudden) - 1e-9).all()


def heaving(*curves, **of):
    """Elevations over time of nodes from the LMRP up."""
    t = np.arange(0.0, 130.5, 0.5)
    z = np.stack([curve(t) for curve in curves], axis=-1)
    return xr.Dataset({"z": (("time", "s"), z)}, {"time": t} | of)


def test_lows_at_depths_are_compared_with_that_of_the_top():
    def heave(amplitude):
        return lambda t: amplitude * np.sin(2 * np.pi * t / 10.0)

    depths = [1000.0, 1500.0]
    nodes = [0.0, 300.0, 800.0, 1800.0]
    deeper = heaving(heave(1.3), heave(1.2), heave(1.1), heave(1.0), s=nodes)
    found = lows_deeper_at_first(deeper, depths, WORD("larger"))
    assert float(found.value) == pytest.approx(1.1, rel=1e-6)
    assert bool(found.true)
    risen = heaving(lambda t: heave(1.3)(t) + 0.05 * t, *[heave(0.9)] * 2, heave(1.0), s=nodes)
    assert not bool(lows_deeper_at_first(risen, depths, WORD("larger")).true)


def test_0_degrees_is_told_from_both_other_angles():
    values = xr.DataArray([2.0, 1.0, 1.7], {"track_angle": [0.0, 45.0, 90.0]}, "track_angle")
    assert not bool(largest_at_0_degrees(values, WORD("considerable")).true)  # by 50 and 15 %
    assert bool(largest_at_0_degrees(values, WORD("evident")).true)
    assert float(largest_at_0_degrees(values, WORD("evident")).value) == pytest.approx(0.85)


def shapes_of(light, heavy):
    """Runs whose risers of 100 m have shapes, with 120 and 140 t, over height from the LMRP."""
    s = np.linspace(0.0, 100.0, 101)
    x = np.zeros((2, 2, s.size))
    x[0, 1], x[1, 1] = -light(s), -heavy(s)
    coords = {"lmrp_mass": [120.0, 140.0], "time": [0.0, 130.0], "s": s}
    return xr.Dataset({"x": (("lmrp_mass", "time", "s"), x)}, coords)


def test_a_change_that_grows_all_the_way_down_occurs_near_the_lmrp_and_arises_everywhere():
    straight = shapes_of(lambda s: 2.0 * (100.0 - s), lambda s: 100.0 - s)
    assert bool(change_near_the_lmrp(straight).true)
    assert float(change_near_the_lmrp(straight).value) == pytest.approx(3.0, rel=0.02)
    assert float(change_arises_near_the_lmrp(straight, 0.5).value) == pytest.approx(0.25)
    bulged = shapes_of(lambda s: s * (100.0 - s), lambda s: 0.0 * s)
    assert not bool(change_near_the_lmrp(bulged).true)


def test_moments_are_small_or_not_below_the_depth_that_is_asked_for():
    s = np.linspace(0.0, 1800.0, 181)
    moment = np.where(s > 1800.0 - 170.0, 1.0, 0.4)
    dims = {"lmrp_mass": [140.0], "time": [130.0], "s": s}
    runs = xr.Dataset({"bending_moment": (("lmrp_mass", "time", "s"), moment[None, None])}, dims)
    assert bool(small_below(runs, 200.0, 0.5).true)
    assert not bool(small_below(runs, 150.0, 0.5).true)


def test_readings_that_come_near_print_are_counted_and_the_nearest_is_named():
    print_of = {"heavy": 58.2, "light": 62.7, "moment": 52.0, "within": 0.02}
    runs = of_two_readings(heavy=(58.0, 40.0), light=(62.5, 43.1), moment=(70.0, 52.5))
    told = readings_near(runs, **print_of)
    assert told["count"] == 2
    assert told["x_heavy"] == told["x_light"] == told["moment"] == "1 of 2 combinations of interpretations is"
    assert told["ratio"] == "2 of 2 combinations of interpretations are"
    assert told["all"] == "None of 2 combinations of interpretations is"
    assert told["best"] == "thick"
    assert told["worst"] == pytest.approx(1.0 - 40.0 / 58.2)
    met = readings_near(of_two_readings((58, 58), (62.5, 10), (52, 52)), **print_of)
    assert met["all"] == "1 of 2 combinations of interpretations is"
    assert met["best"] == "thin"


def test_all_numbers_claims_and_errata_of_the_dossier_are_there():
    known = {*FILE.studies, *FILE.derived}
    file = read_published(CONFIG, PAPER, known)
    ids = {item.id for item in file.items} | {erratum.id for erratum in file.errata}
    wanted = [("N", 4), ("C", 28), ("R", 4), ("T", 14), ("E", 15)]
    assert {f"{letter}{k}" for letter, most in wanted for k in range(1, most + 1)} <= ids
    for item in file.items:
        assert item.impossible or callable(checks_of(PAPER)(item.check))


def test_the_depth_of_a_moment_counts_from_the_end_of_its_own_riser():
    """A lever arm makes the riser of one variant longer, whose nodes all variants then have."""
    names = list(FILE.studies["variants"].axes["variant"])
    s = np.array([0.0, 50.0, 100.0, 108.0])
    moment = np.tile([0.0, 1.0, 2.0, np.nan], (2, len(names), 1)).transpose(1, 0, 2)
    moment[names.index("LMRP with lever arm and rotary inertia"), :, 3] = 3.0
    dims = ("variant", "time", "s")
    coords = {"variant": names, "time": [0.0, 130.0], "s": s}
    runs = xr.Dataset({"bending_moment": (dims, moment), "x": (dims, moment)}, coords)
    facts = variants(runs)
    assert facts["d_base"] == facts["d_lever"] == 0.0


def test_the_moment_on_the_paper_s_elements_is_that_at_their_nodes():
    """The nodes of other variants lie between those of 50 equal elements, and have a larger moment there."""
    names = list(FILE.studies["variants"].axes["variant"])
    s = np.linspace(0.0, 1800.0, 101)
    at_a_node, between = s[98], s[97]  # every second is a node of the paper's
    size = np.where(s == at_a_node, 2.0, np.where(s == between, 3.0, 1.0))
    moment = np.broadcast_to(size, (2, len(names), s.size)).transpose(1, 0, 2)
    dims = ("variant", "time", "s")
    coords = {"variant": names, "time": [0.0, 130.0], "s": s}
    runs = xr.Dataset({"bending_moment": (dims, 1e3 * moment), "x": (dims, moment)}, coords)
    facts = variants(runs)
    assert (facts["m_paper"], facts["d_paper"]) == pytest.approx((2.0, 1800.0 - at_a_node))
    assert (facts["m_base"], facts["d_base"]) == pytest.approx((3.0, 1800.0 - between))


def passing(start, rate, moment, heave):
    """Two LMRP masses over time: distances that grow at a rate, a moment that swings with the heave."""
    t = np.arange(100.0, 201.0)
    x = np.zeros((2, t.size, 2))
    x[:, :, 0] = -(start + rate * (t - 130.0))  # the LMRP, behind a top that stands
    size = moment + heave * np.sin(2.0 * np.pi * t / 10.0)
    bending = 1e3 * np.repeat(np.repeat(size[None, :, None], 2, 0), 2, 2)
    dims = ("lmrp_mass", "time", "s")
    coords = {"lmrp_mass": [120.0, 140.0], "time": t, "s": [0.0, 1.0]}
    return xr.Dataset({"x": (dims, x), "bending_moment": (dims, bending)}, coords)


def test_a_number_without_a_time_is_met_where_a_run_passes_it():
    later = passing(58.2, 0.2, 52.0, 0.0)  # 62.7 m at 152.5 s
    found = distance_of_fig10(later, 120.0, 62.7).value
    assert float(found.sel(when=STRICT)) == pytest.approx(58.2)
    assert float(found.sel(when=FREE)) == pytest.approx(62.7)
    slower = distance_of_fig10(passing(58.2, 0.01, 52.0, 0.0), 120.0, 62.7).value
    assert float(slower.sel(when=FREE)) == pytest.approx(58.9)  # the last, which is the nearest
    assert bool(numbers_at_some_time(later, 58.2, 62.7, 52.0, 0.02).true)
    assert not bool(numbers_at_some_time(passing(50.0, 0.2, 52.0, 0.0), 58.2, 62.7, 52.0, 0.02).true)


def test_a_moment_is_met_at_some_phase_where_the_cycle_passes_it():
    found = moment_of_fig9(passing(58.2, 0.2, 53.4, 2.4), 140.0, 52.0).value
    assert float(found.sel(when=STRICT)) == pytest.approx(53.4)
    assert float(found.sel(when=FREE)) == 52.0
    above = moment_of_fig9(passing(58.2, 0.2, 55.4, 1.4), 140.0, 52.0).value
    assert 54.0 <= float(above.sel(when=FREE)) < 54.1
    # a run that ends in nothing has no value
    gone = passing(58.2, 0.2, 55.4, 1.4)
    gone["bending_moment"][:] = np.nan
    assert moment_of_fig9(gone, 140.0, 52.0).value.isnull().all()
