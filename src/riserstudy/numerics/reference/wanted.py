"""All reference solutions that the studies of the engine compare with."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from riserstudy.numerics import accuracy, long_runs, random_scenes, stability, tiers
from riserstudy.numerics.reference.store import Wanted
from riserstudy.study.measured import Measured

PAPER = "numerics"
#: what a study wants references for
OF: dict[str, Callable[[Any, Path], Iterator[Wanted]]] = {
    "stability": stability.wanted,
    "random_scenes": random_scenes.wanted,
    "accuracy": accuracy.wanted,
    "long_runs": long_runs.wanted,
    "tiers": tiers.wanted,
}


def all_wanted(measured: Measured | None, config: Path) -> dict[str, list[Wanted]]:
    """The cases of each study that need a reference solution."""
    studies = {name: getattr(measured, name, None) for name in OF}
    return {name: list(OF[name](study, config)) for name, study in studies.items() if study}
