"""Which points count as off: by errors of what their study keeps, with the reason that the study gives."""

import random
import sqlite3
from types import SimpleNamespace

import pytest

from riserstudy.records.numerals import spaced
from riserstudy.report.audit import ERRORS, NO_REASON, audit, missed, relevant_errors, warned
from riserstudy.report.formats import counted
from riserstudy.scene.quantities import QUANTITIES

COLUMNS = ["error_displacement", "error_moment", "error_tension", "error_ufj_angle", "error_lfj_angle"]
OTHERS = [f"error_{name}" for name in ERRORS if f"error_{name}" not in COLUMNS]
TABLES = f"""
create table parameters (point, path, value);
create table studies (study, paper, name, caption, axes, table_name, accuracy);
create table columns (table_name, column_name, role, position);
create table wide (point);
create table points (point integer primary key, study, place, {", ".join(COLUMNS)},
    warnings, wall_seconds, unexplained_energy, warning_records, {", ".join(OTHERS)});
create table rests_on (paper, id, study);
create table simulated_behind (study, source);
create table numbers_and_claims (paper, id, kind, verdict, margin);
create table margins (paper, id, place, base, judged, met, same, margin, calibrated, rests_on);
insert into numbers_and_claims values
    ('paper', 'N1', 'claim', 'depends', null), ('paper', 'N2', 'claim', 'holds', null);
"""


@pytest.mark.parametrize(
    "keep, errors",
    [
        (None, [*ERRORS]),
        (["x", "ufj_angle"], ["displacement", "ufj_angle"]),
        (["lfj_angle_max"], ["lfj_angle"]),
        (["bending_moment_max"], ["moment"]),
        (["x", "effective_tension"], ["displacement", "tension"]),
        (["largest_stress"], ["moment", "tension"]),
        (["tensioner_force", "riser_reaction_x"], ["tension", "tensioner_force"]),
        (["platform_surge", "bending_moment"], ["displacement", "moment"]),
        (["stroke_max", "shear_force"], ["shear", "stroke"]),
        (["damage_rate", "lift_max"], ["lift", "damage"]),
    ],
)
def test_an_error_counts_where_what_it_tells_of_is_kept(keep, errors):
    assert relevant_errors(keep) == errors


def database(rows):
    """Studies with one point each: name, mesh prescribed, accuracy, errors, of which the last may lack."""
    db = sqlite3.connect(":memory:")
    db.executescript(TABLES)
    for point, (name, fixed, accuracy, *errors) in enumerate(rows):
        db.execute(
            "insert into studies values (?, 'paper', ?, '', '{}', 'wide', null)", (f"paper/{name}", name)
        )
        db.execute(
            f"insert into points values (?, ?, ''{', ?' * 5}, '', 1, 0, ''{', null' * len(OTHERS)})",
            (point, f"paper/{name}", *errors, *[None] * (len(COLUMNS) - len(errors))),
        )
        if fixed:
            db.execute("insert into parameters values (?, 'analysis.mesh.elements', 9)", (point,))
        if accuracy:
            db.execute("insert into parameters values (?, 'analysis.accuracy', ?)", (point, accuracy))
        db.execute("insert into simulated_behind values (?, ?)", (f"paper/{name}",) * 2)
        db.execute("insert into rests_on values ('paper', ?, ?)", (f"N{point + 1}", f"paper/{name}"))
    return db


def kept(tuned=(), **studies):
    """A study file: what each study keeps, why it may err, and whether a job tunes it."""
    models = {
        name: SimpleNamespace(keep=keep, error_because=why, settings=name in tuned, tuned=None)
        for name, (keep, why) in studies.items()
    }
    return {"paper": SimpleNamespace(studies=models)}


