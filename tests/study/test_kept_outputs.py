"""Names to keep that no run returns are refused; names that runs of the scene do not return are warned of."""

from pathlib import Path

import pytest
from random_rigs import moving, written

from riserstudy.dataset.variables import ENDINGS, OF_RUNS, arrays_of
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.study.idle_values import idle_values
from riserstudy.study.sweep import as_study

SCENE = Path(__file__).parents[2] / "config/scenes/bench/s2c.yaml"
AXES = {"top.offset": ["1 m", "2 m"]}
NAMES = [name + ending for name in QUANTITIES for ending in ("", *ENDINGS)]


@pytest.mark.parametrize("name", NAMES)
def test_only_arrays_of_runs_are_kept(name):
    """Envelopes are of quantities along the riser, magnitudes of those with a sign."""
    file = SceneFile("rig.yaml", written(moving(1)))
    if any(name in arrays_of(one) for one in OF_RUNS):
        assert as_study(file, AXES, [name]).model.keep == [name]
        return
    with pytest.raises(InputError, match=f"'{name}' is not an output of a run"):
        as_study(file, AXES, [name])


@pytest.mark.parametrize("name", ["ufj_angle_max", "stroke_static", "tensioner_force_min", "z_absmax"])
def test_a_name_that_is_refused_is_answered_by_the_names_there_are(name):
    with pytest.raises(InputError) as refused:
        as_study(SceneFile("rig.yaml", written(moving(1))), AXES, [name])
    assert refused.value.allowed == "use " + ", ".join(arrays_of(name.rpartition("_")[0]))


@pytest.mark.parametrize("name", sorted(OF_RUNS))
def test_what_the_beam_does_not_return_is_named(name):
    """With lumped masses, the same scene returns it, or lacks another part."""
    beam = {"analysis.solver": "hermite", "analysis.mesh": {"elements": 20}, "analysis.step": "0.1 s"}
    beam["analysis.accuracy"] = None
    file = read_scene(SCENE)
    for more in ({}, beam):
        study = as_study(file.with_values(more, "test"), AXES, [name])
        scene = study.grid.file((0,)).resolved()
        found = idle_values(study)
        assert bool(found) == bool(QUANTITIES[name].lacks(scene))
        if more and not QUANTITIES[name].of_beam:
            assert "without analysis.solver" in found[0]
