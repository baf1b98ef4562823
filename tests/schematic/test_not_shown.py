"""What a schematic does not show is named in it, and what it says it shows is there."""

import hashlib
import random
import re
from functools import cache
from pathlib import Path

import pytest
from drawn_words import words
from matplotlib.backends.backend_agg import FigureCanvasAgg

from riserstudy.errors import InputError
from riserstudy.scene.load import load_scene
from riserstudy.scene.models import Scene
from riserstudy.scene.resolve import resolve
from riserstudy.scene.riser import Section
from riserstudy.schematic import not_shown as module
from riserstudy.schematic import schematic
from riserstudy.schematic.not_shown import DRAWN_PARTS, NO_PART, parts_left_out
from riserstudy.schematic.words import WORDS, in_words

CONFIG = Path(__file__).parents[2] / "config"
SCENES = sorted((CONFIG / "scenes").glob("*/*.yaml"))
GUIDED = {
    "title": "guided",
    "water": {"density": "1025 kg/m^3", "surface": "980 m"},
    "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "free"},
    "top": {"x": "held", "z": "free", "tension": "3 MN", "rotation": "free"},
    "analysis": {},
}
#: what may be at the lower end of a section, and how a drawing names it
BELOW = {
    "guide_below": ({"stiffness": "7 kN/m"}, "guide, 7 kN/m"),
    "flex_joint_below": ({"stiffness": "8 kN*m/deg"}, "flex joint, 8 kN m/°"),
}

#: drawn in scenes that move sideways, or turn, none of which can do without
ONLY_WHERE_SOMETHING_MOVES = {"top.x", "platform.centre_of_rotation"}


def section(name, length, **more):
    about = {"axial_stiffness": "5e9 N", "bending_stiffness": "1e8 N*m^2", "mass": "500 kg/m"}
    load = {"submerged_weight": "1 kN/m", "lateral_load": "10 N/m"}
    return {"name": name, "length": f"{length} m"} | about | load | more


def lower_and_upper(below, **parts):
    """A scene of two sections, the lower one so long (m), with parts of each."""
    lower = section("lower", below, **parts.get("lower", {}))
    upper = section("upper", 980.0 - below, **parts.get("upper", {}))
    return resolve(Scene.model_validate(GUIDED | {"riser": [lower, upper]}))


@pytest.mark.parametrize("seed", range(8))
def test_a_guide_or_joint_is_named_once_wherever_it_is_along_the_riser(seed):
    below = random.Random(seed).uniform(20.0, 960.0)
    for part, (value, text) in BELOW.items():
        said = words(schematic(lower_and_upper(below, upper={part: value})))
        assert said.count(text) == 1, (below, said)
        assert "Not shown" not in said


@pytest.mark.long
@pytest.mark.parametrize("part", [name for name in Section.model_fields if name.endswith("_below")])
def test_what_is_below_a_section_is_drawn_and_refused_where_the_end_is_held(part):
    assert part in BELOW, f"riser.{part}: enter here an example and the words of its drawing"
    there = {part: BELOW[part][0]}
    assert picture_of(lower_and_upper(500.0, upper=there)) != picture_of(lower_and_upper(500.0))
    with pytest.raises(ValueError, match=part):
        lower_and_upper(500.0, lower=there)


def test_a_new_part_of_sections_is_drawn_or_nothing_that_could_be():
    """Two are named below drawings instead."""
    undrawn = {f"riser.{name}" for name in Section.model_fields} - DRAWN_PARTS - NO_PART
    assert undrawn == {"riser.modules", "riser.lines"}


