"""The outcome of a disconnect: the table agrees with the dataset, and limits on it are checked."""

import csv
import json

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import solve_ivp

from riserstudy import load_scene, simulate
from riserstudy.dataset.tables import in_units, table_of
from riserstudy.dataset.unit_systems import UnitSystem
from riserstudy.errors import InputError
from riserstudy.scene.units import factor

SCENE = "config/scenes/design/recoil.yaml"
QUICK = {
    "analysis.accuracy": None,
    "analysis.mesh": {"elements": 24},
    "analysis.step": "20 ms",
    "analysis.duration": "40 s",
}
LIMITS = [
    {"output": "overpull", "smallest": "100 kN", "mode": "disconnect"},
    {"output": "lmrp_clearance", "smallest": "1 m", "mode": "disconnect"},
]


def words(values):
    return [word for path, value in values.items() for word in ("--set", f"{path}={json.dumps(value)}")]


def cases():
    draw = np.random.default_rng(7)
    for _ in range(4):
        yield {
            "disconnect.phase": f"{draw.uniform(0.0, 360.0):.1f} deg",
            "platform.heave.amplitude": f"{draw.uniform(0.5, 3.0):.2f} m",
            "top.tensioners.gas.pressure": f"{draw.uniform(48.0, 78.0):.1f} bar absolute",
        }


@pytest.mark.parametrize("changed", list(cases()))
def test_the_table_of_a_disconnect_is_what_its_histories_show(commands, tmp_path, changed):
    run, table = tmp_path / "run.nc", tmp_path / "recoil.csv"
    more = words(QUICK | changed)
    code, out, _ = commands("recoil", SCENE, *more, "-o", run, "--csv", table)
    rows = {row["quantity"]: row for row in csv.DictReader(table.open())}
    with xr.open_dataset(run) as of:
        after = of["time"] > float(rows["overpull"]["time (s)"])
        lift, reach = of["lift"].where(after, drop=True), of["tensioner_stroke"]
        attributes = dict(of.attrs)
    value = {name: float(row["value"] or "nan") for name, row in rows.items()}
    assert value["overpull"] == pytest.approx(attributes["overpull"] / 1e3)
    fastest = 0.1 * value["largest upward speed"]  # m between two outputs
    assert 0.0 <= value["largest lift"] - float(lift.max()) + 1e-9 < fastest
    assert value["largest upward speed"] == pytest.approx(attributes["lift_rate_max"])
    assert (rows["re-contact"]["note"] == "no") == bool(lift.min() > -1e-6)
    assert (code == 4) == bool(np.isnan(value["smallest clearance"]))
    if code == 0:
        then = float(rows["smallest clearance"]["time (s)"])
        near = float(lift.sel(time=then, method="nearest")) - value["smallest clearance"]
        assert -1e-9 < near + 1e-9 < fastest
    for side, name in ((reach.min(), "shortest"), (reach.max(), "longest")):
        row = rows[f"{name} cylinder stroke"]
        assert abs(value[f"{name} cylinder stroke"]) >= abs(float(side)) - 1e-6
        end = -7.62 if name == "shortest" else 7.62
        out_of_it = abs(value[f"{name} cylinder stroke"]) > abs(end) + 1e-6
        assert row["note"].startswith("stroke-out") == out_of_it
    assert out.splitlines()[0].split()[0] == "quantity"


@pytest.mark.parametrize("changed", list(cases()))
def test_coarser_outputs_change_nothing_of_the_outcome(changed):
    """Lift and clearance are those of all steps, however few of them are written."""
    names = ("lift_max", "lift_rate_max", "clearance_min", "clearance_time", "recontact_time")
    found = []
    for interval in ("0.1 s", "0.7 s", "3 s"):
        of = load_scene(SCENE, **QUICK, **changed, **{"analysis.output.interval": interval})
        attributes = simulate(of, progress=False).attrs
        found.append({name: attributes.get(name) for name in names})
    assert found[0]["lift_max"] > 1.0
    for other in found[1:]:
        assert other == found[0]


@pytest.mark.parametrize("late", [0.5, 8.0, 20.0])
def test_outputs_that_begin_after_the_disconnect_are_refused(late):
    """What they do not see of lift and clearance would be missing without a word."""
    at = 12.0
    load_scene(SCENE, **QUICK, **{"analysis.output.start": f"{at} s"}).resolved()
    with pytest.raises(InputError, match=r"analysis\.output\.start: .*after the disconnect"):
        load_scene(SCENE, **QUICK, **{"analysis.output.start": f"{at + late} s"}).resolved()


