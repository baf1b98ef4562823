"""Records of grading travel through tables and come back as they were, whatever names are made of."""

import csv
import io
import json
import math
import sqlite3
from dataclasses import replace

import numpy as np
import pytest

from riserstudy.files.csv_files import read_csv
from riserstudy.grading.rows import Row, row_of, table
from riserstudy.grading.verdict_sentences import decided_by, depends_on
from riserstudy.records.graded import (
    Case,
    Chosen,
    Graded,
    Grounds,
    Influence,
    Meaning,
    Missing,
    Outcome,
    Premise,
    Reading,
    Settled,
    Share,
    Together,
)

LETTERS = list("ab .:;,()%=|'\"\\{}[]\n\tµ°–0")


def drawn(seed):
    """Grounds with names of any letters, every part there or not."""
    draw = np.random.default_rng(seed)

    def text():
        return "".join(draw.choice(LETTERS, draw.integers(1, 12)))

    def number():
        return float(draw.choice([draw.normal(), draw.normal() * 1e12, 0.0, math.inf, -math.inf]))

    def share():
        samples = int(draw.integers(1, 500))
        band = draw.random(2).tolist() if samples >= 100 else [None, None]
        met = int(draw.integers(0, samples + 1))
        return Share(met, samples, maybe(samples), *band, same=int(draw.integers(0, samples - met + 1)))

    def reading():
        place = {text(): text() if draw.integers(2) else float(draw.normal())}
        answer = draw.choice(["true", "no difference", "false", "depends"])
        return Reading(place, str(answer), share(), [text() for _ in range(draw.integers(2))])

    def influence():
        effect = float(draw.random()) if draw.integers(2) else None
        options = {text(): float(draw.random()) for _ in range(draw.integers(4))}
        return Influence(text(), text(), effect, options)

    def outcome():
        one = Outcome(text(), number(), number(), bool(draw.integers(2)))
        names = [text() for _ in range(draw.integers(3))]
        if draw.integers(2):
            return replace(one, readings=[reading() for _ in range(draw.integers(1, 3))])
        return replace(one, share=share(), decided_by=names) if draw.integers(2) else one

    def maybe(value):
        return value if draw.integers(2) else None

    return Grounds(
        impossible=text() if draw.integers(2) else "",
        within=maybe(float(draw.random())),
        share=maybe(share()),
        because=draw.choice(["inputs", "base case", "too few samples", "missing values", None]),
        decided_by=[influence() for _ in range(draw.integers(4))],
        explained=maybe(float(draw.random())),
        premise=maybe(Premise(3, 8)),
        words=[Meaning(text(), float(draw.random()), bool(draw.integers(2)), 0.02)],
        readings=[reading() for _ in range(draw.integers(3))],
        missing=maybe(Missing(2, 9)),
        together=maybe(Together([text()], share())),
        chosen=maybe(Chosen(text(), bool(draw.integers(2)))),
        settled=maybe(Settled(maybe(96), 128, 0.99)),
        outcomes=[outcome() for _ in range(draw.integers(3))],
        note=text(),
    )


@pytest.mark.parametrize("seed", range(100))
def test_grounds_come_back_from_json_a_table_and_a_database_as_they_were(seed, tmp_path):
    grounds = drawn(seed)
    assert Grounds.from_json(grounds.to_json()) == grounds
    json.loads(grounds.to_json(), parse_constant=pytest.fail)  # no NaN, which is no JSON
    graded = Graded("p", "C1", "1", "claim", "s", None, 1.0, "m", None, "holds", grounds)
    path = tmp_path / "reproduction.csv"
    path.write_text(table([row_of(graded)], Row), "utf-8", newline="")
    (row,) = read_csv(path)
    assert Grounds.from_json(row["grounds"]) == grounds
    db = sqlite3.connect(":memory:")
    asked = db.execute("select ?1, json_extract(?1, '$.note')", (row["grounds"],))
    back, note = asked.fetchone()
    assert (Grounds.from_json(back), note) == (grounds, grounds.note)


def test_what_is_no_number_is_kept():
    grounds = Grounds(outcomes=[Outcome("a", math.nan, math.nan, False)])
    (outcome,) = Grounds.from_json(grounds.to_json()).outcomes
    assert math.isnan(outcome.low)


@pytest.mark.parametrize("text", ["", "true in 3 of 8 samples", '{"note": 1}', '{"more": 1}'])
def test_a_cell_that_holds_no_grounds_is_refused(text):
    with pytest.raises(ValueError, match="Grounds"):
        Grounds.from_json(text)


def test_a_case_comes_back_from_its_table():
    case = Case(
        "p", "C1", {"line": "a; b: c.", "x": 1.5}, True, False, False, True, -0.25, False, {"p/s": ["line"]}
    )
    (row,) = csv.DictReader(io.StringIO(table([case], Case)))
    assert json.loads(row["place"]) == case.place
    assert json.loads(row["rests_on"]) == case.rests_on
    flags = [row[name] for name in ("base", "judged", "met", "same", "margin", "calibrated")]
    assert flags == ["1", "0", "0", "1", "-0.25", "0"]


def test_a_semicolon_in_a_name_stays_within_what_decides():
    share = Share(3, 8)
    by = [Influence("a", "a; b: c. D"), Influence("e", "e")]
    grounds = Grounds(share=share, because="inputs", decided_by=by)
    assert decided_by(grounds) == "a; b: c. D and e"
    assert depends_on("claim", grounds).startswith(decided_by(grounds))
