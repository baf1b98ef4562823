"""Comparison of published values and claims with computed results: verdicts, and the inputs that decide them.

The grader is independent of risers. The names below are sufficient for any other kind of model; they load
neither scenes nor the simulator.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

__all__ = [
    "ClaimsFile",
    "Graded",
    "Row",
    "above",
    "alike",
    "all_of",
    "below",
    "claim",
    "claims_schema",
    "grade_claims",
    "less",
    "more",
    "read_claims",
    "row_of",
    "table",
]

_HOMES = {
    "ClaimsFile": "open_claims",
    "claims_schema": "open_claims",
    "read_claims": "open_claims",
    "claim": "open_inputs",
    "grade_claims": "open_inputs",
    "above": "margin",
    "below": "margin",
    "alike": "yardstick",
    "all_of": "yardstick",
    "less": "yardstick",
    "more": "yardstick",
    "Graded": "riserstudy.records.graded",
    "Row": "rows",
    "row_of": "rows",
    "table": "rows",
}
__all__ = list(_HOMES)

if TYPE_CHECKING:
    from riserstudy.grading.margin import above, below
    from riserstudy.grading.open_claims import ClaimsFile, claims_schema, read_claims
    from riserstudy.grading.open_inputs import claim, grade_claims
    from riserstudy.grading.rows import Row, row_of, table
    from riserstudy.grading.yardstick import alike, all_of, less, more
    from riserstudy.records.graded import Graded


def __getattr__(name: str) -> Any:
    """Import on first use: a plan reads words and published values without loading arrays."""
    if name in _HOMES:
        from importlib import import_module

        home = _HOMES[name]
        module = home if "." in home else f"{__name__}.{home}"
        return getattr(import_module(module), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
