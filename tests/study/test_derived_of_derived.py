"""Derived datasets read studies and derived datasets that are made before, in any order in the file."""

import random
import re
import sqlite3
from importlib.resources import files
from itertools import pairwise

import pytest
from pydantic import ValidationError

from riserstudy.study.models import StudyFile

STUDIES = {name: {"scene": "s.yaml", "caption": "c", "axes": {}} for name in ("one", "two")}
COUNT = 8


def drawn(seed):
    """Derived datasets that read studies and some of those before them, in any order."""
    draw = random.Random(seed)
    reads = {}
    for k in range(COUNT):
        before = [*STUDIES, *reads]
        reads[f"d{k}"] = draw.sample(before, draw.randint(1, min(3, len(before))))
    names = [*reads]
    draw.shuffle(names)
    return {name: reads[name] for name in names}, draw


def file(derived):
    return StudyFile.model_validate({"paper": "own", "studies": STUDIES, "derived": derived})


def reached(derived, name):
    """All that a dataset rests on."""
    found = {name}
    for source in derived.get(name, []):
        found |= reached(derived, source)
    return found


@pytest.mark.parametrize("seed", range(10))
def test_what_rests_on_nothing_of_itself_is_accepted(seed):
    derived, _ = drawn(seed)
    read = file(derived)
    assert {name: of.reads for name, of in read.derived.items()} == derived


@pytest.mark.parametrize("seed", range(10))
def test_a_ring_is_refused_by_name(seed):
    derived, draw = drawn(seed)
    first = draw.choice([name for name in derived if len(reached(derived, name) & {*derived}) > 1])
    last = draw.choice(sorted(reached(derived, first) & {*derived}))
    derived[last] = [*derived[last], first]
    with pytest.raises(ValidationError, match="datasets depend on each other in a circle") as error:
        file(derived)
    ring = re.search(r"in a circle: (.*);", str(error.value))[1].split(" reads ")
    assert ring[0] == ring[-1]
    assert all(source in derived[name] for name, source in pairwise(ring))


def test_a_dataset_that_is_not_there_is_refused():
    with pytest.raises(
        ValidationError, match=r"derived\.a: the file has no study or derived dataset 'three'"
    ):
        file({"a": ["one", "three"]})


@pytest.mark.parametrize("seed", range(10))
def test_the_database_knows_the_simulated_studies_behind_all_of_them(seed, views):
    derived, _ = drawn(seed)
    db = sqlite3.connect(":memory:")
    db.executescript("create table studies (study, kind); create table reads (study, source);")
    db.executescript(views)
    db.executemany("insert into studies values (?, 'simulated')", [(name,) for name in STUDIES])
    db.executemany("insert into studies values (?, 'derived')", [(name,) for name in derived])
    pairs = [(name, source) for name, sources in derived.items() for source in sources]
    db.executemany("insert into reads values (?, ?)", pairs)
    found = {}
    for study, source in db.execute("select study, source from simulated_behind"):
        found.setdefault(study, []).append(source)
    for name in [*STUDIES, *derived]:
        assert sorted(found[name]) == sorted(reached(derived, name) & {*STUDIES})


@pytest.fixture
def views():
    """The statement of the database that makes the view."""
    schema = (files("riserstudy.database") / "schema.sql").read_text("utf-8")
    begin = schema.index("create view simulated_behind")
    return schema[begin : schema.index(";", begin) + 1]
