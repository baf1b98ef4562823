"""Maps show the extremes that limits without a place apply to, with lines where these limits are reached."""

import json

import numpy as np
import pytest
import xarray as xr
from random_rigs import rig, written

from riserstudy import sweep
from riserstudy.dataset.limits import use
from riserstudy.dataset.unit_systems import UnitSystem, read_in, reading_in
from riserstudy.figures.grid import extreme
from riserstudy.figures.heat_map import _allowables, heat_map
from riserstudy.scene.limits import OF_THE_RISER, SIGNED, UNITS, Limit
from riserstudy.scene.load import SceneFile

LIMITS = [
    {"output": "effective_tension", "largest": "1 MN", "mode": "connected"},
    {"output": "effective_tension", "smallest": "50 kN", "mode": "connected"},
    {"output": "von_mises_stress", "largest": "200 MPa", "mode": "connected"},
    {"output": "von_mises_stress", "largest": "250 MPa", "mode": "disconnect"},
    {"output": "von_mises_stress", "smallest": "1 MPa", "mode": "connected"},
    {"output": "bending_moment", "largest": "1 MN*m", "mode": "connected"},
]


@pytest.mark.parametrize("seed", range(6))
def test_extremes_of_a_rig_are_the_demands_of_its_limits(seed):
    """With and without a stack and a conductor, which limits without a place do not cover."""
    tree = rig(seed, spatial=bool(seed % 2), conductor=seed < 4)
    if seed < 4:
        tree["riser"][0]["inner_diameter"] = 0.9  # a thin conductor, with larger stresses than the riser
    tree["limits"] = LIMITS
    axes = {"top.offset": ["0 m", "4 m"], "riser[0].drag.coefficient": [0.8, 1.2]}
    runs = sweep(SceneFile("rig.yaml", written(tree)), axes, progress=False)
    for k, limit in enumerate(LIMITS):
        side = "_min" if "smallest" in limit else "_max"
        side = "_absmax" if limit["output"] in SIGNED else side
        demand = runs["demand_of_limit"].isel(limit=k).values
        assert extreme(runs, limit["output"] + side).values == pytest.approx(demand, rel=1e-6)
        figure = heat_map(runs, [limit["output"] + side])
        drawn = next(a for a in figure.axes if a.collections).collections[0].get_array().data
        drawn = np.sort(drawn.ravel()) / read_in(UNITS[limit["output"]]).factor
        assert drawn == pytest.approx(np.sort(demand.ravel()), rel=1e-6)


@pytest.mark.parametrize("ending", ["_max", "_min", "_absmax"])
@pytest.mark.parametrize("side", ["largest", "smallest", "mean"])
@pytest.mark.parametrize("output", UNITS)
def test_lines_of_a_map_are_where_its_limit_is_reached(output, side, ending):
    """Of values from -3 to 3, those of a use of one, for the extreme that the limit applies to."""
    allowable, unit = 2.0, UNITS[output]
    try:
        Limit(output=output, mode="drilling", **{side: f"{allowable} {unit}"})
    except ValueError:
        return  # no such limit
    rows = [{"output": output, "side": side, "at": "", "allowable": allowable}]
    dataset = xr.Dataset(attrs={"limits": json.dumps(rows)})
    with reading_in(UnitSystem.SI):
        found = _allowables(dataset, output + ending)
    values = np.linspace(-3.0, 3.0, 601)
    values = abs(values) if ending == "_absmax" else values
    applies = {"largest": ("_max",), "smallest": ("_min",), "mean": ()}[side]
    if output in SIGNED:
        applies, values = ("_max", "_min", "_absmax") if side == "largest" else (), values
    demand = abs(values) if output in SIGNED else values
    uses = np.array([use(side, one, allowable) for one in demand.tolist()])
    reached = sorted({round(v, 9) for v in values[np.isclose(uses, 1.0)].tolist()})
    inside = [level for level in found if values.min() <= level <= values.max()]
    assert inside == pytest.approx(reached if ending in applies else [])


def test_every_output_of_the_riser_alone_has_a_limit_of_each_side_above():
    assert {one["output"] for one in LIMITS} >= set(OF_THE_RISER)
