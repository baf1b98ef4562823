"""Simulate what a study lacks and write its dataset."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from riserstudy.errors import RiserStudyError
from riserstudy.jobs.points_done import PointsDone
from riserstudy.jobs.seals import seal
from riserstudy.jobs.workplan import Workplan
from riserstudy.study.collect import dataset_of, results_of, write_dataset


def simulate(paper: str, study: str, target: Path, tier: str, threads: int, expect: str) -> None:
    """Write the dataset of one study of a tier."""
    settings = {"tier": tier, "papers": [paper]}
    plan = Workplan.read(Path("config"), settings, only=[(paper, study)])
    if plan.study_digest(paper, study) != expect:
        sys.exit("scene, study or engine changed while the workflow was running; run it again")
    planned = plan.study(paper, study)
    results, _ = results_of(planned, threads, print, PointsDone())
    write_dataset(dataset_of(planned, results), target)
    seal(target)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("study")
    parser.add_argument("target", type=Path)
    parser.add_argument("--tier", required=True)
    parser.add_argument("--threads", type=int, required=True)
    parser.add_argument("--expect", required=True)
    try:
        simulate(**vars(parser.parse_args()))
    except RiserStudyError as error:
        sys.exit(f"riserstudy: {error}")
