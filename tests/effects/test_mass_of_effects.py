"""Mass of effects: slope of the inertial force, lumped form and kinetic energy agree."""

import numpy as np
import pytest
from derivatives import WITH, relative
from rig import PAIRS, Rig, dense_tangent, differences, name
from surroundings import N

from riserstudy.effects.added_mass import AddedMass
from riserstudy.effects.drag import Drag
from riserstudy.effects.registry import ROLES, register
from riserstudy.effects.vessel import Vessel
from riserstudy.solve.evaluate import one_call, shape_of
from riserstudy.solve.program import assemble


@pytest.mark.parametrize("pair", WITH["mass"], ids=name)
def test_the_mass_is_the_slope_of_the_inertial_force(pair):
    rig = Rig(*pair)
    slope = differences(rig.inertial_forces, rig.s.a, 1.0)
    rig.s.rate[:] = 0.0, 1.0
    rig.evaluate()
    mass = dense_tangent(rig.s)
    rig.s.rate[:] = 0.0
    rig.evaluate()
    # linear in acceleration: rounding only
    split = rig.m * rig.s.r.shape[1]
    assert relative((dense_tangent(rig.s) - mass)[split:, split:], slope) < 1e-12


@pytest.mark.parametrize("pair", WITH["mass"], ids=name)
def test_the_lumped_mass_is_the_mass_where_none_is_shared(pair):
    kind, d = pair
    rig = Rig(kind, d)
    rig.s.share[:] = 0.5, 0.0
    rig.s.rate[:] = 0.0, 1.0
    shape_of(rig.model.programs, rig.model.state)
    for role in ("mass", "lump"):
        program = assemble([(ROLES[kind][role], rig.frozen_record())], rig.model.state)
        one_call(program, rig.model.state)
    assert not np.any(rig.s.k_up)
    assert not np.any(rig.s.k_low)
    upper = np.triu(np.ones((d, d), bool)).ravel()
    assert relative(rig.s.lump[upper], rig.s.k_node[:, upper].T) < 1e-14
    assert not np.any(rig.s.lump[~upper])


def test_mass_comes_with_its_lumped_form():
    with pytest.raises(TypeError, match="mass and lump must be given together"):
        register(Drag, mass=ROLES[AddedMass]["mass"])


@pytest.mark.parametrize("pair", [p for p in PAIRS if "kinetic" in ROLES[p[0]]], ids=name)
def test_kinetic_energy_is_half_velocity_times_mass_times_velocity(pair):
    rig = Rig(*pair)
    if pair[0] is AddedMass and pair[1] > 1:
        # on a bent pipe the neighbours' directions differ and the two agree to their angle only
        rig.s.r[:] = np.linspace([0.0] * 3, [30.0, 20.0, 60.0], N + 1).T[[0, 2] if rig.d == 2 else [0, 1, 2]]
    if pair[0] is Vessel and pair[1] == 3:
        rig.s.v[:, -1] = 0.0  # a hull that turns takes energy from the one direction to the other
    rig.s.a[:] = rig.s.v
    power = (rig.inertial_forces() * rig.s.v).sum()
    assert -0.5 * power == pytest.approx(rig.kinetic(), rel=1e-12)
