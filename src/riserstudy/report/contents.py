"""What the report tells, gathered from datasets, tables and study files."""

from __future__ import annotations

import csv
import json
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from riserstudy.report.animation import animation
from riserstudy.report.engine import engine
from riserstudy.report.motion import motion_of
from riserstudy.report.scenes import SceneTable, scene_tables
from riserstudy.report.wording import counted, grouped, listed, seconds, share
from riserstudy.study.models import StudyFile
from riserstudy.study.read import read_studies

if TYPE_CHECKING:
    import xarray as xr

VERDICTS = {
    "reproduced": "inside the printed rounding or 1 %, nothing calibrated on the way",
    "calibrated": "met, with an input that was fitted to a printed number",
    "holds": "a claim true in at least 95 % of the assumption samples",
    "depends": "decided by an input that the paper leaves open",
    "fails": "a number missed, or a claim true in at most 5 % of the samples",
    "not reproducible": "the paper does not say enough",
}
ENGINE = "numerics"  # the chapter about the engine itself
ERRORS = ("displacement", "moment", "tension")


@dataclass(frozen=True)
class Sources:
    """Files that the report is made from.

    Attributes
    ----------
    config : folder with the study files.
    papers : in the order of the report.
    datasets, figures : files of all results, netCDF and PNG, in a folder named like their paper.
    tables : CSV files named ``reproduction`` and ``errata``, as far as there are any.
    compiled : marker that holds the time of the cold compile.
    """

    config: Path
    papers: list[str]
    datasets: list[Path]
    figures: list[Path]
    tables: list[Path]
    compiled: Path


class Row(NamedTuple):
    """One dataset of the audit."""

    paper: str
    name: str
    about: str
    axes: str
    points: int
    wall: dict[str, float]
    unexplained: float
    errors: dict[str, float]
    warnings: list[tuple[str, int]]
    warned: int


class MovingRun(NamedTuple):
    """One run in motion: its paper, its name, what it is, and its figure as JSON."""

    paper: str
    name: str
    title: str
    figure: str


class Figure(NamedTuple):
    """One figure, and the scenes behind it."""

    paper: str
    name: str
    caption: str
    image: Path
    reads: list[str]
    scenes: list[SceneTable]


def contents(sources: Sources) -> dict[str, Any]:
    """Everything that the page's template asks for."""
    import xarray as xr

    studies = {paper: read_studies(sources.config, paper) for paper in sources.papers}
    datasets: dict[tuple[str, str], xr.Dataset] = {}
    for path in sources.datasets:
        # histories are large, and but few of them are looked at
        datasets[path.parent.name, path.stem] = xr.open_dataset(path, engine="netcdf4")
    simulated = {key: ds for key, ds in datasets.items() if "point_key" in ds}
    rows = [_row(*key, dataset) for key, dataset in simulated.items()]
    graded = table(sources.tables, "reproduction")
    figures = [_figure(path, studies, simulated, sources.config) for path in sources.figures]
    grading = len({row["paper"] for row in graded}) + 1 if graded else 0
    jobs = (
        len(sources.datasets) + len(sources.figures) + grading + 2
    )  # with compiling and reporting
    cold = json.loads(sources.compiled.read_text() or "{}").get("cold_seconds")
    wall: dict[str, float] = {}
    for row in rows:
        wall |= row.wall
    return {
        "papers": sources.papers,
        "summary": [
            *_came_out(graded),
            *_amounts(sources, rows, wall, jobs, cold),
            *_soundness(rows, simulated),
        ],
        "verdicts": VERDICTS,
        "graded": graded,
        "errata": table(sources.tables, "errata"),
        "motions": [*_motions(studies, datasets)],
        "figures": figures,
        "left_out": {paper: file.left_out for paper, file in studies.items() if file.left_out},
        "anchors": {f"{figure.paper}-{figure.name}" for figure in figures},
        "engine": engine({name: ds for (paper, name), ds in datasets.items() if paper == ENGINE}),
        "rows": rows,
        "derived": [key for key in datasets if key not in simulated and key[0] != ENGINE],
        "wall": wall,
        "jobs": jobs,
        "cold": cold,
    }


def table(tables: list[Path], name: str) -> list[dict[str, str]]:
    """Rows of a table, none when it is not there."""
    for path in tables:
        if path.stem == name:
            with path.open(newline="", encoding="utf-8") as file:
                return list(csv.DictReader(file))
    return []


# in ten lines


def _came_out(graded: list[dict[str, str]]) -> list[str]:
    if not graded:
        return ["No printed numbers or claims are graded."]
    papers = list(dict.fromkeys(row["paper"] for row in graded))
    lines = []
    if len(papers) > 1:
        what = counted(len(papers), "paper")
        lines.append(f"{len(graded)} printed numbers and claims of {what}: {_verdicts(graded)}.")
    for paper in papers:
        own = [row for row in graded if row["paper"] == paper]
        kinds = []
        for kind in ("number", "claim"):
            if found := [row for row in own if row["kind"] == kind]:
                kinds.append(f"{counted(len(found), kind)} ({_verdicts(found)})")
        lines.append(f"{paper}: {listed(kinds)}.")
    return lines


