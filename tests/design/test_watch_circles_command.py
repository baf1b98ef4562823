"""Commands of watch circles and check: closed forms of drift and cruise, and what cannot be told."""

import csv
import json
import math

import numpy as np
import pytest
from adrift import HULL, adrift
from random_rigs import rig, timed, written
from scipy.optimize import brentq

from riserstudy.design.drift import drift


def scene_file(folder, force=1e6, current=0.0, limits=(), **parts):
    """A thread below a hull that its pull does not hold back."""
    tree = adrift(force, current, limits=list(limits), **parts)
    path = folder / "adrift.yaml"
    path.write_text(json.dumps({name: part for name, part in tree.items() if part is not None}))
    return path


def away(largest, mode="disconnect"):
    at = "upper end of thread"
    return {"output": "x", "at": at, "largest": f"{largest} m", "mode": mode}


def rows_of(path):
    return {row["limit"]: row for row in csv.DictReader(path.open())}


def number(row, column):
    return float(row[column]) if row[column] else math.nan


def drawn():
    draw = np.random.default_rng(3)
    return [tuple(draw.uniform((3e5, 0.0, 40.0, 20.0), (2e6, 0.8, 200.0, 90.0))) for _ in range(5)]


@pytest.mark.parametrize("force, current, limit, seconds", drawn())
def test_a_hull_from_its_circle_on_reaches_the_limit_when_the_disconnect_is_over(
    commands, tmp_path, force, current, limit, seconds
):
    scene = scene_file(tmp_path, force, current, [away(limit), away(2.0 * limit)])
    table = tmp_path / "out.csv"
    times = ["--disconnect", f"{seconds} s", "--prepare", "15 s"]
    code, _, _ = commands("watch-circles", scene, *times, "--csv", table)
    assert code == 0
    row = rows_of(table)["disconnect: first of all"]

    def way(time):
        return float(drift(HULL, force, current, time).way)

    first = brentq(lambda t: way(t) - limit, 0.0, 2000.0)
    assert number(row, "reached (s)") == pytest.approx(first, rel=1e-3)
    assert number(row, "offset (m)") == pytest.approx(limit, rel=1e-3)
    for column, before in (("red", seconds), ("yellow", seconds + 15.0)):
        radius = number(row, f"{column} circle (m)")
        if first > before:
            assert radius == pytest.approx(way(first - before), rel=2e-3, abs=1e-3)
        else:
            assert math.isnan(radius)
            assert f"{column}: an alarm at the start is too late" in row["note"]


@pytest.mark.parametrize("force, current, limit, seconds", drawn())
def test_first_order_motion_reaches_the_limit_and_circles_are_those_of_the_drift(
    commands, tmp_path, force, current, limit, seconds
):
    wave = {"amplitude": "3 m", "period": "12 s", "phase": "50 deg", "ramp": "24 s"}
    analysis = {
        "duration": "400 s",
        "mesh": {"elements": 10},
        "step": "0.25 s",
        "output": {"interval": "0.25 s"},
    }
    scene = scene_file(tmp_path, force, current, [away(limit)], platform={"surge": wave}, analysis=analysis)
    table = tmp_path / "out.csv"
    times = ["--disconnect", f"{seconds} s", "--prepare", "15 s"]
    assert commands("watch-circles", scene, *times, "--csv", table)[0] == 0
    row = rows_of(table)["disconnect: first of all"]

    time = np.arange(24.0, 400.0, 0.01)
    way = drift(HULL, force, current, time).way
    first = time[np.argmax(way + 3.0 * np.sin(math.tau * time / 12.0 + math.radians(50.0)) > limit)]
    assert number(row, "reached (s)") == pytest.approx(first, abs=0.05)
    there, *circles = np.interp([first, first - seconds, first - seconds - 15.0], time, way)
    assert number(row, "offset (m)") == pytest.approx(there, rel=2e-3)
    for column, before, radius in zip(("red", "yellow"), (0.0, 15.0), circles, strict=True):
        if first > seconds + before:
            assert number(row, f"{column} circle (m)") == pytest.approx(radius, rel=2e-3, abs=0.05)


