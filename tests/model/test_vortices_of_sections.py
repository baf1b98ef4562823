"""Vortices of risers whose sections shed them differently, or not at all: seeded rigs."""

import numpy as np
import pytest
from random_rigs import rig, timed, written

from riserstudy.model.mesh import even
from riserstudy.model.vortices import at_nodes, ramp_of, shedding, shedding_period
from riserstudy.scene.load import SceneFile


def shedding_rig(seed, sheds=None, speed=0.5, times=1.0):
    """A rig of which some sections (None: all) shed vortices, with random diameters and frequencies."""
    draw = np.random.default_rng(seed)
    tree = rig(seed, spatial=True, conductor=False)
    ends = zip((tree["water"]["seabed"], 0.0), (0.2 * speed, speed), strict=True)
    tree["current"]["profile"] = [{"elevation": z, "speed": u} for z, u in ends]
    for k, section in enumerate(tree["riser"]):
        frequencies = np.sort(draw.uniform(0.1, 0.3, 3))
        viv = {"model": "synchronisation", "coefficient": 1.2, "memory": 20.0, "seed": 1}
        viv |= {"diameter": float(draw.uniform(0.3, 1.2)), "frequencies": frequencies.tolist()}
        viv["in_line"] = {"coefficient": 0.5, "frequencies": (times * frequencies).tolist()}
        if sheds is None or k in sheds:
            section["viv"] = viv
    tree["analysis"] = timed(9e3, 0.2, 50, 0.5)
    return SceneFile("rig.yaml", written(tree)).resolved()


@pytest.mark.parametrize("seed", range(6))
def test_the_shortest_period_is_that_of_one_section(seed):
    """Of all sections together and alone, in twice the current, and with faster forces along the flow."""
    every = shedding_rig(seed)
    alone = [shedding_rig(seed, [k]) for k in range(len(every.riser))]
    for free in (False, True):
        assert shedding_period(every, free) == min(shedding_period(one, free) for one in alone)
        twice = shedding_period(shedding_rig(seed, speed=1.0), free)
        assert shedding_period(every, free) == pytest.approx(2.0 * twice)
        faster = shedding_period(shedding_rig(seed, times=2.5), free)
        assert shedding_period(every, free) == pytest.approx((1.0 if free else 2.5) * faster)
    own = [one.diameter / one.frequencies[1] for one in shedding(every)]
    assert shedding_period(every, True) == pytest.approx(min(own) / 0.5)
    assert shedding_period(every) < shedding_period(every, True)
    assert ramp_of(every) == pytest.approx(10.0 * shedding_period(every, True))


@pytest.mark.parametrize("seed", range(6))
def test_values_at_nodes_are_between_those_of_their_segments(seed):
    """Inside a section its own; between two, nearer to that of the longer segment; without any, zero."""
    draw = np.random.default_rng(seed)
    scene = shedding_rig(seed)
    mesh, sections = even(scene, int(draw.integers(7, 40))), len(scene.riser)
    values = draw.uniform(1.0, 2.0, (sections, 2))
    there = draw.random(sections) < 0.7
    found = at_nodes(mesh, values, there)
    assert found.shape == (2, len(mesh.s))
    for node in range(len(mesh.s)):
        around = [e for e in (node - 1, node) if 0 <= e < len(mesh.l0)]
        around = [e for e in around if mesh.section[e] < sections and there[mesh.section[e]]]
        own = np.array([values[mesh.section[e]] for e in around])
        if not around:
            assert (found[:, node] == 0.0).all()
        elif len({*mesh.section[around]}) == 1:
            np.testing.assert_allclose(found[:, node], own[0], rtol=1e-12)
        else:
            below, above = abs(found[:, node] - own)
            np.testing.assert_allclose(below * mesh.l0[node - 1], above * mesh.l0[node], rtol=1e-9)
            np.testing.assert_allclose(below + above, abs(own[1] - own[0]), rtol=1e-9)
