"""What all parts of a scene share."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field


class Strict(BaseModel):
    """Refuses unknown keys, NaN and conversions."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)


POSITIVE, NOT_NEGATIVE = Field(gt=0), Field(ge=0)
Positive = Annotated[float, POSITIVE]
Coefficient = Annotated[float, NOT_NEGATIVE]