def angled(limit):
    """A limit on the angle of a straight thread of 1000 m at an offset (m), which the angle lags behind."""
    angle = math.atan(limit / 1001.0)
    return {"output": "lfj_angle", "largest": f"{angle!r} rad", "mode": "connected"}


@pytest.mark.parametrize(
    "speed, ramp, limit, seconds",
    [(1.5, 40.0, 90.0, 20.0), (0.8, 120.0, 60.0, 45.0), (2.0, 10.0, 77.0, 31.0)],
)
def test_circles_of_a_cruise_do_not_depend_on_the_outputs(commands, tmp_path, speed, ramp, limit, seconds):
    cruise = {"speed": f"{speed} m/s", "ramp": f"{ramp} s"}
    top = {"x": "platform", "z": "held", "elevation": "1001 m"}
    scene = scene_file(tmp_path, limits=[angled(limit)], vessel=None, top=top, platform={"cruise": cruise})
    table, times = tmp_path / "out.csv", ["--disconnect", f"{seconds} s", "--prepare", "5 s"]

    def way(time):
        return speed * (0.5 * time**2 / ramp if time < ramp else time - 0.5 * ramp)

    found = []
    for interval in (1, 7, 50):
        apart = ["--set", f"analysis.output.interval={interval} s", "--csv", table, "--force"]
        assert commands("watch-circles", scene, *times, *apart)[0] == 0
        found.append(rows_of(table)["connected: first of all"])
    assert found[0] == found[1] == found[2]
    first = number(found[0], "reached (s)")
    assert number(found[0], "offset (m)") == pytest.approx(way(first), rel=1e-6)
    assert number(found[0], "red circle (m)") == pytest.approx(way(first - seconds), rel=1e-6)
    late = way(first - seconds - 5.0)
    assert number(found[0], "yellow circle (m)") == pytest.approx(late, rel=1e-6)


@pytest.mark.parametrize("seed", range(6))
def test_a_run_that_begins_beyond_a_circle_says_so(commands, tmp_path, seed):
    """A platform that cruises past the well is farther from it at the start than at the alarm, or is not."""
    draw = np.random.default_rng(seed)
    start, heading = draw.uniform(-80.0, 20.0), draw.uniform(-0.3, 0.3) if seed % 2 else 0.0
    speed, limit = draw.uniform(0.8, 1.5), 90.0
    cruise = {"speed": f"{speed} m/s", "heading": f"{heading} rad"}
    top = {"x": "platform", "z": "held", "elevation": "1001 m", "offset": f"{start} m"}
    scene = scene_file(tmp_path, limits=[angled(limit)], vessel=None, top=top, platform={"cruise": cruise})
    table, times = tmp_path / "out.csv", ["--disconnect", "30 s", "--prepare", "20 s"]
    assert commands("watch-circles", scene, *times, "--csv", table)[0] == 0
    row = rows_of(table)["connected: first of all"]

    def way(time):
        return abs(start + speed * time * np.exp(1j * heading))

    first = number(row, "reached (s)")
    for column, before in (("red", 30.0), ("yellow", 50.0)):
        radius = number(row, f"{column} circle (m)")
        assert radius == pytest.approx(way(first - before), rel=1e-6)
        told = f"{column}: the run begins {abs(start):.4g} m from the well" in row["note"]
        assert told == (abs(start) > radius + 0.01)


