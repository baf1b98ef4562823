"""Plan of the workflow: names, inputs and one digest for each rule.

Snakemake reruns a job when a string among its params changes. Each rule therefore has one digest over
everything that its output depends on and that Snakemake cannot see, including all imported code.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
import shlex
from collections.abc import Set
from pathlib import Path
from typing import Any, Literal

from riserstudy.figures import module_of_plot
from riserstudy.files.chapters import chapter_modules, variables_of_chapter
from riserstudy.files.digests import defining, dependencies, digest
from riserstudy.grading.false_claims import false_claims_path
from riserstudy.grading.printed import with_printed
from riserstudy.grading.published import published_path
from riserstudy.grading.words_of_size_file import words_path
from riserstudy.jobs.configuration import Configuration
from riserstudy.simulation.compile import marker
from riserstudy.simulation.kernel_groups import GROUPS
from riserstudy.study.config import GRADED
from riserstudy.study.grid import Point
from riserstudy.study.measured import MeasuredModel, Setting
from riserstudy.study.store import canonical, key_of
from riserstudy.study.study import settings_path, threads_worth

#: modules that join points, derive, grade and report
COLLECT, DERIVE = "riserstudy.study.write_study", "riserstudy.chapters.derive"
MEASURE = "riserstudy.chapters.measure"
SETTINGS = "riserstudy.study.settings"
SEAS = "riserstudy.seas.seas_hours"
GRADE = "riserstudy.grading.falsify"  # it imports the grading itself
REPORT = "riserstudy.report"
DATABASE = "riserstudy.database.build"
SIDE_BY_SIDE = 8  # threads that the jobs of one study of a record share
ALL_CORES = 64  # more than any machine has: Snakemake reduces it
TIMED, STUDIES, KERNELS, EARLY_RESULTS = 1, 2, 3, 4  # priorities
FIRST = "line"  # group of kernels for the first results
EARLY = 64  # most points of a study that is simulated before other kernels are compiled
#: strings compile within seconds, and measurements wait for all kernels
COMPILED_IN_ORDER = ("hermite", FIRST, "string", "plane", "space")


class Workplan(Configuration):
    """Inputs, outputs and one digest of each rule."""

    # grids

    def study_digest(self, paper: str, study: str) -> str:
        """Digest of axes, point keys and the code that joins points into a dataset."""
        return f"{self.study(paper, study).digest}-{digest(dependencies(COLLECT) | _named(paper))}"

    def settings_files(self, paper: str, study: str, *_shard: str) -> list[str]:
        """The file with the tuned settings of a study; empty for a study that is not tuned."""
        tuned = self.files[paper].studies[study].settings
        return [settings_path(Path("results"), paper, study).as_posix()] if tuned else []

    def settings_option(self, paper: str, study: str, *_shard: str) -> str:
        """Command-line option that passes this file to a job; empty without a file."""
        return " ".join(f"--settings {shlex.quote(file)}" for file in self.settings_files(paper, study))

    def settings_digest(self, paper: str, study: str) -> str:
        """Digest of axes and point keys of a study, and of the code that tunes."""
        return f"{self.study(paper, study).digest}-{digest(dependencies(SETTINGS))}"

    def threads(self, paper: str, study: str) -> int:
        """Number of threads that a study can use."""
        return threads_worth(len(self.study(paper, study).grid))

    def shard_files(self, paper: str, study: str) -> list[str]:
        """Markers of the jobs that share the points of a study; empty when one job simulates all."""
        shards = self.shards(paper, study)
        folder = f"results/{paper}/{study}.shards"
        return [f"{folder}/{k}-of-{shards}" for k in range(1, shards + 1)] if shards > 1 else []

    def kernels(self, paper: str, study: str, *_shard: str) -> list[str]:
        """Markers of the groups of kernels that a study uses."""
        return [self.kernels_of(group) for group in self.study(paper, study).kernel_groups]

    def shard(self, paper: str, study: str, shard: str, shards: str) -> list[Point]:
        """Points of a shard."""
        return self.study(paper, study).shard(int(shard), int(shards))

    def shard_digest(self, paper: str, study: str, shard: str, shards: str) -> str:
        """Digest of the point keys of a shard."""
        return _hash(" ".join(point.key for point in self.shard(paper, study, shard, shards)))

    def shard_threads(self, paper: str, study: str, shard: str, shards: str) -> int:
        """Number of threads that a shard can use."""
        return threads_worth(math.ceil(len(self.study(paper, study).grid) / int(shards)))

    # hours of a record

    def parts_of_seas(self, paper: str, name: str) -> list[str]:
        """Markers of the simulation jobs, one for each setting and heading."""
        count = len(self.seas(paper, name).parts.grid)
        return [f"results/{paper}/{name}.seas/{k}-of-{count}" for k in range(1, count + 1)]

    def kernels_of_seas(self, paper: str, name: str, *_part: str) -> list[str]:
        """Markers of the groups of kernels that these jobs use."""
        return [self.kernels_of(group) for group in self.seas(paper, name).parts.kernel_groups]

    def records_of_seas(self, paper: str, name: str, *_part: str) -> list[str]:
        """The file of the record; empty for a synthetic record."""
        file = self.seas(paper, name).record_file
        return [str(file)] if file else []

    def seas_digest(self, paper: str, name: str, *_part: str) -> str:
        """Digest of settings, record and requests, and of the code that simulates and counts hours."""
        return f"{self.seas(paper, name).digest}-{digest(dependencies(SEAS) | _named(paper))}"

    def seas_threads(self, paper: str, name: str, *_part: str) -> int:
        """Threads of a job: few, because it runs few sea states at a time and many jobs run in parallel."""
        return max(1, SIDE_BY_SIDE // len(self.seas(paper, name).parts.grid))

    # derived and measured datasets

    def derived_inputs(self, paper: str, name: str) -> list[str]:
        """Files of the datasets that a derived dataset is made from."""
        return [f"results/{paper}/{source}.nc" for source in self.files[paper].derived[name].reads]

    def derived_settings(self, paper: str, name: str) -> str:
        """Its settings as JSON, including published values of the paper."""
        return json.dumps(self._with_printed(paper, self.files[paper].derived[name].settings))

    def _with_printed(self, paper: str, settings: dict[str, Any]) -> dict[str, Any]:
        return with_printed(settings, self.config, paper, self.published.get(paper))

    def derived_code(self, paper: str, name: str) -> Set[Path]:
        """Sources of the function that derives a dataset."""
        code = dependencies(DERIVE) | dependencies(_module(paper, "derived", name))
        return code | _named(paper)

    def derived_digest(self, paper: str, name: str) -> str:
        """Digest of the code that derives, and of its settings."""
        settings = self.derived_settings(paper, name)
        return f"{_hash(settings)}-{digest(self.derived_code(paper, name))}"

    def measured(self, paper: str, name: str) -> MeasuredModel:
        """The model of a dataset that a chapter measures."""
        return self.files[paper].measured[name]

    def setting(self, threads: int) -> Setting:
        """The surroundings that the functions of measured datasets receive."""
        return Setting(self.config, self.tier, threads, self.studies, Path(self.compiled))

    def measured_code(self, paper: str, name: str) -> Set[Path]:
        """Sources of the function that measures a dataset."""
        code = dependencies(MEASURE) | dependencies(_module(paper, "measured", name))
        return code | _named(paper)

    def measured_digest(self, paper: str, name: str) -> str:
        """Digest of what is measured, of its scenes and files, and of the code that measures."""
        model, setting = self.measured(paper, name), self.setting(1)
        scenes = {label: key_of(file.resolved()) for label, file in model.scene_files(setting)}
        files = [(p.name, _hash(p.read_bytes().hex())) for p in model.data_files(setting)]
        about = [self.tier, model.model_dump_json(), scenes, files]
        return f"{_hash(json.dumps(about))}-{digest(self.measured_code(paper, name))}"

    def measured_threads(self, paper: str, name: str) -> int:
        """All threads for a dataset that contains measured times: no other job may run at that time."""
        return ALL_CORES if self.measured(paper, name).timed else 1

    # figures

    def figure_inputs(self, paper: str, name: str) -> list[str]:
        """Files of the datasets that a figure reads; a schematic shows a scene and reads none."""
        figure = self.files[paper].figures.get(name)
        return [f"results/{paper}/{dataset}.nc" for dataset in figure.reads] if figure else []

    def figure_code(self, paper: str, name: str) -> Set[Path]:
        """Sources of the function, the plot or the schematic that draws a figure."""
        figure = self.files[paper].figures.get(name)
        if figure is None:
            return dependencies("riserstudy.schematic")
        if figure.plot:
            return dependencies(module_of_plot(figure.plot)) | _named(paper)
        return dependencies(_module(paper, "figures", name)) | _named(paper)

    def figure_digest(self, paper: str, name: str) -> str:
        """Digest of the code that draws, and of what a general plot or a schematic must show."""
        figure = self.files[paper].figures.get(name)
        if figure is None:
            model = self.files[paper].schematics[name]
            scene = self.schematic(paper, name)
            marked = [sorted(scene.assumed), sorted(scene.calibrated)]
            drawn = json.dumps(canonical(scene.resolved())) + json.dumps(marked)
            drawn += model.cylinders + json.dumps(model.remarks, sort_keys=True)
        else:
            drawn = " ".join((figure.plot or "", *(figure.of or [])))
            if figure.settings:
                drawn += json.dumps(self._with_printed(paper, figure.settings))
        return f"{_hash(drawn)}-{digest(self.figure_code(paper, name))}"

    # grading and report

    def grade_inputs(self, paper: str) -> list[str]:
        """Files of the datasets with which the numbers and claims of a paper are graded."""
        return [f"results/{paper}/{name}.nc" for name in self.published[paper].datasets]

    def grade_code(self, paper: str) -> Set[Path]:
        """Sources of the checks, and of the code that makes verdicts from them."""
        modules = {_module(paper, "claims", name) for name in self.published[paper].checks}
        return frozenset().union(*map(dependencies, (GRADE, *modules)))

    def grade_digest(self, paper: str) -> str:
        """Digest of numbers and claims, false claims, the words that judge them, and the grading code."""
        files = [
            published_path(self.config, paper),
            words_path(self.config),
            false_claims_path(self.config, paper),
        ]
        printed = digest([path for path in files if path.exists()])
        return f"{printed}-{digest(self.grade_code(paper))}"

    @property
    def report_digest(self) -> str:
        """Digest of the code of the report, and of the code with which chapters add to it."""
        return digest(dependencies(REPORT).union(*map(self.report_code, self.papers)))

    def report_code(self, paper: str) -> Set[Path]:
        """Sources of the code with which a chapter adds to the report."""
        return frozenset().union(*map(dependencies, chapter_modules(paper, "report")))

    @property
    def database_digest(self) -> str:
        """Digest of the code that builds the results database, and of the files whose contents it stores.

        The files belong to the digest because an older file that replaces a newer one keeps its date.
        """
        files = [Path(file) for file in (*self.study_files, *self.published_files)]
        return f"{digest(files)}-{digest(dependencies(DATABASE))}"

    @property
    def published_files(self) -> list[str]:
        """Files of numbers and claims, from which the database takes the datasets that each uses."""
        return [str(published_path(self.config, paper)) for paper in self.published]

    @property
    def study_files(self) -> list[str]:
        """Study files, from which the report takes captions, axes and the values that studies set."""
        return [str(self.config / "studies" / f"{paper}.yaml") for paper in self.papers]

    @property
    def compiled(self) -> str:
        """Marker of the kernels compiled from the present sources."""
        return marker().as_posix()

    # priorities: early results first, then kernels, then long jobs

    def study_priority(self, paper: str, study: str, *_shard: str) -> float:
        """Small studies of the first kernels precede other kernels, for early results."""
        planned = self.study(paper, study)
        early = planned.kernel_groups == [FIRST] and len(planned.grid) <= EARLY
        return EARLY_RESULTS if early else STUDIES

    def seas_priority(self, paper: str, name: str, *_part: str) -> float:
        """The hours of a record take as long as other studies."""
        del paper, name
        return STUDIES

    def compile_priority(self, group: str) -> float:
        """The kernels that compile fastest come first, and all kernels before most studies."""
        return KERNELS - COMPILED_IN_ORDER.index(group) / len(COMPILED_IN_ORDER)

    def measure_priority(self, paper: str, name: str) -> float:
        """A measurement that may run in parallel starts before studies: the longest takes minutes on a core.

        A measurement of times runs alone, after the studies.
        """
        return TIMED if self.measured(paper, name).timed else KERNELS

    def kernels_of(self, group: str) -> str:
        """Marker of a group of kernels."""
        return marker(group).as_posix()

    @property
    def all_kernels(self) -> list[str]:
        """Markers of all groups of kernels."""
        return [self.kernels_of(group) for group in GROUPS]

    def figure_files(self, paper: str | None = None) -> list[str]:
        """Files of all figures, or of the figures of one paper."""
        figures = [(p, name) for p, name in self.figures() if paper in (None, p)]
        return [f"results/{p}/{name}.{kind}" for p, name in figures for kind in ("png", "pdf", "csv")]

    def dataset_files(self, paper: str | None = None) -> list[str]:
        """Files of all datasets, simulated and derived, or of the datasets of one paper."""
        return [
            f"results/{p}/{name}.nc"
            for p, file in self.files.items()
            if paper in (None, p)
            for name in file.datasets
        ]

    def graded_files(self, paper: str | None = None, kind: str = "reproduction") -> list[str]:
        """Tables of all papers that have numbers or claims, or of one such paper."""
        return [f"results/{p}/{kind}.csv" for p in self.published if paper in (None, p)]

    def outputs(self) -> list[str]:
        """All files that jobs write into the results folder."""
        graded = [file for kind in GRADED for file in self.graded_files(kind=kind)]
        tables = [*graded, *self.joined_tables()]
        pages = ["results/results.sqlite", "results/report.html"]
        settings = [
            file
            for paper, of in self.files.items()
            for name in of.studies
            for file in self.settings_files(paper, name)
        ]
        return [*self.dataset_files(), *settings, *self.figure_files(), *tables, *pages]

    def joined_tables(self) -> list[str]:
        """Tables over all papers; empty when there is nothing to join."""
        return [f"results/{kind}.csv" for kind in GRADED] if self.published else []

    def pattern(self, kind: Literal["studies", "seas", "derived", "measured"]) -> str:
        """Names of the datasets of a kind, a section of the study files, as a pattern."""
        return _either(name for file in self.files.values() for name in getattr(file, kind))

    @property
    def figure_pattern(self) -> str:
        """Names of figures, as a pattern."""
        return _either(name for _, name in self.figures())


def _module(paper: str, part: str, name: str) -> str:
    """The module of a chapter that defines a function."""
    return defining(chapter_modules(paper, part), name) or ""


def _named(paper: str) -> frozenset[Path]:
    """The file of names, units and labels of a chapter, if it has one."""
    file = variables_of_chapter(paper).absolute()
    return frozenset([file] if file.exists() else [])


def _hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _either(names: Any) -> str:
    return "|".join(sorted({re.escape(name) for name in names})) or "(?!)"
