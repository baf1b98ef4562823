"""config/config.yaml as a model: papers and tier."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from riserstudy.errors import InputError
from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.strict import Strict
from riserstudy.study.axes import Tier
from riserstudy.study.models import Name


class TierModel(Strict):
    """A tier: the tolerance for scenes without a mesh and time step; absent: the default."""

    accuracy: str | None = None


#: names of rules that a paper may not have, because each paper has a rule of its name
RULES = {
    *("all", "compile", "compiled", "shard", "simulate", "tune", "measure", "derive", "figure"),
    *("sea_states", "hours"),
    *("figures", "grade", "reproduction", "database", "report", "everything"),
}


#: tables of verdicts of each paper and of all papers, which are files beside those of figures
GRADED = ("reproduction", "errata", "margins", "false_claims")


class Config(Strict):
    """config/config.yaml.

    ``points_per_job``: a study with more points is simulated by several jobs. Absent: one job for each study.
    ``units``: units of plots that fit any grid and of tables of limits in the report: ``si``, ``field`` (kN
    and MPa, the default) or ``us`` (feet and kips).
    """

    papers: list[Name] = Field(min_length=1)
    tier: Literal["preview", "standard", "reference"]
    tiers: dict[Tier, TierModel]
    points_per_job: Annotated[int, Field(ge=1)] | None = None
    units: Literal["si", "field", "us"] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.tier not in self.tiers:
            found = f"the tier {self.tier!r}, which is to run, is missing here"
            raise Misfit("tiers", found, f"add {self.tier!r}, or choose another tier")
        if len(set(self.papers)) != len(self.papers):
            raise Misfit("papers", "a paper occurs twice", "name each paper once")
        if taken := RULES.intersection(self.papers):
            raise Misfit(
                "papers", f"{taken.pop()!r} is a name that the workflow uses itself", "give another name"
            )
        return self


def read_config(path: Path) -> dict[str, Any]:
    """The fields of config.yaml, not yet checked. Raises InputError when the file cannot be read."""
    tree = read_yaml(path, keep=True)
    if not isinstance(tree, dict):
        allowed = "write fields, each as 'name: value', such as 'papers: [own]'"
        raise InputError(path, "", "this is not a configuration", allowed)
    return tree
