"""Checks before any job starts: scenes against the inputs that papers print, axes against scenes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache, partial
from pathlib import Path

from riserstudy.errors import InputError
from riserstudy.files.cache import remembered
from riserstudy.files.digests import dependencies, digest
from riserstudy.grading.printed import printed_inputs, unprinted
from riserstudy.grading.published import published_path
from riserstudy.scene.load import SceneFile
from riserstudy.study.far_values import far_values
from riserstudy.study.idle_values import idle_values
from riserstudy.study.models import StudyFile
from riserstudy.study.seas_study import SeasStudy
from riserstudy.study.study import Study


def refuse_unprinted(config: Path, scenes: Iterable[SceneFile]) -> None:
    """Refuse a plain value of a paper's scene that is not in the paper's list of inputs.

    A plain value in a paper's scene claims that the paper prints it. Papers whose file has no ``inputs`` are
    not checked. Raises InputError at the first such value.
    """
    inputs_of = cache(partial(printed_inputs, config))
    for scene in scenes:
        paper = scene.tree.get("paper")
        inputs = inputs_of(paper) if isinstance(paper, str) else []
        for path, value in unprinted(inputs, scene) if inputs else []:
            listed = published_path(config, str(paper))
            found = f"{value} has no origin, which marks it as published, but {listed} does not list it"
            allowed = f"list it there under `inputs`, or state its origin: {{chosen: {value}, because: ...}}"
            raise InputError(scene.source, path, found, allowed)


def refuse_unknown_claims(
    config: Path, files: Mapping[str, StudyFile], known: Mapping[str, set[str]]
) -> None:
    """Refuse figures that list a number or claim which the file of their paper does not contain.

    ``known``: IDs by paper. Raises InputError at the first such ID.
    """
    for paper, file in files.items():
        ids = known.get(paper, set())
        for name, figure in file.figures.items():
            for one in [one for one in figure.claims if one not in ids]:
                allowed = f"use IDs of {published_path(config, paper)}"
                where = config / f"studies/{paper}.yaml"
                raise InputError(where, f"figures.{name}.claims", f"there is no claim {one!r}", allowed)


def refuse_settings(study: Study) -> None:
    """Refuse a study to be tuned that has its own mesh or step, or that cannot profit from tuning.

    Raises InputError with the reason.
    """
    from riserstudy.study.tune import check_tunable  # loads solvers

    analysis = study.base.tree.get("analysis") or {}
    for name in ("mesh", "step", "method"):
        if analysis.get(name) is not None:
            found = f"the study is to be tuned, but the scene gives analysis.{name}, {analysis[name]!r}"
            allowed = f"write `analysis.{name}: null` under set, or remove settings"
            raise InputError(study.where, "settings", found, allowed)
    check_tunable(study, study.tuned_at[0])


def refuse_seas(seas: SeasStudy) -> None:
    """Refuse a study of the hours of a record with an invalid setting, record or limit on the sea.

    A record is checked once: the success is stored under a key of its content and of the code that reads it.
    Raises InputError at the first fault.
    """
    from riserstudy.seas.hours import check_limits, sea_limit
    from riserstudy.seas.record import check_windows
    from riserstudy.seas.seas_hours import directions_of, record_of
    from riserstudy.study.demand_in_sea import check_seeds

    check_seeds(seas.model.seeds)
    seas.check()

    def read() -> bool:
        record = record_of(seas)
        check_limits(record, [sea_limit(one) for one in seas.model.sea_limits])
        check_windows(record, seas.model.windows)
        if directions := directions_of(seas):
            directions.between(record)
        return True

    code = digest(dependencies("riserstudy.seas.seas_hours"))
    remembered(f"records/{seas.digest}-{code}", read)


def warnings(studies: Iterable[Study]) -> list[str]:
    """What is unusual in studies, and may be a slip."""
    return [text for study in studies for text in (*far_values(study), *idle_values(study))]
