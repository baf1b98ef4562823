"""Limits: what a run uses of them, and what is said where it cannot be known."""

import csv
import json
import re

import numpy as np
import pytest

from riserstudy import simulate
from riserstudy.dataset.limit_lines import lines
from riserstudy.dataset.limits import use
from riserstudy.errors import InputError
from riserstudy.scene.limits import UNITS, Limit
from riserstudy.scene.load import SceneFile

#: a string of 1 kN/m and 500 m, under 1 MN at its top: 500 kN at its foot, in the middle 750 kN
HUNG = {
    "title": "hung",
    "riser": [
        {"name": name, "length": "250 m", "axial_stiffness": "5e9 N", "submerged_weight": "1 kN/m"}
        for name in ("lower", "upper")
    ],
    "bottom": {"hold": "wellhead", "elevation": "0 m"},
    "top": {"z": "free", "tension": "1 MN"},
    "limits": [
        {"output": "effective_tension", "smallest": "250 kN", "mode": "connected"},
        {"output": "effective_tension", "at": "lower", "largest": "600 kN", "mode": "drilling"},
        {"output": "effective_tension", "at": "upper end of lower", "mean": "1 MN", "mode": "drilling"},
        {"output": "lower_end_tension", "largest": "1 MN", "mode": "drilling"},
        {"output": "tensioner_stroke", "largest": "7 m", "mode": "connected"},
        {"output": "von_mises_stress", "largest": "300 MPa", "mode": "connected"},
    ],
    "analysis": {},
}  # fmt: skip


def as_lines(rows):
    return [line.text for line in lines(rows)]


@pytest.fixture(scope="module")
def rows():
    return json.loads(simulate(SceneFile("hung.yaml", HUNG)).attrs["limits"])


def test_use_is_demand_over_allowable_where_it_is(rows):
    floor, ceiling, mean, *_ = rows
    assert (floor["demand"], floor["s"]) == (pytest.approx(500e3, rel=1e-9), 0.0)
    assert floor["utilisation"] == pytest.approx(0.5, rel=1e-9)
    assert ceiling["utilisation"] == pytest.approx(750.0 / 600.0, rel=1e-9)
    assert ceiling["s"] == pytest.approx(250.0)
    assert mean["demand"] == pytest.approx(750e3, rel=1e-9)
    assert [row["verdict"] for row in rows[:3]] == ["within", "exceeded", "within"]


def test_an_allowable_says_where_it_is_from(rows):
    origins = {row["origin"] for row in rows[:3]}
    assert origins == {"given"}
    limit = HUNG["limits"][3] | {"largest": {"assumed": "1 MN", "because": "a joint"}}
    file = SceneFile("hung.yaml", HUNG).with_values({"limits": [limit]}, "test")
    assert json.loads(simulate(file).attrs["limits"])[0]["origin"] == "assumed"


def test_what_is_missing_is_named_and_never_passes(rows):
    stroke, stress = rows[4:]
    assert (stroke["verdict"], stroke["missing"]) == ("not evaluated", "top.tensioners")
    assert stress["verdict"] == "not evaluated"
    assert "outer_diameter of section 'lower'" in stress["missing"]
    assert any("not evaluated: top.tensioners" in text for text in as_lines(rows))


def test_a_limit_says_which_sections_it_takes_and_what_where_they_meet(rows):
    whole, one, *_, stress = rows
    assert whole["takes"] == "lower to upper"
    assert one["takes"] == ""
    assert stress["takes"].endswith("where two sections meet, the larger stress")
    said = as_lines(rows)
    assert "connected: smallest effective_tension: lower to upper" in said
    assert any(text.startswith("drilling: largest effective_tension at lower ") for text in said)


def walls(thickness):
    """A heavier pipe below a lighter one, each filled; at their joint both carry one tension."""
    sections = [
        {"name": name, "length": "250 m", "outer_diameter": "0.5 m", "inner_diameter": f"{0.5 - 2 * t} m",
         "young_modulus": "207 GPa", "submerged_weight": "0.1 kN/m",
         "contents": {"density": "1025 kg/m^3"}}
        for name, t in zip(("lower", "upper"), thickness, strict=True)
    ]  # fmt: skip
    water = {"density": "1025 kg/m^3", "surface": "500 m", "seabed": "0 m"}
    at = [{"output": "von_mises_stress", "at": at, "largest": "300 MPa", "mode": "drilling"}
          for at in ("upper end of lower", "lower end of upper")]  # fmt: skip
    scene = HUNG | {"riser": sections, "water": water, "gravity": "9.81 m/s^2", "limits": at}
    rows = json.loads(simulate(SceneFile("walls.yaml", scene)).attrs["limits"])
    return [row["demand"] for row in rows]


def test_where_walls_meet_both_sides_have_the_stress_of_the_thinner():
    thin, thick = walls((0.02, 0.02)), walls((0.04, 0.04))
    assert thick[0] < 0.7 * thin[0]
    assert walls((0.04, 0.02)) == pytest.approx([thin[0], thin[0]], rel=1e-6)


