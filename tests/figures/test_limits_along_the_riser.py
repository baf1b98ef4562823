"""A graph over arclength draws a limit where it is judged, with and without a stack and a conductor."""

import json

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy import simulate
from riserstudy.dataset.limits import use
from riserstudy.dataset.unit_systems import UnitSystem, reading_in
from riserstudy.figures.range_graph import range_graph
from riserstudy.scene.limits import SIGNED
from riserstudy.scene.load import SceneFile

OUTPUTS = {
    "effective_tension": ("largest", "0.9 MN"),
    "von_mises_stress": ("largest", "60 MPa"),
    "bending_moment": ("largest", "40 kN*m"),
}


def drawn(run, output):
    """Values and both ends of the marks of limits on positive values, in SI units."""
    with reading_in(UnitSystem.SI):
        (ax,) = range_graph(run, "a rig", [output]).axes
    marks = [line for line in ax.lines if str(line.get_label()).startswith("limit")]
    marks += [line for line in ax.lines if line.get_label() == "_" and line.get_color() == "#c00000"]
    ends = [(line.get_xdata()[0], line.get_ydata()[0], line.get_ydata()[-1]) for line in marks]
    return [one for one in ends if one[0] > 0.0]


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_the_use_of_a_limit_is_that_of_the_values_along_its_mark(seed, spatial):
    """For the whole riser, a section, consecutive sections and an end of one."""
    tree = rig(seed, spatial=spatial, conductor=seed < 3)
    tree["platform"]["position"]["surge"] = 20.0
    names = [section["name"] for section in tree["riser"]]
    places = [None, names[0], names[-1], f"lower end of {names[-1]}"] + [names[-2:]] * (len(names) > 1)
    tree["limits"] = []
    for output, (side, value) in OUTPUTS.items():
        for place in places:
            at = {} if place is None else {"at": place}
            tree["limits"].append({"output": output, side: value, "mode": "drilling", **at})
    run = simulate(SceneFile("rig.yaml", written(tree)), progress=False)
    rows = json.loads(run.attrs["limits"])
    for output in OUTPUTS:
        marks, s = drawn(run, output), run["s_node"].values
        values = run[f"{output}_static"].values
        values = np.abs(values) if output in SIGNED else values
        of = [row for row in rows if row["output"] == output]
        assert len(marks) == len(of) == len(places)
        found = []
        for allowable, low, high in marks:
            there = (s >= low - 1e-6) & (s <= high + 1e-6) & np.isfinite(values)
            found.append(use("largest", values[there].max(), allowable))
        assert sorted(found) == pytest.approx(sorted(row["utilisation"] for row in of), rel=1e-9)
