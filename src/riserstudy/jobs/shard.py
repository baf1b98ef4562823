"""Simulate a shard: those points of a study that fall to one of several jobs and that the store lacks."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from riserstudy.errors import RiserStudyError
from riserstudy.folders import write_whole
from riserstudy.jobs.points_done import PointsDone
from riserstudy.jobs.workplan import Workplan
from riserstudy.study.settings import fill_tuned, read_settings, with_setting
from riserstudy.study.simulate_points import fill


def main(
    paper: str,
    study: str,
    shard: str,
    shards: str,
    target: Path,
    tier: str,
    threads: int,
    expect: str,
    settings: Path | None = None,
) -> None:
    """Store the points of a shard; the target says how many there are."""
    plan = Workplan.read(Path("config"), {"tier": tier, "papers": [paper]}, only=[])
    if plan.shard_digest(paper, study, shard, shards) != expect:
        sys.exit("scene, study or engine changed while the workflow was running; run it again")
    points = plan.shard(paper, study, shard, shards)
    planned = plan.study(paper, study)
    setting = read_settings(settings).setting if settings else None
    if setting:
        tuned = with_setting(planned, setting)
        pairs = zip(points, tuned.shard(int(shard), int(shards)), strict=True)
        again = sum(fill_tuned(planned, tuned, pairs, threads, PointsDone()).by_request)
        said = f"{len(points)} points, {again} of them by request"
    else:
        made = fill(planned, points, threads, PointsDone())
        said = f"{made} points simulated, {len(points) - made} from the store"
    print(f"{paper}/{study}, part {shard} of {shards}: {said}")
    write_whole(target, f"{len(points)} points\n".encode())


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("study")
    parser.add_argument("shard")
    parser.add_argument("shards")
    parser.add_argument("target", type=Path)
    parser.add_argument("--tier", required=True)
    parser.add_argument("--threads", type=int, required=True)
    parser.add_argument("--expect", required=True)
    parser.add_argument("--settings", type=Path, help="file of what the study was tuned to")
    try:
        main(**vars(parser.parse_args()))
    except RiserStudyError as error:
        sys.exit(f"riserstudy: {error}")
