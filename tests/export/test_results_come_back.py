"""A scene and its deck read back give the same results: at rest, in waves, and natural modes."""

import numpy as np
import pytest
from drawn_decks import file_of, there_and_back
from exported_rigs import exported

from riserstudy import modes, simulate

#: a table of a turning current, and of a law, has errors of 0.1 %; drag has twice that of the current
CLOSE = 3e-3
BY_MID_STROKE = ("tensioner_stroke",)  # counted from another state in a deck, which the export names


@pytest.fixture(params=["plane", "space"])
def both(request, seed, tmp_path):
    """A scene and what is read from its deck, with the mesh and step that a deck lacks."""
    tree = exported(seed, request.param == "space")
    file = file_of(tree)
    back, left = there_and_back(file, tmp_path)
    named = {line.partition(":")[0] for line in left}
    assert {"analysis.mesh", "analysis.step"} <= named
    assert ("top.tensioners.mid_stroke" in named) == (
        tree["top"]["tensioners"]["mid_stroke"] == "riser in equilibrium"
    )
    return file, back.with_values({"analysis": tree["analysis"]}, "test")


@pytest.mark.parametrize("seed", range(15))
def test_a_deck_read_back_gives_the_same_results_in_waves(both):
    one, other = (simulate(file, progress=False) for file in both)
    assert one.sizes == other.sizes
    for name, values in one.data_vars.items():
        if values.dtype.kind == "f" and values.attrs.get("units") and not name.startswith(BY_MID_STROKE):
            a, b = values.values, other[name].values
            np.testing.assert_array_equal(np.isnan(a), np.isnan(b))
            assert np.nanmax(np.abs(a - b)) <= CLOSE * np.nanmax(np.abs(a)), name


@pytest.mark.parametrize("seed", range(15))
def test_a_deck_read_back_has_the_same_natural_modes(both):
    one, other = (modes(file, 5) for file in both)
    assert one.frequency.values == pytest.approx(other.frequency.values, rel=1e-3)
    assert list(one.motion.values) == list(other.motion.values)