@pytest.mark.parametrize("path", ["riser.guide_below", "water.surface", "top.tension"])
def test_a_part_that_the_schematic_knows_nothing_of_is_named(path, monkeypatch):
    upper = section("upper", 480.0, guide_below={"stiffness": "7 kN/m"})
    scene = resolve(Scene.model_validate(GUIDED | {"riser": [section("lower", 500.0), upper]}))
    monkeypatch.setattr(module, "DRAWN_PARTS", DRAWN_PARTS - {path})
    assert parts_left_out(scene) == [path]
    assert f"Not shown: {in_words(path)}." in words(schematic(scene))


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_every_schematic_says_what_it_leaves_out(path):
    scene = load_scene(path).resolved()
    left = parts_left_out(scene)
    named = ", ".join(map(in_words, left))
    assert (f"Not shown: {named}." in words(schematic(scene))) == bool(left)


def every_part():
    """All parts of scenes, to two levels."""
    schema = Scene.model_json_schema()
    every = set()
    for name, about in schema["properties"].items():
        every |= {name, *(f"{name}.{inner}" for inner in inner_names(about, schema))}
    return every


def test_what_is_said_to_be_shown_or_nothing_to_show_is_a_part_of_scenes():
    assert every_part() >= DRAWN_PARTS | NO_PART
    assert not DRAWN_PARTS & NO_PART


def test_every_part_that_is_not_drawn_has_words():
    sections = {path.partition(".")[0] for path in DRAWN_PARTS}
    whole = {name for name in Scene.model_fields if name not in sections}
    inner = {path for path in every_part() if path.partition(".")[0] in sections and "." in path}
    assert (whole | inner) - DRAWN_PARTS - NO_PART <= set(WORDS)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_no_schematic_names_a_part_as_the_file_does(path):
    """An identifier: words joined by dots or underscores; decimal points and abbreviations apart."""
    scene = load_scene(path).resolved()
    figure = schematic(scene)
    assert not re.search(r"[a-z]_[a-z]|[a-z]{2}\.[a-z]{2}", words(figure).replace(scene.title, ""))
    assert not re.search(r"\bset [A-Z]{2,}", words(figure))


def inner_names(about, schema):
    """Names of the fields of all models that a part of the schema may be."""
    if "$ref" in about:
        return inner_names(schema["$defs"][about["$ref"].rpartition("/")[2]], schema)
    found = set(about.get("properties", {}))
    for inner in [*about.get("anyOf", []), *([about["items"]] if "items" in about else [])]:
        found |= inner_names(inner, schema)
    return found


@cache
def scene_file(path):
    """A scene as written, read once."""
    return load_scene(path)


@cache
def picture(path, taken):
    """A digest of the pixels of a scene's schematic, with something taken out; None where it cannot be."""
    try:
        return picture_of(scene_file(path).with_values(dict.fromkeys(taken), "test").resolved())
    except InputError:
        return None


def picture_of(scene):
    """A digest of the pixels of a scene's schematic."""
    figure = schematic(scene)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return hashlib.sha256(bytes(canvas.buffer_rgba())).hexdigest()


@pytest.mark.long
def test_what_is_said_to_be_shown_changes_the_drawing():
    """Each part that scenes of the project can do without: without it some drawing is another one."""
    tried, changed = set(), set()
    for path in sorted(SCENES, key=lambda one: -len(load_scene(one).tree)):  # few drawings show most parts
        tree = load_scene(path).tree
        for shown in sorted(DRAWN_PARTS - changed - ONLY_WHERE_SOMETHING_MOVES):
            name, _, inner = shown.partition(".")
            parts = [f"riser[{k}]" for k in range(len(tree["riser"]))] if name == "riser" else [name]
            where = tuple(f"{part}.{inner}" if inner else part for part in parts)
            if not any(stands(tree, place) for place in where):
                continue
            without = picture(path, where)
            if without is None:
                continue
            tried.add(shown)
            changed |= {shown} if without != picture(path, ()) else set()
    assert len(changed) > 25, changed
    assert tried <= changed


def stands(tree, path):
    """Whether something stands at a path."""
    name, _, inner = path.partition(".")
    first, _, index = name.partition("[")
    here = tree.get(first)
    here = here[int(index[:-1])] if index else here
    return isinstance(here, dict) and inner in here if inner else here is not None
