"""Files of printed numbers and claims: what is refused, and that checks and bases exist."""

import inspect
import random
import shutil

import pytest
from invented import CONFIG, dataset, number_row, published

from chapters.chang2020 import claims as checks
from riserstudy.errors import InputError
from riserstudy.grading.models import PublishedFile
from riserstudy.grading.published import read_published
from riserstudy.jobs.configuration import Configuration
from riserstudy.study.read import read_studies

PAPERS = sorted(path.stem for path in (CONFIG / "studies").glob("*.yaml"))


def test_an_input_is_not_called_nothing():
    item = {"id": "C1", "figure": "1", "kind": "claim", "statement": "s", "impossible": "no scale"}
    with pytest.raises(ValueError, match="called"):
        PublishedFile(paper="p", items=[item], called={"model": ""})


@pytest.mark.parametrize(
    "about, fault",
    [
        ({"published": None, "rounding": None}, "a number has a published value, but a claim has none"),
        ({"rounding": None}, "rounding"),
        ({"check": None, "reads": {}}, "one of check, impossible and not_comparable"),
        ({"reads": {}}, "check and reads"),
        ({"over": {"other": "space"}}, "other arguments than reads"),
        ({"further_cases": {"Settled": {"other": "space"}}}, "other arguments than reads"),
        ({"rounding": 0.0}, "greater than 0"),
        ({"colour": "red"}, "Extra inputs"),
    ],
)
def test_data_that_cannot_be_meant_are_refused(about, fault):
    with pytest.raises(ValueError, match=fault):
        number_row({"base": dataset(2.0)}, **about)


def test_a_published_file_names_its_fault(tmp_path):
    (tmp_path / "published").mkdir()
    path = tmp_path / "published/paper.yaml"
    one = "{id: X1, figure: '1', kind: claim, statement: s, check: c, reads: {runs: base}}"
    path.write_text(f"paper: paper\nitems: [{one}, {one}]\n")
    with pytest.raises(InputError, match="'X1' occurs twice"):
        read_published(tmp_path, "paper", {"base"})
    path.write_text(f"paper: paper\nitems: [{one}]\n")
    with pytest.raises(InputError, match="no dataset 'base'; use one of other"):
        read_published(tmp_path, "paper", {"other"})


def test_every_check_exists_and_takes_what_it_is_given():
    file = published()
    known = {item.id for item in file.items}
    assert {f"A{k}" for k in range(1, 17)} - {"A10"} <= known  # A10 is part of A8
    for entry in (*file.items, *file.errata):
        if entry.check:
            function = getattr(checks, entry.check)
            inspect.signature(function).bind(**entry.reads, **entry.options)


@pytest.mark.parametrize("paper", ["chang2020", "fem_riser", "liu2017", "liu2020", "mao_hangoff"])
def test_the_base_of_a_claim_is_in_every_tier(paper):
    studies = read_studies(CONFIG, paper).studies.values()
    thinned = [
        (name, axis.preview)
        for study in studies
        for name, axis in study.axes.items()
        if getattr(axis, "preview", None)
    ]
    for item in published(paper).items:
        for name, value in (item.base or {}).items():
            for axis, values in thinned:
                assert axis != name or value in values, f"{item.id}: {name} {value} is not in preview"


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("kind", ["published", "studies", "false_claims"])
def test_a_file_that_names_another_paper_is_refused(tmp_path, seed, kind):
    """Its verdicts would be stored under that name, and the report of the chapter would have none."""
    draw = random.Random(seed)
    paper = draw.choice([name for name in PAPERS if (CONFIG / f"false_claims/{name}.yaml").exists()])
    letters = list(paper)
    letters[draw.randrange(len(letters))] = draw.choice("qxz")
    config = tmp_path / "config"
    shutil.copytree(CONFIG, config, ignore=shutil.ignore_patterns("references"))
    path = config / kind / f"{paper}.yaml"
    text = path.read_text("utf-8")
    path.write_text(text.replace(f"paper: {paper}\n", f"paper: {''.join(letters)}\n", 1), "utf-8")
    with pytest.raises(InputError) as error:
        Configuration.read(config, {"papers": [paper]}, only=None)
    assert (error.value.where, error.value.field) == (str(path), "paper")
    assert error.value.allowed.startswith(f"write 'paper: {paper}'")
