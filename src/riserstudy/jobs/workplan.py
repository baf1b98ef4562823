"""What the workflow has to do, as Snakemake asks for it: names, inputs and one digest a rule.

Snakemake reruns a job when a string among its params changes. Each rule therefore carries one digest
over everything that its output depends on and that Snakemake cannot see.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import Any, Self

from riserstudy.digests import digest
from riserstudy.errors import InputError
from riserstudy.folders import PACKAGE
from riserstudy.numerics.scenes import MeasuredStudy, scenes_of
from riserstudy.published.models import PublishedFile, published_path, read_published
from riserstudy.scene.check import check
from riserstudy.scene.load import SceneFile, read_yaml
from riserstudy.solve.kernel_cache import kernel_cache
from riserstudy.study.config import Config
from riserstudy.study.grid import Point
from riserstudy.study.models import StudyFile, Tier
from riserstudy.study.read import read_studies
from riserstudy.study.store import canonical, key_of
from riserstudy.study.study import Study, scene_file, threads_worth

ALL_CORES = 64  # more than there are: Snakemake gives what it has


class Workplan:
    """All studies, datasets, figures and printed numbers of the configured papers.

    Parameters
    ----------
    only : studies to check instead of all, as (paper, name): enough for the job that simulates one.

    Raises
    ------
    InputError
        When any part of the configuration, a scene or a grid point cannot be meant.
    """

    def __init__(
        self, config: Path, settings: dict[str, Any], only: list[tuple[str, str]] | None = None
    ):
        self.config = config
        self.settings = check(Config, dict(settings), config / "config.yaml")
        self.tier: Tier = self.settings.tier
        self.papers = self.settings.papers
        self.files: dict[str, StudyFile] = {p: read_studies(config, p) for p in self.papers}
        if only is None:
            self.published  # noqa: B018  what is printed is checked before any job, too
        for paper, name in self._studies if only is None else only:
            study = self.study(paper, name)
            scene_file(config / study.model.scene).scene()
            study.plan  # noqa: B018  every point is checked before any job
        if only is None:
            self.published  # noqa: B018  and so is what was printed
            for paper, file in self.files.items():
                for name in file.schematics:
                    self.schematic(paper, name).scene()

    @classmethod
    def read(
        cls, config: Path, overrides: dict[str, Any], only: list[tuple[str, str]] | None = None
    ) -> Self:
        """Read config.yaml, and let overrides win over what it says."""
        path = config / "config.yaml"
        settings = read_yaml(path, keep=True)
        if not isinstance(settings, dict):
            raise InputError(path, "", "no mapping", "it starts with names such as 'papers:'")
        return cls(config, settings | overrides, only)

    @cached_property
    def published(self) -> dict[str, PublishedFile]:
        """What papers printed."""
        return {
            paper: read_published(self.config, paper, set(file.datasets))
            for paper, file in self.files.items()
            if published_path(self.config, paper).exists()
        }

    @cached_property
    def _studies(self) -> dict[tuple[str, str], Study]:
        accuracy = self.settings.tiers[self.tier].accuracy
        return {
            (paper, name): Study(
                paper, name, model, self.config, self.tier, accuracy, file.readings
            )
            for paper, file in self.files.items()
            for name, model in file.studies.items()
        }

    @property
    def studies(self) -> list[Study]:
        """All studies of all papers."""
        return list(self._studies.values())

    def study(self, paper: str, name: str) -> Study:
        """One study, planned once."""
        return self._studies[paper, name]

    def schematic(self, paper: str, name: str) -> SceneFile:
        """The scene that a schematic shows."""
        return self.files[paper].schematics[name].file(self.config)

    # what Snakemake asks, with a rule's wildcards

    def study_digest(self, wildcards: Any) -> str:
        """Axes, point keys and the code that joins points into a dataset."""
        names = ("gather.py", "names.py", "simulation.py", "variables.yaml")
        joining = digest(PACKAGE / name for name in names)
        return f"{self.study(wildcards.paper, wildcards.study).digest}-{joining}"

    def threads(self, wildcards: Any) -> int:
        """Threads that a study can use."""
        return threads_worth(len(self.study(wildcards.paper, wildcards.study).grid))

    def shard_files(self, wildcards: Any) -> list[str]:
        """Markers of the jobs that share the points of a study; none when one job simulates all."""
        paper, study = wildcards.paper, wildcards.study
        per_job = self.settings.points_per_job
        shards = math.ceil(len(self.study(paper, study).grid) / per_job) if per_job else 1
        folder = f"results/{paper}/{study}.shards"
        return [f"{folder}/{k}-of-{shards}" for k in range(shards)] if shards > 1 else []

    def shard(self, wildcards: Any) -> list[Point]:
        """Points of a shard."""
        study = self.study(wildcards.paper, wildcards.study)
        return study.shard(int(wildcards.shard), int(wildcards.shards))

    def shard_digest(self, wildcards: Any) -> str:
        """Keys of a shard."""
        keys = " ".join(point.key for point in self.shard(wildcards))
        return hashlib.sha256(keys.encode()).hexdigest()[:16]

    def shard_threads(self, wildcards: Any) -> int:
        """Threads that a shard can use."""
        points = len(self.study(wildcards.paper, wildcards.study).grid)
        return threads_worth(math.ceil(points / int(wildcards.shards)))

    def derived_inputs(self, wildcards: Any) -> list[str]:
        """Datasets that a derived dataset is made from."""
        names = self.files[wildcards.paper].derived[wildcards.study].reads
        return [f"results/{wildcards.paper}/{name}.nc" for name in names]

    def derived_digest(self, wildcards: Any) -> str:
        """The code that derives, and what it is told."""
        settings = self.derived_settings(wildcards)
        told = hashlib.sha256(settings.encode()).hexdigest()[:16]
        return f"{told}-{self._code('derived', wildcards.paper)}"

    def derived_settings(self, wildcards: Any) -> str:
        """What it is told, as JSON."""
        return json.dumps(self.files[wildcards.paper].derived[wildcards.study].settings)

    def measured_digest(self, wildcards: Any) -> str:
        """Scenes and settings of a measured dataset, the engine, and the code that measures."""
        model = self._measured(wildcards)
        scenes = scenes_of(model, self.config, self.tier, self.studies)
        about = [self.tier, model.model_dump_json(), {n: key_of(f.scene()) for n, f in scenes}]
        code = digest(_files(PACKAGE / "numerics"))
        return f"{hashlib.sha256(json.dumps(about).encode()).hexdigest()[:16]}-{code}"

    def _measured(self, wildcards: Any) -> MeasuredStudy:
        model: MeasuredStudy = getattr(self.files[wildcards.paper].measured, wildcards.study)
        return model

    def measured_threads(self, wildcards: Any) -> int:
        """All there are for a dataset that tells times: nothing may run beside it."""
        return ALL_CORES if self._measured(wildcards).timed else 1

    def figure_inputs(self, wildcards: Any) -> list[str]:
        """Datasets that a figure reads; a schematic shows a scene and reads none."""
        figure = self.files[wildcards.paper].figures.get(wildcards.figure)
        return [f"results/{wildcards.paper}/{name}.nc" for name in figure.reads] if figure else []

    def figure_digest(self, wildcards: Any) -> str:
        """The code that draws, and what a plot for any grid, or a schematic, is to show."""
        figure = self.files[wildcards.paper].figures.get(wildcards.figure)
        if figure is None:
            scene = json.dumps(canonical(self.schematic(wildcards.paper, wildcards.figure).scene()))
            code = [*(PACKAGE / "schematic").glob("*.py"), PACKAGE / "figures/style.py"]
            return f"{hashlib.sha256(scene.encode()).hexdigest()[:16]}-{digest(code)}"
        if not figure.plot:
            return self._code("figures", wildcards.paper)
        drawing = [*(PACKAGE / "figures/generic").glob("*.py"), PACKAGE / "figures/style.py"]
        return " ".join((figure.plot, *(figure.of or []), digest(drawing)))

    def grade_inputs(self, wildcards: Any) -> list[str]:
        """Datasets that a paper's numbers and claims are graded with."""
        paper = wildcards.paper
        return [f"results/{paper}/{name}.nc" for name in self.published[paper].datasets]

    def grade_digest(self, wildcards: Any) -> str:
        """The printed numbers and claims, and the code that grades."""
        printed = digest([published_path(self.config, wildcards.paper)])
        return f"{printed}-{self._code('published', wildcards.paper)}"

    def _code(self, folder: str, paper: str) -> str:
        shared = [f for f in (PACKAGE / folder).glob("*.py") if f.stem not in self.files]
        common = (PACKAGE / "quantities").glob("*.py")
        return digest([*shared, *common, PACKAGE / folder / f"{paper}.py"])

    @property
    def report_digest(self) -> str:
        """The code of the report."""
        return digest(_files(PACKAGE / "report"))

    @property
    def study_files(self) -> list[str]:
        """Study files: the report tells captions, axes and what studies set."""
        return [str(self.config / "studies" / f"{paper}.yaml") for paper in self.papers]

    @property
    def compiled(self) -> str:
        """Marker of the kernels compiled from the present sources."""
        return str(kernel_cache() / "compiled")

    def figures(self) -> list[tuple[str, str]]:
        """All figures as (paper, name), the schematics of a paper first."""
        return [
            (paper, name)
            for paper, file in self.files.items()
            for name in (*file.schematics, *file.figures)
        ]

    def figure_files(self, paper: str | None = None) -> list[str]:
        """Files of all figures, or of those of one paper."""
        figures = [(p, name) for p, name in self.figures() if paper in (None, p)]
        return [f"results/{p}/{name}.{kind}" for p, name in figures for kind in ("png", "pdf")]

    def dataset_files(self, paper: str | None = None) -> list[str]:
        """Files of all datasets, simulated and derived, or of those of one paper."""
        return [
            f"results/{p}/{name}.nc"
            for p, file in self.files.items()
            if paper in (None, p)
            for name in file.datasets
        ]

    def graded_files(self, paper: str | None = None, kind: str = "reproduction") -> list[str]:
        """Tables of all papers that have numbers or claims, or of one of them."""
        return [f"results/{p}/{kind}.csv" for p in self.published if paper in (None, p)]

    def joined_tables(self) -> list[str]:
        """Tables over all papers, when there is anything to join."""
        return ["results/reproduction.csv", "results/errata.csv"] if self.published else []

    @property
    def study_pattern(self) -> str:
        """Names of studies, as a pattern."""
        return _either(name for file in self.files.values() for name in file.studies)

    @property
    def derived_pattern(self) -> str:
        """Names of derived datasets, as a pattern."""
        return _either(name for file in self.files.values() for name in file.derived)

    @property
    def measured_pattern(self) -> str:
        """Names of measured datasets, as a pattern."""
        return _either(
            n for file in self.files.values() if file.measured for n in file.measured.names
        )

    @property
    def figure_pattern(self) -> str:
        """Names of figures, as a pattern."""
        return _either(name for _, name in self.figures())


def _files(folder: Path) -> Iterator[Path]:
    """Files of a folder, beside which Python puts its bytecode."""
    return (path for path in folder.iterdir() if path.is_file())


def _either(names: Any) -> str:
    return "|".join(sorted({re.escape(name) for name in names})) or "(?!)"