def level_of_the_mud(lift):
    """Lowest height (m) of the mud above the riser's end, of the scene with a lower end that is higher."""
    length, depth, bore, mud, sea, gravity = 1500.0, 1482.0, 19.25 * 0.0254, 1440.0, 1025.0, 9.80665

    def rates(_, y):
        friction = (0.02 * y[0] / bore + 1.5) * y[1] * abs(y[1]) / 2.0
        return [-y[1], gravity * (1.0 - sea * (depth - lift) / (mud * y[0])) - friction / y[0]]

    def turns(_, y):
        return y[1] - 1e-12

    turns.terminal, turns.direction = True, -1.0
    start, settings = [length - lift, 1e-6], {"rtol": 1e-9, "atol": 1e-9, "max_step": 0.1}
    until_the_end = (0.0, 20.0)
    return solve_ivp(rates, until_the_end, start, events=turns, **settings).y[0, -1]


@pytest.mark.parametrize("seed", range(3))
def test_the_lowest_level_of_the_mud_is_named_by_what_it_is_measured_from(commands, tmp_path, seed):
    """A riser that is shorter by some metres below the same sea and flow line."""
    lift = float(np.random.default_rng(seed).uniform(0.0, 30.0))
    table = tmp_path / "recoil.csv"
    raised = {"bottom.elevation": f"{18.0 + lift} m", "riser[0].length": f"{91.44 - lift} m"}
    commands("recoil", SCENE, *words(QUICK | raised), "--csv", table)
    rows = {row["quantity"]: row for row in csv.DictReader(table.open())}
    row = rows["lowest level of the mud"]
    assert row["note"] == "above the lower end"
    assert float(row["value"]) == pytest.approx(level_of_the_mud(lift), abs=0.1)


def test_a_stored_run_and_its_scene_give_one_table(commands, tmp_path):
    run, one, two = (tmp_path / name for name in ("run.nc", "one.csv", "two.csv"))
    code, out, _ = commands("run", SCENE, *words(QUICK), "-o", run)
    assert code == 0
    assert "largest upward speed" in out
    assert commands("table", run, "-o", one, "--kind", "recoil")[0] == 0
    assert commands("table", SCENE, *words(QUICK), "-o", two, "--kind", "recoil")[0] == 0
    assert one.read_text() == two.read_text()


@pytest.mark.parametrize("changed", list(cases()))
def test_limits_on_overpull_and_clearance_are_met_where_the_attributes_meet_them(changed):
    dataset = simulate(load_scene(SCENE, **QUICK, **changed, limits=LIMITS), progress=False)
    rows = json.loads(dataset.attrs["limits"])
    for row, name in zip(rows, ("overpull", "clearance_min"), strict=True):
        found = dataset.attrs.get(name)
        if found is None:
            assert row["verdict"] == "not evaluated"
        else:
            assert row["demand"] == pytest.approx(found)
            assert row["verdict"] == ("within" if found >= row["allowable"] else "exceeded")


def test_a_scene_without_a_disconnect_has_no_recoil(commands):
    code, out, said = commands("recoil", "config/scenes/design/riser.yaml")
    assert (code, out) == (2, "")
    assert "disconnect" in said


@pytest.mark.parametrize("pressure", [36, 42, 50, 64])
def test_a_disconnect_warns_exactly_where_the_lmrp_stands_on_the_stack(pressure):
    held = {"top.tensioners.gas.pressure": f"{pressure} bar absolute"}
    dataset = simulate(load_scene(SCENE, **QUICK, **held), progress=False)
    said = [text for text in json.loads(dataset.attrs["warnings"]) if "overpull" in text]
    assert bool(said) == (dataset.attrs["overpull"] < 0.0)
    assert bool(said) or pressure > 36, "no case stands on the stack: it tests nothing"


@pytest.mark.parametrize("seed", range(6))
def test_in_feet_and_kips_the_outcome_has_the_same_quantities(seed):
    draw = np.random.default_rng(seed)
    names = ("overpull", "lift_max", "lift_rate_max", "clearance_min", "clearance_time", "smallest_tension")
    names += ("contents_speed_max", "contents_top_min")
    of = xr.Dataset(attrs={name: float(draw.uniform(-1e3, 1e3)) for name in names})
    table = table_of("recoil", load_scene(SCENE).resolved(), of)
    us = in_units(table, UnitSystem.US)
    assert "ft" in {row[2] for row in us.rows}
    for plain, same in zip(table.rows, us.rows, strict=True):
        if plain[1] is None:
            assert same[1] is None
        else:
            assert same[1] * factor(same[2], plain[2]) == pytest.approx(plain[1]), plain[0]
        assert same[3] == plain[3]  # s
