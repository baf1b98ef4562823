"""Datasets computed from datasets: what a paper reports is seldom what a run returns."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr


def derive(paper: str, name: str, datasets: dict[str, xr.Dataset]) -> xr.Dataset:
    """Derived dataset ``name`` of a paper, by the function of that name in the paper's module."""
    function = getattr(import_module(f"riserstudy.derived.{paper}"), name)
    dataset: xr.Dataset = function(**datasets)
    return dataset
