"""Results of studies: results, sql, verify, prune, crate, diff."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from riserstudy.cli.shared import wrote
from riserstudy.cli.targets import ForceOption, Writes, check_output
from riserstudy.errors import InputError
from riserstudy.records.words import counted

if TYPE_CHECKING:
    import sqlite3

ResultsOption = Annotated[Path, typer.Option("--results", help="results folder", metavar="FOLDER")]

CsvOption = Annotated[
    Path | None,
    typer.Option("--csv", help="write the result to this file instead of printing it", metavar="FILE.csv"),
    Writes("table"),
]

JsonOption = Annotated[bool, typer.Option("--json", help="print JSON")]

IN_RESULTS, HERE = Path("results"), Path()


def results(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            help="name of a study, or words; lists the points that contain all these words",
            metavar="[STUDY | FILTER...]",
        ),
    ] = None,
    where: Annotated[
        str | None,
        typer.Option(
            help="list only points for which this condition is true, such as 'heave_amplitude > 3'",
            metavar="CONDITION",
        ),
    ] = None,
    columns: Annotated[str | None, typer.Option(help="columns to show", metavar="A,B,...")] = None,
    sort: Annotated[
        str | None,
        typer.Option(
            help="columns to sort by, smallest values first; -A: largest values of A first", metavar="A,B,..."
        ),
    ] = None,
    csv: CsvOption = None,
    as_json: JsonOption = False,
    folder: ResultsOption = IN_RESULTS,
    force: ForceOption = False,
) -> None:
    """List studies, or the points of one study with their results.

    If the arguments are not the name of a study, ``results`` lists the points (single simulations) whose
    description contains all given words. The description includes study, axis values, scene, effects and
    warnings.
    """
    from riserstudy.database import listing
    from riserstudy.database.ask import NAME, connect

    words = names or []
    for option, text in (("--where", where), ("--columns", columns), ("--sort", sort)):
        if text is not None and not text.strip():
            raise InputError(option, repr(text), "the text is empty", "omit the option, or give a value")
    with connect(folder / NAME) as db:
        _check_csv(csv, db, folder, force, as_json)
        _note_changes(db, folder)
        table = listing.table_of(db, words[0]) if len(words) == 1 else None
        if table is None and (where or columns or sort):
            found = f"there is no study {' '.join(words)!r}" if words else "the name of a study is missing"
            raise InputError("results", "", found, "give a name that `riserstudy results` lists")
        if table is not None:
            parts = [re.split(r"\s*,\s*", part.strip()) if part else [] for part in (columns, sort)]
            answer = listing.cells(db, table, parts[0] or None, where, parts[1])
            units = listing.units(db, table)
        else:
            answer = listing.points(db, words) if words else listing.studies(db)
            units = {}
        if words and table is None and not answer.rows:
            found = "no study has this name, and no" if len(words) == 1 else "no"
            note = f"{found} point has a description that contains {' and '.join(map(repr, words))}"
            print(f"riserstudy: note: {note}", file=sys.stderr)
    _show(answer, csv, as_json, units)


def sql(
    statement: Annotated[str, typer.Argument(help="one SELECT statement", metavar="STATEMENT")],
    csv: CsvOption = None,
    as_json: JsonOption = False,
    folder: ResultsOption = IN_RESULTS,
    force: ForceOption = False,
) -> None:
    """Query the results database (read-only)."""
    from riserstudy.database.ask import NAME, ask, connect

    with connect(folder / NAME) as db:
        _check_csv(csv, db, folder, force, as_json)
        _note_changes(db, folder)
        answer = ask(db, statement)
    _show(answer, csv, as_json)


def _check_csv(csv: Path | None, db: sqlite3.Connection, folder: Path, force: bool, as_json: bool) -> None:
    """Refuse an output that would replace the database, or a file that it describes, or printed JSON."""
    from riserstudy.database.ask import NAME, ask
    from riserstudy.files.seals import sealed

    if csv is not None:
        if as_json:
            raise InputError("--json", "", "has no effect with --csv", "give either --json or --csv")
        files = [folder / str(path) for (path,) in ask(db, "select path from files").rows]
        check_output(csv, ("table",), [folder / NAME, *files, *sealed(folder)], force, "--csv")


def _note_changes(db: sqlite3.Connection, folder: Path) -> None:
    """Print a note if results changed after the database was built."""
    from riserstudy.database.ask import NAME
    from riserstudy.database.outdated import outdated

    if note := outdated(db, folder / NAME):
        print(f"riserstudy: note: {note}", file=sys.stderr)


def _show(answer: Any, csv: Path | None, as_json: bool, units: dict[str, str] | None = None) -> None:
    import os

    from riserstudy.database import show

    if csv is not None:
        from riserstudy.files.csv_files import write_csv

        write_csv(csv, show.headings(answer, units or {}), answer.rows)
        wrote(csv)
        return
    lines = [show.as_json(answer)] if as_json else show.as_table(answer, units)
    try:
        for line in lines:
            print(line)
        sys.stdout.flush()
    except BrokenPipeError:  # the reading program has stopped
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def verify(folder: ResultsOption = IN_RESULTS) -> None:
    """Compare the report, every dataset, figure, table and stored point with its recorded checksum.

    In a folder that was unpacked from a run crate, ``verify`` also compares every input of the study. The
    exit status is 1 if a file or stored point differs from its checksum.
    """
    from riserstudy.crate.received import changed_inputs, inputs_in
    from riserstudy.database.ask import NAME
    from riserstudy.database.verify import verify as verified

    study = folder.parent if folder.name else folder.resolve().parent
    inputs = inputs_in(study)
    verdict = verified(folder / NAME)
    wrong = [*changed_inputs(study, inputs), *verdict.wrong]
    for line in wrong:
        print(line)
    print(
        f"{counted(len(wrong), 'fault')} in {counted(len(inputs) + verdict.files, 'file')} "
        f"and {counted(verdict.points, 'point')}"
    )
    if verdict.missing:
        print(
            f"not in this store: {counted(verdict.missing, 'point')}; "
            "the datasets are complete without these points"
        )
    if wrong:
        raise typer.Exit(1)


def prune(
    every: Annotated[
        bool,
        typer.Option(
            "--all", help="also remove points of the present engine version that no study in this folder uses"
        ),
    ] = False,
    yes: Annotated[bool, typer.Option("--yes", help="do not ask for confirmation")] = False,
    config: Annotated[Path, typer.Option(help="folder of the configuration", metavar="FOLDER")] = Path(
        "config"
    ),
    folder: ResultsOption = IN_RESULTS,
) -> None:
    """Remove stored points that no result needs, after confirmation; their size is shown first.

    A point is one stored simulation of a study. The command ``prune`` removes damaged points, and points
    of other engine versions or former file formats. The option ``--all`` also removes valid points that
    the studies in this folder do not need. Studies in other folders that use the same store may still
    need points that no study in this folder needs.
    """
    from riserstudy.database.ask import NAME
    from riserstudy.database.prune import unneeded
    from riserstudy.study import store

    superfluous = unneeded(folder / NAME, config)
    size = {name: sum(h.bytes for h in getattr(superfluous, name)) / 1e6 for name in ("old", "strange")}
    print(f"needed: {counted(superfluous.needed, 'point')}")
    old, strange = (counted(len(found), "file") for found in (superfluous.old, superfluous.strange))
    print(f"damaged, or of another engine version or file format: {old}, {size['old']:.1f} MB")
    unused = "of this engine version, but not used by any study in this folder"
    print(f"{unused}: {strange}, {size['strange']:.1f} MB")
    if superfluous.strange and superfluous.seas:
        of = ", ".join(superfluous.seas)
        print(
            f"the unused points may be runs in sea states of {of}; if removed, they are simulated again when "
            f"{of} changes"
        )
    going = [*superfluous.old, *(superfluous.strange if every else [])]
    if not going:
        print("nothing to remove")
        return
    if not yes and not typer.confirm(f"remove {counted(len(going), 'file')}?"):
        raise typer.Exit(1)
    store.remove(going)
    print(f"{counted(len(going), 'file')} removed, {sum(held.bytes for held in going) / 1e6:.1f} MB")


def crate(
    output: Annotated[Path, typer.Argument(help="archive to write, a new file", metavar="OUT.zip"), Writes()],
    study: Annotated[Path, typer.Option(help="folder of the study", metavar="FOLDER")] = HERE,
) -> None:
    """Pack a study, its results and their description into one archive (run crate), which anyone can rerun.

    The command ``crate`` refuses results that are damaged or were edited. The command ``crate`` also
    refuses results of a run that was interrupted, failed or made only some files. If an input was edited
    after the run, ``crate`` prints a note that names the results with an edited input.
    """
    from riserstudy.crate.pack import pack

    former = _outdated(study) if (study / "results").is_dir() else []
    count = pack(study, output)
    if former:
        more = f" and {len(former) - 1} more" if len(former) > 1 else ""
        print(
            f"riserstudy: note: {study / former[0]}{more}: made before an edit of scene, study, units, "
            "published values or code; run the study, and pack it again",
            file=sys.stderr,
        )
    wrote(output)
    print(f"{count} files; to rerun the study, unpack the archive and run `snakemake --cores all`")


def _outdated(study: Path) -> list[str]:
    """Return the results that a run would make again; a separate process plans it, in the study's folder."""
    import os
    import subprocess

    path = os.pathsep.join(str(Path(place).absolute()) for place in sys.path if place)
    # -P: no module of the folder replaces one of Python or of this package
    done = subprocess.run(
        [sys.executable, "-P", "-m", "riserstudy.jobs.outdated"],
        cwd=study,
        env=os.environ | {"PYTHONPATH": path},
        stdout=subprocess.PIPE,
        text=True,
        encoding="utf-8",
    )
    if done.returncode:  # it has printed the reason
        raise typer.Exit(done.returncode)
    return [line for line in done.stdout.splitlines() if line]


