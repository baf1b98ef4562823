"""Shares in the notation of files: ``0.15 %``."""

from __future__ import annotations

import re
from typing import Annotated

from pydantic import BeforeValidator, WithJsonSchema

from riserstudy.inputs.misfit import Misfit

NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


def _percent(value: object) -> float:
    if isinstance(value, str) and (m := NUMBER.match(value)) and value[m.end() :].strip() == "%":
        return float(m.group()) / 100.0
    raise Misfit("", f"{value!r} is not a percentage", "write, for example, '1 %'")


Percent = Annotated[float, BeforeValidator(_percent), WithJsonSchema({"type": "string"})]
