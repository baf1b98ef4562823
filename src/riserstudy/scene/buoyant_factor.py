"""Weight and top tension of a riser given by a buoyant factor and a tension ratio."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from riserstudy.inputs.strict import Strict
from riserstudy.scene.base import Positive
from riserstudy.scene.riser import Section

#: for each interpretation, functions of the factor: the share of the dry weight that remains along the riser,
#: and the share of the dry weight that the tension ratio multiplies
READINGS = {"R1": lambda b: (1.0 - b, 1.0 - b), "R2": lambda b: (b, b), "R3": lambda b: (b, 1.0)}


class Buoyancy(Strict):
    """Foam blocks around the riser, from which submerged weights and top tension are computed.

    The keys ``factor`` (b) and ``tension_ratio`` (e) can be interpreted in three ways. The key ``reading``
    selects one of the interpretations R1, R2 or R3. The interpretations R1, R2 and R3 give different formulas
    for the effective tension at a distance h below the top. In the formulas of R1, R2 and R3, w is the weight
    in air of riser and contents per length, and L the length of the riser. With R1, the effective tension is
    (1 - b) w (e L - h), and the blocks carry the fraction b of the weight. With R2, the effective tension is
    b w (e L - h), and the blocks carry the fraction 1 - b of the weight. With R3, the effective tension is w
    (e L - b h), and the blocks carry the fraction 1 - b of the weight. If there is a body at the top of the
    riser, the top tension also carries the weight of the body.
    """

    factor: Annotated[float, Field(ge=0, le=1)]
    tension_ratio: Positive
    reading: Literal["R1", "R2", "R3"]

    def loads(self, riser: list[Section], gravity: float) -> tuple[list[Section], float]:
        """Sections with their submerged weights, and the top tension (N)."""
        left, of_tension = READINGS[self.reading](self.factor)
        tension, sections = 0.0, []
        for section in riser:
            inside = section.contents_mass * gravity
            dry = (section.mass or 0.0) * gravity + inside
            tension += self.tension_ratio * of_tension * dry * section.total_length
            sections.append(section.replaced(submerged_weight=left * dry - inside))
        return sections, tension
