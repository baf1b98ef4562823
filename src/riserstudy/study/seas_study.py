"""Workable hours of a record over settings of a riser, to be planned: one part per setting and heading."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from riserstudy.errors import InputError
from riserstudy.files.whole import sha256_of
from riserstudy.inputs.validate import check
from riserstudy.scene.load import SceneFile
from riserstudy.study.axes import Labels, Tier
from riserstudy.study.departures import check_stays
from riserstudy.study.in_sea import heading_values, phases_of
from riserstudy.study.seas_model import HEADING, SeasModel
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel


class Settings(Study):
    """The grid of a dataset of seas."""

    @property
    def where(self) -> str:
        """Name of the dataset in errors."""
        return f"config/studies/{self.paper}.yaml: seas.{self.name}"


@dataclass(frozen=True)
class SeasStudy:
    """A dataset of seas of a tier, ready to be planned."""

    paper: str
    name: str
    model: SeasModel
    config: Path
    tier: Tier
    accuracy: str | None = None
    readings: dict[str, Labels] = field(default_factory=dict)

    @cached_property
    def settings(self) -> Study:
        """The grid of settings, with the heading of the scene."""
        return self._grid({})

    @cached_property
    def parts(self) -> Study:
        """The grid of settings and headings; a job simulates one point of it."""
        if self.model.headings is None:
            return self.settings
        sets = heading_values(self.settings.base, self.model.headings.sectors)
        return self._grid({HEADING: {str(k): one for k, one in enumerate(sets)}})

    def _grid(self, more: dict[str, Any]) -> Study:
        model = self.model
        fields = {
            "scene": model.scene,
            "caption": model.caption,
            "set": model.set,
            "limits": model.limits,
            "axes": model.axes | more,
            "keep": [],
        }
        where = f"config/studies/{self.paper}.yaml: seas.{self.name}"
        grid = check(StudyModel, fields, where)
        more_of = (self.config, self.tier, self.accuracy, self.readings)
        return Settings(self.paper, self.name, grid, *more_of)

    @property
    def record_file(self) -> Path | None:
        """The file of the record; None for a synthetic record."""
        return self.config / self.model.record if isinstance(self.model.record, str) else None

    def part(self, number: int) -> tuple[SceneFile, int]:
        """Scene of a part's setting, and the index of its heading (0 if there is only one).

        ``number``: number of the part, counted from 1.
        """
        index = self.parts.plan[number - 1].index
        if self.model.headings is None:
            return self.settings.grid.file(index), 0
        return self.settings.grid.file(index[:-1]), index[-1]

    def check(self) -> None:
        """Check, before any job, that each setting has the inputs for workable hours.

        Raises InputError if a setting lacks them.
        """
        for point in self.parts.plan:
            file = self.parts.grid.file(point.index)
            phases_of(file, 1)  # refuses a scene without a sea, or a static scene
            if not file.resolved().limits:
                found = "missing, but the downtime is computed from them"
                raise InputError(self.settings.where, "limits", found, "add the limits of the riser")
            check_stays(file)

    @cached_property
    def digest(self) -> str:
        """A text that changes with every input of the dataset."""
        about = [self.parts.digest, self.model.model_dump(mode="json"), self._content]
        return hashlib.sha256(json.dumps(about, sort_keys=True).encode()).hexdigest()[:16]

    @property
    def _content(self) -> str:
        """Digest of the content of the record's file."""
        record = self.record_file
        if record is None:
            return ""
        try:
            if record.exists() and not record.is_file():  # reading a device or a pipe may never end
                raise OSError(0, "this is not a regular file")
            return sha256_of(record)
        except OSError as error:
            found = f"{record} cannot be read: {error.strerror}"
            raise InputError(self.settings.where, "record", found, "give the path of a record") from None
