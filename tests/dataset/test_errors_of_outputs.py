"""The estimated error of each output that may have a limit is at least its difference between two meshes."""

from functools import cache

import pytest
from random_rigs import moving, written

from riserstudy.dataset.limits import FACTS, SCALES, checked, error_of
from riserstudy.model.mesh import prescribed
from riserstudy.scene.limits import ENDS, UNITS
from riserstudy.scene.load import SceneFile
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.run import finish, march

#: stresses follow from two quantities, and their errors from none alone
ALONE = [name for name in UNITS if len(QUANTITIES[name].errors) == 1]


@cache
def pair(seed):
    """Extremes of a drawn rig on a mesh and on one twice as fine, and the facts of the finer run."""
    tree = moving(seed, spatial=True, conductor=seed % 2 == 0)
    tree["platform"]["position"]["sway"] = 0.0
    tree["platform"]["sway"] = {**tree["platform"]["surge"], "amplitude": 0.1}  # mainly along x
    tree["analysis"] = {"duration": 12.0, "output": {"interval": 0.5}, "step": 0.5}
    scene = SceneFile("rig.yaml", written(tree)).with_values({"analysis.mesh": {"elements": 20}}, "t")
    scene = scene.resolved()
    coarse, fine = (march(scene, prescribed(scene, n), 0.5) for n in (20, 40))
    share = difference(coarse, fine)
    done = [finish(scene, prescribed(scene, n), of) for n, of in ((20, coarse), (40, fine))]
    rows = [{(r["output"], r["where"]): r for r in of.facts["extremes"]} for of in done]
    return rows, {**done[1].facts, "error_estimate": share}


@pytest.mark.parametrize("output", ALONE)
@pytest.mark.parametrize("seed", range(6))
def test_an_error_is_at_least_the_difference_of_two_runs(seed, output):
    """At the ends of sections, which are nodes of both meshes, and of outputs without a place."""
    (low, up), facts = pair(seed)
    size = error_of(output, facts, own_mesh=True).size
    places = [place for of, place in up if of == output and (place == "" or place.startswith(ENDS))]
    off = [abs(up[output, place][side] - low[output, place][side])
           for place in places for side in ("largest", "smallest")]  # fmt: skip
    assert all(one <= size * (1.0 + 1e-9) + 1e-9 for one in off)


class Seen(dict):
    """Facts that tell which of them were asked for."""

    def __init__(self, *given):
        super().__init__(*given)
        self.asked = set()

    def get(self, key, default=None):
        self.asked.add(key)
        return super().get(key, default)

    def __contains__(self, key):
        self.asked.add(key)
        return super().__contains__(key)

    def __getitem__(self, key):
        self.asked.add(key)
        return super().__getitem__(key)


def test_limits_ask_for_no_fact_that_is_not_listed():
    """A study reads only the listed facts from its store, and would judge a limit without the others."""
    tree, asked = moving(3, spatial=True), set()
    for output in UNITS:
        more = {"limits": [{"output": output, "largest": f"1e9 {UNITS[output]}", "mode": "connected"}]}
        file = SceneFile("rig.yaml", written(tree) | more)
        scene = file.with_values({"top.telescopic_joint": None}, "t") if output == "stroke" else file
        row = {"output": output, "where": "", "largest": 1.0, "smallest": -1.0}
        errors = dict.fromkeys(("displacement", *QUANTITIES[output].errors), 0.1)
        for since in ({}, {"vibration_since": 1.0}):
            facts = Seen({"extremes": [row], "error_estimate": errors, **since})
            if output != "stroke":
                checked(scene, scene.resolved(), facts)
            error_of(output, facts, own_mesh=True)
            asked |= facts.asked
    assert asked <= set(FACTS)
    assert set(SCALES.values()) <= asked
