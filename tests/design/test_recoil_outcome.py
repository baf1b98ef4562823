"""Disconnects judged, on histories that can be judged by eye; the riser of both scenes is one."""

from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from riserstudy import load_scene
from riserstudy.design.recoil import limits, outcome

TIME = np.linspace(0.0, 40.0, 401)


def test_a_riser_that_swings_clear_has_the_depth_of_its_trough_as_clearance():
    lift = np.where(TIME > 5.0, 3.0 - 3.0 * np.cos(TIME - 5.0) + 0.1 * (TIME - 5.0), 0.0)
    reach = -lift
    judged = outcome(TIME, lift[None], reach[None], (-7.0, 7.0))
    troughs = lift[(TIME > 6.0) & (5.0 + 2.0 * np.pi + 1.0 > TIME)]
    assert judged.clearance[0] == pytest.approx(troughs[30:].min(), abs=1e-12)
    assert judged.lift[0] == lift.max()
    assert judged.shortest[0] == -lift.max()
    assert not judged.recontact[0]
    assert judged.stroked_out[0] == (lift.max() > 7.0)


@pytest.mark.parametrize(
    "lift, clearance, down",
    [
        (np.where(TIME > 5.0, np.abs(np.sin(TIME)), 0.0), 0.0, True),
        (np.zeros_like(TIME), np.nan, True),  # never leaves the stack
    ],
)
def test_what_touches_and_what_stays(lift, clearance, down):
    judged = outcome(TIME, lift[None], 0.0 * lift[None], (-7.0, 7.0))
    np.testing.assert_allclose(judged.clearance, clearance, atol=5e-3)
    if np.isfinite(clearance):  # between two outputs it may not show
        judged = outcome(TIME, (lift - 5e-3)[None], 0.0 * lift[None], (-7.0, 7.0))
    assert judged.recontact[0] == down


@pytest.mark.parametrize("seed", range(20))
def test_a_run_that_ends_on_the_way_up_or_down_is_not_judged(seed):
    """A lower end that comes down again is judged so if the run contains it, and else not at all."""
    draw = np.random.default_rng(seed)
    highest, down = 5.0 + draw.uniform(3.0, 15.0), 5.0 + draw.uniform(20.0, 33.0)
    steps = np.array([5.0, highest, down]), np.array([0.0, draw.uniform(1.0, 9.0), 0.0])
    falls = PchipInterpolator(*steps)(np.clip(TIME, 5.0, down))
    whole = np.where(down <= TIME, 0.0, falls)  # the stack stops it
    judged = 0
    for end in draw.integers(60, len(TIME), 60):
        lift = np.stack([np.zeros(end), whole[:end]])  # the first one never leaves the stack
        if TIME[end - 1] < down:
            with pytest.raises(ValueError, match="1 of 2 runs"):
                outcome(TIME[:end], lift, 0.0 * lift, (-7.0, 7.0))
        else:
            assert outcome(TIME[:end], lift, 0.0 * lift, (-7.0, 7.0)).recontact.all()
            judged += 1
    assert 0 < judged < 60


@pytest.mark.parametrize("seed", range(8))
def test_a_lower_end_that_has_come_to_rest_is_judged_and_one_that_still_sinks_is_not(seed):
    """It rises within 3 s, and sinks by an exponential function to its place at rest."""
    draw = np.random.default_rng(seed)
    rest, above, decay = draw.uniform(2.0, 5.0), draw.uniform(0.5, 2.0), draw.uniform(1.0, 1.5)
    since = np.maximum(TIME - 5.0, 0.0)
    lift = np.where(since < 3.0, (rest + above) * since / 3.0, rest + above * np.exp(-(since - 3.0) / decay))
    judged = outcome(TIME, lift[None], 0.0 * lift[None], (-7.0, 7.0))
    assert judged.clearance[0] == pytest.approx(rest, rel=1e-6)
    assert not judged.recontact[0]
    short = 5.0 + 3.0 + 3.0 * decay > TIME  # in the second half, it sinks by several per cent
    with pytest.raises(ValueError, match="1 of 1 runs"):
        outcome(TIME[short], lift[None, short], 0.0 * lift[None, short], (-7.0, 7.0))


def test_settings_that_serve_lie_between_those_that_were_tried_and_do_not():
    setting = np.array([2.0, 3.0, 4.0, 5.0, 6.0])
    down = np.array([True, True, False, False, False])
    out = np.array([False, False, False, True, True])
    assert limits(setting, down, out) == (4.0, 3.0, 4.0, 5.0)
    assert np.isnan(limits(setting, down, ~down)).all()
    assert np.isnan(limits(setting, ~down & down, ~down & down)[1::2]).all()


def test_the_riser_that_lets_go_is_the_riser_of_the_chapter():
    """Two files tell it: one with all that acts on it, one along its axis alone, with damping."""
    folder = Path(__file__).parents[2] / "config" / "scenes" / "design"
    whole, along = (load_scene(folder / f"{name}.yaml").resolved() for name in ("riser", "recoil"))
    same = [s.replaced(structural_damping=None) for s in along.riser]
    assert same == whole.riser
    assert along.bottom.body == whole.bottom.body
    assert along.hanging == whole.hanging


@pytest.mark.parametrize("seed", range(20))
def test_all_settings_between_the_limits_serve_and_those_beside_them_do_not(seed):
    """With failures in between, the smallest and the largest setting that serves have no range in common."""
    draw = np.random.default_rng(seed)
    setting = np.cumsum(draw.uniform(0.1, 1.0, int(draw.integers(1, 12))))
    down, out = draw.random((2, len(setting))) < 0.25
    serves = ~down & ~out
    found = limits(setting, down, out)
    if not serves.any():
        assert np.isnan(found).all()
        return
    within = (setting >= found.smallest) & (setting <= found.largest)
    assert serves[within].all()
    for side, beside in ((found.below, setting[setting < found.smallest]),
                         (found.above, setting[setting > found.largest][::-1])):  # fmt: skip
        assert np.isnan(side) if not len(beside) else side == beside[-1]
        assert not len(beside) or not serves[setting == side].any()
    for a in range(len(setting)):  # no other range is wider
        for b in range(a, len(setting)):
            if serves[a : b + 1].all():
                assert setting[b] - setting[a] <= found.largest - found.smallest
