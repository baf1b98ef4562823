"""A grid in one call: its points are those that ``simulate`` makes, and what cannot be completed is told."""

from pathlib import Path

import numpy as np
import pytest
from page_notebook import run_notebook
from random_rigs import moving, written

from riserstudy import load_scene, simulate, sweep
from riserstudy.errors import InputError, SimulationError
from riserstudy.records.numerals import duration
from riserstudy.scene.load import SceneFile
from riserstudy.study import simulate_points, store
from riserstudy.study.far_values import far_values
from riserstudy.study.sweep import Lines, as_study

ROOT = Path(__file__).parents[2]
COARSE = {
    "analysis.mesh": {"elements": 30},
    "analysis.step": "0.1 s",
    "analysis.duration": "12 s",
    "analysis.output": {"interval": "0.5 s"},
}
PERIODS = [8, 12]
TWO_WAYS = {"free": {"bottom.rotation": "free"}, "fixed": {"bottom.rotation": "fixed"}}


pytestmark = pytest.mark.usefixtures("own_store")


def scene(**overrides):
    return load_scene(ROOT / "config/scenes/hard/surge.yaml", **(COARSE | overrides))


def swept(axes, **options):
    return sweep(scene(), axes, progress=False, **({"cores": 1} | options))


def test_a_point_of_a_sweep_is_what_simulate_makes_of_its_scene():
    found = swept({"platform.surge.period": PERIODS, "bottom": TWO_WAYS}, keep=["x", "bending_moment_absmax"])
    assert found["x"].dims[:2] == ("platform_surge_period", "bottom")
    assert found["platform_surge_period"].attrs["units"] == "s"
    for period in PERIODS:
        for label, sets in TWO_WAYS.items():
            alone = simulate(scene(**{"platform.surge.period": f"{period} s"}, **sets))
            point = found.sel(platform_surge_period=period, bottom=label)
            np.testing.assert_array_equal(point["x"], alone["x"])
            np.testing.assert_array_equal(point["bending_moment_absmax"], alone["bending_moment_absmax"])
    assert (found["failure"] == "").all()


def planned(axes, **overrides):
    """The grid of a sweep, which nothing is simulated of."""
    return as_study(scene(**overrides), axes, ["x"])


@pytest.mark.parametrize(
    "texts, unit, values",
    [
        (["2 MN", "2.5 MN"], "MN", [2.0, 2.5]),
        (["2000 kN", "2.5 MN"], "kN", [2000.0, 2500.0]),
        (["2.0e3 kN", "2500 kN"], "kN", [2000.0, 2500.0]),
        ([" 203.9432 tf", "2500kN"], "tf", [203.9432, 2500.0 / 9.80665]),
    ],
)
def test_numbers_have_their_own_unit_or_that_of_the_scene(texts, unit, values):
    written = planned({"top.tension": texts})
    assert written.model.axes["top_tension"].unit == unit
    assert [value for value, _ in written.axes["top_tension"]] == pytest.approx(values, rel=1e-12)
    loads = [written.grid.file(point.index).resolved().top.tension for point in written.plan]
    plain = planned({"top.tension": [load / 1e3 for load in loads]})  # in kN, as the scene has it
    again = [plain.grid.file(point.index).resolved().top.tension for point in plain.plan]
    assert again == pytest.approx(loads, rel=1e-12)


def test_a_sweep_of_quantities_is_over_an_axis_of_numbers():
    numbers = swept({"top.tension": [2000, 2500]}, keep=["ufj_angle"])
    texts = swept({"top.tension": ["2000 kN", "2500 kN"]}, keep=["ufj_angle"])
    assert texts["top_tension"].attrs["units"] == "kN"
    np.testing.assert_array_equal(texts["top_tension"], numbers["top_tension"])
    np.testing.assert_array_equal(numbers["ufj_angle"], texts["ufj_angle"])


def test_options_stay_labels():
    labels = ["free", "fixed"]
    assert planned({"bottom.rotation": labels}).axes["bottom_rotation"][1][0] == "fixed"


@pytest.mark.parametrize(
    "values, said",
    [
        ([1.6e6, 2.0e6], "2000000.0 kN is 1000 times the scene's 2000 kN at top.tension"),
        ([1600.0, 2100.0], ""),
        ([16.0, 17.0], "0.008 times the scene's 2000 kN"),
        ([20.0, 200.0, 1000.0], ""),  # it leads there
        ([20.0, 2000.0], ""),  # the scene's own is among them
        (["2 kN", "3 kN"], "2.0 kN is 0.001 times"),
        (["2 MN", "3 MN"], ""),
        ([0.0, 2100.0], ""),
    ],
)
def test_values_far_from_the_scene_s_are_warned_of(values, said):
    warned = far_values(planned({"top.tension": values}, **{"top.tension": "2000 kN"}))
    assert len(warned) == bool(said)
    if said:
        assert said in warned[0]
        assert warned[0].startswith("sweep: axes.top_tension: ")


