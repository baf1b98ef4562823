"""A scene, its deck, and the scene that is read from it: line by line the same, or named as left out."""

import cmath
import math
import re
from pathlib import Path

import pytest
from drawn_decks import file_of, loaded, there_and_back

from riserstudy.errors import InputError
from riserstudy.model.sea import current_velocity
from riserstudy.scene.load import read_scene

ROOT = Path(__file__).parents[2]

#: labels, and what is given in other words: compared by what it amounts to
LABELS = ("title", "paper", "note", "name", "young_modulus", "axial_stiffness", "bending_stiffness")
#: absent is there what zero is
ZERO = ("top.offset", "current.heading", "platform.position.surge")
RISER = ("joints", "wall_density", "mass", "submerged_weight", "drag", "tangential_drag")
CURRENT = ("current.profile", "current.heading")
RESPONSE = tuple(f"platform.response.{name}" for name in ("operators", "headings", "symmetry"))


def leaves(tree, path=""):
    """Values of a scene by path, all in SI."""
    if isinstance(tree, dict):
        parts = [(f"{path}.{key}" if path else key, part) for key, part in tree.items()]
    elif isinstance(tree, list | tuple):
        parts = [(f"{path}[{k}]", part) for k, part in enumerate(tree)]
    else:
        return {path: tree}
    return {key: value for name, part in parts for key, value in leaves(part, name).items()}


def bare(path):
    return re.sub(r"\[\d+\]", "", path)


def alike(path, a, b):
    if b is None and a == 0.0:
        return path in ZERO
    if isinstance(a, float) and isinstance(b, int | float):
        if bare(path).endswith(("heading", "bearing", "direction", "phase")):
            return abs(math.remainder(a - b, 2.0 * math.pi)) < 1e-6
        return math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-6)
    return a == b


def within(path, place):
    return path == place or path.startswith(f"{place}.")


def silent(file, back, left):
    """Paths of a scene that are neither in what comes back nor named."""
    named = {bare(line.partition(": ")[0]) for line in left}
    ours, theirs = (leaves(f.resolved().model_dump(exclude_none=True)) for f in (file, back))
    derived = [f"riser.{name}" for name in RISER] + [*CURRENT, *RESPONSE]
    if "top.tensioners.mid_stroke" in named:
        derived += ["top.tensioners.table.reach", "top.tensioners.linear.tension"]
    if "platform.response.wave" in named:  # operators of a deck with a calm sea
        derived.append("platform.response")
    return [
        path
        for path, value in ours.items()
        if not alike(path, value, theirs.get(path))
        and bare(path).rpartition(".")[2] not in LABELS
        and not any(within(bare(path), place) for place in (*named, *derived))
    ]


@pytest.fixture(params=range(60))
def came_back(request, tmp_path):
    file = file_of(loaded(request.param))
    scene = file.resolved()
    try:
        back, left = there_and_back(file, tmp_path)
    except InputError as refused:
        if "enclose the direction of the waves" not in str(refused):
            raise
        pytest.skip("neither scene nor deck can be run in waves between the operators' headings")
    return file, scene, back, back.resolved(), left


def test_every_line_comes_back_or_is_named(came_back):
    file, _, back, _, left = came_back
    assert silent(file, back, left) == []


def test_what_comes_back_in_other_words_is_the_same(came_back):
    _, scene, _, back, left = came_back
    named = {bare(line.partition(": ")[0]) for line in left}
    for one, same in zip(scene.riser, back.riser, strict=True):
        assert one.elasticity == pytest.approx(same.elasticity, rel=1e-8)
        assert one.mass == pytest.approx(same.mass, rel=1e-8)
        assert one.submerged_weight == pytest.approx(same.submerged_weight, rel=1e-6, abs=1e-4)
        for name, power in (("drag", 1), ("tangential_drag", 1), ("added_mass", 2)):
            a, b = (getattr(section, name) for section in (one, same))
            assert (a is None) == (b is None)
            if a and not (name == "drag" and a.table):
                assert a.coefficient * a.diameter**power == pytest.approx(
                    b.coefficient * b.diameter**power, rel=1e-8
                )
            assert not (a and name == "drag" and a.table) or "riser.drag.coefficient" in named
    profiles = [current_velocity(part.current, part.water) for part in (scene, back)]
    (z, velocity), (again, same) = profiles
    assert again == pytest.approx(z)
    assert same == pytest.approx(velocity, abs=1e-6)


def operators(scene):
    """Complex motion a metre of wave, later ones by their lag, by heading and frequency."""
    response = scene.platform and scene.platform.response
    if not response:
        return {}
    sign = 1.0 if response.phases == "lead" else -1.0
    found = {}
    for heading, rows in response.by_heading.items():
        way = 0 if heading is None else round(math.degrees(heading)) % 360
        for row in rows:
            for name in response.moving:
                size, phase = getattr(row, name) or 0.0, getattr(row, f"{name}_phase") or 0.0
                found[way, round(row.circular, 6), name] = size * cmath.exp(1j * sign * phase)
    return found


SCENES = ("design/riser", "fem_riser/base", "liu2020/system")


@pytest.mark.parametrize("name", SCENES)
def test_scenes_of_papers_come_back(tmp_path, name):
    file = read_scene(ROOT / f"config/scenes/{name}.yaml")
    back, left = there_and_back(file, tmp_path)
    assert silent(file, back, left) == []
    lengths = [sum(s.total_length for s in f.resolved().riser) for f in (file, back)]
    assert lengths[0] == pytest.approx(lengths[1])


def test_upright_cylinders_below_a_joint_do_not_come_back_as_inclined_ones(tmp_path):
    file = read_scene(ROOT / "config/scenes/design/recoil.yaml")
    with pytest.raises(InputError, match=r"top\.tensioners\.arrangement: upright"):
        there_and_back(file, tmp_path)


def test_the_example_comes_back(tmp_path):
    file = read_scene(ROOT / "examples/drilling_riser/config/scenes/riser.yaml")
    back, left = there_and_back(file, tmp_path)
    assert silent(file, back, left) == []


def test_operators_come_back_at_every_heading(came_back):
    _, scene, _, back, _ = came_back
    ours, theirs = operators(scene), operators(back)
    assert ours.keys() == {key for key, value in theirs.items() if key in ours or value}
    for key, value in ours.items():
        assert theirs[key] == pytest.approx(value, abs=1e-6)


def test_a_line_that_is_lost_is_found(tmp_path):
    """The check itself: a deck with another drag, tension or current does not pass."""
    file = file_of(loaded(1))
    back, left = there_and_back(file, tmp_path)
    assert silent(file, back, left) == []
    for path, value in (
        ("bottom.elevation", "-1 m"),
        ("riser[1].length", "7 m"),
        ("analysis.duration", "3 s"),
    ):
        try:
            spoiled = back.with_values({path: value}, "test")
            spoiled.resolved()
        except InputError:
            continue
        assert [bare(one) for one in silent(file, spoiled, left)] == [bare(path)]