def diff(
    old: Annotated[Path, typer.Argument(help="results folder, dataset or table", metavar="OLD")],
    new: Annotated[Path, typer.Argument(help="the new version of OLD", metavar="NEW")],
) -> None:
    """List the changes between two sets of results: published numbers, verdicts, every dataset.

    Of a number or claim, ``diff`` compares the published and the computed value, the unit, the error, the
    verdict and the deciding inputs. Of a dataset, ``diff`` compares all variables with their units, but no
    other attributes. The exit status is 1 if any result changed.
    """
    from rich.console import Console
    from rich.table import Table

    from riserstudy.dataset.diff import changes

    changed = changes(old, new)
    console = Console(markup=False)
    if not console.is_terminal:
        console.width = 160  # a file has no width for wrapping
    if changed.graded:
        table = Table("number or claim", "", "old", "new")
        for one in changed.graded:
            table.add_row(*one)
        console.print(table)
    if changed.varied:
        table = Table("dataset", "variable", "largest change", "")
        for name, variable, change, why in changed.varied:
            table.add_row(name, variable, "" if why else f"{change:.2g}", why)
        console.print(table)
    print(f"{len({one.item for one in changed.graded})} of {changed.rows} numbers and claims changed")
    most = f", by {changed.largest:.2g} at most" if changed.apart < len(changed.varied) else ""
    apart = f"; {counted(changed.apart, 'changed variable')} cannot be compared" if changed.apart else ""
    print(f"{len(changed.varied)} of {changed.variables} variables changed{most}{apart}")
    if changed.graded or changed.varied:
        raise typer.Exit(1)
