"""Datasets of others: what they hold is read as a scene is, and nothing that they name is read or written."""

import json
import random
import sys
import tempfile
from pathlib import Path

import matplotlib.font_manager  # noqa: F401  makes its cache before home is another folder
import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.provenance import scene_file_of
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.simulate import simulate

TABLE = "elevation (m), speed (m/s)\n0, 0\n300, 0.4\n"
OWN = "../tables/current.csv"
SCENE = {
    "title": "one section in a current",
    "gravity": "9.81 m/s^2",
    "water": {"density": "1025 kg/m^3", "surface": "300 m", "seabed": "0 m"},
    "riser": [
        {
            "name": "riser", "length": "300 m", "outer_diameter": "0.5 m", "inner_diameter": "0.46 m",
            "young_modulus": "210 GPa", "mass": "400 kg/m", "submerged_weight": "2 kN/m",
            "drag": {"coefficient": 1.0, "diameter": "0.5 m"},
        }
    ],
    "current": {"profile": {"file": OWN}},
    "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "free"},
    "top": {"x": "platform", "z": "free", "tension": "1.5 MN", "rotation": "free"},
    "platform": {"surge": {"amplitude": "1 m", "period": "10 s"}},
    "analysis": {
        "duration": "2 s", "output": {"interval": "0.5 s"}, "mesh": {"elements": 6},
        "step": "0.1 s",
    },
}  # fmt: skip
WRITES = ("open", "os.mkdir", "os.rename", "os.link", "os.symlink", "os.truncate")
_seen: list[str] | None = None  # while something is looked at: what Python wrote


def _hook(event, arguments):
    if _seen is None or event not in WRITES:
        return
    path, mode, flags = (*arguments, None, None)[:3] if event == "open" else (*arguments[:1], "w", 0)
    if isinstance(path, int) or not (set(mode or "") & set("wax+") or (flags or 0) & 0o3):
        return
    if event == "os.mkdir" and Path(path).is_dir():  # which then does nothing
        return
    _seen.append(str(path))


