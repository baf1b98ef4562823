"""A plain value of a paper's scene is one that the paper prints; anything else says where it comes from."""

from pathlib import Path

import pytest
from ruamel.yaml import YAML

from riserstudy.errors import InputError
from riserstudy.grading.models import PrintedInput
from riserstudy.grading.printed import printed_as, printed_inputs, unprinted
from riserstudy.scene.load import load_scene, read_scene
from riserstudy.scene.origin import plain_values
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

CONFIG = Path(__file__).parents[2] / "config"
PAPERS = ["chang2020", "fem_riser", "liu2017", "liu2020", "mao_hangoff"]


def scenes(paper):
    """Scenes that say they are of a paper."""
    read = [read_scene(path) for path in sorted((CONFIG / "scenes" / paper).glob("*.yaml"))]
    return [scene for scene in read if scene.tree.get("paper")]


@pytest.mark.parametrize("paper", PAPERS)
def test_every_plain_value_of_a_scene_is_printed(paper):
    inputs = printed_inputs(CONFIG, paper)
    assert {path for scene in scenes(paper) for path, _ in unprinted(inputs, scene)} == set()


@pytest.mark.parametrize("paper", PAPERS)
def test_every_printed_input_with_a_place_stands_there(paper):
    """A list of places that no scene and no study has would let nothing through, and prove nothing."""
    studies = read_studies(CONFIG, paper).studies.items()
    varied = [Study(paper, name, model, CONFIG, "standard").base for name, model in studies]
    read = [*scenes(paper), *varied]
    plain = {value for scene in read for value in plain_values(scene.tree, scene.origins)}
    for printed in printed_inputs(CONFIG, paper):
        for at in printed.paths:
            here = printed.replaced(at=at)
            assert any(printed_as([here], *value) for value in plain), (printed.what, at)


def test_scenes_of_a_paper_are_those_in_its_folder():
    for paper in PAPERS:
        assert {scene.tree["paper"] for scene in scenes(paper)} == {paper}


MASS = PrintedInput(what="mass", value="749000 kg", where="Table 2", at="top.body.mass")


def test_a_value_is_printed_at_its_place_and_as_it_stands():
    assert printed_as([MASS], "top.body.mass", "749000 kg") is MASS
    assert printed_as([MASS], "top.body.mass", "749001 kg") is None
    assert printed_as([MASS], "bottom.body.mass", "749000 kg") is None


def test_a_place_may_be_in_any_section():
    density = PrintedInput(what="E", value="206 GPa", where="Table 1", at="riser[*].young_modulus")
    assert printed_as([density], "riser[3].young_modulus", "206 GPa") is density
    assert printed_as([density], "riser[3].mass", "206 GPa") is None


def test_what_is_not_printed_is_found_and_what_says_its_origin_is_not():
    scene = CONFIG / "scenes/chang2020/heave.yaml"
    inputs = printed_inputs(CONFIG, "chang2020")
    assert unprinted(inputs, load_scene(scene, **{"top.body.mass": "750 t"})) == [("top.body.mass", "750 t")]
    chosen = {"chosen": "750 t", "because": "a round number"}
    assert unprinted(inputs, load_scene(scene, **{"top.body.mass": chosen})) == []


def test_a_choice_needs_a_reason():
    scene = CONFIG / "scenes/chang2020/heave.yaml"
    with pytest.raises(InputError, match="the choice has no reason"):
        load_scene(scene, **{"top.body.mass": {"chosen": "750 t"}})


def test_a_paper_without_a_list_prints_nothing_that_is_known(tmp_path):
    assert printed_inputs(tmp_path, "unknown") == []
    published = tmp_path / "published" / "some.yaml"
    published.parent.mkdir()
    with published.open("w") as file:
        YAML().dump({"paper": "some", "items": []}, file)
    with pytest.raises(InputError, match="items"):
        printed_inputs(tmp_path, "some")
