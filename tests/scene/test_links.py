"""Scenes and datasets by symbolic links are the files that these point to; tables of a scene are no links."""

import os
import random

import pytest
import xarray as xr
from ruamel.yaml import YAML

from riserstudy import load_scene, simulate
from riserstudy.dataset.open import open_dataset
from riserstudy.errors import InputError

SCENE = {
    "title": "a riser in a current",
    "water": {"density": "1025 kg/m^3", "surface": "0 m", "seabed": "-110 m"},
    "riser": [
        {
            "name": "pipe",
            "length": "100 m",
            "outer_diameter": "0.5 m",
            "inner_diameter": "0.46 m",
            "young_modulus": "207 GPa",
            "mass": "600 kg/m",
            "submerged_weight": "3 kN/m",
            "drag": {"coefficient": 1.0, "diameter": "0.5 m"},
        }
    ],
    "bottom": {"hold": "wellhead", "elevation": "-105 m", "rotation": "free"},
    "top": {"x": "held", "z": "free", "tension": "900 kN", "rotation": "free"},
    "current": {"profile": {"file": "current.csv"}},
    "analysis": {"mesh": {"elements": 10}},
}


def table(speed):
    return f"depth (m),speed (m/s)\n0,{speed}\n110,{speed}\n"


def linked(target, folder, draw):
    """A chain of links to a file, through folders and by relative and absolute paths."""
    at = target
    for k in range(draw.randint(1, 4)):
        link = folder / f"{k}" / draw.choice(["scene.yaml", "other name.yaml"])
        link.parent.mkdir(parents=True)
        link.symlink_to(at if draw.random() < 0.5 else os.path.relpath(at, link.parent))
        at = link
    return at


@pytest.mark.parametrize("seed", range(9))
def test_a_linked_scene_is_the_file_with_its_own_tables(tmp_path, monkeypatch, seed):
    draw = random.Random(seed)
    home = tmp_path / "home"
    home.mkdir()
    with (home / "riser.yaml").open("w") as file:
        YAML().dump(SCENE, file)
    speed = round(draw.uniform(0.3, 1.0), 3)
    (home / "current.csv").write_text(table(speed))
    link = linked(home / "riser.yaml", tmp_path / "links", draw)
    if draw.random() < 0.6:  # a table of the same name beside the link is not that of the scene
        (link.parent / "current.csv").write_text(table(9.9))
    if draw.random() < 0.5:
        monkeypatch.chdir(link.parent)
        link = link.relative_to(link.parent)
    one, other = load_scene(home / "riser.yaml"), load_scene(link)
    assert other.resolved() == one.resolved()
    assert other.resolved().current.profile[0].speed == speed
    assert [path.resolve() for path in other.files] == [home / "riser.yaml", home / "current.csv"]


@pytest.mark.parametrize("seed", range(3))
def test_a_linked_dataset_is_the_file(tmp_path, seed):
    (tmp_path / "home").mkdir()
    tree = SCENE | {"current": {"profile": {"shape": "uniform", "surface_speed": f"0.{seed + 3} m/s"}}}
    with (tmp_path / "home/riser.yaml").open("w") as file:
        YAML().dump(tree, file)
    run = simulate(load_scene(tmp_path / "home/riser.yaml"), progress=False)
    run.to_netcdf(tmp_path / "home/run.nc")
    link = linked(tmp_path / "home/run.nc", tmp_path / "links", random.Random(seed))
    xr.testing.assert_identical(open_dataset(link), open_dataset(tmp_path / "home/run.nc"))


@pytest.mark.parametrize("seed", range(3))
def test_a_linked_table_of_a_scene_is_refused_by_name(tmp_path, seed):
    """Its text would go into results."""
    with (tmp_path / "riser.yaml").open("w") as file:
        YAML().dump(SCENE, file)
    (tmp_path / "secret.csv").write_text(table(0.5))
    link = linked(tmp_path / "secret.csv", tmp_path / "links", random.Random(seed))
    (tmp_path / "current.csv").symlink_to(link)
    with pytest.raises(InputError, match=r"current\.csv: this is a symbolic link"):
        load_scene(tmp_path / "riser.yaml")


@pytest.mark.parametrize("target", ["nowhere.yaml", "scene.yaml"])
def test_a_link_to_nothing_is_one_clear_error(tmp_path, target):
    (tmp_path / "scene.yaml").symlink_to(target)
    with pytest.raises(InputError, match=r"scene\.yaml: "):
        load_scene(tmp_path / "scene.yaml")
