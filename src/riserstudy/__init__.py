"""Parameter studies of deepwater drilling risers: simulate, store, grade and draw."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"
__all__ = ["load_scene", "open_results", "simulate"]

_HOMES = {
    "load_scene": "riserstudy.scene.load",
    "simulate": "riserstudy.simulation",
    "open_results": "riserstudy.results",
}

if TYPE_CHECKING:
    from riserstudy.results import open_results
    from riserstudy.scene.load import load_scene
    from riserstudy.simulation import simulate


def __getattr__(name: str) -> Any:
    """Import on first use: planning a study must not load numba."""
    if name in _HOMES:
        from importlib import import_module

        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