@pytest.mark.parametrize("seed", range(8))
def test_a_slip_of_a_prefix_is_warned_of_whatever_the_scene_s_value(seed):
    draw = np.random.default_rng(seed)
    load = float(draw.uniform(1.5, 4.0))
    values = sorted(set((load * draw.uniform(0.3, 3.0, 4)).round(3)))
    right = planned({"top.tension": values}, **{"top.tension": f"{load} MN"})
    assert far_values(right) == []
    for slip in (1e3, 1e-3, 100.0 / 0.3):
        wrong = planned({"top.tension": [v * slip for v in values]}, **{"top.tension": f"{load} MN"})
        assert len(far_values(wrong)) == 1


def test_a_sweep_warns_and_tells_how_far_it_is_where_there_is_no_terminal(capsys):
    file = scene(**{"top.tension": "2000 kN"})
    with pytest.warns(UserWarning, match=r"210000.0 kN is 105 times the scene's 2000 kN"):
        found = sweep(file, {"top.tension": [2e5, 2.1e5]}, keep=["x"], cores=1)
    assert np.isfinite(found["x"]).all()
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "sweep: 2 points, 0 of them stored"
    assert lines[-1] == "sweep: 2 of 2 points"


def test_progress_says_how_much_is_left(monkeypatch, capsys):
    now = [0.0]
    monkeypatch.setattr("riserstudy.study.sweep.time.monotonic", lambda: now[0])
    told = Lines(120)
    told(40)  # stored
    for second in range(1, 41):
        now[0] = float(second)
        told(2)
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "sweep: 120 points, 40 of them stored"
    assert lines[1] == "sweep: 52 of 120 points, about 34 s to go"
    assert lines[-1] == "sweep: 120 of 120 points"
    assert len(lines) < 10


@pytest.mark.parametrize("seed", range(6))
def test_estimates_of_time_exclude_compiling(seed, monkeypatch, capsys):
    """Points of equal cost, of which the first waits for kernels that are compiled."""
    rng = np.random.default_rng(seed)
    compiling, each, points = rng.uniform(20.0, 200.0), rng.uniform(0.5, 9.0), int(rng.integers(8, 60))
    now = [0.0]
    monkeypatch.setattr("riserstudy.study.sweep.time.monotonic", lambda: now[0])
    progress = Lines(points)
    progress(0)
    now[0] += compiling
    for _ in range(points):
        now[0] += each
        progress(1)
    lines = [line.split() for line in capsys.readouterr().err.splitlines() if "to go" in line]
    assert lines
    for words in lines:
        number, unit = words[-4:-2]
        told = float(number) * {"s": 1.0, "min": 60.0, "h": 3600.0}[unit]
        assert told == pytest.approx((points - int(words[1])) * each, rel=0.06)


@pytest.mark.parametrize("seed", range(5))
def test_times_in_messages_have_no_exponents(seed, monkeypatch, capsys):
    """Estimates from a millisecond to a week, in seconds, minutes or hours; within 6 % of the time."""
    rng = np.random.default_rng(seed)
    for told in 10.0 ** rng.uniform(-3.0, 5.8, 200):
        for digits in (2, 3):
            number, unit = duration(told, digits).split()
            assert "e" not in number
            given = float(number) * {"ms": 1e-3, "s": 1.0, "min": 60.0, "h": 3600.0}[unit]
            assert given == pytest.approx(told, rel=0.055)
    now = [0.0]
    monkeypatch.setattr("riserstudy.study.sweep.time.monotonic", lambda: now[0])
    progress = Lines(1000)
    progress(0)
    for _ in range(30):
        now[0] += rng.uniform(5.0, 500.0)
        progress(1)
    assert "e+" not in capsys.readouterr().err


def test_nothing_is_told_where_all_is_stored_or_nobody_asks(capsys):
    swept({"platform.surge.period": PERIODS}, keep=["x"])
    sweep(scene(), {"platform.surge.period": PERIODS}, keep=["x"], cores=1)
    assert capsys.readouterr().err == ""


def test_what_is_stored_is_not_simulated_again(monkeypatch):
    first = swept({"platform.surge.period": PERIODS}, keep=["x"])
    monkeypatch.setattr(simulate_points, "_simulate", lambda *_: pytest.fail("simulated"))
    again = swept({"platform.surge.period": PERIODS[::-1]}, keep=["x"])
    np.testing.assert_array_equal(again["x"].values[::-1], first["x"].values)


def test_a_point_that_cannot_be_completed_has_no_numbers_and_says_why():
    """30 kN do not carry a riser of 75 kN in water."""
    found = swept({"top.tension": [30, 2000]}, keep=["x", "ufj_angle"])
    weak, strong = (found.isel(top_tension=k) for k in (0, 1))
    assert "buckles sideways under its own weight" in str(weak["failure"].item())
    assert strong["failure"].item() == ""
    for name in ("x", "ufj_angle", "largest_bending_moment", "smallest_tension", "wall_seconds"):
        assert np.isnan(weak[name]).all(), name
        assert np.isfinite(strong[name]).all(), name
    alone = simulate(scene(**{"top.tension": "2000 kN"}))
    np.testing.assert_array_equal(strong["x"], alone["x"])


