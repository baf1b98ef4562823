"""Find points that the store need not keep: of other engines, and points that no study refers to."""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import dataclass, field
from pathlib import Path

from riserstudy.database.ask import ask, connect
from riserstudy.files.digests import engine_digest
from riserstudy.inputs.validate import check
from riserstudy.study import store
from riserstudy.study.config import Config, read_config
from riserstudy.study.modes import key_of_modes
from riserstudy.study.read import read_studies
from riserstudy.study.settings import read_settings, with_setting
from riserstudy.study.study import Study, settings_path


@dataclass
class Unneeded:
    """Points that can be removed.

    ``old``: of other engines or formats, or damaged. ``strange``: of this engine, but of no study here.
    ``needed``: number of points that must stay. ``seas``: datasets of seas here (paper/name), whose runs are
    found only when their hours are counted, and are among ``strange``.
    """

    old: list[store.Held] = field(default_factory=list)
    strange: list[store.Held] = field(default_factory=list)
    needed: int = 0
    seas: list[str] = field(default_factory=list)


def unneeded(database: Path, config: Path) -> Unneeded:
    """Find the points of the store that are not needed.

    Needed are the points that a study of the configuration plans, in any tier, and the points that the
    database, if it exists, lists. Raises InputError when the configuration or a file of tuned settings next
    to the database is invalid.
    """
    keys = planned(config, database.parent) | _spoken_of(database)
    superfluous = Unneeded(seas=_seas(config))
    for held in store.everything():
        if held.key in keys:
            superfluous.needed += 1
        elif held.key and _engine(held.key) == engine_digest():
            superfluous.strange.append(held)
        else:
            superfluous.old.append(held)
    return superfluous


def _engine(key: str) -> str | None:
    about = store.about(key)
    return about["engine"] if about else None


def _spoken_of(database: Path) -> Set[str]:
    if not database.exists():
        return set()
    with connect(database) as db:
        return {key for (key,) in ask(db, "select key from points").rows}


def planned(config: Path, results: Path) -> Set[str]:
    """Keys of all points of all configured studies, in every tier, also with settings tuned in ``results``.

    Raises InputError when a file of the configuration or a file of tuned settings cannot be read.
    """
    settings = _settings(config)
    keys: set[str] = set()
    for paper in settings.papers:
        file = read_studies(config, paper)
        for tier, of_tier in settings.tiers.items():
            accuracy = of_tier.accuracy
            for name, model in file.studies.items():
                study = Study(paper, name, model, config, tier, accuracy, file.readings)
                for one in (study, *_tuned(study, results)):
                    keys.update(point.key for point in one.plan)
                    if model.modes:
                        keys.update(key_of_modes(point.key, model.modes) for point in one.plan)
    return keys


def _tuned(study: Study, results: Path) -> Iterator[Study]:
    """Yield the study with its tuned settings, if a job has written settings for it."""
    file = settings_path(results, study.paper, study.name)
    if study.model.settings and file.exists() and (setting := read_settings(file).setting):
        yield with_setting(study, setting)


def _seas(config: Path) -> list[str]:
    papers = _settings(config).papers
    return [f"{paper}/{name}" for paper in papers for name in read_studies(config, paper).seas]


def _settings(config: Path) -> Config:
    path = config / "config.yaml"
    return check(Config, read_config(path), path)