def test_an_error_of_what_nobody_stores_is_no_miss():
    db = database([("shape", True, None, 0.001, 5.0, 0.001)])
    assert missed(db, kept(shape=(["x"], None))).off == 0
    off = missed(db, kept(shape=(["x", "bending_moment"], None)))
    assert (off.off, off.verdicts) == (1, [("paper", "N1")])
    assert off.reasons == [(NO_REASON, 1, ["paper/shape"])]


@pytest.mark.parametrize("name", [name for name, of in QUANTITIES.items() if of.is_array])
def test_on_a_prescribed_mesh_only_errors_of_what_is_stored_count(name):
    """Each error in turn is 30 %, and the study stores one quantity."""
    for error in ERRORS:
        db = database([("stored", True, None, 0.001)])
        db.execute(f"update points set error_{error} = 0.3")
        of = missed(db, kept(stored=([f"{name}_max"], None)))
        assert of.off == (error in QUANTITIES[name].errors), error
        assert of.where == (f"paper/stored ({error})" if of.off else "")


@pytest.mark.parametrize("seed", range(20))
def test_an_error_of_a_stored_angle_counts_where_nothing_but_the_mesh_limits_it(seed):
    draw = random.Random(seed)
    rows, keeps = [], {}
    for k in range(draw.randint(1, 8)):
        fixed = draw.random() < 0.6
        keeps[f"s{k}"] = (
            draw.choice([None, ["x"], ["ufj_angle"], ["x", "ufj_angle_max"], ["lfj_angle"]]),
            None,
        )
        rows.append(
            (f"s{k}", fixed, None if fixed else 0.05, 0.001, 0.001, 0.001, draw.choice([None, 0.002, 0.3]))
        )
    of = missed(database(rows), kept(**keeps))
    silent = (["x"], ["lfj_angle"])
    told = [row for row in rows if row[1] and row[-1] == 0.3 and keeps[row[0]][0] not in silent]
    assert (of.off, of.worst) == (len(told), 0.3 if told else 0.0)
    assert of.where.endswith("(ufj_angle)") == bool(told)


def test_points_that_miss_are_counted_with_their_reason_and_what_rests_on_them():
    db = database(
        [
            ("blow", True, None, 0.001, 0.03, None),
            ("fine", True, None, 0.001, 0.002, None),
            ("silent", True, None, None, None, None),
            ("asked", False, 0.001, 0.0005, None, None),
        ]
    )
    files = kept(blow=(None, "a stop is met"), fine=(None, None), silent=(None, None), requested=(None, None))
    of = missed(db, files)
    assert (of.points, of.off, of.requested, of.missed_by_request, of.estimated) == (4, 1, 1, 0, 2)
    assert of.verdicts == [("paper", "N1")]
    assert of.reasons == [("a stop is met", 1, ["paper/blow"])]
    assert (
        "Mesh and time step are prescribed, instead of a tolerance, at 3 grid points. "
        "Of the points with a prescribed mesh, the error was estimated at 2, and exceeds 1 % at 1."
        in of.sentences
    )


def test_each_point_is_held_to_the_accuracy_that_it_asks_for():
    db = database([("coarse", False, 0.1, 0.08, None, None), ("fine", False, 0.001, 0.008, None, None)])
    of = missed(db, kept(coarse=(None, None), fine=(None, None)))
    assert (of.requested, of.missed_by_request, of.verdicts) == (2, 1, [("paper", "N2")])


def test_where_nothing_misses_that_is_all_that_is_said():
    db = database([("fine", True, None, 0.001, 0.002, None)])
    assert (
        missed(db, kept(fine=(None, None))).sentences
        == "At 1 grid point, the estimated errors are within the tolerance."
    )


@pytest.mark.parametrize("seed", range(8))
def test_no_point_without_an_estimate_is_said_to_be_within_its_tolerance(seed):
    draw = random.Random(seed)
    rows = [
        (f"s{k}", draw.random() < 0.5, 0.02, *([draw.choice([None, 0.001])] * 3))
        for k in range(draw.randint(1, 9))
    ]
    told = sum(row[-1] is not None for row in rows)
    of = missed(database(rows), kept(**{row[0]: (None, None) for row in rows}))
    assert of.sentences.startswith(
        f"At {told} grid point{'s' * (told != 1)}, the estimated errors are within"
    )
    silent = len(rows) - told
    assert (f"At {silent} further grid point" in of.sentences) == (silent > 0)


