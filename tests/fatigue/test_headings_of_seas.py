"""Headings of a scatter table count by whole turns, and none is calmer than another: seeded tables."""

import json
import math

import numpy as np
import pytest
from test_years import study, summed, table

from riserstudy.errors import InputError

HEADINGS = {"degree": np.arange(-90.0, 181.0, 45.0), "rad": np.arange(7) * 0.8}
TURN = {"degree": 360.0, "rad": 2.0 * math.pi}


def turned(unit):
    """The made-up study over heights and headings, in a unit."""
    of = study(periods=HEADINGS[unit]).isel(seed=0, drop=True).rename({"peak_period": "heading"})
    name = {"degree": "deg", "rad": "rad"}[unit]
    values = {str(v): {"wave.heading": f"{v} {name}"} for v in of["heading"].values.tolist()}
    of["heading"].attrs = {"units": unit, "sets": json.dumps(values)}
    return of, name


@pytest.mark.parametrize("unit", [*TURN])
@pytest.mark.parametrize("seed", range(5))
def test_whole_turns_change_nothing(seed, unit, tmp_path):
    draw = np.random.default_rng(seed)
    of, name = turned(unit)
    heights = draw.uniform(1.0, 9.0, 12)
    angles = draw.uniform(HEADINGS[unit][0], HEADINGS[unit][-1], 12)
    turns = draw.integers(-3, 4, 12) * TURN[unit]
    found = []
    for more in (0.0, turns):
        rows = zip(heights.tolist(), (angles + more).tolist(), strict=True)
        text = "\n".join([f"hs (m),heading ({name}),share (%)", *(f"{h!r},{a!r},8" for h, a in rows)])
        found.append(summed(of, table(tmp_path, text + "\n")))
    assert [w.rate for w in found[1].worst] == pytest.approx([w.rate for w in found[0].worst])
    assert found[1].notes == found[0].notes


@pytest.mark.parametrize("heading", [-100.0, 190.0, 620.0])
@pytest.mark.parametrize("calm", [False, True])
def test_a_heading_that_is_not_simulated_is_refused(heading, calm, tmp_path):
    """Also with calmer seas as the calmest, which is not offered for it."""
    of, _ = turned("degree")
    path = table(tmp_path, f"hs (m),heading (deg),share (%)\n2,{heading},50\n2,0,50\n")
    with pytest.raises(InputError, match="outside the simulated range -90 to 180") as refused:
        summed(of, path, calm=calm)
    assert "--calm" not in str(refused.value)


def test_an_offset_on_the_other_side_is_not_calmer(tmp_path):
    of = study(periods=np.arange(0.0, 21.0, 5.0)).isel(seed=0, drop=True)
    of = of.rename({"peak_period": "offset"})
    values = {str(v): {"platform.position.surge": f"{v} m"} for v in of["offset"].values.tolist()}
    of["offset"].attrs = {"units": "m", "sets": json.dumps(values)}
    path = table(tmp_path, "hs (m),offset (m),share (%)\n2,-5,50\n2,0,50\n")
    with pytest.raises(InputError, match="outside the simulated range 0 to 20"):
        summed(of, path, calm=True)
