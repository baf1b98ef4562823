"""Studies with common points: the dataset of one does not depend on whether another one ran before."""

import numpy as np
import pytest
import xarray as xr
from random_rigs import moving, written
from ruamel.yaml import YAML
from some_seeds import seeds

from riserstudy.study import store
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.models import StudyFile
from riserstudy.study.study import Study

MANY = [*range(1000, 1018)]  # kg/m3; so many points that the error is estimated at some of them
DENSITIES = {"few": MANY[:12:4], "many": MANY}
MEASURED = {"wall_seconds", "solve_seconds"}


def dataset(folder, name, limits):
    axis = {"path": "water.density", "unit": "kg/m^3", "values": DENSITIES[name]}
    model = {"scene": "rig.yaml", "caption": "c", "axes": {"density": axis}, "limits": limits}
    file = StudyFile.model_validate({"paper": "own", "studies": {name: model}})
    study = Study("own", name, file.studies[name], folder, "standard")
    found = dataset_of(study, results_of(study, 1, lambda _: None)[0])
    del found.attrs["history"]
    return found.drop_vars(MEASURED & {*found.variables})


def in_order(folder, names, limits, monkeypatch):
    """Datasets of studies that run in this order on a store of their own."""
    points = folder / "-".join(names)
    points.mkdir()
    monkeypatch.setattr(store, "_file", lambda key: points / f"{key}.point")
    return {name: dataset(folder, name, limits) for name in names}


@pytest.mark.parametrize("seed", seeds(8, few=4))
def test_a_dataset_does_not_depend_on_other_studies(seed, tmp_path, monkeypatch):
    """Also where the error exceeds the result, so that the estimate decides verdicts and warnings."""
    tree = moving(seed, spatial=seed % 2 == 1, conductor=seed % 3 == 2)
    interval, coarse = tree["analysis"]["output"]["interval"], seed % 4 == 3
    tree["analysis"] |= {"duration": 4 * interval, "mesh": {"elements": 2 if coarse else 8}}
    YAML().dump(written(tree), tmp_path / "rig.yaml")
    limit = {"output": "lfj_angle", "largest": "80 deg", "mode": "drilling"}
    demand = in_order(tmp_path, ["few"], [limit], monkeypatch)["few"]["demand_of_limit"]
    # 0.1 % above the largest demand: within the limit only if no error is estimated at any point
    limits = [limit | {"largest": f"{1.001 * float(np.rad2deg(demand.max()))!r} deg"}]
    first = in_order(tmp_path, ["few", "many"], limits, monkeypatch)
    second = in_order(tmp_path, ["many", "few"], limits, monkeypatch)
    assert first["few"]["error_estimated"].all()
    assert not first["many"]["error_estimated"].all()
    verdicts = {*first["many"]["verdict_of_limit"].values.ravel()}
    assert "not evaluated" in verdicts
    assert "within" not in verdicts
    for name, found in first.items():
        # functions of arrays differ in the last digit with the place of an array in memory
        xr.testing.assert_allclose(found, second[name], rtol=1e-12, atol=1e-15)
        assert found.attrs == second[name].attrs
