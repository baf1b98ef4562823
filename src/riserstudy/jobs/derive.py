"""Derive a dataset from others."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import xarray as xr

from riserstudy.chapters.derive import derive
from riserstudy.jobs.seals import seal
from riserstudy.study.collect import write_dataset


def main(paper: str, name: str, target: Path, settings: str, sources: list[Path]) -> None:
    """Read the sources, write the derived dataset."""
    datasets = {source.stem: xr.load_dataset(source, engine="netcdf4") for source in sources}
    write_dataset(derive(paper, name, datasets, json.loads(settings)), target)
    seal(target)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("name")
    parser.add_argument("target", type=Path)
    parser.add_argument("--settings", required=True, help="what it is told besides, as JSON")
    parser.add_argument("sources", type=Path, nargs="+")
    main(**vars(parser.parse_args()))