@pytest.mark.parametrize(
    "axes, options",
    [({"top.tension": [2000, 30]}, {"on_error": "raise"}), ({"top.tension": [25, 30]}, {})],
    ids=["asked for", "nothing is left"],
)
def test_failure_is_an_error_where_it_must_be(axes, options):
    with pytest.raises(SimulationError, match=r"points? cannot be completed; at top_tension = (25|30) kN:"):
        swept(axes, **options)


@pytest.mark.parametrize("seed", range(6))
def test_failing_points_of_a_study_are_told_by_their_values_and_words(seed, monkeypatch):
    draw = np.random.default_rng(seed)
    axes = {"top.tension": [2000.0, 2500.0, 3000.0], "lower_end": TWO_WAYS}
    study = planned(dict(reversed(axes.items())) if seed % 2 else axes)
    lost = study.plan[int(draw.integers(len(study.plan)))]
    failure = SimulationError("it does not stand")
    monkeypatch.setattr(simulate_points, "_simulate", lambda _, p: failure if p.key == lost.key else None)
    monkeypatch.setattr(store, "pack", lambda _: None)
    place = dict(zip(study.axes, lost.index, strict=True))
    tension = f"top_tension = {[2000, 2500, 3000][place['top_tension']]} kN"
    words = {"lower_end": f"lower_end = {[*TWO_WAYS][place['lower_end']]}", "top_tension": tension}
    told = ", ".join(words[name] for name in study.axes)
    with pytest.raises(SimulationError, match=f"1 of 6 points .* first, at {told}: it does not"):
        simulate_points.fill(study, study.plan, 1)


@pytest.mark.parametrize(
    "axes, options, fault",
    [
        ({}, {}, "give at least one path"),
        ({"top.tension": []}, {}, "different values"),
        ({"top.tension": [1, 1]}, {}, "different values"),
        ({"top.tension": [1600, "1700 kN"]}, {}, "give a unit to all values, or to none"),
        ({"top.tension": ["2 MN", "3 m"]}, {}, "wrong dimension"),
        ({"top.pull": [1, 2]}, {}, "pull"),
        ({"platform.surge.period": [8, -8]}, {}, "platform.surge.period"),
        ({"platform.surge.phase": [0, 90]}, {}, "platform.surge.phase"),  # no unit is there
        ({"top.tension": [2000]}, {"keep": ["moment"]}, "moment"),
        ({"top.tension": [2000]}, {"on_error": "skip"}, "'nan' or 'raise'"),
        ({"top.tension": [2000]}, {"cores": 0}, "a whole number from 1"),
        ({"top.tension": [2000]}, {"cores": -2}, "a whole number from 1"),
        ({"top.tension": [2000]}, {"cores": 1.5}, "a whole number from 1"),
        ({"x": TWO_WAYS}, {}, "name of an output"),
        ({"top.tension": 2000.0}, {}, "a list of numbers or texts"),
        ({"top.tension": "2 MN"}, {}, "a list of numbers or texts"),
        ({"top.tension": [[1600, 1700]]}, {}, "a list of numbers or texts"),
        ({"top.tension": np.ones((2, 2))}, {}, "a list of numbers or texts"),
    ],
)
def test_what_cannot_be_meant_is_refused_before_anything_runs(axes, options, fault, monkeypatch):
    monkeypatch.setattr(simulate_points, "_simulate", lambda *_: pytest.fail("simulated"))
    with pytest.raises(InputError, match=fault):
        swept(axes, **options)


@pytest.mark.long
def test_the_notebook_of_its_page_runs_as_it_stands(tmp_path, monkeypatch):
    cells, printed = run_notebook("sweep.md", 3, tmp_path, monkeypatch)
    (picture,) = (output for cell in cells for output in cell.get("outputs", []))
    assert picture["data"]["image/png"].startswith("iVBOR")  # as PNG begins in base64
    assert (tmp_path / "sweep.png").stat().st_size > 5_000
    assert "increase the top tension" in printed


@pytest.mark.parametrize("seed", range(3))
def test_a_warning_states_points_whose_error_is_larger_than_the_result(seed):
    """As the attribute ``warnings`` of each of these runs does; other points cause none."""
    tree = moving(seed, spatial=bool(seed % 2), conductor=False)
    tree["analysis"] |= {"mesh": {"elements": 2}, "step": 2.4, "output": {"interval": 3.0}}
    tree["analysis"]["duration"] = 30.0
    tree["limits"] = [{"output": "bending_moment", "largest": "1e9 N*m", "mode": "drilling"}]
    rig = SceneFile("rig.yaml", written(tree))
    doubtful = [
        "error is larger than the result" in simulate(at, progress=False).attrs["warnings"]
        for at in (rig.with_values({"analysis.step": f"{step} s"}, "test") for step in (2.4, 1.2))
    ]
    assert doubtful[0]
    with pytest.warns(UserWarning, match="larger than the result") as caught:
        sweep(rig, {"analysis.step": [2.4, 1.2]}, cores=1, progress=False)
    said = [str(one.message) for one in caught if "without a known result" in str(one.message)]
    assert len(said) == 1
    assert said[0].startswith(f"sweep: {sum(doubtful)} point")
