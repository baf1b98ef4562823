"""The allowance of a sea covers the motion of every tensioner cylinder, not only of the outermost at rest."""

import numpy as np
import pytest
from rigs_in_waves import in_waves, limited

from riserstudy.design.sea_allowances import allowances
from riserstudy.scene.at_rest import static
from riserstudy.simulation.refine import run
from riserstudy.study.in_sea import Sea, in_sea

SEA = Sea(6.0, 11.0)
UNITS = {"tensioner_stroke": "m", "tensioner_force": "N"}


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", [1, 4])
def test_an_allowance_covers_the_motion_of_every_cylinder(seed, spatial):
    """A platform that pitches at an offset moves cylinders on opposite sides by different amounts."""
    tree = in_waves(seed, spatial, 17, "6 m", 20, 60.0, [0.1], [60])
    for one in tree["platform"]["response"]["operators"]:
        one |= {"pitch": "0.6 deg/m", "pitch_phase": "0 deg"}
    tree["platform"]["position"]["surge"] = 0.02 * -float(tree["water"]["seabed"])
    file = limited(tree, dict.fromkeys(UNITS, 1e12), UNITS)
    often = file.with_values({"analysis.output.interval": "0.1 s"}, "test")
    moving, rest = run(in_sea(often, SEA, 1).resolved()).arrays, run(static(file.resolved())).arrays
    for name, one in zip(UNITS, allowances(file, SEA, 1), strict=True):
        assert not one.missing
        motion = float(np.max(moving[name] - rest[f"{name}_static"]))
        assert one.value >= 0.995 * motion, name
