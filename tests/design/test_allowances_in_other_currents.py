"""The envelope of a current does not depend on the current that the scene itself has."""

import numpy as np
import pytest
from rigs_in_waves import in_waves, limited

from riserstudy.design.envelope import envelope
from riserstudy.study.in_sea import Sea

SEA = Sea(5.0, 11.0)
SPEEDS = [0.05, 0.9]
ALLOWED = 0.1  # rad


def ends_of(tree, own):
    """Ends of the envelope (m) in each current; ``own``: current of the scene itself (m/s)."""
    tree["current"]["profile"]["surface_speed"] = own
    file = limited(tree, {"lfj_angle": ALLOWED}, {"lfj_angle": "rad"})
    found = envelope(file, -0.15 * tree["water"]["seabed"], SPEEDS, [SEA], 5)
    assert not found.missing
    return np.array([row[3:5] for row in found.table.rows], float)


@pytest.mark.long
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_current_of_the_scene_does_not_change_the_envelope_of_another(seed, spatial):
    """In a strong current, drag damps the lower end, which moves by a tenth of its motion in a weak one."""
    tree = in_waves(seed, spatial, 31, "5 m", 30, 40.0, [0.1], [160])
    weak, strong = (ends_of(tree, own) for own in SPEEDS)
    assert np.isfinite(weak).any()
    np.testing.assert_allclose(weak, strong, atol=0.01)