@pytest.mark.parametrize("force, current, limit, seconds", drawn()[:3])
def test_circles_of_a_vessel_are_right_or_their_outputs_too_coarse(
    commands, tmp_path, force, current, limit, seconds
):
    scene = scene_file(tmp_path, force, current, [away(limit), angled(limit)])
    table, times = tmp_path / "out.csv", ["--disconnect", f"{seconds} s", "--prepare", "15 s"]

    def way(time):
        return float(drift(HULL, force, current, time).way)

    right, by_angle = brentq(lambda t: way(t) - limit, 0.0, 2000.0), []
    for interval in (1, 20, 50, 130):
        apart = ["--set", f"analysis.output.interval={interval} s", "--csv", table, "--force"]
        assert commands("watch-circles", scene, *times, *apart)[0] == 0
        rows = rows_of(table)
        by_angle.append(number(rows["connected: first of all"], "reached (s)"))
        for row, first in (
            (rows["disconnect: first of all"], right),
            (rows["connected: first of all"], by_angle[0]),
        ):
            coarse = "outputs are too coarse" in row["note"]
            assert not (coarse and interval == 1)
            for column, before in (("red", seconds), ("yellow", seconds + 15.0)):
                radius = number(row, f"{column} circle (m)")
                if not coarse and first > before + 1.0:
                    assert radius <= 1.015 * way(first - before) + 0.02
    assert by_angle == pytest.approx(by_angle[:1] * 4, rel=1e-9, nan_ok=True)


@pytest.mark.parametrize("start", [0, 30, 170])
def test_a_check_says_from_when_its_values_are_counted(commands, tmp_path, start):
    scene = scene_file(tmp_path, limits=[away(1e5)])
    late = ["--set", f"analysis.output.start={start} s"]
    code, out, _ = commands("check", scene, *late)
    assert code == 0
    assert ("counted from" in out) == (start > 0)
    assert not start or f"counted from t = {start} s on" in out


@pytest.mark.parametrize("start", [1, 40, 200])
def test_outputs_that_begin_late_are_refused(commands, tmp_path, start):
    """A limit that is reached before them has a circle that is smaller than that of the first output."""
    scene = scene_file(tmp_path, limits=[away(20.0)])
    late = ["--set", f"analysis.output.start={start} s"]
    times = ["--disconnect", "20 s", "--prepare", "10 s"]
    code, out, said = commands("watch-circles", scene, *times, *late)
    assert (code, out) == (2, "")
    assert f"reached before {start} s would be missed" in said


@pytest.mark.parametrize("ramp, heading", [(None, 0.0), (30.0, 0.0), (30.0, 60.0)])
def test_a_cruising_platform_has_the_circles_of_its_speed(commands, tmp_path, ramp, heading):
    cruise = {"speed": "1.5 m/s", "heading": f"{heading} deg"} | ({"ramp": f"{ramp} s"} if ramp else {})
    out = "x" if heading == 0.0 else "y"
    limit = {"output": out, "at": "upper end of thread", "largest": "90 m", "mode": "disconnect"}
    top = {"x": "platform", "z": "held", "elevation": "1001 m"}
    scene = scene_file(tmp_path, limits=[limit], vessel=None, top=top, platform={"cruise": cruise})
    table = tmp_path / "out.csv"
    times = ["--disconnect", "20 s", "--prepare", "10 s"]
    assert commands("watch-circles", scene, *times, "--csv", table)[0] == 0
    row = rows_of(table)["disconnect: first of all"]
    share = 1.0 if heading == 0.0 else math.sin(math.radians(heading))
    first = 90.0 / share / 1.5 + (ramp or 0.0) / 2.0
    assert number(row, "reached (s)") == pytest.approx(first, rel=1e-3)
    assert number(row, "offset (m)") == pytest.approx(90.0 / share, rel=1e-3)
    assert number(row, "red circle (m)") == pytest.approx(90.0 / share - 30.0, rel=2e-3)
    assert number(row, "yellow circle (m)") == pytest.approx(90.0 / share - 45.0, rel=2e-3)


def test_limits_that_are_not_reached_and_means_are_named(commands, tmp_path):
    mean = {"output": "x", "at": "upper end of thread", "mean": "5 m", "mode": "drilling"}
    scene = scene_file(tmp_path, limits=[away(1e5), away(50.0, "connected"), mean])
    times = ["--disconnect", "20 s", "--prepare", "10 s"]
    code, out, _ = commands("watch-circles", scene, *times)
    assert code == 4
    assert "not evaluated: a mean has no time" in out
    assert "drilling: first of all that are evaluated" in out
    code, out, _ = commands("watch-circles", scene, *times, "--mode", "disconnect")
    assert code == 0
    assert out.count("not reached within the run") == 2
    assert "connected" not in out


