"""The angle of a lower flex joint has statistics until a disconnect opens it, on rigs in motion."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy import simulate
from riserstudy.dataset.place import complete
from riserstudy.dataset.statistics_tables import most_missed, of_a_run
from riserstudy.scene.load import SceneFile


def disconnected(seed, spatial):
    """A run that disconnects shortly before its end, and the time of this (s)."""
    tree = moving(seed, spatial=spatial, conductor=False)
    release = 0.7 * tree["analysis"]["duration"]
    tree["disconnect"] = {"at": f"{release!r} s", "over": "0.3 s", "stack": {"stiffness": "20 MN/m"}}
    tree["analysis"]["duration"] = release + 1.0
    tree["analysis"]["output"]["interval"] = 0.1
    return complete(simulate(SceneFile("rig.yaml", written(tree)), progress=False)), release


def rows(run, start=0.0):
    """Statistics by output and place."""
    return {(row[0], row[1]): row[3:] for row in of_a_run(run, start, None).rows}


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_what_the_free_end_does_is_no_angle_of_the_joint(seed, spatial):
    run, release = disconnected(seed, spatial)
    found = rows(run)
    joined = run.isel(time=run["time"].values <= release)
    np.testing.assert_allclose(found["lfj_angle", None], rows(joined)["lfj_angle", None], rtol=1e-12)
    other = run.copy(deep=True)
    draw = np.random.default_rng(seed)
    after = run["time"].values > release
    other["lfj_angle"].values[after] = draw.uniform(2.0, 3.0, int(after.sum()))
    np.testing.assert_equal(rows(other), found)
    assert most_missed(other) == most_missed(run)
    late = rows(run, release)
    assert set(found) - set(late) == {("lfj_angle", None)}


def test_the_command_says_where_statistics_end(commands, tmp_path):
    run, release = disconnected(0, spatial=False)
    run.to_netcdf(tmp_path / "run.nc")
    code, _, err = commands("statistics", tmp_path / "run.nc", "-o", tmp_path / "made.csv")
    assert code == 0
    assert f"lfj_angle end with the disconnect at {release:.4g} s" in err
