"""Remarks of the table of effects name the fault alone."""

import numpy as np
import pytest
import xarray as xr

from chapters.numerics.report.tables import CHANGES, changes
from riserstudy.errors import InputError, InputErrors

CHANGE = "the change 'with drag'"
WHERE = f"config/scenes/bench/s4b.yaml with {CHANGE}"
FIRST = InputError(
    WHERE, "riser[0].submerged_weight", "riser section 'riser' has no weight", "give submerged_weight"
)
SECOND = InputError(WHERE, "riser[0].drag", "has no diameter", "give drag.diameter")
BECAUSE = "hermite cannot simulate drag (the effect is not in this method); remove it"


@pytest.mark.parametrize(
    "message, remark",
    [
        (str(FIRST), "riser section 'riser' has no weight"),
        (str(InputErrors([FIRST, SECOND])), "riser section 'riser' has no weight"),
        (str(SECOND), "riser[0].drag has no diameter"),
        (str(InputError(f"s.yaml with b.yaml: studies.a.set, {CHANGE}", "top", "is not", "x")), "top is not"),
        (str(InputError("s4b.yaml", "", "is empty", "write a scene")), "the scene is empty"),
        (BECAUSE, BECAUSE.removesuffix("; remove it")),
    ],
)
def test_a_change_that_is_refused_is_told_without_file_and_remedy(message, remark):
    nothing = (("scene", "change"), np.full((1, 1), np.nan))
    of = xr.Dataset(
        {**dict.fromkeys([*CHANGES, "time_change"], nothing), "message": (("scene", "change"), [[message]])},
        coords={"scene": ["s4b"], "change": ["with drag"]},
    )
    ((*_, cell),) = changes(of).rows
    assert cell.text == f"Not possible, because {remark}."
