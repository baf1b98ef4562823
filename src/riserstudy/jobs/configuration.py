"""Configuration of all papers, read and checked before any job starts."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from contextlib import suppress
from functools import cached_property
from pathlib import Path
from typing import Any, Self, TypeVar

from riserstudy.dataset.unit_systems import UnitSystem
from riserstudy.errors import InputError
from riserstudy.files.whole import write_whole
from riserstudy.grading.false_claims import read_false_claims
from riserstudy.grading.models import PublishedFile
from riserstudy.grading.published import published_path, read_published
from riserstudy.inputs.validate import check
from riserstudy.jobs.plan_checks import (
    refuse_seas,
    refuse_settings,
    refuse_unknown_claims,
    refuse_unprinted,
    warnings,
)
from riserstudy.scene.load import SceneFile
from riserstudy.study.axes import Tier
from riserstudy.study.config import GRADED, RULES, Config, read_config
from riserstudy.study.models import RENAME, StudyFile
from riserstudy.study.read import read_studies
from riserstudy.study.seas_study import SeasStudy
from riserstudy.study.study import Study, scene_file

T = TypeVar("T")


class Configuration:
    """Studies, scenes, figures and published values of the configured papers.

    Parameters
    ----------
    only : studies to check, as (paper, name); None: all. A job that simulates one study needs no more.

    Raises
    ------
    InputError
        When any part of the configuration, a scene or a grid point is invalid.
    """

    def __init__(self, config: Path, settings: dict[str, Any], only: list[tuple[str, str]] | None = None):
        self.config = config
        self.settings = check(Config, dict(settings), config / "config.yaml")
        self.tier: Tier = self.settings.tier
        self.papers = self.settings.papers
        self.files: dict[str, StudyFile] = {p: read_studies(config, p) for p in self.papers}
        self._refuse_equal_names()
        if ignores_case(config / "config.yaml"):
            self._refuse_names_in_another_case()
        if only is None:
            # these files, too, are checked before any job
            for paper, printed in self.published.items():
                read_false_claims(config, paper, printed)
            known = {p: {i.id for i in of.items} for p, of in self.published.items()}
            refuse_unknown_claims(config, self.files, known)
        for paper, name in self._studies if only is None else only:
            study = self.study(paper, name)
            scene_file(config / study.model.scene).resolved()
            study.plan  # noqa: B018  every point is checked before any job
            if study.model.settings:
                refuse_settings(study)
        if only is None:
            for seas in self._seas.values():
                refuse_seas(seas)
            schematics = [self.schematic(p, n) for p, of in self.files.items() for n in of.schematics]
            for scene in schematics:
                scene.resolved()
            own = {self.config / study.model.scene for study in self.studies}
            refuse_unprinted(config, map(scene_file, sorted(own)))

    @property
    def units(self) -> str:
        """System of units of plots and limits."""
        return self.settings.units or UnitSystem.FIELD.value

    @classmethod
    def read(cls, config: Path, overrides: dict[str, Any], only: list[tuple[str, str]] | None = None) -> Self:
        """Read config.yaml; overrides replace its values.

        Raises InputError when the file cannot be read, or is invalid.
        """
        return cls(config, read_config(config / "config.yaml") | overrides, only)

    def _refuse_equal_names(self) -> None:
        """Refuse names that give two rules one name: figure ``b_c`` of ``a`` and figure ``c`` of ``a_b``.

        The table of a figure must not have the name of a table of verdicts either.
        """
        taken: dict[str, str] = {paper: f"paper {paper}" for paper in self.papers}
        for paper, name in self.figures():
            rule, label = f"{paper}_{name}", f"figure {name} of {paper}"
            section = "figures" if name in self.files[paper].figures else "schematics"
            where = self.config / "studies" / f"{paper}.yaml", f"{section}.{name}"
            if name in GRADED:
                raise InputError(
                    *where, f"its table {name}.csv would have the name of the table of verdicts", RENAME
                )
            if rule in RULES or rule in taken:
                other = taken.get(rule, f"a rule named {rule}")
                raise InputError(*where, f"its target {rule!r} is also the name of {other}", RENAME)
            taken[rule] = label

    def _refuse_names_in_another_case(self) -> None:
        """Refuse names that differ only in upper and lower case, where the system makes them one file."""
        groups = [(self.config / "config.yaml", "papers", self.papers)]
        for paper, file in self.files.items():
            where = self.config / "studies" / f"{paper}.yaml"
            groups += [(where, "studies", file.datasets)]
            groups += [(where, "figures", [*file.schematics, *file.figures])]
        for where, field, names in groups:
            known: dict[str, str] = {}
            for name in names:
                if (other := known.setdefault(name.lower(), name)) != name:
                    found = f"{other!r} and {name!r} are the same file name on this system"
                    raise InputError(where, field, found, RENAME)

    @cached_property
    def published(self) -> dict[str, PublishedFile]:
        """Numbers and claims of the papers."""
        return {
            paper: read_published(self.config, paper, set(file.datasets))
            for paper, file in self.files.items()
            if published_path(self.config, paper).exists()
        }

    @cached_property
    def _studies(self) -> dict[tuple[str, str], Study]:
        return self._planned(Study, "studies")

    @cached_property
    def _seas(self) -> dict[tuple[str, str], SeasStudy]:
        return self._planned(SeasStudy, "seas")

    def _planned(self, kind: Callable[..., T], section: str) -> dict[tuple[str, str], T]:
        """Studies of the tier, from a section of the study files."""
        accuracy = self.settings.tiers[self.tier].accuracy
        return {
            (paper, name): kind(paper, name, model, self.config, self.tier, accuracy, file.readings)
            for paper, file in self.files.items()
            for name, model in getattr(file, section).items()
        }

    @property
    def warnings(self) -> list[str]:
        """Warnings about unusual values in the studies, which may be mistakes."""
        return warnings([*self.studies, *(seas.settings for seas in self._seas.values())])

    @property
    def studies(self) -> list[Study]:
        """All studies of all papers."""
        return list(self._studies.values())

    def write_point_counts(self, where: Path) -> None:
        """Write the numbers of points and of jobs of each study; the time left is estimated from them.

        On a full disk or in a folder that is read-only there is no such file, and the estimate is rougher.
        """
        counts = {
            f"{paper}/{name}": (len(study.plan), self.shards(paper, name))
            for (paper, name), study in self._studies.items()
        }
        with suppress(OSError):
            where.parent.mkdir(exist_ok=True)
            write_whole(where, json.dumps(counts).encode())

    def shards(self, paper: str, study: str) -> int:
        """Number of jobs that share the points of a study; 1: the job that writes it simulates all."""
        per_job = self.settings.points_per_job
        return math.ceil(len(self.study(paper, study).grid) / per_job) if per_job else 1

    def study(self, paper: str, name: str) -> Study:
        """One study; it is planned only once."""
        return self._studies[paper, name]

    def seas(self, paper: str, name: str) -> SeasStudy:
        """One study of the hours of a record over settings; it is planned only once."""
        return self._seas[paper, name]

    def schematic(self, paper: str, name: str) -> SceneFile:
        """The scene that a schematic shows."""
        return self.files[paper].schematics[name].file(self.config)

    def figures(self) -> list[tuple[str, str]]:
        """All figures as (paper, name), the schematics of a paper first."""
        return [
            (paper, name) for paper, file in self.files.items() for name in (*file.schematics, *file.figures)
        ]


def ignores_case(file: Path) -> bool:
    """Whether the folder of an existing file has no other file with its name in another case."""
    other = file.with_name(file.name.swapcase())
    return other.exists() and other.samefile(file)
