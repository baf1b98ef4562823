"""All reference solutions that the studies of the engine compare with."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from chapters.numerics.measured import accuracy, long_runs, random_scenes, stability, tiers
from chapters.numerics.reference.store import Wanted
from riserstudy.study.measured import MeasuredModel

PAPER = "numerics"
#: by study: function that yields the cases that need a reference
OF: dict[str, Callable[[Any, Path], Iterator[Wanted]]] = {
    "stability": stability.wanted,
    "random_scenes": random_scenes.wanted,
    "accuracy": accuracy.wanted,
    "long_runs": long_runs.wanted,
    "tiers": tiers.wanted,
}


def all_wanted(measured: Mapping[str, MeasuredModel], config: Path) -> dict[str, list[Wanted]]:
    """Return the cases of each study that need a reference solution."""
    return {name: list(OF[name](measured[name], config)) for name in OF if name in measured}
