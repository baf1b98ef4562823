"""What differs from the digests is told, and only what nothing needs is removed."""

import random

import pytest
import workspace
from ruamel.yaml import YAML

from riserstudy.database.verify import verify
from riserstudy.errors import InputError
from riserstudy.jobs.seals import seal
from riserstudy.study import store


@pytest.fixture
def command(mine, commands):
    """Run a command in a workspace of one's own; its exit code, output and messages."""
    return commands


def points():
    """Files of stored points by key."""
    return {held.key: held.path for held in store.everything()}


def test_all_is_well_in_what_was_just_made(command):
    code, out, err = command("verify")
    assert (code, err) == (0, "")
    assert out.startswith("0 faults in ")


@pytest.mark.parametrize(
    "name", ["plain/surge.nc", "odd/fig1.png", "plain/one.pdf", "reproduction.csv", "errata.csv"]
)
@pytest.mark.parametrize("how", ["flipped", "cut", "longer", "gone"])
def test_a_file_that_differs_is_named(mine, name, how):
    path = workspace.RESULTS / name
    content = bytearray(path.read_bytes())
    if how == "flipped":
        content[random.Random(name).randrange(len(content))] ^= 4
    path.write_bytes({"cut": content[:-1], "longer": content + b"\n"}.get(how, content))
    if how == "gone":
        path.unlink()
    found = verify(workspace.DATABASE)
    (line,) = found.wrong
    assert str(path) in line
    assert found.missing == 0


def test_every_kind_of_damage_to_a_point_is_named_and_a_missing_one_counted(command):
    (first, one), (_, two), (_, three), *_ = sorted(points().items())
    content = bytearray(one.read_bytes())
    content[-40] ^= 1
    one.write_bytes(content)
    two.write_bytes(two.read_bytes()[:-5])
    three.unlink()
    code, out, _ = command("verify")
    assert code == 1
    assert f"point {first}: damaged" in out
    assert "2 faults in" in out
    assert "not in this store: 1 point; " in out


def test_points_of_a_former_format_are_missing_not_damaged(command):
    path = next(iter(points().values()))
    path.rename(path.with_suffix(".point"))
    code, out, _ = command("verify")
    assert (code, "not in this store: 1 point; " in out) == (0, True)


def test_a_file_that_the_database_does_not_know_is_named(command):
    (workspace.RESULTS / "plain/stray.nc").write_bytes(b"")
    code, out, _ = command("verify")
    assert code == 1
    assert "stray.nc: not in the database" in out


def test_a_database_whose_rows_do_not_fit_is_named(mine):
    import sqlite3
    from contextlib import closing

    with closing(sqlite3.connect(workspace.DATABASE)) as db, db:
        db.execute("delete from studies where study = 'plain/one'")  # its points stay behind
    assert any("results.sqlite" in line for line in verify(workspace.DATABASE).wrong)


def said():
    """What is wrong, where the database can be read at all."""
    try:
        return verify(workspace.DATABASE).wrong
    except InputError as error:
        return [str(error)]


def test_a_database_with_another_value_is_named_by_its_seal(mine):
    """Its pages fit together as before: nothing else tells."""
    seal(workspace.DATABASE)
    assert verify(workspace.DATABASE).wrong == []
    content = workspace.DATABASE.read_bytes()
    for place in random.Random(8).sample(range(4096, len(content)), 5):
        spoilt = bytearray(content)
        spoilt[place] ^= 1
        workspace.DATABASE.write_bytes(spoilt)
        assert "results.sqlite" in "\n".join(said())


def test_nothing_is_removed_where_all_is_needed(command):
    before = points()
    code, out, _ = command("prune", "--yes", "--all")
    assert code == 0
    assert f"needed: {len(before)} points" in out
    assert "nothing to remove" in out
    assert points() == before


def leftovers():
    """A point of another engine, one of no study, one of a former format, a damaged one."""
    needed = points()
    key, path = next(iter(sorted(needed.items())))
    file, result = store.all_of(key)
    scene = store_file(file)
    folder = path.parent
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(store, "engine_digest", lambda: "another engine")
        store.put("00" + "a" * 30, result, scene)
    store.put("00" + "b" * 30, result, scene)
    (folder / "old.npz").write_bytes(b"old")
    (folder / ("c" * 32 + store.ENDING)).write_bytes(b"damaged")
    return needed


def store_file(about):
    """The scene that a stored point names."""
    from riserstudy.scene.load import SceneFile

    return SceneFile(about["source"], about["scene"])


def test_the_size_of_what_goes_is_told_before_anything_is_asked(command, monkeypatch):
    needed = leftovers()
    every = points()
    gone = sum(held.bytes for held in store.everything() if held.key not in needed)
    answers = []

    def refuse(question):
        answers.append(question)
        return False

    monkeypatch.setattr("typer.confirm", refuse)
    code, out, _ = command("prune")
    assert code == 1
    assert answers == ["remove 3 files?"]
    assert "damaged, or of another engine version or file format: 3 files" in out
    assert "of this engine version, but not used by any study in this folder: 1 file, " in out
    assert f"needed: {len(needed)} points" in out
    assert points() == every
    assert gone > 0


@pytest.mark.parametrize("seas", [False, True])
def test_runs_in_sea_states_are_said_to_be_among_points_of_no_study(command, seas):
    """Their keys are not known before the hours of the record are counted."""
    leftovers()
    path = workspace.Path("config/studies/plain.yaml")
    yaml = YAML()
    tree = yaml.load(path)
    if seas:
        about = {"scene": "scenes/surge.yaml", "caption": "hours", "record": "sea.csv"}
        tree["seas"] = {"years": about}
        yaml.dump(tree, path)
    out = command("prune", "--yes")[1]
    assert ("the unused points may be runs in sea states of plain/years; if removed" in out) == seas


def test_points_of_old_engines_go_and_all_that_studies_need_stays(command):
    needed = leftovers()
    before = sum(held.bytes for held in store.everything())
    code, out, _ = command("prune", "--yes")
    assert code == 0
    assert {*points()} == {*needed, "00" + "b" * 30}
    freed = before - sum(held.bytes for held in store.everything())
    assert f"3 files removed, {freed / 1e6:.1f} MB" in out
    assert command("prune", "--yes", "--all")[0] == 0
    assert {*points()} == {*needed}
    assert verify(workspace.DATABASE).missing == 0


def test_points_that_only_the_database_speaks_of_stay(command):
    yaml = YAML()
    path = workspace.Path("config/studies/plain.yaml")
    tree = yaml.load(path)
    del tree["studies"]["static"]
    yaml.dump(tree, path)
    before = points()
    assert command("prune", "--yes", "--all")[0] == 0
    assert points() == before
    workspace.built()
    assert command("prune", "--yes", "--all")[0] == 0
    assert len(points()) == len(before) - 1


def test_without_a_configuration_nothing_goes(command):
    before = points()
    workspace.Path("config/config.yaml").unlink()
    code, _, err = command("prune", "--yes", "--all")
    assert (code, "config.yaml" in err) == (2, True)
    assert points() == before
