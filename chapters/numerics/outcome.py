"""Outcome of a run, as datasets of the numerics chapter store it."""

from __future__ import annotations

from enum import StrEnum


class Outcome(StrEnum):
    """Outcome of a run."""

    ACCURATE = "accurate"
    INACCURATE = "stable but inaccurate"
    DIVERGED = "finished with impossible values"
    REFUSED = "refused"
    UNSTABLE = "refused: physically unstable"
    TOO_LONG = "refused: longer than the study allows"
    MISSED = "finished, although physically unstable"
    UNJUDGED = "finished, without a reference solution"
    NOT_RUN = "not run"


#: outcomes of runs without a result
REFUSALS = (Outcome.REFUSED, Outcome.UNSTABLE, Outcome.TOO_LONG)
