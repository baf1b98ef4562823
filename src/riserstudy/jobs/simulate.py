"""Simulate what a study lacks and write its dataset."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from riserstudy.errors import RiserStudyError
from riserstudy.jobs.points_done import PointsDone
from riserstudy.jobs.seals import seal
from riserstudy.jobs.workplan import Workplan
from riserstudy.study.join import write_study
from riserstudy.study.settings import read_settings


def simulate(
    paper: str,
    study: str,
    target: Path,
    tier: str,
    threads: int,
    expect: str,
    settings: Path | None = None,
) -> None:
    """Write the dataset of one study of a tier."""
    plan = Workplan.read(Path("config"), {"tier": tier, "papers": [paper]}, only=[(paper, study)])
    if plan.study_digest(paper, study) != expect:
        sys.exit("scene, study or engine changed while the workflow was running; run it again")
    planned = plan.study(paper, study)
    tuned = read_settings(settings) if settings else None
    write_study(planned, target, threads, print, PointsDone(), tuned)
    seal(target)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("study")
    parser.add_argument("target", type=Path)
    parser.add_argument("--tier", required=True)
    parser.add_argument("--threads", type=int, required=True)
    parser.add_argument("--expect", required=True)
    parser.add_argument("--settings", type=Path, help="file of what the study was tuned to")
    try:
        simulate(**vars(parser.parse_args()))
    except RiserStudyError as error:
        sys.exit(f"riserstudy: {error}")
