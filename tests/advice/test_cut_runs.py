"""Advice on a part of a run is on what the scene shows: not on the time of its ramps, nor on half a drift."""

import re

import pytest
from random_rigs import moving, written

from riserstudy.advice import recommendations
from riserstudy.scene.load import SceneFile

PERIODS, RAMP = 14, 5  # of a run, and of its ramps


def long_run(seed, cruise):
    """A rig whose motions grow over some periods, and whether it drifts meanwhile."""
    tree = moving(seed, conductor=False)
    period = tree["platform"]["surge"]["period"]
    for name in ("surge", "sway", "heave", "pitch"):
        if name in tree["platform"]:
            tree["platform"][name]["ramp"] = RAMP * period
    if cruise:
        tree["platform"]["cruise"] = {"speed": 0.02, "ramp": period}
    tree["analysis"] |= {"duration": PERIODS * period, "mesh": {"elements": 12}}
    return SceneFile("rig.yaml", written(tree)), period


@pytest.mark.parametrize("cruise", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_runs_are_cut_after_their_ramps_and_drifts_not_at_all(seed, cruise, monkeypatch):
    monkeypatch.setattr("riserstudy.advice.ablation.fitting", lambda _: [])
    monkeypatch.setattr(recommendations, "BUDGET", 100.0)
    file, period = long_run(seed, cruise)
    told = " ".join(recommendations.advice(file).sentences)
    found = re.search(r"over the first (\S+) s of (\S+) s", told)
    if cruise:
        assert found is None
    else:
        assert found
        assert (RAMP + 1) * period < float(found[1]) < PERIODS * period
