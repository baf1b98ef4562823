"""The command of tensions: its window is the chapter's, and cylinders need what a constant tension needs."""

import csv

import pytest
from random_rigs import at_mid_stroke, rig, written

from chapters.design.derived.tension import window_of
from riserstudy import load_scene
from riserstudy.design import engine_tension as engine
from riserstudy.design.tension import Rig, Tolerances
from riserstudy.design.tension_table import TensionRequest, tension_table
from riserstudy.scene.load import SceneFile

RISER = "config/scenes/design/riser.yaml"
ASKED = ["--units", 6, "--tension-ratio", 0.95, "--weight", 1.05, "--buoyancy", 0.96]
WINDOW = ["--dynamic-limit", "6.7 MN", "--share", 0.9, "--overpull", "200 kN"]


def mud(density):
    return {f"riser[{k}].contents.density": f"{density} kg/m^3" for k in range(4)}


def settings():
    return {
        "weight": 1.05,
        "buoyancy": 0.96,
        "units": 6,
        "tension_ratio": 0.95,
        "fleet_angle": "0 deg",
        "overpull": "200 kN",
        "dynamic_limit": "6.7 MN",
        "share": 0.9,
    }


@pytest.mark.parametrize("density", [1030, 1440, 1900])
@pytest.mark.parametrize("failed", [0, 2])
def test_the_window_of_the_command_is_that_of_the_chapter(commands, tmp_path, density, failed):
    changed = [word for path, value in mud(density).items() for word in ("--set", f"{path}={value}")]
    table = tmp_path / "tension.csv"
    code, out, _ = commands("tension", RISER, "--failed", failed, *ASKED, *WINDOW, *changed, "--csv", table)
    assert code == 0
    rows = {row["quantity"]: row for row in csv.DictReader(table.open())}
    of = window_of(load_scene(RISER, **mud(density)).resolved(), settings(), failed)
    assert float(rows["window"]["tension (N)"]) == pytest.approx(of.gap, rel=1e-8)
    assert float(rows["ceiling"]["tension (N)"]) == pytest.approx(of.ceilings[of.ceiling])
    assert ("no setting" in rows["window"]["note"]) == (of.gap < 0.0)
    assert of.floor in rows["window"]["note"]
    assert f"window: {of.gap / 1e3:.2f} kN" in out


@pytest.mark.parametrize("words", [["--share", 0.9], ["--dynamic-limit", "6 MN"], ["--overpull", "5 m"]])
def test_half_of_a_window_is_refused(commands, words):
    code, out, said = commands("tension", RISER, "--failed", 0, *ASKED, *words)
    assert (code, out) == (2, "")
    assert words[0] in said


@pytest.mark.parametrize(
    "words",
    [
        *(["--fleet-angle", angle] for angle in ("-5 deg", "90 deg", "100 deg", "180 deg")),
        ["--dynamic-limit", "-6 MN", "--share", 0.9],
        ["--dynamic-limit", "0 kN", "--share", 0.9],
        ["--overpull", "-200 kN"],
    ],
)
def test_a_tension_or_an_angle_below_zero_is_refused(commands, words):
    """Before, a fleet angle of 100 deg gave a tension setting of -57 MN."""
    code, out, said = commands("tension", RISER, "--failed", 0, *ASKED, *words)
    assert (code, out) == (2, "")
    assert words[0] in said


def test_a_riser_without_an_lmrp_has_no_lift_off(commands):
    words = [*ASKED, *WINDOW, "--set", "bottom.body=null"]
    code, out, _ = commands("tension", RISER, "--failed", 0, *words)
    assert code == 4
    assert "LMRP lift-off: not evaluated: bottom.body" in out


def hung(seed, conductor=False):
    """A rig on cylinders, and the riser of the same tree on a constant tension of another size."""
    tree = rig(seed, spatial=False, conductor=conductor)
    del tree["current"]
    for section in tree["riser"]:
        section["buoyancy_lift"] = 0.0
    held = SceneFile("rig.yaml", written(tree, unit_of={"buoyancy_lift": "N/m"}))
    joint, of = tree["top"]["telescopic_joint"], tree["top"].pop("tensioners")
    joint["tension"] = 0.9 * of["count"] * at_mid_stroke(of)
    return held, SceneFile("rig.yaml", written(tree, unit_of={"buoyancy_lift": "N/m"}))


