"""False claims: the grader refuses them, and would be found out if it did not."""

import csv
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
import yaml

from riserstudy.errors import InputError
from riserstudy.grading.false_claims import SUBTLE, Falsified, read_false_claims
from riserstudy.grading.falsify import ACCEPTED, false_rows
from riserstudy.grading.found import Found, judged
from riserstudy.grading.grade import grade
from riserstudy.grading.margin import above
from riserstudy.grading.models import PublishedFile
from riserstudy.grading.published import printed_of

ROOT = Path(__file__).parents[2]
CONFIG = ROOT / "config"
PAPERS = ("chang2020", "liu2020", "mao_hangoff", "fem_riser", "liu2017")
TABLE = ROOT / "results/false_claims.csv"


def false_claims():
    return [
        (paper, one)
        for paper in PAPERS
        for one in read_false_claims(CONFIG, paper, printed_of(CONFIG, paper))
    ]


def test_forty_false_claims_over_five_papers_half_of_them_subtle():
    claims = false_claims()
    assert {paper for paper, _ in claims} == {*PAPERS}
    assert len(claims) >= 40
    assert 2 * sum(one.how in SUBTLE for _, one in claims) >= len(claims)


def test_no_false_claim_is_what_its_paper_prints():
    for paper, one in false_claims():
        printed = {item.id: item for item in printed_of(CONFIG, paper).items}
        assert one.statement not in {item.statement for item in printed.values()}
        assert one.published is None or one.published != printed[one.of].published
        if one.options and not one.check:
            options = printed[one.of].options
            assert {**options, **one.options} != options, one.id


# a small study: two models of a mass, of which the stiff one answers less in all samples

FILE = PublishedFile.model_validate(
    {
        "paper": "small",
        "items": [
            {"id": "C1", "figure": "1", "kind": "claim", "statement": "soft answers more than stiff",
             "check": "soft_answers_more", "reads": {"runs": "base"}, "over": {"runs": "open"}},
            {"id": "N1", "figure": "1", "kind": "number", "statement": "soft answers by 2", "published": 2.0,
             "rounding": 0.1, "check": "soft", "reads": {"runs": "base"}},
        ],
    }
)  # fmt: skip


def soft_answers_more(runs):
    soft, stiff = (runs["answer"].sel(model=name, drop=True) for name in ("soft", "stiff"))
    return judged(soft, above(soft, stiff))


def soft(runs):
    return Found(runs["answer"].sel(model="soft", drop=True))


CHECKS = {"soft_answers_more": soft_answers_more, "soft": soft}.__getitem__


def datasets(samples=64):
    stiff = np.linspace(0.5, 1.5, samples)
    model = xr.DataArray(["soft", "stiff"], dims="model")
    values = np.stack([2.0 * stiff, stiff])
    answer = xr.DataArray(values, dims=("model", "sample"), coords={"model": model})
    answer = answer.assign_coords(sample=np.arange(samples))
    base = xr.Dataset({"answer": ("model", [2.0, 1.0])}, {"model": model})
    return {"base": base, "open": answer.to_dataset(name="answer")}


def rows(*false):
    """Rows of false claims about the small study, by ID."""
    given = datasets()
    claims = [Falsified.model_validate({"statement": "false", **one}) for one in false]
    found = false_rows(CONFIG, FILE, claims, given, CHECKS, grade(FILE, given, CHECKS))
    return {row.id: row for row in found}


@pytest.mark.parametrize(
    "change",
    [
        {"how": "cases", "relabelled": {"model": ["soft", "stiff"]}},
        {"how": "cases", "reversed": ["model"]},
        {"how": "sign", "negated": ["answer"]},
    ],
)
def test_a_true_claim_turned_round_fails_in_every_sample(change):
    row = rows({"id": "false", "of": "C1", **change})["false"]
    assert (row.verdict, row.met, row.samples) == ("fails", 0, 64)
    assert (row.verdict_of_that, row.accepted) == ("holds", False)


@pytest.mark.parametrize("published", [4.0, 1.0, 2.2])
def test_a_number_with_a_factor_is_refused(published):
    row = rows({"id": "false", "of": "N1", "how": "factor", "published": published})["false"]
    assert (row.verdict, row.verdict_of_that) == ("fails", "reproduced")


def test_a_claim_that_only_seems_false_is_counted_as_accepted():
    row = rows({"id": "idle", "of": "N1", "how": "factor", "published": 2.01})["idle"]
    assert (row.verdict, row.accepted) == ("reproduced", True)


@pytest.mark.parametrize(
    "change, found",
    [
        ({"negated": ["speed"]}, "speed"),
        ({"reversed": ["period"]}, "period"),
        ({"relabelled": {"model": ["soft", "rigid"]}}, "model: rigid"),
        ({"exchanged": [["answer", "question"]]}, "answer and question"),
    ],
)
def test_what_no_dataset_has_is_refused(change, found):
    with pytest.raises(InputError, match=found):
        rows({"id": "false", "of": "C1", "how": "cases", **change})


@pytest.mark.parametrize("seed", range(30))
def test_pairs_that_are_none_are_refused_with_their_place(seed, tmp_path):
    draw = np.random.default_rng(seed)
    odd = [None, 5, 1.5, True, "ab", "", {}, {"a": 1}, ["ab"], [5], [None], [["a"]], [["a", "b", "c"]], [{}]]
    field = ("exchanged", "relabelled")[int(draw.integers(2))]
    found = odd[int(draw.integers(len(odd)))]
    if field == "relabelled" and draw.random() < 0.7:
        found = {"model": odd[int(draw.integers(len(odd)))]}
    one = {"id": "F1", "of": "C1", "how": "opposite", "statement": "it falls", field: found}
    file = tmp_path / "false_claims/small.yaml"
    file.parent.mkdir()
    file.write_text(yaml.safe_dump({"paper": "small", "claims": [one]}))
    with pytest.raises(InputError, match=r"small\.yaml: claims\[0\]"):
        read_false_claims(tmp_path, "small", FILE)


def test_a_false_claim_that_changes_nothing_is_refused():
    with pytest.raises(ValueError, match="changes nothing"):
        Falsified.model_validate({"id": "a", "of": "C1", "how": "sign", "statement": "as printed"})


# the papers' own, where the study has run

ran = pytest.mark.skipif(not TABLE.exists(), reason="the study has not run in this checkout")


@pytest.fixture(scope="module")
def graded():
    with TABLE.open(newline="", encoding="utf-8") as file:
        found = {(row["paper"], row["id"]): row for row in csv.DictReader(file)}
    if found.keys() != {(paper, one.id) for paper, one in false_claims()}:
        pytest.skip("the study has run with other false claims")
    return found


@ran
def test_the_grader_accepts_no_false_claim_about_the_papers(graded):
    assert not [key for key, row in graded.items() if row["verdict"] in ACCEPTED]


@ran
def test_forty_of_them_fail_outright(graded):
    assert sum(row["verdict"] == "fails" for row in graded.values()) >= 40


@ran
def test_the_grader_does_not_refuse_what_the_false_claims_are_made_from(graded):
    """Or it would refuse them whatever they say; 30 % and 50 % of Chang et al. contradict each other."""
    refused = {key for key, row in graded.items() if row["verdict_of_that"] == "fails"}
    assert refused <= {("chang2020", "A1-twice"), ("chang2020", "A2-twice")}