@pytest.mark.parametrize(
    "words, said",
    [
        (["--disconnect", "-3 s", "--prepare", "1 s"], "--disconnect"),
        (["--disconnect", "3 s", "--prepare", "1 m"], "--prepare"),
        (["--disconnect", "3 s", "--prepare", "1 s", "--mode", "drilling"], "--mode"),
        (
            ["--disconnect", "3 s", "--prepare", "1 s", "--mode", "disconnect", "--mode", "connected"],
            "--mode: connected: no limit",
        ),
    ],
)
def test_what_cannot_be_meant_is_refused_before_a_run(commands, tmp_path, words, said):
    code, out, err = commands("watch-circles", scene_file(tmp_path, limits=[away(9.0)]), *words)
    assert (code, out) == (2, "")
    assert said in err


def test_a_scene_that_stays_above_the_well_is_refused(commands):
    words = ["--disconnect", "60 s", "--prepare", "90 s"]
    code, _, err = commands("watch-circles", "config/scenes/design/riser.yaml", *words)
    assert code == 2
    assert "`vessel` (drift-off) or `platform.cruise` (drive-off)" in err


@pytest.mark.parametrize("seed", range(6))
def test_a_riser_that_disconnects_on_the_way_has_no_circles(commands, tmp_path, seed):
    """Its limits are reached later than those of the connected riser, or not at all."""
    tree = rig(seed, spatial=bool(seed % 2), conductor=False)
    tree["top"] |= {"x": "vessel", "z": "held"}
    del tree["platform"]
    tree["bottom"]["body"] = {"name": "LMRP", "mass": 1e5, "submerged_weight": "8e5 N"}
    tree["vessel"] = {"mass": "3e7 kg", "wave_drift": {"force": "1e6 N"}}
    tree["disconnect"] = {"at": f"{4 + 2 * seed} s", "over": "1 s"}
    tree["limits"] = [{"output": "ufj_angle", "largest": "0.1 deg", "mode": "disconnect"}]
    tree["analysis"] = timed(20.0, 0.1, 30, 0.5)
    scene = tmp_path / "rig.yaml"
    scene.write_text(json.dumps(written(tree)))
    words = ["--disconnect", "2 s", "--prepare", "1 s"]
    code, out, err = commands("watch-circles", scene, *words)
    assert (code, out) == (2, "")
    assert f"after the disconnect at {4 + 2 * seed} s" in err
    assert "--set disconnect=null" in err


@pytest.mark.parametrize("seed", range(4))
def test_a_riser_that_hangs_free_has_nothing_to_disconnect(commands, tmp_path, seed):
    """In plane and space; with a cruising platform or below a drifting vessel."""
    tree = rig(seed, spatial=bool(seed % 2), conductor=False)
    tree["bottom"] = {"hold": "free", "body": {"name": "LMRP", "mass": 1e5, "submerged_weight": "8e5 N"}}
    if seed < 2:
        tree["top"] = {"x": "vessel", "z": "held", "elevation": "0 m"}
        tree["vessel"] = {"mass": "3e7 kg", "wave_drift": {"force": "1e6 N"}}
        del tree["platform"]
    else:
        tree["top"] = {"x": "platform", "z": "platform", "elevation": "0 m"}
        tree["platform"] = {"cruise": {"speed": "1 m/s", "ramp": "5 s"}}
    tree["limits"] = [{"output": "ufj_angle", "largest": "0.1 deg", "mode": "disconnect"}]
    tree["analysis"] = timed(20.0, 0.1, 30, 0.5)
    scene = tmp_path / "rig.yaml"
    scene.write_text(json.dumps(written(tree)))
    code, out, err = commands("watch-circles", scene, "--disconnect", "2 s", "--prepare", "1 s")
    assert (code, out) == (2, "")
    assert "bottom.hold: 'free' means a hung-off riser" in err
