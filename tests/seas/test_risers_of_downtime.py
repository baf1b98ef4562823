"""Workable hours are those of risers that stay, by limits whose demands are known as `check` knows them."""

import numpy as np
import pytest
from platform_in_a_sea import RISER, in_a_sea
from random_rigs import written
from rigs_in_waves import in_waves

from riserstudy import load_scene
from riserstudy.dataset.limits import WITHIN, checked
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.scene.pressures import not_in_tension
from riserstudy.seas.hours import sea_limit
from riserstudy.seas.record import read_record, with_peak_period, write_record
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.riser_hours import excess_of
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.synthetic import synthetic
from riserstudy.simulation.refine import run
from riserstudy.study.in_sea import Sea, in_sea

SEA = Sea(3.0, 9.0)
ONE = [{"output": "ufj_angle", "largest": "3 deg", "mode": "drilling"}]
CASES = [(seed, spatial) for seed in range(3) for spatial in (False, True)]
ANGLE = {"output": "lfj_angle", "largest": "4 deg", "mode": "drilling"}


def tree_of(seed, spatial):
    """A rig below a platform that follows an irregular sea."""
    return in_waves(seed, spatial, 29, "3 m", 10, 20.0, [0.5], [24])


def file_of(tree, limits):
    return SceneFile("rig.yaml", written(tree, unit_of={"level": "m"}) | {"limits": limits})


DRIFTING = {"mass": "6e7 kg", "hull_drag": "6e5 N*s^2/m^2", "wave_drift": {"force": "1 MN"}}
WEAK = DRIFTING | {"thrusters": {"gain": "0 N/m", "command": "0 m"}}


def departing(tree, kind, draw):
    """What moves or loads the rig besides its sea, by path of the scene."""
    early = f"{draw.uniform(2.0, 15.0)} s"
    if kind == "vessel":
        return {"vessel": [DRIFTING, WEAK][draw.integers(2)], "top.x": "vessel", "platform.position": None}
    if kind == "platform.cruise":
        return {kind: {"speed": "0.5 m/s"}}
    if kind == "disconnect":
        return {kind: {"at": early, "over": "0.3 s", "stack": {"stiffness": "20 MN/m"}}}
    if kind == "top.tension_loss":
        loss = {"share": 0.3, "at": early, "over": "2 s"}
        return {"top": {"x": "platform", "z": "free", "tension": "9 MN", "rotation": "free",
                        "tension_loss": loss}}  # fmt: skip
    return {kind: {"at": early, "cylinders": [0]}}


@pytest.mark.parametrize(
    "kind", ["platform.cruise", "vessel", "disconnect", "top.tension_loss", "top.tensioners.failing"]
)
@pytest.mark.parametrize("seed, spatial", CASES)
def test_a_riser_that_does_not_stay_has_no_workable_hours(seed, spatial, kind):
    """Else each hour of the record would begin with a drift-off, or contain a failure."""
    file = file_of(tree_of(seed, spatial), [ANGLE])
    other = file.with_values(departing(file.tree, kind, np.random.default_rng(seed)), "test")
    other.resolved()  # the scene itself is allowed
    with pytest.raises(InputError, match=f"{kind}: .*during the runs in a sea"):
        RiserResponse(other, 1, 3600.0, 1)


def test_a_vessel_that_its_thrusters_hold_is_allowed():
    hull = DRIFTING | {"thrusters": {"gain": "1 MN/m", "command": "0 m", "velocity_gain": "10 MN*s/m"}}
    file = file_of(tree_of(0, False), [ANGLE])
    held = file.with_values({"vessel": hull, "top.x": "vessel", "platform.position": None}, "test")
    assert RiserResponse(held, 1, 3600.0, 1).exposure > 0.0


@pytest.mark.parametrize("seed, spatial", CASES)
def test_a_limit_whose_inputs_are_missing_is_not_met_in_silence(seed, spatial):
    """`check` does not evaluate it, though sections with all inputs meet it."""
    tree = tree_of(seed, spatial)
    limit = {"output": "von_mises_stress", "largest": "9 GPa", "mode": "drilling"}
    RiserResponse(file_of(tree, [limit]), 1, 3600.0, 1)
    section = {**tree["riser"][-1], "name": "bare"}
    del section["contents"]
    section["length"] *= 0.5
    tree["riser"][-1]["length"] *= 0.5
    tree["riser"] = [section, *tree["riser"]]
    file = file_of(tree, [ANGLE, limit])
    with pytest.raises(InputError, match=r"limits\[1\].*von_mises_stress.*contents of section 'bare'"):
        RiserResponse(file, 1, 3600.0, 1)


