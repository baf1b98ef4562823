"""Tables of a run: the stack-up against the engine, and the same from a scene as from its dataset."""

import csv
import json
import math
import random
from itertools import chain

import pytest

from riserstudy import simulate
from riserstudy.dataset.table import Table
from riserstudy.dataset.tables import in_columns, stack_up
from riserstudy.scene.load import SceneFile

#: two sections with mud, a ring above and a stack below, pulled by 3 MN
PULLED = {
    "title": "pulled",
    "gravity": "9.81 m/s^2",
    "water": {"density": "1025 kg/m^3"},
    "riser": [
        {
            "name": name, "joints": {"count": count, "length": "20 m"}, "axial_stiffness": "5e9 N",
            "mass": "700 kg/m", "submerged_weight": weight, "inner_diameter": "19 in",
            "outer_diameter": "21 in", "contents": {"density": "1300 kg/m^3"},
        }
        for name, count, weight in (("slick", 5, "2.9 kN/m"), ("buoyed", 20, "-0.8 kN/m"))
    ],
    "bottom": {"hold": "wellhead", "elevation": "-500 m"},
    "top": {
        "z": "free", "tension": "3 MN",
        "body": {"name": "ring", "mass": "20000 kg", "density": "7850 kg/m^3"},
    },
    "analysis": {},
}  # fmt: skip