def _verdicts(rows: list[dict[str, str]]) -> str:
    counts = Counter(row["verdict"] for row in rows)
    ordered = [*(v for v in VERDICTS if v in counts), *sorted(set(counts) - set(VERDICTS))]
    return ", ".join(f"{counts[verdict]} {verdict}" for verdict in ordered)


def _amounts(
    sources: Sources, rows: list[Row], wall: dict[str, float], jobs: int, cold: float | None
) -> list[str]:
    what = (counted(len(sources.datasets), "dataset"), counted(len(sources.figures), "figure"))
    points = sum(row.points for row in rows)
    lines = [
        f"{what[0]} and {what[1]} from {counted(jobs, 'job')}; {counted(points, 'grid point')}, "
        f"{len(wall)} of them different simulations."
    ]
    if wall:
        total, longest = sum(wall.values()), max(wall.values())
        compiling = f"; compiling the kernels from nothing {seconds(cold)}" if cold else ""
        lines.append(
            f"Simulating took {seconds(total)} of one core, {seconds(total / len(wall))} a point on "
            f"average and {seconds(longest)} at most{compiling}."
        )
    return lines


def _soundness(rows: list[Row], simulated: dict[tuple[str, str], xr.Dataset]) -> list[str]:
    lines = []
    worst = max(rows, key=lambda row: row.unexplained, default=None)
    if worst and worst.unexplained > 0.0:
        lines.append(
            f"Of the energy exchanged in a simulation at most {share(worst.unexplained)} is left "
            f"unexplained ({worst.paper}/{worst.name})."
        )
    errors = []
    for name in ERRORS[:2]:
        worst = max(rows, key=lambda row: row.errors[name], default=None)
        if worst and worst.errors[name] > 0.0:
            where = f"{worst.paper}/{worst.name}"
            errors.append(f"{share(worst.errors[name])} of {name} ({where})")
    if errors:
        lines.append(f"Estimated errors are at most {listed(errors)}.")
    warned, points = sum(row.warned for row in rows), sum(row.points for row in rows)
    lines.append(f"{warned} of {counted(points, 'grid point')} carry a warning; see the audit.")
    about = [
        listed(sorted({str(dataset.attrs[name]) for dataset in simulated.values()}))
        for name in ("tier", "riserstudy", "engine")
    ]
    lines.append(f"Tier {about[0]}; riserstudy {about[1]}, engine {about[2]}.")
    return lines


# datasets and figures


def _row(paper: str, name: str, dataset: xr.Dataset) -> Row:
    def largest(variable: str) -> float:
        return max((float(v) for v in dataset[variable].values.flat if v == v), default=0.0)

    keys = [str(key) for key in dataset["point_key"].values.flat]
    said = [str(text) for text in dataset["warnings"].values.flat]
    return Row(
        paper=paper,
        name=name,
        about=str(dataset.attrs["title"]).partition(": ")[2],
        axes=" × ".join(f"{dataset.sizes[a]} {a}" for a in dataset["point_key"].dims),
        points=len(keys),
        wall=dict(zip(keys, map(float, dataset["wall_seconds"].values.flat), strict=True)),
        unexplained=largest("unexplained_energy"),
        errors={error: largest(f"error_{error}") for error in ERRORS},
        warnings=grouped(part for text in said for part in text.splitlines()),
        warned=sum(bool(text) for text in said),
    )


def _motions(
    studies: dict[str, StudyFile], datasets: dict[tuple[str, str], xr.Dataset]
) -> Iterator[MovingRun]:
    for paper, file in studies.items():
        shown = file.in_motion
        if shown and (paper, shown.study) in datasets:
            motion = motion_of(shown, datasets[paper, shown.study])
            yield MovingRun(paper, shown.study, motion.title, animation(motion))


def _figure(
    image: Path,
    studies: dict[str, StudyFile],
    simulated: dict[tuple[str, str], xr.Dataset],
    config: Path,
) -> Figure:
    paper, name = image.parent.name, image.stem
    file = studies[paper]
    if name in file.schematics:
        shown = file.schematics[name]
        return Figure(paper, name, shown.caption, image, [shown.scene], [])
    figure = file.figures[name]
    behind: list[str] = []
    for read in figure.reads:
        sources = file.derived[read].reads if read in file.derived else [read]
        behind += [s for s in sources if s not in behind]
    scenes = {s: simulated[paper, s] for s in behind if (paper, s) in simulated}
    tables = scene_tables(scenes, file, config)
    return Figure(paper, name, figure.caption, image, figure.reads, tables)
