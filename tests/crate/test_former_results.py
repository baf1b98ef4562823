"""Results that were made from results which another job has replaced, from records written by hand."""

import hashlib
import json
from base64 import urlsafe_b64encode

import pytest

from riserstudy.crate.claims import claim_entities
from riserstudy.crate.former import of_former_results
from riserstudy.crate.records import recorded
from riserstudy.files.seals import SEALS

READ, MADE = "results/paper/runs.nc", "results/paper/fig01.png"


def result(study, name, content):
    """A result with its seal."""
    file = study / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(content)
    seal = study / "results" / SEALS / name.removeprefix("results/")
    seal.parent.mkdir(parents=True, exist_ok=True)
    seal.write_text(hashlib.sha256(content.encode()).hexdigest() + " of this job")


def record(study, name, began, ended, inputs=(), checksums=None, width=None):
    """What Snakemake leaves of a job; a long name is cut into folders, each part after an at."""
    about = {"rule": "draw", "starttime": began, "endtime": ended, "input": list(inputs), "params": []}
    about["input_checksums"] = checksums or {}
    text = urlsafe_b64encode(name.encode()).decode()
    parts = [text[k : k + width] for k in range(0, len(text), width)] if width else [text]
    *folders, last = parts
    file = (study / ".snakemake/metadata").joinpath(*(f"@{part}" for part in folders), last)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(about))


def sha(content):
    return "sha256:" + hashlib.sha256(content.encode()).hexdigest()


@pytest.fixture
def study(tmp_path):
    result(tmp_path, READ, "numbers")
    result(tmp_path, MADE, "a drawing")
    record(tmp_path, READ, 10.0, 20.0)
    return tmp_path


@pytest.mark.parametrize("began, former", [(20.5, False), (20.0, False), (19.5, True), (5.0, True)])
def test_without_a_checksum_a_job_must_have_begun_after_its_input_was_made(study, began, former):
    record(study, MADE, began, 30.0, [READ])
    assert of_former_results(study) == ([MADE] if former else [])


@pytest.mark.parametrize("began", [5.0, 25.0])
@pytest.mark.parametrize("content, former", [("numbers", False), ("former numbers", True)])
def test_with_a_checksum_times_do_not_count(study, began, content, former):
    record(study, MADE, began, 30.0, [READ], {READ: sha(content)})
    assert of_former_results(study) == ([MADE] if former else [])


def test_inputs_that_no_job_made_replace_nothing(study):
    record(study, MADE, 5.0, 30.0, ["config/scenes/riser.yaml", "results/paper/absent.nc"])
    assert of_former_results(study) == []


def test_an_absent_seal_is_no_difference(study):
    (study / "results" / SEALS / "paper/runs.nc").unlink()
    record(study, MADE, 5.0, 30.0, [READ], {READ: sha("former numbers")})
    assert of_former_results(study) == []


@pytest.mark.parametrize("width", [None, 8, 20])
def test_records_of_long_names_are_read_and_damaged_ones_skipped(study, width):
    record(study, MADE, 21.0, 30.5, [READ], {READ: sha("numbers")}, width)
    (study / ".snakemake/metadata/broken").write_text("{")
    found = recorded(study)
    assert set(found) == {READ, MADE}
    one = found[MADE]
    assert (one.rule, one.inputs, one.checksums) == ("draw", (READ,), {READ: sha("numbers")})
    assert (one.ended - one.began).total_seconds() == 9.5


def test_a_verdict_is_described_once_and_a_margin_only_where_there_is_one(tmp_path):
    table = tmp_path / "reproduction.csv"
    table.write_text(
        "paper,id,statement,verdict,note,margin\n"
        "p,C1,it sags,not reproducible,,-0.25\np,C2,it sings,not reproducible,nobody listened,\n"
    )
    found = list(claim_entities(table))
    ids = [entity["@id"] for entity in found]
    assert len(set(ids)) == len(ids)
    entities = dict(zip(ids, found, strict=True))
    assert set(entities) == {"#verdict-not-reproducible", "#claim-p-C1", "#claim-p-C2", "#review-p-C1",
                             "#review-p-C2", "#margin-p-C1"}  # fmt: skip
    assert entities["#margin-p-C1"]["value"] == -0.25
    for name in ("p-C1", "p-C2"):
        review = entities[f"#review-{name}"]
        assert review["itemReviewed"] == {"@id": f"#claim-{name}"}
        assert review["reviewRating"] == {"@id": "#verdict-not-reproducible"}
    assert entities["#review-p-C2"]["reviewBody"] == "nobody listened"
    assert list(claim_entities(tmp_path / "absent.csv")) == []
