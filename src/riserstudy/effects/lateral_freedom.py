"""Lateral freedom: a second or third direction of motion, which adds unknowns but no forces.

Lateral freedom has no record (set of parameters): the function `model.layout.directions` counts the
directions that a scene needs. Without large rotations and axial motion, the model would be equal to the beam
with small angles in `solve.hermite`.
"""

from __future__ import annotations

from riserstudy.effects.registry import LATERAL_FREEDOM, Called, call, put_in, taken_out

call(
    Called(
        LATERAL_FREEDOM,
        "a lateral load or motion",
        (
            taken_out("large rotation and axial motion", "lateral", sets={"analysis.solver": "hermite"}),
            put_in(
                "motion out of the plane",
                "spatial",
                {
                    "current.heading": "=current turned",
                    "platform.cruise.heading": "=cruise turned",
                    "platform.sway": {"amplitude": "1e-9 m", "period": "10 s"},
                },
                "almost nothing leads out of the plane: headings turned by 0.0001 deg, sway of 1e-9 m",
                "lateral",
            ),
        ),
    )
)
