"""Time series that the command writes, in any units, are read again by `compare`, at the same places."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.dataset.comparison import compared, difference
from riserstudy.dataset.label import to_dataset
from riserstudy.dataset.tables import in_units, time_series, write_csv
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


@pytest.mark.parametrize("system", ["si", "field", "us"])
@pytest.mark.parametrize("seed", range(4))
def test_a_table_of_time_series_is_that_of_its_run_at_every_place(tmp_path, seed, system):
    tree = moving(seed)
    length = sum(section["length"] for section in tree["riser"])
    stations = sorted(np.random.default_rng(seed).uniform(0.0, length, 3))
    tree["analysis"]["output"]["stations"] = [f"{place!r} m" for place in map(float, stations)]
    file = SceneFile("rig.yaml", written(tree))
    dataset = to_dataset(run(file.resolved(), estimated=False), file, {})
    table = in_units(time_series(dataset), system)
    write_csv(table, tmp_path / "series.csv")
    found = compared(dataset, tmp_path / "series.csv").pairs
    assert len(found) == len(table.columns) - 1
    for pair in found:
        assert pair.notes == [], pair.name
        assert len(pair.along) == dataset.sizes["time"], pair.name
        assert abs(difference(pair).largest) <= 1e-8 * abs(pair.ours).max() + 1e-12, pair.name
