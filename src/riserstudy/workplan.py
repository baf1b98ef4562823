"""What the workflow has to do, as Snakemake asks for it: names, inputs and one digest a rule.

Snakemake reruns a job when a string among its params changes. Each rule therefore carries one digest
over everything that its output depends on and that Snakemake cannot see.
"""

from __future__ import annotations

import re
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

from pydantic import Field

from riserstudy.folders import PACKAGE, digest, kernel_cache
from riserstudy.scene.load import check
from riserstudy.scene.models import Strict
from riserstudy.study import Study, StudyFile, Tier, read_studies, threads_worth


class TierModel(Strict):
    """A tier: the accuracy asked of scenes that name no mesh and step; absent: the default."""

    accuracy: str | None = None


class Config(Strict):
    """config/config.yaml."""

    papers: list[str] = Field(min_length=1)
    tier: Literal["preview", "standard", "reference"]
    tiers: dict[Tier, TierModel]


class Workplan:
    """All studies, datasets and figures of the configured papers.

    Raises
    ------
    InputError
        When any part of the configuration, a scene or a grid point cannot be meant.
    """

    def __init__(self, config: Path, settings: dict[str, Any]):
        self.config = config
        self.settings = check(Config, dict(settings), config / "config.yaml")
        self.tier: Tier = self.settings.tier
        self.papers = self.settings.papers
        self.files: dict[str, StudyFile] = {p: read_studies(config, p) for p in self.papers}
        for paper, file in self.files.items():
            for name in file.studies:
                self.study(paper, name).plan  # noqa: B018  every point is checked before any job

    @cached_property
    def _studies(self) -> dict[tuple[str, str], Study]:
        accuracy = self.settings.tiers[self.tier].accuracy
        return {
            (paper, name): Study(paper, name, model, self.config, self.tier, accuracy)
            for paper, file in self.files.items()
            for name, model in file.studies.items()
        }

    def study(self, paper: str, name: str) -> Study:
        """One study, planned once."""
        return self._studies[paper, name]

    # what Snakemake asks, with a rule's wildcards

    def study_digest(self, wildcards: Any) -> str:
        """Axes, point keys and the code that joins points into a dataset."""
        joining = digest(
            [PACKAGE / name for name in ("gather.py", "simulation.py", "variables.yaml")]
        )
        return f"{self.study(wildcards.paper, wildcards.study).digest}-{joining}"

    def threads(self, wildcards: Any) -> int:
        """Threads that a study can use."""
        return threads_worth(len(self.study(wildcards.paper, wildcards.study).plan))

    def derived_inputs(self, wildcards: Any) -> list[str]:
        """Datasets that a derived dataset is made from."""
        names = self.files[wildcards.paper].derived[wildcards.study]
        return [f"results/{wildcards.paper}/{name}.nc" for name in names]

    def derived_digest(self, wildcards: Any) -> str:
        """The code that derives."""
        return self._code("derived", wildcards.paper)

    def figure_inputs(self, wildcards: Any) -> list[str]:
        """Datasets that a figure reads."""
        names = self.files[wildcards.paper].figures[wildcards.figure].reads
        return [f"results/{wildcards.paper}/{name}.nc" for name in names]

    def figure_digest(self, wildcards: Any) -> str:
        """The code that draws."""
        return self._code("figures", wildcards.paper)

    def _code(self, folder: str, paper: str) -> str:
        shared = [f for f in (PACKAGE / folder).glob("*.py") if f.stem not in self.files]
        return digest([*shared, PACKAGE / folder / f"{paper}.py"])

    @property
    def compiled(self) -> str:
        """Marker of the kernels compiled from the present sources."""
        return str(kernel_cache() / "compiled")

    def figures(self) -> list[tuple[str, str]]:
        """All figures as (paper, name)."""
        return [(paper, name) for paper, file in self.files.items() for name in file.figures]

    def figure_files(self, paper: str | None = None) -> list[str]:
        """Files of all figures, or of those of one paper."""
        return [f"results/{p}/{name}.png" for p, name in self.figures() if paper in (None, p)]

    @property
    def study_pattern(self) -> str:
        """Names of studies, as a pattern."""
        return _either(name for file in self.files.values() for name in file.studies)

    @property
    def derived_pattern(self) -> str:
        """Names of derived datasets, as a pattern."""
        return _either(name for file in self.files.values() for name in file.derived)

    @property
    def figure_pattern(self) -> str:
        """Names of figures, as a pattern."""
        return _either(name for file in self.files.values() for name in file.figures)


def _either(names: Any) -> str:
    return "|".join(sorted({re.escape(name) for name in names})) or "(?!)"
