"""The scene as its file says it: a riser and what acts on it, checked.

Every section is present or absent; what is absent is not simulated. Fields hold SI once read. No field has
a default that changes physics: an absent section stands for an absent effect, and its docstring says so.
"""

from __future__ import annotations

from typing import Self

from pydantic import model_validator

from riserstudy.scene.parts import Parts
from riserstudy.scene.rules import check_rules


class Scene(Parts):
    """The root of a scene file: a riser, its supports and its loads.

    If the scene has the key ``paper``, values without a stated origin are *published* values. Without this
    key, they are *given* values.
    """

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_rules(self)
        return self
