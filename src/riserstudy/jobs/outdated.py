"""``python -m riserstudy.jobs.outdated``: print the results here that a run would make again, after an edit.

Results whose digest or units have changed are printed, one a line, without the results that are made from
them. The study is that of the current folder. Its code is read, not run.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from riserstudy.crate.metadata import outputs_of
from riserstudy.crate.records import recorded
from riserstudy.errors import RiserStudyError
from riserstudy.files.seals import SEALS
from riserstudy.jobs.planned import CONFIG
from riserstudy.jobs.workplan import Workplan

HERE = Path()
IN_UNITS = ("figure", "report")  # rules whose results are in the units of the configuration


def outdated() -> Iterator[str]:
    """Yield the results whose digest or units have changed.

    Raises InputError when the configuration is invalid.
    """
    made, tier = recorded(HERE), HERE / "results" / SEALS / "tier"
    settings = {"tier": tier.read_text("utf-8")} if tier.is_file() else {}
    plan = Workplan.read(CONFIG, settings, only=[])
    for name in outputs_of(HERE):
        if name in made and not _is_planned(plan, name, made[name].rule, made[name].params):
            yield name


def _is_planned(plan: Workplan, output: str, rule: str, params: tuple[str, ...]) -> bool:
    """Return whether the digest and the units that a result was made with are the planned ones."""
    path = Path(output)
    paper, name = path.parent.name, path.name.partition(".")[0]
    by_name: dict[str, Callable[[str, str], str]] = {
        "simulate": plan.study_digest,
        "tune": plan.settings_digest,
        "hours": plan.seas_digest,
        "measure": plan.measured_digest,
        "derive": plan.derived_digest,
        "figure": plan.figure_digest,
    }
    try:
        if rule in by_name:
            digest = by_name[rule](paper, name)
        elif rule == "grade":
            digest = plan.grade_digest(paper)
        elif rule in ("database", "report"):
            digest = plan.database_digest if rule == "database" else plan.report_digest
        else:  # a rule of the user, or one without a digest
            return True
    except KeyError:  # the study or figure was removed
        return False
    in_units = rule not in IN_UNITS or repr(plan.units) in params
    return in_units and any(digest in value for value in params)


if __name__ == "__main__":
    try:
        print(*outdated(), sep="\n")
    except RiserStudyError as error:
        print(f"riserstudy: {error}", file=sys.stderr)
        sys.exit(error.exit_code)
