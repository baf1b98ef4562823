"""The base class of models of input files."""

from __future__ import annotations

from typing import Any, Self

from pydantic import BaseModel, ConfigDict


class Strict(BaseModel):
    """Refuses unknown keys, NaN and conversions."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)

    def replaced(self, **values: Any) -> Self:
        """Return a copy with other values of some fields, which are not checked."""
        return self.model_copy(update=values)
