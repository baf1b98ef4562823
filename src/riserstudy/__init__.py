"""Parameter studies of deepwater drilling risers: simulate, store, grade and draw."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

__all__ = [
    "__version__",
    "dataset_of",
    "load_scene",
    "modes",
    "open_point",
    "open_results",
    "query",
    "simulate",
    "sweep",
]

_HOMES = {
    "load_scene": "riserstudy.scene.load",
    "simulate": "riserstudy.simulation.simulate",
    "modes": "riserstudy.simulation.labelled_modes",
    "open_results": "riserstudy.dataset.open",
    "query": "riserstudy.database.query",
    "open_point": "riserstudy.database.open_points",
    "dataset_of": "riserstudy.database.open_points",
    "sweep": "riserstudy.study.sweep",
}

if TYPE_CHECKING:
    __version__: str

    from riserstudy.database.open_points import dataset_of, open_point
    from riserstudy.database.query import query
    from riserstudy.dataset.open import open_results
    from riserstudy.scene.load import load_scene
    from riserstudy.simulation.labelled_modes import modes
    from riserstudy.simulation.simulate import simulate
    from riserstudy.study.sweep import sweep


def __getattr__(name: str) -> Any:
    """Import on first use: planning a study must not load numba."""
    if name == "__version__":
        from importlib.metadata import version

        return version("riserstudy")
    if name in _HOMES:
        from importlib import import_module

        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
