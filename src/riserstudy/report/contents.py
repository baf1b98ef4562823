"""Contents of the report, collected from the results database, datasets and study files."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Container, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from riserstudy.database.ask import connect, rows_by_name
from riserstudy.grading.summary import VERDICTS, totals
from riserstudy.report import audit
from riserstudy.report.animation import animation
from riserstudy.report.claims import Claim, read_claims
from riserstudy.report.curves import curves
from riserstudy.report.false_claims import false_claims
from riserstudy.report.limits import LimitTable, limit_tables
from riserstudy.report.machine import made_on
from riserstudy.report.motion import Motion, motion_of
from riserstudy.report.moving_riser import moving_riser
from riserstudy.report.of_chapters import section_of, tiles_of
from riserstudy.report.overview import amounts, bars, findings, short_of, subject, title_of
from riserstudy.report.pictures import Figure, Picture, claims_by_figure, heading, labels, picture_of
from riserstudy.report.scenes import SceneTable, scene_tables
from riserstudy.study.models import StudyFile
from riserstudy.study.read import read_studies

if TYPE_CHECKING:
    import xarray as xr


#: caption, PNG and PDF by paper and name
FilesOfFigures = dict[tuple[str, str], tuple[str, str, str]]


@dataclass(frozen=True)
class Sources:
    """Files from which the report is made."""

    config: Path  # folder with the study files
    papers: list[str]  # papers in the order of the report
    # results database; it contains the paths of figures and datasets relative to its folder
    database: Path
    compiled: Path  # marker that contains the time of the first compilation

    @property
    def folder(self) -> Path:
        """Folder of the results."""
        return self.database.parent


class MovingRun(NamedTuple):
    """One animated run: its paper, its study and path, its title, and its figure as JSON."""

    paper: str
    name: str
    path: str  # of the dataset, relative to the page
    title: str
    figure: str


class Chapter(NamedTuple):
    """The part of the report about one paper."""

    paper: str
    title: str
    reference: str
    about: str
    claims: list[Claim]
    motion: MovingRun | None
    figures: list[Figure]
    errata: list[dict[str, str]]
    left_out: dict[str, str]
    limits: list[LimitTable]
    scenes: list[SceneTable]


def contents(sources: Sources) -> dict[str, Any]:
    """Return all values that the template of the page needs."""
    import xarray as xr

    files = {paper: read_studies(sources.config, paper) for paper in sources.papers}
    with connect(sources.database) as db, ThreadPoolExecutor() as pool:
        known = _files_of_figures(db)
        pictures = {  # encoding takes as long as all the rest, and does not block other threads
            path: pool.submit(picture_of, path) for path in _drawn(known, sources.folder, files)
        }
        claims = read_claims(db)
        errata = list(rows_by_name(db, "select * from errata order by rowid"))
        paths: dict[str, str] = dict(db.execute("select study, path from studies").fetchall())
        # histories are large, and only few of them are read
        datasets = {
            tuple(study.split("/")): xr.open_dataset(sources.folder / path, engine="netcdf4")
            for study, path in paths.items()
        }
        tables = {
            p: scene_tables(_own(p, files[p], datasets), files[p], sources.config) for p in sources.papers
        }
        figures = _figures(db, sources, files, claims, paths, tables, known, pictures)
        drawn_runs = curves(db, sources.config, claims, datasets)
        rows, warned = audit.audit(db, files), audit.warned(db)
        missed = audit.missed(db, files)
        facts = audit.run_facts(db)
    cold = json.loads(sources.compiled.read_text() or "{}").get("cold_seconds")
    of_paper = {p: {n: ds for (q, n), ds in datasets.items() if q == p} for p in sources.papers}
    points = sum(row.points for row in rows)
    motions = {
        paper: motion
        for paper, file in files.items()
        if (motion := _motion(paper, file, datasets)) is not None
    }
    return {
        "totals": totals([(claim.verdict, claim.grounds) for claim in claims]),
        "moving_riser": moving_riser(motions.items()),
        "subject": subject(files, claims),
        "bars": bars(claims, files),
        "findings": findings(claims, files, figures),
        "tiles": [t for p in sources.papers for t in tiles_of(p, of_paper[p], figures)],
        "facts": [amounts(claims, len(paths), len(figures), points), facts, made_on()],
        "total": sum(row.total for row in rows),
        "cold": cold,
        "verdicts": VERDICTS,
        "numbers": [claim for claim in claims if claim.kind == "number"],
        "claims": [claim for claim in claims if claim.kind != "number"],
        "false_claims": false_claims(sources.folder),
        "chapters": [
            *_chapters(files, claims, errata, figures, datasets, tables, _moving(motions, files, paths))
        ],
        "short": {paper: short_of(files, paper) for paper in sources.papers},
        "figures_of": _figures_of(figures),
        "curves": drawn_runs,
        "sections": {p: section_of(p, of_paper[p]) for p in sources.papers},
        "rows": rows,
        "warned": warned,
        "missed": missed,
    }


def _chapters(
    files: dict[str, StudyFile],
    claims: list[Claim],
    errata: list[dict[str, str]],
    figures: list[Figure],
    datasets: dict[Any, xr.Dataset],
    tables: dict[str, list[SceneTable]],
    moving: dict[str, MovingRun],
) -> Iterator[Chapter]:
    for paper, file in files.items():
        yield Chapter(
            paper,
            title_of(files, paper),
            file.reference,
            file.about,
            [claim for claim in claims if claim.paper == paper],
            moving.get(paper),
            [figure for figure in figures if figure.paper == paper],
            [row for row in errata if row["paper"] == paper],
            file.left_out,
            limit_tables(_own(paper, file, datasets), {n: of.caption for n, of in file.studies.items()}),
            tables[paper],
        )


def _motion(paper: str, file: StudyFile, datasets: dict[Any, xr.Dataset]) -> Motion | None:
    drawn_runs = file.in_motion
    if not drawn_runs or (paper, drawn_runs.study) not in datasets:
        return None
    caption = file.studies[drawn_runs.study].caption
    return motion_of(drawn_runs, datasets[paper, drawn_runs.study], caption)


def _moving(
    motions: dict[str, Motion], files: dict[str, StudyFile], paths: dict[str, str]
) -> dict[str, MovingRun]:
    """Return the animated runs for the page."""
    runs = {}
    for paper, motion in motions.items():
        drawn_runs = files[paper].in_motion
        name = drawn_runs.study if drawn_runs else ""
        runs[paper] = MovingRun(paper, name, paths[f"{paper}/{name}"], motion.title, animation(motion))
    return runs


def _own(paper: str, file: StudyFile, datasets: dict[Any, xr.Dataset]) -> dict[str, xr.Dataset]:
    """Return the simulated datasets of a paper."""
    return {name: datasets[paper, name] for name in file.studies if (paper, name) in datasets}


def _figures(
    db: sqlite3.Connection,
    sources: Sources,
    files: dict[str, StudyFile],
    claims: list[Claim],
    paths: dict[str, str],
    tables: dict[str, list[SceneTable]],
    known: FilesOfFigures,
    pictures: dict[Path, Future[Picture]],
) -> list[Figure]:
    """Return the figures in the order of the study files, with everything that they link to."""
    rests = _sets(db, "select paper, id, study from rests_on")
    by_figure = _sets(db, "select figure, study from figure_reads")
    reads = {figure: studies for (figure,), studies in by_figure.items()}
    sources_of = _sets(db, "select study, source from simulated_behind")
    present = {path for (path,) in db.execute("select path from files")}
    figures: list[Figure] = []
    for paper, file in files.items():
        names = _names(paper, file, known)
        own = claims_by_figure(
            [claim for claim in claims if claim.paper == paper],
            names,
            rests,
            {name: reads.get(f"{paper}/{name}", set()) for name in names},
            sources_of,
            {name: figure.claims for name, figure in file.figures.items()},
        )
        label = labels(names, short_of(files, paper), printed=bool(file.reference))
        for name in names:
            caption, png, pdf = known[paper, name]
            datasets = file.figures[name].reads if name in file.figures else ()
            read = [f"{paper}/{n}" for n in datasets]
            simulated = set().union(*(sources_of.get((study,), set()) for study in read))
            drawn_scene = _drawn_scene(file, name, sources.config)
            picture = pictures[sources.folder / png].result()
            files_of = [("PDF", pdf), ("PNG", png), ("data as CSV", f"{paper}/{name}.csv")]
            figure = Figure(
                paper,
                name,
                label[name],
                heading(label[name], picture.title),
                caption,
                picture,
                [(kind, path) for kind, path in files_of if path in present],
                [(study.split("/")[1], paths[study]) for study in read if study in paths],
                own[name],
                [
                    (t.title, t.anchor(paper))
                    for t in tables[paper]
                    if simulated & t.studies(paper) or t.title == drawn_scene
                ],
                f"snakemake -c1 {paper}_{name}",
            )
            figures.append(figure)
    return figures


def _files_of_figures(db: sqlite3.Connection) -> FilesOfFigures:
    """Return caption, PNG and PDF of each figure, by paper and name."""
    found = db.execute("select paper, name, caption, png, pdf from figures")
    return {(paper, name): (caption, png, pdf) for paper, name, caption, png, pdf in found}


def _names(paper: str, file: StudyFile, known: Container[tuple[str, str]]) -> list[str]:
    """Return the figures of a chapter that the database contains, in the order of its study file."""
    return [name for name in (*file.schematics, *file.figures) if (paper, name) in known]


def _drawn(known: FilesOfFigures, folder: Path, files: dict[str, StudyFile]) -> Iterator[Path]:
    """Yield the PNG files of all figures."""
    for paper, file in files.items():
        for name in _names(paper, file, known):
            yield folder / known[paper, name][1]


def _drawn_scene(file: StudyFile, name: str, config: Path) -> str:
    """Return the title of the scene that a schematic draws; "" for other figures."""
    return str(file.schematics[name].file(config).tree["title"]) if name in file.schematics else ""


def _sets(db: sqlite3.Connection, sql: str) -> dict[tuple[str, ...], set[str]]:
    """Return the values of the last column of a statement's rows, by the values of the other columns."""
    sets: dict[tuple[str, ...], set[str]] = {}
    for *key, value in db.execute(sql):
        sets.setdefault(tuple(key), set()).add(value)
    return sets


def _figures_of(figures: list[Figure]) -> dict[str, list[tuple[str, str]]]:
    """Return anchors and short names of the figures of each claim, by the anchor of the claim."""
    by_dataset: dict[str, list[tuple[str, str]]] = {}
    for figure in figures:
        for claim in figure.claims:
            by_dataset.setdefault(claim.anchor, []).append((figure.anchor, figure.label))
    return by_dataset
