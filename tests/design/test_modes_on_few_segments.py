"""Modes that vortices may excite, on few segments: they are those of a fine mesh, or a warning is given."""

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.design.vortex_screening import screening
from riserstudy.scene.load import SceneFile

FINE = 400  # segments


def screened(seed, spatial, elements):
    """The screening of a rig in a fast current."""
    tree = rig(seed, spatial=spatial, conductor=False)
    tree["current"]["profile"]["surface_speed"] = 1.3
    tree["analysis"] = {"mesh": {"elements": elements}}
    for section in tree["riser"]:
        for name in ("drag", "added_mass"):
            section[name]["diameter"] = section["outer_diameter"]
    return screening(SceneFile("rig.yaml", written(tree)))


@pytest.mark.parametrize("seed, spatial", [(0, False), (1, False), (2, False), (3, False), (0, True)])
def test_without_a_warning_modes_are_those_of_a_fine_mesh(seed, spatial):
    fine = screened(seed, spatial, FINE)
    assert "warning" not in fine.attrs
    assert "warning" in screened(seed, spatial, 20).attrs
    every = [screened(seed, spatial, elements) for elements in (60, 200)]
    resolved = [found for found in every if "warning" not in found.attrs]
    assert resolved
    for found in resolved:
        both = np.intersect1d(found["mode"], fine["mode"])
        assert abs(found.sizes["mode"] - fine.sizes["mode"]) <= 2
        of, true = (one.sel(mode=both) for one in (found, fine))
        np.testing.assert_allclose(of["natural_frequency"], true["natural_frequency"], rtol=0.02)
        assert float(found["amplitude"].max()) == pytest.approx(float(fine["amplitude"].max()), rel=0.03)
