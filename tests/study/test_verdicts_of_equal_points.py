"""Points that differ by nothing have one verdict, whether or not their error is estimated."""

import json

import pytest
from random_rigs import moving, written

from riserstudy.study import simulate_points, store
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.repeat_point import rerun
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel

LIMITS = [
    {"output": "bending_moment", "largest": "1 GN*m", "mode": "drilling"},
    {"output": "ufj_angle", "largest": "9 deg", "mode": "connected"},
    {"output": "lfj_angle", "largest": "3 deg", "mode": "connected"},
    {"output": "effective_tension", "largest": "90 MN", "mode": "drilling"},
]
DENSITIES = [1025.0 * (1.0 + 1e-9 * k) for k in range(4)]


@pytest.fixture(autouse=True)
def own_store_and_one_estimate(tmp_path, monkeypatch):
    """No point is there before a test; keys, which change with the engine, select none in the middle."""
    monkeypatch.setattr(store, "_file", lambda key: tmp_path / f"{key}.point")
    monkeypatch.setattr(simulate_points, "ONE_IN", 16**4 + 1)


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(5))
def test_equal_points_have_one_verdict(seed, spatial, tmp_path):
    """In a preview, only the last of four points has an estimate; meshes are coarse."""
    tree = moving(seed, spatial=spatial, conductor=seed == 4)
    tree["analysis"]["mesh"] = {"elements": 3 + 2 * seed}
    tree["analysis"]["duration"] = 12 * tree["analysis"]["output"]["interval"]
    (tmp_path / "rig.yaml").write_text(json.dumps(written(tree)))
    axis = {"path": "water.density", "unit": "kg/m^3", "values": DENSITIES}
    model = {"scene": "rig.yaml", "caption": "c", "axes": {"density": axis}, "limits": LIMITS}
    study = Study("own", "equal", StudyModel.model_validate(model), tmp_path, "preview")
    found = dataset_of(study, results_of(study, 1, lambda _: None)[0])
    assert found["error_estimated"].values.tolist() == [0, 0, 0, 1]
    verdicts = found["verdict_of_limit"].transpose("density", "limit").values
    for of_limit in verdicts.T:
        assert len(set(of_limit)) == 1
    again = rerun(found, {"density": str(found["density"].values[1])})
    assert again.changes["verdict_of_limit"] == 0.0
