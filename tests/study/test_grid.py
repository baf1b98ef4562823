"""Grids: points planned from parts are the scenes that the whole of their values makes."""

import random
import re
import resource
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path

import pytest
from pydantic import ValidationError

from riserstudy.dataset.label import quantities
from riserstudy.dataset.variables import of_runs
from riserstudy.errors import InputError
from riserstudy.jobs.workplan import Workplan
from riserstudy.scene.load import read_scene
from riserstudy.simulation.refine import run
from riserstudy.simulation.warm_up import scenes
from riserstudy.study.axes import Steps
from riserstudy.study.grid import Grid
from riserstudy.study.store import key_of
from riserstudy.study.study_model import StudyModel

CONFIG = Path(__file__).parents[2] / "config"
SURGE = CONFIG / "scenes/bench/s2c.yaml"
STUDIES = Workplan.read(CONFIG, {"tier": "preview"}, only=[]).studies


def steps(path, *values):
    return [{path: value} for value in values]


@pytest.mark.parametrize("study", STUDIES, ids=lambda s: f"{s.paper}-{s.name}")
def test_a_point_has_the_key_of_its_whole_scene(study):
    some = study.plan[:: max(1, len(study.plan) // 3)]
    for point in [*some, study.plan[-1]]:
        assert point.key == key_of(study.grid.file(point.index).resolved())


def test_a_later_axis_wins_and_takes_away_what_an_earlier_one_set():
    axes = [
        steps("platform.surge.amplitude", "1 m", "2 m"),
        [{}, {"platform.surge": {"amplitude": "3 m", "period": "9 s", "ramp": "9 s"}}],
    ]
    keys = {point.index: point.key for point in Grid(read_scene(SURGE), axes, "test").points()}
    assert len(keys) == 4
    assert keys[0, 0] != keys[1, 0]
    assert keys[0, 1] == keys[1, 1] not in (keys[0, 0], keys[1, 0])


def test_shards_planned_by_themselves_are_those_of_the_whole():
    study = next(study for study in STUDIES if study.name == "steady")
    alone = [replace(study).shard(number, 3) for number in (1, 2, 3)]
    assert len(study.plan) == len(study.grid)
    assert alone == [study.shard(number, 3) for number in (1, 2, 3)]
    assert sorted(p.index for points in alone for p in points) == [p.index for p in study.plan]


@pytest.mark.parametrize(
    "path, value, field",
    [
        ("platform.nothing", "1 m", "platform.nothing"),
        ("nothing", "1 m", "nothing"),
        ("riser[7].mass", "1 t/m", "riser"),
        ("platform.surge.period", "-9 s", "platform.surge.period"),
        ("riser", None, "riser"),
        ("water", None, "water"),  # each part is right, and the whole is not
    ],
)
def test_a_point_that_cannot_be_meant_is_refused_as_the_whole_scene_is(path, value, field):
    grid = Grid(read_scene(SURGE), [steps("riser[0].mass", "900 kg/m"), steps(path, value)], "test")
    with pytest.raises(InputError) as of_grid:
        list(grid.points())
    with pytest.raises(InputError) as of_scene:
        grid.file((0, 0)).resolved()
    assert str(of_grid.value) == str(of_scene.value)
    assert field in str(of_grid.value)


def test_planning_imports_neither_solver_nor_arrays():
    heavy = ["numba", "scipy", "xarray", "matplotlib", "pint", "riserstudy.simulation.refine"]
    script = f"""if True:
        import sys
        from pathlib import Path
        from riserstudy.jobs.workplan import Workplan
        Workplan.read(Path({str(CONFIG)!r}), {{"papers": ["bench", "fem_riser"]}}, [("bench", "s2")])
        print([name for name in {heavy} if name in sys.modules])"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.stdout == "[]\n", done.stderr


def planned(amplitudes):
    """Time of planning a thousand points for each amplitude (s), and the most memory so far (kB)."""
    axes = [
        steps("riser[0].mass", *(f"{k} kg/m" for k in range(900, 1900, 100))),
        steps("platform.surge.period", *(f"{k} s" for k in range(8, 18))),
        steps("riser[0].drag.coefficient", *(0.7 + k / 10 for k in range(10))),
        steps("platform.surge.amplitude", *(f"{k / 10} m" for k in range(1, amplitudes + 1))),
    ]
    began = time.process_time()
    points = list(Grid(read_scene(SURGE), axes, "test").points())
    seconds = time.process_time() - began
    assert len({point.key for point in points}) == len(points) == 1000 * amplitudes
    return seconds, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


@pytest.mark.slow
def test_planning_takes_time_in_proportion_to_the_points_and_at_most_a_gigabyte():
    """Ten times as many points, in turn: at most twice that in time, whatever the machine."""
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:  # its memory is not that of other tests
        few, _ = pool.submit(planned, 10).result()
        many, memory = pool.submit(planned, 100).result()
    assert many <= 20.0 * few
    assert memory < 1e6  # kB


OF_SURGE = {"scene": "scenes/bench/s2c.yaml", "caption": "c"}
AMPLITUDE = {"path": "platform.surge.amplitude", "unit": "m", "values": [1.0, 2.0]}


@pytest.mark.parametrize(
    "said, changed",
    [
        ("'bending_momnet' is not an output of a run", {"keep": ["bending_momnet"]}),
        ("axes.stroke: this is also the name of an output", {"axes": {"stroke": AMPLITUDE}}),
        ("axes.x_max: this is also the name of an output", {"axes": {"x_max": AMPLITUDE}}),
        ("axes.s_node: this is also the name of an output", {"axes": {"s_node": AMPLITUDE}}),
        ("axes.use_of_limit: this is also the name of an output", {"axes": {"use_of_limit": AMPLITUDE}}),
        ("axes.s_of_statistic: this is also the name", {"axes": {"s_of_statistic": AMPLITUDE}}),
        ("axes.statistic: this is also the name of an output", {"axes": {"statistic": AMPLITUDE}}),
        ("axes.elements: this is also the name of an output", {"axes": {"elements": AMPLITUDE}}),
        ("axes.warnings: this is also the name of an output", {"axes": {"warnings": AMPLITUDE}}),
        ("axes.failure: this is also the name of an output", {"axes": {"failure": AMPLITUDE}}),
        ("axes.assumed_mass: names that start with 'assumed_'", {"axes": {"assumed_mass": AMPLITUDE}}),
        (
            "axes.b.calm: sets 'platform.surge.amplitude', where axis 'a' has its numbers",
            {"axes": {"a": AMPLITUDE, "b": {"as it is": {}, "calm": {AMPLITUDE["path"]: "1 m"}}}},
        ),
        (
            "axes.b.calm: sets 'platform', where axis 'a' has its numbers",
            {"axes": {"a": AMPLITUDE, "b": {"calm": {"platform": {"surge": {}}}}}},
        ),
        (
            "axes.b.high: sets 'platform.surge', where axis 'a' has its own",
            {
                "axes": {
                    "a": {"low": {}, "some": {"platform.surge.amplitude": "1 m"}},
                    "b": {"low": {"wave": None}, "high": {"platform.surge": {}}},
                }
            },
        ),
        (
            "axes.b: sets 'platform.surge.amplitude', which axis 'a' also sets",
            {"axes": {"a": AMPLITUDE, "b": AMPLITUDE}},
        ),
        ("which axis 'a' also sets", {"axes": {"a": AMPLITUDE | {"path": "platform.surge"}, "b": AMPLITUDE}}),
    ],
)
def test_names_and_paths_that_clash_are_refused_before_any_run(said, changed):
    study = OF_SURGE | {"axes": {"a": AMPLITUDE}} | changed
    with pytest.raises(ValidationError, match=re.escape(said)):
        StudyModel.model_validate(study)


@pytest.mark.parametrize(
    "axes",
    [
        {"b": {"calm": {"platform.surge": {"period": "9 s"}}}, "a": AMPLITUDE},  # numbers on top
        {"a": AMPLITUDE, "b": {"none": {"platform": None}}},  # which says that it goes
        {"a": AMPLITUDE, "b": {"slow": {"platform.surge.period": "20 s"}}},
    ],
)
def test_labels_may_set_what_numbers_are_within_before_them_and_what_is_beside(axes):
    StudyModel.model_validate(OF_SURGE | {"axes": axes})


def test_steps_reach_their_stop_or_are_refused():
    with pytest.raises(ValidationError, match=r"give 0\.6 or 1\.2, or another step"):
        Steps(start=0.0, stop=1.0, step=0.6)
    assert Steps(start=0.0, stop=0.3, step=0.1).values == [0.0, 0.1, 0.2, 0.3]


@pytest.mark.parametrize("seed", range(60))
def test_steps_are_counted_in_the_digits_that_they_are_written_in(seed):
    """Of any size: a whole number of steps of whole numbers, all shifted by the same power of ten."""
    rng = random.Random(seed)
    first, step = rng.randint(-99_999, 99_999), rng.randint(1, 99_999)
    count, power = rng.randint(0, 200), rng.randint(-40, 25)
    start, stop, by = (float(f"{whole}e{power}") for whole in (first, first + count * step, step))
    found = Steps(start=start, stop=stop, step=by).values
    assert found == [float(f"{first + k * step}e{power}") for k in range(count + 1)]
    short = float(f"{first + count * step + rng.randint(1, 9) / 10 * step}e{power}")
    with pytest.raises(ValidationError, match="not a whole number of steps"):
        Steps(start=start, stop=short, step=by)


def test_an_axis_whose_factor_is_nothing_is_refused():
    axis = {"path": "platform.surge.amplitude", "unit": "m", "factor": 0, "values": [1, 2]}
    with pytest.raises(ValidationError, match="all values of the axis are equal"):
        StudyModel.model_validate(OF_SURGE | {"axes": {"a": axis}})


@pytest.mark.long
def test_all_that_runs_return_can_be_kept():
    returned = set()
    for group in scenes().values():
        for scene in group:
            returned |= set(quantities(run(scene).arrays))
    assert len(returned) > 40
    assert [name for name in returned if not of_runs(name)] == []
