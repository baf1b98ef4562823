"""Parts of documentation pages that are generated from the code, and committed for readers of a checkout.

A page contains ``<!-- made: NAME arguments -->``, the part, and ``<!-- end -->``. The build of the site
generates each part again.
"""

from __future__ import annotations

import ast
import pkgutil
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import typer
import typer.cli

from effect_drawings import file_of
from riserstudy import cli, effects
from riserstudy.dataset.variables import variables
from riserstudy.effects.catalogue import catalogue
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.records.numerals import plain
from riserstudy.scene.models import Scene
from scene_reference import models

if TYPE_CHECKING:
    import xarray as xr

ROOT = Path(__file__).resolve().parents[2]
#: place of a generated part in a page, with the part itself if the page contains it
MARK = re.compile(r"<!-- made: (\w+)([^>]*?)-->(?P<kept>\n(?:(?!<!-- made:).)*?<!-- end -->)?", re.DOTALL)
LONGEST_HELP = 1000  # characters; longer than any help text, which is thus never cut
NO_EFFECT = ("catalogue", "registry")  # modules of the folder without an effect
TABLE = "|---|---|---|---|"


def commands(_: str) -> str:
    """Return all commands with their arguments and options, from Typer's generator of documentation."""
    command = typer.main.get_command(cli.app)
    context = typer.Context(command, info_name="riserstudy")
    text = typer.cli.get_docs_for_click(obj=command, ctx=context, name="riserstudy")
    text = text.partition("\n")[2]  # the page has its own title
    text = _with_whole_help(text, getattr(command, "commands", {}))
    text = re.sub(r"^\* `--help`.*\n", "", text, flags=re.MULTILINE)
    return re.sub(r"^\*\*Options\*\*:\n\n(?!\*)", "", text, flags=re.MULTILINE)


def _with_whole_help(text: str, commands: Mapping[str, Any]) -> str:
    """Return the list of commands with the whole first sentence of each, which Typer truncates."""
    for name, command in commands.items():
        message = str(command.get_short_help_str(LONGEST_HELP))
        text = re.sub(rf"^\* `{name}`: .*$", f"* [`{name}`](#riserstudy-{name}): {message}", text, flags=re.M)
    return text


def called_by(_: str) -> str:
    """Return the effects, each with its drawing and the part of a scene that includes it."""
    rows = [
        f"| ![drawing: {name}](images/effects/{file_of(name)}) | {name} "
        f"| {' '.join(_with_code(effect.requires.split()))} |"
        for name, effect in catalogue().items()
    ]
    return "\n".join(["| | effect | included by |", "|---|---|---|", *rows])


def files_of_effects(_: str) -> str:
    """Return all files of effects with the first sentence of their docstrings and links to their formulas."""
    rows = []
    for module in pkgutil.iter_modules(effects.__path__):
        if module.name not in NO_EFFECT:
            path = f"src/riserstudy/effects/{module.name}.py"
            text = ast.get_docstring(ast.parse((ROOT / path).read_text("utf-8"))) or ""
            first = " ".join(text.partition("\n\n")[0].split()).rstrip(".")
            rows.append(f"| [`{module.name}`](../{path}) | {first} |")
    return "\n".join(["| file | effect |", "|---|---|", *rows])


def quantities(_: str) -> str:
    """Return the variables of datasets with their units."""
    rows = [
        f"| `{name}` | {about.get('units', '')} | {_in_words(about)} |" for name, about in variables().items()
    ]
    return "\n".join(["| variable | unit | |", "|---|---|---|", *rows])


def _in_words(about: dict[str, str]) -> str:
    return ": ".join(about[key] for key in ("long_name", "comment") if key in about)


def others(_: str) -> str:
    """Return the smallest displacement error of other simulators in the last `make bench`, and their time."""
    study = read_yaml(ROOT / "config/studies/numerics.yaml")["measured"]["accuracy"]
    rows = [
        f"| {scene} | {peer} | {100 * error:g} % | {ratio:g} |"
        for scene, peers in study["peers"].items()
        for peer, reached in peers.items()
        for error, ratio in [min(reached)]
    ]
    head = "| scene | simulator | smallest error reached | run time relative to riserstudy |"
    return "\n".join([head, TABLE, *rows])


def known(found: xr.Dataset, kind: str) -> str:
    """Return the comparisons of the engine with one kind of reference: known quantity and tolerance."""
    rows = []
    for k in np.flatnonzero(found["kind"] == kind.strip()):
        of = {str(name): variable.item() for name, variable in found.isel(row=k).data_vars.items()}
        cells = [f"{of['name']}: {of['quantity']}", of["by"], amount(of["reference"], of["unit"], 4)]
        rows.append(f"| {' | '.join(cells)} | {allowed(of['tolerance'])}: {of['because']} |")
    return "\n".join(["| Number | Reference | Known | Tolerance, and why |", TABLE, *rows])


def amount(value: float, unit: str, digits: int) -> str:
    """Return a value with its SI unit and without an exponent; forces and energies from 10 kN or 10 kJ on."""
    if unit[0] in "NJ" and abs(value) >= 1e4:
        return amount(value / 1e3, f"k{unit}", digits)
    return plain(value, digits) + ("" if unit == "1" else f" {unit}")


def allowed(tolerance: float) -> str:
    """Return a relative tolerance (1) in per cent, with one digit."""
    return f"{plain(100.0 * tolerance, 1)} %"


def _with_code(words: list[str]) -> Iterator[str]:
    """Return words with keys and paths of a scene as code, such as both in "top.tension or stop"."""
    keys = {key for model in models() for key in model.model_fields}
    for word, last in zip(words, ["", *words], strict=False):
        bare = word.rstrip(",")
        named = "." in bare or "_" in bare or bare in Scene.model_fields or (last == "or" and bare in keys)
        yield f"`{bare}`{word[len(bare) :]}" if named else word


MAKERS: dict[str, Callable[[str], str]] = {
    maker.__name__: maker for maker in (commands, called_by, files_of_effects, quantities, others)
}


def kept_pages() -> dict[Path, str]:
    """Return the correct texts of pages with generated parts; parts that need runs are unchanged."""
    texts = {path: path.read_text("utf-8") for path in sorted((ROOT / "docs").glob("*.md"))}
    kept = {path: text for path, text in texts.items() if any(m["kept"] for m in MARK.finditer(text))}
    return {path: with_parts(text, MAKERS) for path, text in kept.items()}


def with_parts(text: str, makers: Mapping[str, Callable[[str], str]]) -> str:
    """Return a page with its parts generated again, for all parts that have a maker."""

    def part(found: re.Match[str]) -> str:
        if not found["kept"] or found[1] not in makers:
            return found[0]
        head = found[0].partition("-->")[0]
        return f"{head}-->\n{makers[found[1]](found[2]).strip()}\n<!-- end -->"

    return MARK.sub(part, text)


def write_validation(found: xr.Dataset) -> None:
    """Write the engine's comparisons into their page, from a dataset of the validation study."""
    page = ROOT / "docs/validation.md"
    makers = {"validation": lambda kind: known(found, kind)}
    page.write_text(with_parts(page.read_text("utf-8"), makers), "utf-8")
