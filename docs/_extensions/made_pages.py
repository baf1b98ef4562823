"""Parts of pages that are made from the code each time the site is built, so that they cannot be old.

A page holds ``<!-- made: NAME arguments -->`` where a part goes.
"""

from __future__ import annotations

import importlib
import pkgutil
import re
import subprocess
import sys
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import typer
import typer.cli
import xarray as xr
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment

import riserstudy
from riserstudy import cli, effects
from riserstudy.chapters import function_of
from riserstudy.dataset.variables import variables
from riserstudy.effects.catalogue import catalogue
from riserstudy.folders import PACKAGE
from riserstudy.numerics.measure import measure
from riserstudy.numerics.scenes import Setting
from riserstudy.scene.load import read_yaml
from riserstudy.study.read import read_studies

ROOT = Path(__file__).resolve().parents[2]
MARK = re.compile(r"<!-- made: (\w+)(.*?)-->", re.DOTALL)
LONGEST_HELP = 1000  # characters: none is cut
NO_EFFECT = ("catalogue", "registry")  # modules of the folder that hold none


def commands(_: str) -> str:
    """Every command with its arguments and options, by Typer's own writer of documentation."""
    command = typer.main.get_command(cli.app)
    context = typer.Context(command, info_name="riserstudy")
    text = typer.cli.get_docs_for_click(obj=command, ctx=context, name="riserstudy")
    text = text.partition("\n")[2]  # the page has a title
    text = _with_whole_help(text, getattr(command, "commands", {}))
    text = re.sub(r"^\* `--help`.*\n", "", text, flags=re.MULTILINE)
    return re.sub(r"^\*\*Options\*\*:\n\n(?!\*)", "", text, flags=re.MULTILINE)


def _with_whole_help(text: str, commands: Mapping[str, Any]) -> str:
    """The list of commands with the whole first sentence of each, which Typer cuts short."""
    for name, command in commands.items():
        said = str(command.get_short_help_str(LONGEST_HELP))
        text = re.sub(
            rf"^\* `{name}`: .*$", f"* [`{name}`](#riserstudy-{name}): {said}", text, flags=re.M
        )
    return text


def functions(_: str) -> str:
    """What ``import riserstudy`` offers."""
    names = [name for name in riserstudy.__all__ if not name.startswith("_")]
    return "\n".join(_rst(f".. autofunction:: riserstudy.{name}") for name in names)


def laws(_: str) -> str:
    """Every file of effects: what it says at its head."""
    parts = []
    for module in pkgutil.iter_modules(effects.__path__):
        if module.name not in NO_EFFECT:
            name = f"riserstudy.effects.{module.name}"
            title = module.name.replace("_", " ").capitalize()
            parts.append(f"## {title}\n\n`{name}`\n\n" + _rst(f".. automodule:: {name}"))
    return "\n".join(parts)


def called_by(_: str) -> str:
    """Effects with the part of a scene that calls for each."""
    rows = [f"| {name} | {' '.join(_code(word) for word in effect.section.split())} |"
            for name, effect in catalogue().items()]  # fmt: skip
    return "\n".join(["| effect | called for by |", "|---|---|", *rows])


def quantities(_: str) -> str:
    """Variables of datasets with their units."""
    rows = [
        f"| `{name}` | {about.get('units', '')} | {_told(about)} |"
        for name, about in variables().items()
    ]
    return "\n".join(["| variable | unit | |", "|---|---|---|", *rows])


def _told(about: dict[str, str]) -> str:
    return ": ".join(about[key] for key in ("long_name", "comment") if key in about)


