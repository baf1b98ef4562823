"""The share of vibration needs equal details in the studies with and without vibration."""

import pytest
from fatigued_rigs import INSIDE, WELD
from test_years import study, summed, table

from riserstudy.errors import InputError
from riserstudy.fatigue.vibration_share import shares
from riserstudy.fatigue.years import VIBRATION

CHANGES = [{"stress_concentration": 2.0}, {"curve": INSIDE["curve"]}, {"face": "inside"}]


@pytest.mark.parametrize("change", CHANGES)
def test_details_with_other_curves_or_factors_are_refused(tmp_path, change):
    """Their difference is not due to vibration."""
    path = table(tmp_path, "hs (m),tp (s),share (%)\n2.5,9,100\n")
    vibrating = study().assign_attrs(effects=VIBRATION)
    years, same, other = (
        summed(of, path) for of in (vibrating, study(), study(details=(WELD | change, INSIDE)))
    )
    assert [one.share for one in shares(years, same)] == pytest.approx([0.0, 0.0], abs=1e-9)
    with pytest.raises(InputError, match="different curves, places or factors of weld"):
        shares(years, other)
