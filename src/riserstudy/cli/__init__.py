"""The commands of ``riserstudy``, each a thin layer over the function that it is named after.

A command has a function, an entry in ``GROUPS``, and an example.
"""

from __future__ import annotations

import atexit
import gc
import io
import sys
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

import riserstudy
from riserstudy.blas import use_one_thread
from riserstudy.cli import (
    analyse,
    check,
    compare,
    design,
    disconnect,
    downtime,
    fatigue,
    files,
    offsets,
    outputs,
    results,
    seas,
    simulate,
    tune,
)
from riserstudy.cli.definitions import where_defined
from riserstudy.cli.examples import EXAMPLES
from riserstudy.errors import RiserStudyError, printable

OBJECTS = (50_000, 20, 100)  # thresholds of the garbage collection

#: commands by purpose, in the order of the help
GROUPS: dict[str, tuple[Any, ...]] = {
    "Simulate": (simulate.run, check.check, analyse.modes, tune.tune, simulate.rerun),
    "Inspect": (
        outputs.plot, outputs.table, outputs.statistics, compare.compare, files.draw,
        analyse.cost, analyse.effects, analyse.advise,
    ),
    "Design": (
        design.tension, offsets.operability, offsets.envelope, design.viv,
        disconnect.watch_circles, disconnect.recoil, seas.seas, downtime.downtime, fatigue.fatigue,
    ),
    "Files": (files.import_deck, files.export_deck, files.new, files.schema),
    "Results": (results.results, results.sql, results.verify, results.prune,
        results.crate, results.diff,
    ),
}  # fmt: skip
NAMES: dict[Any, str] = {
    files.import_deck: "import",
    files.export_deck: "export",
    disconnect.watch_circles: "watch-circles",
}  # names of commands that differ from names of functions

app = typer.Typer(
    name="riserstudy", no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False
)


def _version(requested: bool) -> None:
    if requested:
        print(f"riserstudy {riserstudy.__version__}")
        raise typer.Exit


@app.callback()
def about(
    version: Annotated[
        bool, typer.Option("--version", is_eager=True, callback=_version, help="print the version")
    ] = False,
) -> None:
    """Simulate deepwater drilling risers and check them against limits."""


class Command(TyperCommand):
    """A command whose help shows square brackets, which rich otherwise takes for markup and omits."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help."""
        from rich.markup import escape

        text = self.help
        self.help = escape(text or "")
        super().format_help(ctx, formatter)
        self.help = text


for group, commands in GROUPS.items():
    for command in commands:
        name = NAMES.get(command, command.__name__)
        example = f"Example: {EXAMPLES[name]}"
        app.command(name, cls=Command, rich_help_panel=group, epilog=example)(command)


def main() -> None:
    """Run the command line; errors are printed on stderr in one line, with their exit code."""
    use_one_thread()
    _collect_seldom()
    _print_anything()
    try:
        if status := app(standalone_mode=False):  # exit status of the command
            sys.exit(status)
    except typer.Exit as done:
        sys.exit(done.exit_code)
    except (typer.Abort, KeyboardInterrupt):
        sys.exit(130)
    except RiserStudyError as error:
        print(f"riserstudy: {error}{where_defined(error)}", file=sys.stderr)
        sys.exit(error.exit_code)
    except Exception as error:
        if hasattr(error, "format_message"):  # a usage error of the command line
            print(f"riserstudy: command line: {printable(error.format_message())}", file=sys.stderr)
            sys.exit(2)
        raise


def _print_anything() -> None:
    """Print escapes for characters that the encoding of the output lacks, instead of failing at them."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _collect_seldom() -> None:
    """Make garbage collections rare, and omit the last one at exit, which would take half a second."""
    gc.set_threshold(*OBJECTS)
    atexit.register(gc.freeze)
