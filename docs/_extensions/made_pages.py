"""Parts of pages that are made from the code each time the site is built, so that they cannot be old.

A page holds ``<!-- made: NAME arguments -->`` where a part goes. Parts that pages keep for who reads a
checkout are those of ``workflow/scripts/made_parts.py``; they are made again here.
"""

from __future__ import annotations

import pkgutil
import re
import subprocess
import sys
from collections.abc import Callable
from contextlib import chdir
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment

import riserstudy
from riserstudy import effects
from riserstudy.chapters import function_of
from riserstudy.chapters.measure import measure
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.records.numerals import percent
from riserstudy.study.measured import Setting
from riserstudy.study.read import read_studies

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "workflow/scripts"))
import made_parts  # noqa: E402
from made_parts import MARK, NO_EFFECT, allowed, amount  # noqa: E402


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
    held = "" if of["holds"] else " **does not hold**"
    cells = [f"{of['name']}: {of['quantity']}", of["by"]]
    cells += [amount(of[name], of["unit"], 7) for name in ("reference", "value")]
    cells += [f"{percent(of['error'])}{held}", f"{allowed(of['tolerance'])}: {of['because']}"]
    return f"| {' | '.join(cells)} |"


@cache
def _validated() -> xr.Dataset:
    """The last run's comparisons; run now where there is none."""
    file = ROOT / "results/numerics/validation.nc"
    if file.is_file():
        return xr.load_dataset(file)
    with chdir(ROOT):  # chapters are those of the folder where one works
        study = read_studies(ROOT / "config", "numerics").measured["validation"]
        return measure("numerics", "validation", study, Setting(ROOT / "config", "standard"))


def gallery(names: str) -> str:
    """Figures as a grid, each with what it shows; its command and code unfold."""
    figures = "\n".join(_figure(*name.split("/")) for name in names.split())
    return f"::::::{{container}} exhibits\n{figures}\n::::::"


def _figure(paper: str, name: str) -> str:
    caption = str(_study(paper)["figures"][name]["caption"]).strip()
    with chdir(ROOT):  # chapters are those of the folder where one works
        module = function_of(paper, "figures", name).__module__
    source = f"../{module.replace('.', '/')}.py"
    return f"""
:::::{{container}} exhibit
![{caption}](images/gallery/{paper}_{name}.png)

**{paper}/{name}**: {caption}.

```{{raw}} html
<details><summary>command and code</summary>
```

```sh
snakemake {paper}_{name}
```

```{{literalinclude}} {source}
:pyobject: {name}
:language: python
```

```{{raw}} html
</details>
```
:::::
"""


@cache
def _study(paper: str) -> dict[str, Any]:
    """The study file of a chapter."""
    return read_yaml(ROOT / f"config/studies/{paper}.yaml")


def _rst(directive: str) -> str:
    return f"```{{eval-rst}}\n{directive}\n```\n"


MAKERS: dict[str, Callable[[str], str]] = made_parts.MAKERS | {
    maker.__name__: maker for maker in (functions, laws, coming, gallery, validation)
}


def fill(app: Sphinx, page: str, source: list[str]) -> None:
    """Put what is made in its place."""
    source[0] = MARK.sub(lambda found: MAKERS[found[1]](found[2]), source[0])


def outdated(
    app: Sphinx, env: BuildEnvironment, _added: set[str], _changed: set[str], _removed: set[str]
) -> list[str]:
    """Pages that are read again at every build: what they hold is made from other files."""
    return [page for page in env.found_docs if MARK.search(Path(env.doc2path(page)).read_text("utf-8"))]


def escape(_app: Sphinx, _what: str, _name: str, _object: object, _options: object, lines: list[str]) -> None:
    """Names such as d_+ stand in docstrings as they are read; to Sphinx an underscore there is a link."""
    lines[:] = [line if "\\" in line else re.sub(r"(?<=\w)_(?=[+-])", r"\_", line) for line in lines]


def setup(app: Sphinx) -> dict[str, bool]:
    """Fill pages as they are read."""
    app.connect("env-get-outdated", outdated)
    app.connect("source-read", fill)
    app.connect("autodoc-process-docstring", escape)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
