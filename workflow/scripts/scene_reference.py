"""Write the reference page of scene files from the models."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from typing import Annotated, Any, Literal, get_args, get_origin

from annotated_types import Ge, Gt, Le, Lt
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from riserstudy.inputs.percent import Percent
from riserstudy.scene.models import Scene
from riserstudy.scene.tables import PLACES
from riserstudy.scene.units import Unit, usual_units

HEAD = """\
# Scene files

<!-- Written by workflow/scripts/make_reference.py from the models; edits here are lost. -->

A scene is a YAML file that describes one riser, its supports, its motions and its surroundings. **The engine
(simulation program) simulates only what the scene contains**: no default value adds a physical effect. The
command `riserstudy effects SCENE.yaml` lists the effects (physical mechanisms) of a scene file, and the line
of the file that includes each effect.

Write each value with the unit of its source, such as `21 in`, `27 kN*m/deg` or `2.5 knot`. The engine
converts all values of a scene to SI units. The section [Units](#units) lists the unit names. The engine
refuses a value without a unit if the key of this value requires a unit. The unit of a rotational stiffness
must contain `/deg` or `/rad`. Elevations increase upwards from one datum, which you can choose freely.
Arclengths along the riser start at its lower end.

Every value of a scene has an origin, which states where the value comes from. If the scene has the key
`paper`, a value without a stated origin is *published*: the paper prints it. In a scene without the key
`paper`, a value without a stated origin is *given*: you know it. Write an origin other than *published* or
*given* together with the value, as in the following examples of origins:

```yaml
count: {assumed: 6, options: [6, 7], because: "six make the pull that the paper states"}
pin_length: {assumed: 24 m, range: [22.5 m, 30 m], because: "the retracted body is longer than 15 m"}
roll_centre: {calibrated: 4.5 m, to: paper/ID of the number it was fitted to}
added_mass: {derived: 1198 kg/m, from: "Ca rho pi D^2/4"}
interval: {chosen: 0.1 s, because: "output interval of the run"}
```

An *assumed* value is your estimate of an unknown value; the key `range` or `options` can give other possible
values. A study (a set of simulations) can vary all assumed values with a `range` or `options` together. A
*calibrated* value was fitted to a published number. A *derived* value was computed from other values. A
*chosen* value does not describe the riser; examples are the datum of elevations and the output interval. For
each paper, a file in `config/published` can contain a list `inputs`, which names the values that the paper
prints. In a scene of a paper with the list `inputs`, every value without a stated origin must be in this
list.

You can give a table as a CSV file in the folder of the scene file, for example `profile: {file:
current.csv}`. The first line of the CSV file gives the names of the columns with their units, in any order.
The following list names the keys that accept a CSV file, and the columns of each CSV file:

%s

In the table of response amplitude operators (`operators`), each motion can have a second column for its
phase, for example `heave_phase`.

An editor that supports JSON schemas (descriptions of allowed keys and values) can complete and check scene
files. The command `riserstudy schema` prints the schema,
[`scene.schema.json`](../workflow/schemas/scene.schema.json). To use the schema `scene.schema.json` in an
editor, write the following comment in the first line of a scene file. The path of the schema in this comment
is relative to the folder of the scene file.

```yaml
# yaml-language-server: $schema=../../../workflow/schemas/scene.schema.json
```
"""


def scene_reference() -> str:
    """Return the page as Markdown."""
    keys: dict[str, list[str]] = {}  # keys of tables, by the names of their columns
    for place in PLACES:
        columns = ", ".join(" or ".join(f"`{n}`" for n in names) for names in place.columns)
        more = f", and optionally {_named(place.optional)}" if place.optional else ""
        keys.setdefault(columns + more, []).append(f"`{'.'.join((*place.way, place.name))}`")
    tables = [f"- {', '.join(names)}: columns {columns}" for columns, names in keys.items()]
    parts = [HEAD % "\n".join(tables), units()]
    described_in: dict[str | None, str] = {}  # first model with a docstring, by the docstring
    for model in models():
        first = described_in.setdefault(model.__doc__, title(model))
        parts.append(f"## {title(model)}\n\n{_prose(model, first)}\n")
        rows = [f"| `{name}` | {described(field)} |" for name, field in model.model_fields.items()]
        parts.append("| key | value |\n|---|---|\n" + "\n".join(rows) + "\n")
    return "\n".join(parts)


def _named(columns: tuple[str, ...]) -> str:
    """Names of columns, without phases of motions, which the text around the list explains."""
    return ", ".join(f"`{name}`" for name in columns if not name.endswith("_phase"))


UNITS = """\
## Units

A unit is a product or a quotient of names, with powers, for example `kN*m/deg`, `lb/ft` or `m^2`. The
following table lists the usual unit names, grouped by SI unit. A scene can also contain other units that the
Python library pint knows. A pressure requires the word `absolute` or `gauge` after its unit; a modulus or a
stress does not require this word. The name `t` is a tonne, `short_ton` is 2000 lb, and `gal` is a US gallon.
A barrel (`bbl`) is 42 US gallons. The names `t` and `lb` are units of mass; `tf` (tonne-force), `lbf` and
`kip` are units of force. The engine refuses the name `ton`, because it can mean 1000 kg, 2000 lb or 2240 lb.

| SI unit | names |
|---|---|
"""


def units() -> str:
    """Return the section with the names of usual units, by SI unit."""
    rows = [
        f"| `{unit}` | {', '.join(f'`{name}`' for name in names)} |" for unit, names in usual_units().items()
    ]
    return UNITS + "\n".join(rows) + "\n"


def models(first: type[BaseModel] = Scene) -> list[type[BaseModel]]:
    """Return a model and every model below it, each after the model that first mentions it."""
    reached = [first]
    for field in first.model_fields.values():
        for below in _models_in(field.annotation):
            reached += [model for model in models(below) if model not in reached]
    return reached


def _models_in(kind: Any) -> Iterator[Any]:
    if inspect.isclass(kind) and issubclass(kind, BaseModel):
        yield kind
    for part in get_args(kind):
        yield from _models_in(part)


def _prose(model: type[BaseModel], first_model: str) -> str:
    """Return the docstring of a model, with its first sentence as a subtitle; the rest only once."""
    text = (inspect.getdoc(model) or "").replace("``", "`")
    first, _, others = re.sub(r"\.(\s+|$)", "\0", text, count=1).partition("\0")
    if title(model) != first_model:
        others = f"The text of the section {_link(first_model)} also applies here."
    return f"*{first}*\n\n{others}".rstrip()


def title(model: type[BaseModel]) -> str:
    """Return the name of a model as a heading, with the parameter of a generic model after "of"."""
    return model.__name__.replace("[", " of ").replace("]", "")


def _link(heading: str) -> str:
    return f"[{heading}](#{heading.lower().replace(' ', '-')})"


def described(field: FieldInfo) -> str:
    """Describe the values that a field accepts, and state whether it is required."""
    text = describe(field.annotation, field.metadata)
    return f"{text}; required" if field.is_required() else text


def describe(kind: Any, limits: list[Any]) -> str:
    """Describe in words the values that a type accepts."""
    if get_origin(kind) is Annotated:
        inner, *more = get_args(kind)
        for extra in more:
            limits = [*limits, *(extra.metadata if isinstance(extra, FieldInfo) else [extra])]
        return describe(inner, limits)
    choices = get_args(kind)
    if get_origin(kind) is Literal:
        return " or ".join(f"`{choice}`" for choice in choices)
    if get_origin(kind) is list:
        return _several(describe(choices[0], []))
    if type(None) in choices:
        return " or ".join(describe(c, limits) for c in choices if c is not type(None))
    if choices and not inspect.isclass(kind):
        return " or ".join(describe(choice, limits) for choice in choices)
    if inspect.isclass(kind) and issubclass(kind, BaseModel):
        return _link(title(kind))
    return _plain(kind, limits)


def _several(text: str) -> str:
    """Describe a list of values, of which each is described by the text."""
    for one in ("whole number", "number", "text", "quantity"):
        if text == one or text.startswith((f"{one},", f"{one} such as")):
            many = "quantities" if one == "quantity" else f"{one}s"
            return f"list of {many}{text[len(one) :].replace(', ', ', each ', 1)}"
    return f"list of {text}"


def _plain(kind: Any, limits: list[Any]) -> str:
    units = [limit.name for limit in limits if isinstance(limit, Unit)]
    percent = any(limit in get_args(Percent)[1:] for limit in limits)
    names = {float: "number", int: "whole number", str: "text", bool: "true or false"}
    text = f"quantity such as `1 {units[0]}`" if units else names[kind]
    if units == ["Pa"]:
        text = "pressure such as `1 bar absolute` or `1 bar gauge`"
    if percent:
        return "percentage such as `1 %`"
    bounds = {Gt: ("gt", "above"), Ge: ("ge", "from"), Lt: ("lt", "below"), Le: ("le", "up to")}
    for limit in limits:
        if type(limit) in bounds:
            attribute, word = bounds[type(limit)]
            text += f", {word} {getattr(limit, attribute):g}"
    return text
