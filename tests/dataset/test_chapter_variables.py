"""Names, units and labels that a chapter gives its variables: in its datasets, and nowhere else."""

import random

import pytest
from ruamel.yaml import YAML

from riserstudy.dataset.chapter_variables import chapter_table
from riserstudy.dataset.variables import attributes, variables
from riserstudy.errors import InputError
from riserstudy.files import digests
from riserstudy.jobs.workplan import Workplan
from riserstudy.study.axes import Numbers, Samples
from riserstudy.study.collect import _named
from riserstudy.study.new import new_study

OF_THE_PACKAGE = {name: variables()[name] for name in ("x", "heave_amplitude", "tensioner_force", "z")}
UNITS = ["m", "kN", "N m", "1", "degree", "s-1"]


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(folder, paper, table):
    file = folder / "chapters" / paper / "variables.yaml"
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("w") as stream:
        YAML().dump(table, stream)
    return file


def drawn(seed, paper):
    draw = random.Random(f"{seed} {paper}")
    table = {}
    for k in range(draw.randint(1, 6)):
        about = {"long_name": f"what {paper} calls {k}", "units": draw.choice(UNITS)}
        if draw.random() < 0.4:
            about["label"] = f"label {k}"
        table[f"{paper}_{k}"] = about
    return table


@pytest.mark.parametrize("seed", range(8))
def test_variables_of_all_chapters_where_one_works_are_known_there_alone(
    place, seed, monkeypatch, tmp_path_factory
):
    tables = {paper: drawn(seed, paper) for paper in ("first", "second")}
    for paper, table in tables.items():
        write(place, paper, table)
    for paper, table in tables.items():
        assert chapter_table(paper) == table
        for name, about in table.items():
            plain = {key: value for key, value in about.items() if key != "label"}
            assert attributes(name) == plain
            largest = attributes(f"{name}_max")
            assert largest == {**plain, "long_name": f"largest {about['long_name']}"}
    monkeypatch.chdir(tmp_path_factory.mktemp("elsewhere"))
    assert not {name for table in tables.values() for name in table} & variables().keys()


@pytest.mark.parametrize("seed", range(4))
def test_a_name_with_two_meanings_is_refused_and_the_same_twice_is_not(place, seed):
    name = random.Random(seed).choice(sorted(OF_THE_PACKAGE))
    about = OF_THE_PACKAGE[name]
    write(place, "same", {name: about})
    write(place, "also", {name: about, "own": {"long_name": "own"}})
    assert attributes("own") == {"long_name": "own"}


@pytest.mark.parametrize("name", ["x", "tensioner_force", "own"])
def test_another_meaning_of_a_name_is_refused_by_file_and_name(place, name):
    write(place, "first", {"own": {"long_name": "mine", "units": "m"}})
    write(place, "second", {name: {"long_name": "another", "units": "m"}})
    with pytest.raises(InputError, match=rf"second/variables\.yaml: {name}: this variable is also"):
        variables()


@pytest.mark.parametrize(
    "table, said",
    [
        ({"own": {"units": "m"}}, r"own\.long_name: missing"),
        ({"own": {"long_name": "mine", "unit": "m"}}, r"own\.unit: unknown key"),
        ({"own": {"long_name": 3}}, r"own\.long_name: 3"),
        ({"own": "mine"}, "own: "),
        (["own"], "variables.yaml: "),
    ],
)
def test_what_is_no_table_of_names_is_refused(place, table, said):
    write(place, "first", table)
    with pytest.raises(InputError, match=said):
        variables()


def test_words_of_an_axis_mean_what_the_chapter_says_not_what_the_package_has(place):
    write(place, "first", {"way": {"long_name": "way to hang off"}})
    words = {"soft": {}, "hard": {}}
    assert _named("way", words, "first") == {"long_name": "way to hang off"}
    assert _named("way", words, "second") == {"long_name": "way"}
    assert _named("mode", words, "first") == {"long_name": "mode"}  # no natural modes
    assert (
        _named(
            "sample", Samples(count=dict.fromkeys(("preview", "standard", "reference"), 2), seed=1), "first"
        )["units"]
        == "1"
    )
    metres = Numbers(path="riser[0].length", unit="m", values=[1.0, 2.0])
    assert _named("heave_amplitude", metres, "first")["long_name"].startswith("heave amplitude")


def test_an_edit_of_the_file_remakes_what_carries_the_names_and_simulates_nothing(place):
    new_study(place / "study")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(place / "study")
        found = []
        for long_name in (None, "one", "another"):
            if long_name:
                write(place / "study", "example", {"own": {"long_name": long_name}})
            digests._digest.cache_clear()  # as in another process
            plan = Workplan.read(place / "study/config", {})
            keys = [point.key for point in plan.study("example", "heave").grid.points()]
            made = (
                plan.study_digest("example", "heave"),
                plan.derived_digest("example", "tension_swing"),
                *(plan.figure_digest(*figure) for figure in plan.figures()),
            )
            found.append((keys, made))
    (keys, first), (same, second), (still, third) = found
    assert keys == same == still
    pairs = [*zip(first, second, strict=True), *zip(second, third, strict=True)]
    schematics = sum(a == b for a, b in pairs)
    assert schematics <= 2  # which show no variable of datasets
    assert len(pairs) > 8
