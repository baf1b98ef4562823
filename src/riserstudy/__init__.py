"""Parameter studies of deepwater drilling risers: simulate, store, grade and draw."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"
__all__ = ["load_scene", "open_results", "simulate"]

_HOMES = {
    "load_scene": "riserstudy.scene.load",
    "simulate": "riserstudy.simulation.simulate",
    "open_results": "riserstudy.dataset.open",
}

if TYPE_CHECKING:
    from riserstudy.dataset.open import open_results
    from riserstudy.scene.load import load_scene
    from riserstudy.simulation.simulate import simulate


def __getattr__(name: str) -> Any:
    """Import on first use: planning a study must not load numba."""
    if name in _HOMES:
        from importlib import import_module

        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