@pytest.fixture(scope="module", autouse=True)
def hooked():
    """An audit hook cannot be taken off again, so that there is one for all tests."""
    sys.addaudithook(_hook)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A run whose scene read a table of another folder, which is gone."""
    folder = tmp_path_factory.mktemp("of_others")
    (folder / "scenes").mkdir()
    (folder / "tables").mkdir()
    (folder / "tables/current.csv").write_text(TABLE)
    dataset = simulate(SceneFile(str(folder / "scenes/scene.yaml"), SCENE))
    (folder / "tables/current.csv").unlink()
    return dataset


def renamed(dataset, name, more=()):
    """The dataset whose scene calls its table by another name, with tables that nothing refers to."""
    record = json.loads(dataset.attrs["provenance"])
    record["scene"]["current"]["profile"]["file"] = name
    record["tables"] = dict.fromkeys(more, "#!/bin/sh\n") | {name: TABLE}
    return dataset.assign_attrs(provenance=json.dumps(record))


def hostile_names(rng, root):
    """A name of each kind that a dataset could choose."""
    word = "".join(rng.choices("abcxyz", k=6))
    up = "../" * rng.randint(1, 9)
    return {
        "absolute": f"{root}/elsewhere/{word}.csv",
        "absolute, not there": f"{root}/{word}/new/.profile",
        "above": f"{up}{word}.pth",
        "above by a way round": f"{word}/{up}{word}.csv",
        "home": f"~/.{word}rc",
        "hidden": f".{word}",
        "nested": "/".join([word] * rng.randint(2, 30)) + ".csv",
        "a link": "link/x.csv",
        "with NUL": f"{word}\0.csv",
        "with a line break": f"{word}\n.csv",
        "Windows": rf"C:\Users\{word}\x.csv",
        "Windows, above": rf"..\..\{word}.csv",
        "a device": "/dev/stdout",
        "very long": word * rng.randint(100, 2000) + ".csv",
        "a folder": f"{word}/",
        "empty": "",
        "a point": ".",
        "no Unicode": "\ud800.csv",
    }


COMMANDS = {
    "rerun": (["rerun", "of_others.nc"], None),
    "rerun to a file": (["rerun", "of_others.nc", "-o", "out.nc"], "out.nc"),
    "stack-up": (["table", "of_others.nc", "--kind", "stack-up", "-o", "out.csv"], "out.csv"),
    "extremes": (["table", "of_others.nc", "-o", "out.csv"], "out.csv"),
    "statistics": (["statistics", "of_others.nc", "-o", "out.csv"], "out.csv"),
    "plot": (["plot", "of_others.nc", "-o", "out.png"], "out.png"),
    "diff": (["diff", "of_others.nc", "of_others.nc"], None),
}


@pytest.fixture
def sandbox(tmp_path, monkeypatch):
    """Folders to work in, for temporary files and as home, all within one that is looked at as a whole."""
    for name in ("work", "temporary", "home", "elsewhere"):
        (tmp_path / name).mkdir()
    (tmp_path / "work/link").symlink_to(tmp_path / "elsewhere")
    (tmp_path / "temporary/link").symlink_to(tmp_path / "elsewhere")
    monkeypatch.chdir(tmp_path / "work")
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setenv("TMPDIR", str(tmp_path / "temporary"))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    return tmp_path


def entries(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*")}


@pytest.mark.long
@pytest.mark.parametrize("name", COMMANDS)
def test_whatever_tables_are_called_only_the_output_is_written(commands, run, sandbox, monkeypatch, name):
    words, output = COMMANDS[name]
    rng = random.Random(name)
    for kind, hostile in hostile_names(rng, sandbox).items():
        more = hostile_names(rng, sandbox).values() if rng.random() < 0.3 else ()
        write_dataset(renamed(run, hostile, more), sandbox / "work/of_others.nc")
        before = entries(sandbox)
        monkeypatch.setattr(sys.modules[__name__], "_seen", written := [])
        code, _, error = commands(*words)
        monkeypatch.setattr(sys.modules[__name__], "_seen", None)
        # a scene whose table has such a name is refused by commands that read it
        assert code in ((0, 2) if kind in ("with NUL", "no Unicode") else (0,)), (kind, error)
        assert code == 0 or "contains the character U+" in error
        made = {f"work/{output}"} if output and code == 0 else set()
        assert entries(sandbox) - before == made, kind
        foreign = [path for path in written if _foreign(path, output, sandbox)]
        assert not foreign, kind
        for path in made:
            (sandbox / path).unlink()


def _foreign(path, output, sandbox):
    """Whether what was written is neither the output nor of a cache."""
    if output and Path(path).name.strip(".").startswith(Path(output).stem):
        return Path(path).resolve().parent != sandbox / "work"
    return not any(part in path for part in ("__pycache__", "/.cache/", "matplotlib", "/dev/null"))


def test_a_scene_of_a_dataset_reads_no_file_that_is_not_in_the_dataset(run, tmp_path):
    (tmp_path / "secret.csv").write_text(TABLE)
    for name in (str(tmp_path / "secret.csv"), "/etc/passwd", OWN):
        record = json.loads(run.attrs["provenance"])
        record["scene"]["current"]["profile"]["file"] = name
        record["tables"] = {}
        other = run.assign_attrs(provenance=json.dumps(record))
        with pytest.raises(InputError, match="use a table that is stored in the dataset"):
            scene_file_of(other, {}).resolved()


PIECES = [
    None, 1.5, "text", [], {}, [[]], {"scene": 1}, {"a": {"b": []}}, True, "{", float("nan"),
]  # fmt: skip


@pytest.mark.parametrize("seed", range(40))
def test_a_dataset_that_holds_anything_else_is_refused_in_one_line(run, seed):
    rng = random.Random(seed)
    record = json.loads(run.attrs["provenance"])
    for _ in range(rng.randint(1, 2)):
        record[rng.choice(["scene", "tables", "origins", "engine"])] = rng.choice(PIECES)
    said = json.dumps(record)
    said = said[: rng.randrange(len(said))] if rng.random() < 0.2 else said
    said = rng.choice([said, said, said, "[" * 100_000, 1.5, "null"])
    changed = run.assign_attrs(provenance=said)
    refusal = refusal_of(changed)
    if refusal:
        assert "\n" not in refusal
    else:  # what is left must be the scene as it was
        assert json.loads(said)["scene"] == json.loads(run.attrs["provenance"])["scene"]


def refusal_of(dataset):
    try:
        scene_file_of(dataset, {}).resolved()
    except InputError as error:
        return str(error)
    return None


def test_a_point_of_a_study_whose_axis_was_damaged_is_refused(run):
    study = run.expand_dims(tension=[1.0])
    for sets in ("{", "[]", "{}", '{"1.0": 3}', '{"1.0": {"top.tension": NaN}}', None):
        study["tension"].attrs = {} if sets is None else {"sets": sets}
        with pytest.raises(InputError):
            scene_file_of(study, {"tension": 0})
    study["tension"].attrs["sets"] = '{"1.0": {"top.tension": "2 MN"}}'
    assert scene_file_of(study, {"tension": 0}).resolved().top.tension == 2e6


def test_the_tables_of_a_rerun_stand_in_its_own_dataset(commands, run, sandbox):
    write_dataset(run, sandbox / "work/of_others.nc")
    assert commands("rerun", "of_others.nc", "-o", "again.nc")[0] == 0
    with xr.open_dataset(sandbox / "work/again.nc") as again:
        assert json.loads(again.attrs["provenance"])["tables"] == {OWN: TABLE}


@pytest.mark.parametrize("seed", range(12))
def test_a_point_has_one_scene_whichever_of_its_axes_are_selected_first(run, seed):
    """Axes that set parts of what another axis sets whole; later axes replace values of earlier ones."""
    draw = random.Random(seed)
    whole = {f"{a}": {"platform.surge": {"amplitude": f"{a} m", "period": "15 s"}} for a in (1, 2)}
    part = {f"{p}": {"platform.surge.period": f"{p} s"} for p in (8, 12)}
    pull = {f"{k}": {"top.tension": f"{k} MN"} for k in (2, 3)}
    axes = {"whole": whole, "part": part, "pull": pull}
    names = draw.sample([*axes], 3)
    study = xr.Dataset(
        {"point": (names, np.zeros((2, 2, 2)))},
        {name: (name, [*axes[name]], {"sets": json.dumps(axes[name])}) for name in names},
        run.attrs,
    )
    for index in np.ndindex(2, 2, 2):
        at = dict(zip(names, map(int, index), strict=True))
        tree = scene_file_of(study, at).tree
        if names.index("whole") < names.index("part"):
            assert tree["platform"]["surge"]["period"] == f"{[8, 12][at['part']]} s"
        for first in [draw.sample(names, draw.randint(1, 3)) for _ in range(3)]:
            selected = study
            for name in first:
                selected = selected.isel({name: at[name]})
            rest = {name: at[name] for name in draw.sample(names, 3) if name not in first}
            assert scene_file_of(selected, rest).tree == tree, first
