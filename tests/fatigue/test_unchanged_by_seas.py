"""Waves and motions that no sea state of a table changes are refused, or named."""

import json

import numpy as np
import pytest
from test_years import WAVE, study, summed, table

from riserstudy.errors import InputError


@pytest.mark.parametrize("kind", ["significant_height", "peak_period"])
@pytest.mark.parametrize("seed", range(3))
def test_a_wave_that_the_axes_leave_as_it_is_is_refused(seed, kind, tmp_path):
    """The platform would otherwise move by its own sea, equally in all states of the table."""
    of = study()
    tree = json.loads(of.attrs["scene"])
    draw = np.random.default_rng(seed)
    operators = [{"period": f"{t} s", "surge": "0.5 m/m", "surge_phase": "90 deg"} for t in (1, 60)]
    sea = {name: WAVE[name] for name in WAVE if name != "above_mean_level"}
    tree["platform"]["response"] = {"operators": operators, "phases": "lead", "wave": sea, "ramp": "9 s"}
    of.attrs["scene"] = json.dumps(tree)
    path = table(tmp_path, f"hs (m),tp (s),share (%)\n{draw.uniform(1, 9)},{draw.uniform(5, 15)},80\n")
    every = {name: json.loads(of[name].attrs["sets"]) for name in ("significant_height", "peak_period")}
    for name, sets in every.items():
        if name != kind:
            both = {v: one | {f"platform.response.{p}": x for p, x in one.items()} for v, one in sets.items()}
            of[name].attrs["sets"] = json.dumps(both)
    word = {"significant_height": "height", "peak_period": "period"}[kind]
    with pytest.raises(InputError, match=f"the {word} of platform.response.wave in the scene is equal"):
        summed(of, path)
    both = {v: one | {f"platform.response.{p}": x for p, x in one.items()} for v, one in every[kind].items()}
    of[kind].attrs["sets"] = json.dumps(both)
    assert summed(of, path).worst == summed(study(), path).worst


@pytest.mark.parametrize("moved", [False, True])
def test_a_motion_that_no_sea_changes_is_named(moved, tmp_path):
    of = study()
    tree = json.loads(of.attrs["scene"])
    if moved:
        motion = {"amplitude": "1 m", "period": "11 s"}
        tree["platform"] |= {"surge": motion, "heave": motion, "sway": motion | {"amplitude": "0 m"}}
    of.attrs["scene"] = json.dumps(tree)
    notes = summed(of, table(tmp_path, "hs (m),tp (s),share (%)\n3,9,100\n")).notes
    named = [note for note in notes if note.startswith("prescribed surge and heave of the platform: equal")]
    assert len(named) == moved