def coming(_: str) -> str:
    """Notes of what the next release brings, as Towncrier would join them."""
    command = [sys.executable, "-m", "towncrier", "build", "--draft", "--version", "Unreleased"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return "\n" + done.stdout.partition("## ")[2].partition("\n")[2]


def validation(kind: str) -> str:
    """What the engine computes, compared with what is known by one kind of reference."""
    found = _validated()
    rows = [_compared(found.isel(row=k)) for k in np.flatnonzero(found["kind"] == kind.strip())]
    head = "| Number | Reference | Known | Computed | Error | Tolerance, and why |"
    return "\n".join([head, "|---|---|---|---|---|---|", *rows])


def _compared(row: xr.Dataset) -> str:
    """A number compared with what is known, as a line of a table."""
    of = {str(name): variable.item() for name, variable in row.data_vars.items()}
    unit = "" if of["unit"] == "1" else f" {of['unit']}"
    held = "" if of["holds"] else " **does not hold**"
    cells = [f"{of['name']}: {of['quantity']}", of["by"]]
    cells += [f"{of[name]:.7g}{unit}" for name in ("reference", "value")]
    cells += [f"{of['error']:.1e}{held}", f"{of['tolerance']:.0e}: {of['because']}"]
    return f"| {' | '.join(cells)} |"


@cache
def _validated() -> xr.Dataset:
    """The last run's comparisons; run now where there is none."""
    file = ROOT / "results/numerics/validation.nc"
    if file.is_file():
        return xr.load_dataset(file)
    study = read_studies(ROOT / "config", "numerics").measured.validation
    return measure("numerics validation", study, Setting(ROOT / "config", "standard"))


def others(_: str) -> str:
    """Least error of displacement that other simulators reached in the last `make bench`, and their time."""
    measured = read_studies(ROOT / "config", "numerics").measured.accuracy
    rows = [
        f"| {scene} | {peer} | {100 * error:g} % | {ratio:g} |"
        for scene, peers in measured.peers.items()
        for peer, reached in peers.items()
        for error, ratio in [min(reached)]
    ]
    return "\n".join(
        [
            "| scene | simulator | finest level reached | times riserstudy's time |",
            "|---|---|---|---|",
            *rows,
        ]
    )


def gallery(names: str) -> str:
    """Figures with what they show and the lines that draw them."""
    return "\n".join(_figure(*name.split("/")) for name in names.split())


def _figure(paper: str, name: str) -> str:
    study = read_yaml(ROOT / f"config/studies/{paper}.yaml")
    caption = str(study["figures"][name]["caption"]).strip()
    module = importlib.import_module(function_of(paper, "figures", name).__module__)
    source = Path(str(module.__file__)).relative_to(PACKAGE.parent)
    return f"""
:::::{{container}} exhibit
![{caption}](images/gallery/{paper}_{name}.png)

**{paper}/{name}**: {caption}.

```sh
snakemake {paper}_{name}
```

::::{{container}} lines
```{{literalinclude}} ../src/{source}
:pyobject: {name}
:language: python
```
::::
:::::
"""


def _code(word: str) -> str:
    """A path of a scene as code; the words between as they are."""
    bare = word.rstrip(",")
    return f"`{bare}`{word[len(bare) :]}" if "." in bare or "_" in bare else word


def _rst(directive: str) -> str:
    return f"```{{eval-rst}}\n{directive}\n```\n"


MAKERS: dict[str, Callable[[str], str]] = {
    maker.__name__: maker
    for maker in (
        commands,
        functions,
        laws,
        called_by,
        quantities,
        coming,
        gallery,
        validation,
        others,
    )
}


def fill(app: Sphinx, page: str, source: list[str]) -> None:
    """Put what is made in its place."""
    source[0] = MARK.sub(lambda found: MAKERS[found[1]](found[2]), source[0])


def outdated(
    app: Sphinx, env: BuildEnvironment, _added: set[str], _changed: set[str], _removed: set[str]
) -> list[str]:
    """Pages that are read again at every build: what they hold is made from other files."""
    return [
        page for page in env.found_docs if MARK.search(Path(env.doc2path(page)).read_text("utf-8"))
    ]


def escape(
    _app: Sphinx, _what: str, _name: str, _object: object, _options: object, lines: list[str]
) -> None:
    """Names such as d_+ stand in docstrings as they are read; to Sphinx an underscore there is a link."""
    lines[:] = [
        line if "\\" in line else re.sub(r"(?<=\w)_(?=[+-])", r"\_", line) for line in lines
    ]


def setup(app: Sphinx) -> dict[str, bool]:
    """Fill pages as they are read."""
    app.connect("env-get-outdated", outdated)
    app.connect("source-read", fill)
    app.connect("autodoc-process-docstring", escape)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