def rows_of(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def test_the_stack_up_adds_up_to_the_tension_that_is_lost_on_the_way_down():
    file = SceneFile("pulled.yaml", PULLED)
    table = stack_up(file.resolved())
    total = dict(zip(table.columns, table.rows[-1], strict=True))["with contents from the top"]
    dataset = simulate(file)
    assert [row[0] for row in table.rows] == ["ring", "buoyed", "slick"]
    lost = 3e6 - float(dataset["lower_end_tension"])
    assert 1e3 * total == pytest.approx(lost, rel=1e-9)


@pytest.mark.parametrize("steel, water", [(7850.0, 1025.0), (7850.0, 1000.0), (2800.0, 1030.0)])
def test_bare_joints_weigh_on_the_hook_what_their_steel_does_in_water(steel, water):
    """Whatever mud the scene has in them: joints are run open to the sea."""
    joints = {"count": 12, "length": "22.86 m"}
    pipe = {
        "outer_diameter": "21 in", "inner_diameter": "19.25 in", "young_modulus": "207 GPa",
        "wall_density": f"{steel} kg/m^3", "contents": {"density": "1700 kg/m^3"},
    }  # fmt: skip
    riser = [{"name": name, "joints": joints, **pipe} for name in ("lower", "upper")]
    file = SceneFile(
        "bare.yaml", PULLED | {"riser": riser, "water": {"density": f"{water} kg/m^3"}}
    ).with_values({"top.body": None}, "test")
    table = stack_up(file.resolved())
    upper, lower = (dict(zip(table.columns, row, strict=True)) for row in table.rows)
    for one in (upper, lower):
        share = one["wet weight a joint"] / one["dry weight a joint"]
        assert share == pytest.approx(1.0 - water / steel)
        assert one["wet weight"] == pytest.approx(12 * one["wet weight a joint"])
    assert lower["hook load"] == pytest.approx(lower["wet weight"])
    assert upper["hook load"] == pytest.approx(upper["wet weight"] + lower["wet weight"])
    assert upper["hook load"] == pytest.approx(lower["wet weight from the top"])


def test_uplift_is_the_water_that_a_body_displaces():
    table = stack_up(SceneFile("pulled.yaml", PULLED).resolved())
    ring = dict(zip(table.columns, table.rows[0], strict=True))
    assert ring["uplift"] == pytest.approx(20.0 / 7.850 * 1.025 * 9.81, rel=1e-9)  # kN
    assert ring["upper end"] == 0.0


def test_a_dataset_gives_the_tables_of_its_scene_without_a_run(tmp_path, commands):
    scene, run, out = tmp_path / "pulled.yaml", tmp_path / "run.nc", tmp_path / "out.csv"
    scene.write_text(json.dumps(PULLED))

    def table(source, kind):
        assert commands("table", source, "-o", out, "--kind", kind)[0] == 0
        return rows_of(out)

    assert commands("run", scene, "-o", run)[0] == 0
    for kind in ("stack-up", "extremes", "limits"):
        assert table(run, kind) == table(scene, kind)
    code, _, said = commands("table", run, "-o", out, "--kind", "time-series")
    assert code == 2
    assert "analysis.duration" in said
    assert commands("table", run, "-o", out, "--set", "top.tension=4 MN")[0] == 2


def test_a_run_is_no_workbook_and_says_what_is(tmp_path, commands):
    scene = tmp_path / "pulled.yaml"
    scene.write_text(json.dumps(PULLED))
    code, _, said = commands("run", scene, "-o", tmp_path / "a.xlsx")
    assert code
    assert ".csv" in said
    assert "`riserstudy table` writes workbooks" in said


def test_a_workbook_without_its_library_says_what_to_install(tmp_path, monkeypatch, commands):
    scene, book = tmp_path / "pulled.yaml", tmp_path / "a.xlsx"
    scene.write_text(json.dumps(PULLED))
    monkeypatch.setattr("riserstudy.dataset.workbook.find_spec", lambda name: None)
    code, _, said = commands("table", scene, "-o", book)
    assert code == 2
    assert "pip install 'riserstudy[workbook]'" in said
    assert not book.exists()


@pytest.mark.parametrize("units", ["si", "us"])
def test_a_workbook_has_the_tables_that_csv_files_have(tmp_path, commands, units):
    openpyxl = pytest.importorskip("openpyxl", reason="the extra riserstudy[workbook] is not here")
    scene, book = tmp_path / "pulled.yaml", tmp_path / "a.xlsx"
    scene.write_text(json.dumps(PULLED))

    assert commands("table", scene, "--units", units, "-o", book)[0] == 0
    sheets = openpyxl.load_workbook(book)
    assert sheets.sheetnames == ["stack-up", "extremes"]
    for name in sheets.sheetnames:
        out = tmp_path / "out.csv"
        assert commands("table", scene, "--units", units, "-o", out, "--kind", name)[0] == 0
        with out.open() as file:
            rows = list(csv.reader(file))
        cells = [["" if cell is None else cell for cell in row] for row in sheets[name].values]
        assert cells[0] == rows[0]
        for told, cell in zip(chain(*rows[1:]), chain(*cells[1:]), strict=True):
            assert cell == (told if isinstance(cell, str) else pytest.approx(float(told), rel=1e-9))


def test_a_body_of_some_mass_that_weighs_nothing_is_told_of():
    without = SceneFile("pulled.yaml", PULLED).with_values({"top.body.density": None}, "test")
    table = stack_up(without.resolved())
    ring = dict(zip(table.columns, table.rows[0], strict=True))
    assert ring["wet weight"] is ring["uplift"] is None
    (said,) = json.loads(simulate(without).attrs["warnings"])
    assert said.startswith("top.body: 'ring' has a mass of 20000 kg, but no weight")
    assert json.loads(simulate(SceneFile("pulled.yaml", PULLED)).attrs["warnings"]) == []


@pytest.mark.parametrize("seed", range(8))
def test_columns_print_no_value_as_nothing_and_numbers_below_one_another(seed):
    draw = random.Random(seed)
    cells = [None, math.nan, 1.5, -20.25, 3]
    rows = [[f"row {k}", *(draw.choice(cells) for _ in range(3))] for k in range(6)]
    rows.append(["last", 1.5, 1.5, 1.5])
    heading, *lines = in_columns(Table(["name", "a", "b", "c"], ["", "m", "m", ""], rows))
    assert not any(word in line for line in lines for word in ("None", "nan"))
    for line, row in zip(lines, rows, strict=True):
        known = [value for value in row[1:] if value is not None and value == value]
        assert [float(word) for word in line.split()[len(row[0].split()) :]] == known
    assert len(lines[-1]) == len(heading)