def test_the_command_ends_with_what_it_found(tmp_path, commands):
    scene = tmp_path / "hung.yaml"

    def checked(limits):
        scene.write_text(json.dumps(HUNG | {"limits": limits}))
        return commands("check", scene)

    code, said, _ = checked(HUNG["limits"][:1])
    assert code == 0
    assert " 50 % " in said
    assert checked(HUNG["limits"][:2])[0] == 1
    assert checked(HUNG["limits"][4:])[0] == 4
    code, _, said = checked([{"output": "colour", "largest": "1 m", "mode": "drilling"}])
    assert code == 2
    assert "limits[0]" in said


@pytest.mark.parametrize(
    "limit, said",
    [
        ({"output": "lfj_angle", "largest": 4, "mode": "drilling"}, "4 has no unit"),
        ({"output": "lfj_angle", "largest": "4 deg"}, "missing"),
        ({"output": "lfj_angle", "largest": "4 m", "mode": "drilling"}, "wrong dimension"),
        ({"output": "lfj_angle", "at": "lower", "largest": "4 deg", "mode": "drilling"}, "one place"),
        ({"output": "x", "at": "middle", "largest": "4 m", "mode": "drilling"}, "no section 'middle'"),
        ({"output": "x", "largest": "4 m", "smallest": "0 m", "mode": "drilling"}, "one of largest"),
        ({"output": "x", "largest": "0 m", "mode": "drilling"}, "the utilisation cannot be computed"),
        (
            {"output": "x", "smallest": "-4 m", "mode": "drilling"},
            "for which a smallest value has no meaning",
        ),
        ({"output": "lfj_angle", "smallest": "1 deg", "mode": "drilling"}, "a smallest value"),
        ({"output": "lfj_angle", "mean": "-1 deg", "mode": "drilling"}, "a negative value"),
        ({"output": "x", "largest": "-4 m", "mode": "drilling"}, "limits on x apply to its magnitude"),
    ],
)
def test_a_limit_that_cannot_be_meant_is_refused(limit, said):
    with pytest.raises(InputError, match="limits") as error:
        SceneFile("hung.yaml", HUNG | {"limits": [limit]}).resolved()
    assert said in str(error.value)


@pytest.mark.parametrize(
    "side, demand, allowable, share",
    [
        ("largest", 3.0, 4.0, 0.75),
        ("largest", -3.0, 4.0, 0.0),
        ("smallest", 8.0, 4.0, 0.5),
        ("smallest", 2.0, 4.0, 2.0),
        ("smallest", -1.0, 4.0, float("inf")),
        ("smallest", 1.0, 0.0, 0.0),
        ("smallest", -1.0, 0.0, float("inf")),
        ("smallest", -3.0, -4.0, 0.75),
        ("smallest", 3.0, -4.0, 0.0),
        ("mean", 3.0, 4.0, 0.75),
        ("mean", 3.0, -4.0, float("inf")),
        ("mean", -5.0, -4.0, 0.8),
        ("mean", -2.0, -4.0, 2.0),
    ],
)
def test_use_is_above_one_where_a_limit_is_exceeded(side, demand, allowable, share):
    assert use(side, demand, allowable) == pytest.approx(share)


def test_tables_are_csv_and_what_is_none_is_refused(tmp_path, commands):
    scene, out = tmp_path / "hung.yaml", tmp_path / "out.csv"
    scene.write_text(json.dumps(HUNG))

    def table(*words):
        assert commands(*words, "-o", out)[0] == 0
        return list(csv.reader(out.open()))

    found = table("table", scene, "--kind", "stack-up")
    assert [row[0] for row in found] == ["section", "upper", "lower"]
    assert float(found[2][found[0].index("wet weight from the top (kN)")]) == pytest.approx(500.0)
    found = table("table", scene)
    assert ["effective_tension", "upper end of upper", "N"] in [row[:3] for row in found]
    assert len(table("run", scene)) > 1
    for name in ("out.xlsx", "out.txt"):
        assert commands("run", scene, "-o", tmp_path / name)[0] == 2
        assert not (tmp_path / name).exists()


@pytest.mark.parametrize("seed", range(4))
def test_a_limit_over_several_sections_is_the_worst_of_theirs(seed):
    chance = np.random.default_rng(seed)
    names = [f"part {k}" for k in range(5)]
    riser = [
        {
            "name": name, "length": f"{chance.integers(20, 200)} m", "axial_stiffness": "5e9 N",
            "submerged_weight": f"{chance.uniform(-1.5, 2.0)} kN/m",
        }
        for name in names
    ]  # fmt: skip
    first, last = sorted(chance.choice(5, 2, replace=False))
    common = {"output": "effective_tension", "mode": "drilling"}
    for side in ("largest", "smallest"):
        limits = [common | {"at": [names[first], names[last]], side: "1 MN"}]
        limits += [common | {"at": name, side: "1 MN"} for name in names]
        file = SceneFile("hung.yaml", HUNG | {"riser": riser, "limits": limits})
        several, *each = json.loads(simulate(file).attrs["limits"])
        worst = max(each[first : last + 1], key=lambda row: row["utilisation"])
        assert several["utilisation"] == worst["utilisation"]
        assert several["s"] == worst["s"]
        assert several["at"] == f"{names[first]} to {names[last]}"