def test_points_of_tuned_studies_without_an_estimate_do_not_meet_a_tolerance():
    rows = [("blow", True, None, 0.03, 0.03, None), ("asked", False, 0.02, 0.001, None, None)]
    rows += [(f"tuned{k}", False, 0.02, None, None, None) for k in range(3)]
    tuned = [row[0] for row in rows[2:]]
    said = missed(database(rows), kept(tuned, **{row[0]: (None, None) for row in rows})).sentences
    assert said.startswith("At 1 grid point with a tolerance, the estimated errors are within the tolerance")
    assert (
        "At 3 further grid points with a tolerance, the error was not estimated, because their mesh" in said
    )


@pytest.mark.parametrize("seed", range(8))
def test_points_without_an_estimate_are_tuned_only_in_studies_that_a_job_tunes(seed):
    """All others are static massless springs, which one segment represents exactly."""
    draw = random.Random(seed)
    rows = [("blow", True, None, 0.03, 0.03, None), ("asked", False, 0.02, 0.001, None, None)]
    rows += [(f"s{k}", False, 0.02, None, None, None) for k in range(draw.randint(2, 9))]
    tuned = draw.sample([row[0] for row in rows[2:]], draw.randint(1, len(rows) - 3))
    of = missed(database(rows), kept(tuned, **{row[0]: (None, None) for row in rows}))
    assert (of.not_estimated, of.exact) == (len(tuned), len(rows) - 2 - len(tuned))
    assert (
        f"At {of.exact} further grid point{'s' * (of.exact > 1)}, the riser is a massless spring"
        in of.sentences
    )


@pytest.mark.parametrize(
    "count, text", [(1, "1"), (9999, "9999"), (10_000, "10 000"), (1_234_567, "1 234 567")]
)
def test_thousands_stand_apart_from_five_digits_on(count, text):
    assert spaced(count).replace("\u00a0", " ") == text
    assert counted(count, "point").replace("\u00a0", " ").startswith(f"{text} point")


@pytest.mark.parametrize("keep, misses", [(0.0099, 0), (0.0101, 1)])
def test_without_a_requested_accuracy_an_error_of_one_per_cent_is_the_most(keep, misses):
    of = missed(database([("runs", True, None, keep, None, None)]), kept(runs=(None, None)))
    assert (of.off, of.worst) == (misses, keep if misses else 0.0)


def test_points_of_both_kinds_that_miss_are_counted_apart_and_the_largest_error_is_named():
    rows = [
        ("asked", False, 0.001, 0.03, None, None),
        ("again", False, 0.01, 0.005, None, None),
        ("none", False, 0.01, None, None, None),
        ("blow", True, None, 0.001, 0.05, 0.2),
        ("stop", True, None, 0.02, None, None),
        ("fine", True, None, 0.001, None, None),
    ]
    of = missed(database(rows), kept(["none"], **{row[0]: (None, None) for row in rows}))
    assert of.sentences.replace("\N{NO-BREAK SPACE}", " ") == (
        "1 of 2 grid points with a tolerance have larger errors. At 1 further grid point with a tolerance, "
        "the error was not estimated, because its mesh and time step were tuned in advance. Mesh and time "
        "step are prescribed, instead of a tolerance, at 3 grid points. Of the points with a "
        "prescribed mesh, the error was estimated at 3, and exceeds 1 % at 2. "
        "The largest estimated error is 20 %, in the dataset paper/blow (tension)."
    )


