"""Measure the engine itself: a dataset about methods and effects instead of a grid."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from riserstudy.errors import RiserStudyError
from riserstudy.jobs.seals import seal
from riserstudy.jobs.workplan import Workplan
from riserstudy.numerics.measure import measure
from riserstudy.study.collect import write_dataset


def main(
    paper: str, study: str, target: Path, tier: str, papers: list[str], threads: int, expect: str
) -> None:
    """Write one measured dataset of a tier."""
    plan = Workplan.read(Path("config"), {"tier": tier, "papers": papers}, only=[])
    if plan.measured_digest(paper, study) != expect:
        sys.exit("scene, study or engine changed while the workflow was running; run it again")
    dataset = measure(f"{paper} {study}", plan.measured(paper, study), plan.setting(threads))
    write_dataset(dataset, target)
    seal(target)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("study")
    parser.add_argument("target", type=Path)
    parser.add_argument("--tier", required=True)
    parser.add_argument("--papers", nargs="+", required=True)
    parser.add_argument("--threads", type=int, required=True)
    parser.add_argument("--expect", required=True)
    try:
        main(**vars(parser.parse_args()))
    except RiserStudyError as error:
        sys.exit(f"riserstudy: {error}")
