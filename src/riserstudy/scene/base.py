"""What all parts of a scene share."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Field


def _whole(value: Any) -> Any:
    """A number of an axis is a float: 3.0 is 3."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


WHOLE = BeforeValidator(_whole)
ALONG_X = 1e-12  # sine of a heading that is in the plane of x and z
POSITIVE, NOT_NEGATIVE = Field(gt=0), Field(ge=0)
Positive = Annotated[float, POSITIVE]
Coefficient = Annotated[float, NOT_NEGATIVE]
