"""Insert facts about papers from study files, tables and published values: figures, verdicts, errata."""

from __future__ import annotations

import math
import sqlite3
from collections.abc import Iterator
from pathlib import Path

from riserstudy.database.sources import File, Sources
from riserstudy.database.write_study import About, marks
from riserstudy.errors import InputError
from riserstudy.files.csv_files import read_csv
from riserstudy.grading.published import published_path, read_published
from riserstudy.grading.verdict_sentences import decided_by
from riserstudy.records.graded import Grounds, Share
from riserstudy.study.models import StudyFile
from riserstudy.study.read import read_studies

TABLES = ("figure_reads", "figures", "rests_on", "numbers_and_claims", "margins", "errata", "reads")


def studies_of(sources: Sources) -> dict[str, StudyFile]:
    """Return the study files by paper."""
    return {paper: read_studies(sources.config, paper) for paper in sources.papers}


def datasets_of(files: dict[str, StudyFile]) -> Iterator[About]:
    """Yield what study files contain about their datasets."""
    for paper, file in files.items():
        for name in file.datasets:
            kind = "simulated" if name in file.studies else "measured"
            caption = file.studies[name].caption if name in file.studies else ""
            if name in file.seas:
                kind, caption = "hours", file.seas[name].caption
            if name in file.derived:
                kind, caption = "derived", "from " + ", ".join(file.derived[name].reads)
            yield About(paper, name, kind, caption, f"{paper}/{name}.nc")


def remove_papers(db: sqlite3.Connection) -> None:
    """Delete the rows that `write_papers` inserts: they are few, and are written again each time."""
    for table in TABLES:
        db.execute(f"delete from {table}")


def write_papers(
    db: sqlite3.Connection, sources: Sources, files: dict[str, StudyFile], present: list[File]
) -> None:
    """Insert the sources of derived datasets, figures, graded numbers and claims, and errata."""
    paths = {file.path for file in present}
    studies = {study for (study,) in db.execute("select study from studies")}
    for paper, file in files.items():
        _write_reads(db, paper, file, studies)
        _write_figures(db, paper, file, studies, paths)
        if published_path(sources.config, paper).exists():
            _write_rests(db, sources.config, paper, file, studies)
    for path in sources.files:
        if path.name == "reproduction.csv":
            _insert(db, "numbers_and_claims", map(_graded, read_csv(path)))
        if path.name == "margins.csv":
            _insert(db, "margins", map(_margin, read_csv(path)))
        if path.name == "errata.csv":
            _insert(db, "errata", (tuple(row.values()) for row in read_csv(path)))


def _write_reads(db: sqlite3.Connection, paper: str, file: StudyFile, studies: set[str]) -> None:
    pairs = {
        (f"{paper}/{name}", f"{paper}/{source}")
        for name, derived in file.derived.items()
        for source in derived.reads
    }
    _insert(db, "reads", sorted(pair for pair in pairs if studies.issuperset(pair)))


def _write_figures(
    db: sqlite3.Connection, paper: str, file: StudyFile, studies: set[str], paths: set[str]
) -> None:
    captions = {name: figure_model.caption for name, figure_model in (file.schematics | file.figures).items()}
    for name, caption in captions.items():
        drawn = [f"{paper}/{name}.{kind}" for kind in ("png", "pdf")]
        if paths.issuperset(drawn):
            _insert(db, "figures", [(f"{paper}/{name}", paper, name, caption, *drawn)])
            figure = file.figures.get(name)
            read = {f"{paper}/{source}" for source in (figure.reads if figure else [])}
            _insert(db, "figure_reads", [(f"{paper}/{name}", one) for one in sorted(read & studies)])


def _write_rests(
    db: sqlite3.Connection, config: Path, paper: str, file: StudyFile, studies: set[str]
) -> None:
    published = read_published(config, paper, set(file.datasets))
    rests = {
        (paper, entry.id, f"{paper}/{name}")
        for entry in (*published.items, *published.errata)
        for name in entry.datasets
    }
    _insert(db, "rests_on", sorted(row for row in rests if row[2] in studies))


def _graded(row: dict[str, str]) -> tuple[str | float | None, ...]:
    """Return a row of reproduction.csv, with the share of samples and the deciding input as columns."""
    cell = row.get("grounds") or "{}"  # tables of earlier versions lack this column
    try:
        grounds = Grounds.from_json(cell)
    except ValueError:
        where = f"{row['paper']}/{row['id']}: grounds"
        found = "the cell does not contain the JSON that grading writes"
        raise InputError("reproduction.csv", where, found, "grade the paper again") from None
    return (
        *(row[name] for name in ("paper", "id", "figure", "kind", "statement")),
        *(_number(row[name]) for name in ("published", "simulated")),
        row["unit"],
        _number(row["error"]),
        row["verdict"],
        *_share(grounds.share),
        decided_by(grounds),
        *(_number(row.get(name, "")) for name in ("margin", "margin_low", "margin_high")),
        row["note"],
        cell,
    )


def _share(share: Share | None) -> tuple[float | int | None, ...]:
    """Return the share (1) of the samples, its interval, and the two counts from which it is calculated."""
    if share is None:
        return (None,) * 5
    return share.met / share.samples, share.low, share.high, share.met, share.samples


def _margin(row: dict[str, str]) -> tuple[str | float | None, ...]:
    """Return a row of margins.csv."""
    # blank where a case has no value
    flags = (int(row[name]) if row[name] else None for name in ("base", "judged", "met", "same"))
    margin, fitted = _number(row["margin"]), int(row["calibrated"])
    return row["paper"], row["id"], row["place"], *flags, margin, fitted, row["rests_on"]


def _number(text: str) -> float | None:
    return float(text) if text and math.isfinite(float(text)) else None


def _insert(db: sqlite3.Connection, table: str, rows: object) -> None:
    every = [tuple(row) for row in rows]  # type: ignore[attr-defined]
    if every:
        db.executemany(f"insert into {table} values ({marks(len(every[0]))})", every)