@pytest.mark.parametrize(
    "at, said",
    [
        (["upper", "lower"], "'upper' is above 'lower'"),
        (["lower", "top"], "no section 'top'"),
        (["lower"], "at"),
    ],
)
def test_a_range_of_sections_that_is_none_is_refused(at, said):
    limit = {"output": "effective_tension", "at": at, "smallest": "1 kN", "mode": "drilling"}
    with pytest.raises(InputError, match=said):
        SceneFile("hung.yaml", HUNG | {"limits": [limit]}).resolved()


@pytest.mark.parametrize("floor", ["0 N", "0 kN"])
def test_a_floor_of_zero_tells_its_margin_and_no_share(floor):
    limits = [{"output": "effective_tension", "smallest": floor, "mode": "connected"}]
    rows = json.loads(simulate(SceneFile("hung.yaml", HUNG | {"limits": limits})).attrs["limits"])
    line = as_lines(rows)[1]
    assert re.search(r"margin 500 kN .*within$", line)
    assert "%" not in line
    slack = {"demand": -400e3, "utilisation": float("inf"), "verdict": "exceeded"}
    assert re.search(r"margin -400 kN .*exceeded$", as_lines([rows[0] | slack])[1])


@pytest.mark.parametrize(
    "share, said", [(0.0, "0 %"), (1.146e-17, "0 %"), (0.3349, "33.49 %"), (12.0, "1200 %")]
)
def test_a_use_by_rounding_is_printed_as_none(share, said):
    row = {
        "output": "x", "at": "", "mode": "drilling", "side": "largest", "allowable": 1.0, "demand": share,
        "utilisation": share, "s": None, "time": None, "verdict": "within", "missing": "", "origin": "given",
    }  # fmt: skip
    assert f" {said} " in as_lines([row])[1]


@pytest.mark.parametrize("ramp", [10.0, 25.0, 200.0])
def test_a_mean_over_time_leaves_out_what_grows(ramp):
    """A string that the platform draws aside for good: its slope at the foot is that of the end."""
    limit = {"output": "x", "at": "upper end of lower", "mean": "1 m", "mode": "drilling"}
    riser = [part | {"mass": "100 kg/m"} for part in HUNG["riser"]]
    changes = {
        "riser": riser, "limits": [limit], "top": {"x": "platform", "z": "free", "tension": "1 MN"},
        "platform": {"surge": {"amplitude": "3 m", "period": "40 s", "ramp": f"{ramp} s"}},
        "analysis": {
            "duration": "80 s", "step": "0.5 s", "mesh": {"elements": 8}, "output": {"interval": "0.5 s"},
        },
    }  # fmt: skip
    run = simulate(SceneFile("hung.yaml", HUNG | changes), progress=False)
    (row,) = json.loads(run.attrs["limits"])
    at = run["x"].interp(s=250.0)
    lines = as_lines([row])
    start = 40.0 if ramp < 80.0 else 0.0
    integral = float(at.sel(time=slice(start, 80.0)).integrate("time"))
    assert row["demand"] == pytest.approx(abs(integral) / (80.0 - start), rel=1e-6)
    if ramp == 25.0:  # with little of a transient, the string sways as far to one side as to the other
        assert row["demand"] <= 1e-3 * float(abs(at).max())
    assert any("from 40 s on, over 1 whole period" in text for text in lines) == (ramp < 80.0)
    assert any("includes ramps" in text for text in lines) == (ramp > 80.0)


@pytest.mark.parametrize("seed", range(8))
def test_the_limit_that_governs_stands_first_and_none_is_lost(seed):
    """Exceeded before kept, more used before less, what could not be evaluated last."""
    rng = np.random.default_rng(seed)
    rows = []
    for k in range(9):
        use = None if rng.random() < 0.2 else float(rng.uniform(0.0, 2.0))
        verdict = "not evaluated" if use is None else "exceeded" if use > 1.0 else "within"
        rows.append(
            {
                "output": "lfj_angle", "at": f"place {k}", "mode": "drilling", "side": "largest",
                "allowable": 0.02, "demand": None if use is None else 0.02 * use, "utilisation": use,
                "s": None, "time": None, "verdict": verdict, "missing": "" if use else "a joint",
                "origin": "given", "takes": "",
            }
        )  # fmt: skip
    head, *table = lines(rows)[: len(rows) + 1]
    assert head.text.split()[0] == "limit"
    uses = [line.use for line in table]
    known = [use for use in uses if not np.isnan(use)]
    assert known == sorted((row["utilisation"] for row in rows if row["demand"] is not None), reverse=True)
    assert all(np.isnan(use) for use in uses[len(known) :])
    for k in range(9):
        assert sum(f"place {k} " in line.text for line in table) == 1


def test_the_page_of_scenes_names_every_output_that_can_have_a_limit():
    first = Limit.__doc__.partition("A stress range cannot")[0]
    assert set(re.findall(r"``(\w+)``", first)) - {"output"} == set(UNITS)