@pytest.mark.parametrize("seed", range(8))
def test_cylinders_need_the_tension_at_which_the_riser_on_a_constant_one_is_slack_at_one_point(seed):
    held, constant = hung(seed, conductor=seed % 2 == 1)
    tolerances = Tolerances(1.0, 1.0)
    needed = engine.needed(held.resolved(), tolerances).tension
    at_it = constant.with_values({"top.telescopic_joint.tension": f"{needed!r} N"}, "test")
    _, left = engine.along(at_it.resolved())
    assert abs(left.min()) < 1e-6 * needed
    more = constant.with_values({"top.telescopic_joint.tension": f"{1.01 * needed!r} N"}, "test")
    assert engine.along(more.resolved())[1].min() > 0.005 * needed


@pytest.mark.parametrize("seed", range(4))
def test_a_plumb_riser_on_cylinders_needs_by_the_engine_what_the_formula_gives(seed):
    held, _ = hung(seed)
    rows = tension_table(held.resolved(), TensionRequest(Tolerances(1.05, 0.96), Rig(6, 1, 0.95, 0.0)))
    told = {row.quantity: row for row in rows.totals}
    assert told["engine"].tension == pytest.approx(told["formula"].tension, rel=1e-6)
    assert "in place of the tensioners" in told["engine"].note
    ratio = told["setting"].tension / told["formula"].tension
    assert ratio == pytest.approx(6 / (5 * 0.95))


@pytest.mark.parametrize("seed", range(6))
def test_the_weight_of_a_tension_ring_is_needed_at_every_point(seed):
    """By formula and engine, with the tolerance on steel, and so it is in the setting."""
    weight, steel = 4e4 * (seed + 1), 1.0 + 0.02 * seed
    request = TensionRequest(Tolerances(steel, 0.96), Rig(6, 1, 0.95, 0.0), ceiling=(9e6, 0.9))
    held = hung(seed)[seed % 2]
    ring = {"name": "ring", "mass": f"{weight / 9.0} kg", "submerged_weight": f"{weight} N"}
    bare, loaded = (
        {row.quantity: row.tension for row in (*of.ends, *of.totals)}
        for file in (held, held.with_values({"top.body": ring}, "test"))
        for of in [tension_table(file.resolved(), request)]
    )
    more = steel * weight
    for name in bare:
        expected = {"ceiling": 0.0, "setting": more * 6 / (5 * 0.95)}.get(name, more)
        expected = -more * 6 / (5 * 0.95) if name == "window" else expected
        assert loaded[name] - bare[name] == pytest.approx(expected, rel=1e-5, abs=1.0), name
    assert loaded["engine"] == pytest.approx(loaded["formula"], rel=1e-6)


def test_tension_tells_formula_engine_and_setting(commands):
    code, out, _ = commands("tension", RISER, "--failed", 1, *ASKED)
    assert code == 0
    told = {line.split(":")[0]: line for line in out.splitlines() if ":" in line}
    formula, engine = (float(told[name].split()[1]) for name in ("formula", "engine"))
    assert formula == pytest.approx(engine, rel=1e-4)
    assert float(told["setting"].split()[1]) == pytest.approx(formula * 6 / (0.95 * 5), abs=0.02)


def test_tension_names_what_a_scene_does_not_tell(commands):
    code, out, _ = commands("tension", RISER, "--failed", 1, *ASKED, "--set", "riser[1].buoyancy_lift=null")
    assert code == 4
    assert out.startswith("not evaluated: buoyancy_lift of section 'buoyed joints'")


def test_tension_without_a_working_unit_is_refused(commands):
    code, _, said = commands("tension", RISER, "--failed", 6, *ASKED)
    assert code == 2
    assert "--failed" in said
