"""Tune mesh, step and method of a study, and leave them in a file for its points."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from riserstudy.errors import RiserStudyError
from riserstudy.jobs.seals import seal
from riserstudy.jobs.workplan import Workplan
from riserstudy.study.settings import tuned_for, write_settings


def main(paper: str, study: str, target: Path, tier: str, expect: str) -> None:
    """Write the settings of one study of a tier."""
    plan = Workplan.read(Path("config"), {"tier": tier, "papers": [paper]}, only=[(paper, study)])
    if plan.settings_digest(paper, study) != expect:
        sys.exit("scene, study or engine changed while the workflow was running; run it again")
    found = tuned_for(plan.study(paper, study), lambda what: print(what, flush=True))
    print(found.because or f"{found.setting}: work {found.work:.2g} of that of requests")
    write_settings(found, target)
    seal(target)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("study")
    parser.add_argument("target", type=Path)
    parser.add_argument("--tier", required=True)
    parser.add_argument("--expect", required=True)
    try:
        main(**vars(parser.parse_args()))
    except RiserStudyError as error:
        sys.exit(f"riserstudy: {error}")
