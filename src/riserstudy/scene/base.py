"""The base of all parts of a scene."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Field


def _whole(value: Any) -> Any:
    """Read a whole number that an axis holds as a float: 3.0 is 3."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


WHOLE = BeforeValidator(_whole)
ALONG_X = 1e-12  # largest sine of a heading that counts as being in the plane of x and z
POSITIVE, NOT_NEGATIVE = Field(gt=0), Field(ge=0)
Positive = Annotated[float, POSITIVE]
Coefficient = Annotated[float, NOT_NEGATIVE]