@pytest.mark.parametrize("seed", range(6))
def test_a_dataset_is_told_by_the_worst_of_its_points_and_their_sum(seed):
    """Points in any order, of which some lack values."""
    draw = random.Random(seed)
    db = database([])
    db.execute("insert into studies values ('paper/runs', 'paper', 'runs', 'a caption', '{}', 'wide', null)")
    points = []
    for point in range(draw.randint(3, 12)):
        errors = [draw.choice([None, draw.uniform(0.0, 0.02)]) for _ in COLUMNS]
        spent, lost = draw.choice([None, draw.uniform(1.0, 9.0)]), draw.uniform(0.0, 1e-3)
        text, fixed = draw.choice(["", "a warning"]), draw.random() < 0.5
        points.append((errors, spent, lost, text, fixed))
        row = (point, "paper/runs", "", *errors, text, spent, lost)
        marks = ", ".join("?" * len(row))
        db.execute(f"insert into points values ({marks}, ''{', null' * len(OTHERS)})", row)
        if fixed:
            db.execute("insert into parameters values (?, 'analysis.mesh.elements', 9)", (point,))
    (row,) = audit(db, kept(runs=(None, None)))
    assert (row.points, row.about) == (len(points), "a caption")
    for k, name in enumerate(("displacement", "moment", "tension", "ufj_angle", "lfj_angle")):
        assert row.errors[name] == max([0.0, *(p[0][k] for p in points if p[0][k] is not None)])
    assert row.energy == max(p[2] for p in points)
    seconds = [p[1] for p in points if p[1] is not None]
    assert row.total == pytest.approx(sum(seconds))
    assert row.longest == max(seconds, default=0.0)
    assert row.warned == sum(p[3] != "" for p in points)
    assert row.mesh == ("fixed" if all(p[4] for p in points) else "refined")
    limited = [p[0] if p[4] else p[0][:3] for p in points]  # a tolerance does not limit the error of angles
    assert row.off == sum(any(error is not None and error > 0.01 for error in p) for p in limited)


def test_the_most_frequent_warning_is_told_first_with_its_datasets():
    db = database([("one", True, None, None, None, None), ("two", True, None, None, None, None)])
    db.execute("update points set warnings = 'rare\nfrequent' where point = 0")
    db.execute("update points set warnings = 'frequent' where point = 1")
    assert [(one.number, one.datasets) for one in warned(db)] == [
        (2, ["paper/one", "paper/two"]), (1, ["paper/one"])
    ]  # fmt: skip


@pytest.mark.parametrize("seed", range(12))
def test_points_of_tuned_studies_have_the_tolerance_that_these_were_tuned_to(seed):
    """By the record in the study file, or by the dataset of a study whose runs tune it."""
    draw = random.Random(seed)
    rows, files, off = [], kept(), 0
    ways = [draw.choice(["record", "job", "neither"]) for _ in range(draw.randint(1, 6))]
    percents = [draw.choice(["0.2 %", "1 %", "2 %", "5%", "12.5 %"]) for _ in ways]
    for k, (way, percent) in enumerate(zip(ways, percents, strict=True)):
        most = 0.01 if way == "neither" else float(percent.rstrip(" %")) / 100.0
        error = most * draw.choice([0.5, 0.99, 1.01, 3.0])
        off += error > most
        rows.append((f"s{k}", True, None, error, None, None))
        record = SimpleNamespace(accuracy=percent) if way == "record" else None
        files["paper"].studies[f"s{k}"] = SimpleNamespace(
            keep=None, error_because=None, settings="tuned" if way == "job" else None, tuned=record
        )
    db = database(rows)
    db.executemany(
        "update studies set accuracy = ? where name = ?", [(p, f"s{k}") for k, p in enumerate(percents)]
    )
    of = missed(db, files)
    assert of.off == off
    assert sum(row.off for row in audit(db, files)) == off
    other = any(w != "neither" and p != "1 %" for w, p in zip(ways, percents, strict=True))
    assert ("to which mesh and time step were tuned" in of.sentences) == (other and off > 0)