@pytest.mark.parametrize("output", ["effective_tension", "lower_end_tension"])
@pytest.mark.parametrize("seed, spatial", CASES)
def test_mud_above_the_ring_takes_its_margin_of_a_smallest_tension(seed, spatial, output):
    tree = tree_of(seed, spatial)
    for section in tree["riser"]:
        section["contents"]["level"] = tree["top"]["elevation"] + 25.0
    some = [{"output": output, "smallest": "1 kN", "mode": "connected"}]
    sea = in_sea(file_of(tree, some), SEA, 1).resolved()
    facts = run(sea, estimated=False).facts
    tension, mud = checked(file_of(tree, some), sea, facts)[0].demand, not_in_tension(sea)
    assert mud > 0.0
    limits = [{**some[0], "smallest": f"{tension - share * mud!r} N"} for share in (0.5, 0.9, 1.1, 2.0)]
    file = file_of(tree, limits)
    riser = RiserResponse(file, 1, 20.0, 1)
    met = excess_of(riser(np.array([SEA]))[0], riser.allowed, ["smallest"] * 4) <= 0.0
    known = checked(file, in_sea(file, SEA, 1).resolved(), facts)
    np.testing.assert_array_equal(met, [one.verdict == WITHIN for one in known])
    np.testing.assert_array_equal(met, [False, False, True, True])


@pytest.mark.parametrize(
    "limits, idle", [([], "wind_speed and current_speed"), (["wind <= 9 m/s"], "current_speed")]
)
def test_what_a_record_has_without_effect_and_how_its_periods_were_found_is_told(limits, idle):
    record = synthetic(2, 8).isel(time=slice(None, None, 887))
    draw = np.random.default_rng(len(limits))
    period = record["peak_period"] / 1.3
    more = {
        name: ("time", draw.uniform(0.0, 9.0, record.sizes["time"]))
        for name in ("wind_speed", "current_speed")
    }
    record = record.drop_vars("peak_period").assign(zero_crossing_period=period, **more)
    file = load_scene(RISER).with_values(in_a_sea(ONE, (1, 6, 12, 60), 20, "60 s"), "test")
    made = riser_downtime(file, record, [sea_limit(one) for one in limits], seeds=1, error=0.5, cores=1)
    assert [line for line in made.lines if line.startswith(f"not used: {idle} of the record")]
    assert [line for line in made.lines if "JONSWAP with gamma 2" in line]


@pytest.mark.parametrize("gamma, noted", [(2.0, False), (3.3, True), (1.0, True)])
def test_periods_that_were_converted_for_other_waves_than_the_scene_has_are_noted(tmp_path, gamma, noted):
    """The scene's waves have a peak enhancement of 2."""
    record = synthetic(2, 8).isel(time=slice(None, None, 1300))
    record = record.rename(peak_period="zero_crossing_period")
    write_record(with_peak_period(record, gamma), tmp_path / "sea.nc")
    file = load_scene(RISER).with_values(in_a_sea(ONE, (1, 6, 12, 60), 20, "60 s"), "test")
    made = riser_downtime(file, read_record(tmp_path / "sea.nc"), seeds=1, error=0.5)
    lines = [line for line in made.lines if f"with a gamma of {gamma:g}; the scene has 2" in line]
    assert len(lines) == noted


@pytest.mark.parametrize("start", [0.0, 3.0, 9.0, 14.0])
@pytest.mark.parametrize("seed, spatial", CASES[:2])
def test_extremes_are_those_of_the_time_in_which_they_are_counted(seed, spatial, start):
    """Else the extremes of a short record would be those of a longer one, and too small for an hour."""
    late = {"analysis.output.start": f"{start} s"}
    file = file_of(tree_of(seed, spatial), [ANGLE]).with_values(late, "test")
    time = run(in_sea(file, SEA, 1).resolved(), estimated=False).arrays["time"]
    first = max(time[0], file.resolved().built_up)
    assert RiserResponse(file, 1, 3600.0, 1).exposure == pytest.approx(time[-1] - first, abs=1e-9)
