"""Plots of runs with a disconnect show whole runs, and do not judge them by limits that end before.

A limit of drilling or of a connected riser applies until the disconnect only: the demand of such a limit is
not the extreme of a run, and a line where the extreme reaches it would not be where its verdict changes.
"""

import json

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy import simulate, sweep
from riserstudy.dataset.unit_systems import UnitSystem, reading_in
from riserstudy.figures.grid import extreme
from riserstudy.figures.heat_map import _allowables
from riserstudy.figures.range_graph import range_graph
from riserstudy.scene.load import SceneFile

STEP, AT = 0.1, 4.0  # s
OUTPUTS = {"effective_tension": 5.0, "von_mises_stress": 300.0, "bending_moment": 2.0}
UNITS = {"effective_tension": "MN", "von_mises_stress": "MPa", "bending_moment": "MN*m"}
RELEASE = {"at": f"{AT} s", "over": "0.3 s", "stack": {"stiffness": "20 MN/m"}}


def released(seed):
    """A rig that disconnects, with a limit of drilling above that of the mode disconnect."""
    tree = moving(seed, spatial=bool(seed % 2), conductor=False)
    times = {"duration": AT + 3.0, "step": STEP, "output": {"interval": STEP}, "method": "ESDIRK4"}
    tree["analysis"] |= times
    tree["top"]["telescopic_joint"]["stop"] = {"collapse": "4 m", "stiffness": "5 MN/m"}
    tree["disconnect"] = dict(RELEASE)
    tree["limits"] = [
        {"output": name, "largest": f"{share * value} {UNITS[name]}", "mode": mode}
        for mode, share in (("drilling", 1.0), ("disconnect", 1.5))
        for name, value in OUTPUTS.items()
    ]
    return tree


@pytest.mark.parametrize("by_axis", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_maps_show_the_extremes_of_whole_runs_and_limits_that_apply_to_them(own_store, seed, by_axis):
    tree = released(seed)
    axes = {"top.telescopic_joint.bending_stiffness": [5e8, 6e8]}
    if by_axis:
        del tree["disconnect"]
        axes |= {"release": {"held": {"disconnect": None}, "let go": {"disconnect": RELEASE}}}
    runs = sweep(SceneFile("rig.yaml", written(tree)), axes, progress=False, cores=1)
    for name in ("effective_tension", "von_mises_stress"):
        envelope = runs[f"{name}_max"]  # of all steps, at all nodes
        if name == "effective_tension":  # the tension of the riser, without its telescopic joint
            envelope = envelope.isel(s_node=slice(-1))
        assert extreme(runs, f"{name}_max").values == pytest.approx(envelope.max("s_node").values, rel=1e-6)
    rows = json.loads(runs.attrs["limits"])
    for name in OUTPUTS:
        (allowable,) = (r["allowable"] for r in rows if (r["output"], r["mode"]) == (name, "disconnect"))
        with reading_in(UnitSystem.SI):
            assert {abs(level) for level in _allowables(runs, f"{name}_max")} == {allowable}


@pytest.mark.parametrize("seed", range(4))
def test_a_graph_over_arclength_tells_the_limits_that_end_before_its_values(seed):
    tree = released(seed)
    run = simulate(SceneFile("rig.yaml", written(tree)), progress=False)
    del tree["disconnect"]
    held = simulate(SceneFile("rig.yaml", written(tree)), progress=False)
    for of, words in ((run, {"limit", "limit until the disconnect"}), (held, {"limit"})):
        for name in OUTPUTS:
            (ax,) = range_graph(of, "a rig", [name]).axes
            labels = {str(line.get_label()) for line in ax.lines}
            assert {label for label in labels if label.startswith("limit")} == words
    assert np.isfinite(run["von_mises_stress_max"].values).any()
