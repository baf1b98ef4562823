"""The scene as written in its file, checked: a riser, its supports and its loads.

Every part is present or absent; an absent part is not simulated. Fields hold SI values once read. No field
has a default that changes physics: an absent part means an absent effect, as its docstring states.
"""

from __future__ import annotations

from typing import Self

from pydantic import model_validator

from riserstudy.scene.parts import Parts
from riserstudy.scene.rules import check_rules


class Scene(Parts):
    """The top level of a scene file: a riser, its supports and its loads."""

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_rules(self)
        return self
