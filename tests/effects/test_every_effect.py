"""What every effect must satisfy, whatever it is: kernel, plain version, energy and derivatives agree."""

import numpy as np
import pytest
from derivatives import DIFFERENCES, WITH, check_blocks, relative
from each.bending import bending
from each.drag import drag
from each.vortex_drag import vortex_drag
from each.vortex_lift import vortex_lift
from hypothesis import given
from hypothesis import strategies as st
from plain import at_nodes, lump, pressed
from rig import CASES, MOTIONS, PAIRS, PLAIN, Rig, copied, dense_tangent, differences, name
from surroundings import N, nodes

from riserstudy.effects.added_mass import AddedMass
from riserstudy.effects.bending import Bending
from riserstudy.effects.bending_damping import BendingDamping
from riserstudy.effects.bending_in_space import SpatialBending
from riserstudy.effects.current import Current
from riserstudy.effects.drag import Drag
from riserstudy.effects.drag_over_depth import DragOverDepth
from riserstudy.effects.draining import Draining
from riserstudy.effects.fading_moment import FadingMoment
from riserstudy.effects.flex_joint import FlexJoint
from riserstudy.effects.foreshortening import Foreshortening
from riserstudy.effects.inner_flex_joint import InnerFlexJoint
from riserstudy.effects.registry import ROLES
from riserstudy.effects.vortex_drag import VortexDrag
from riserstudy.effects.vortex_lift import VortexLift
from riserstudy.effects.waterline import Waterline
from riserstudy.effects.wave_force import WaveForce
from riserstudy.solve.blocktri import solve
from riserstudy.solve.evaluate import one_call, shape_of
from riserstudy.solve.jit import kernel
from riserstudy.solve.program import assemble

# plain versions that sample what the kernel integrates, a jump within a segment
SAMPLED = {DragOverDepth: 1e-5, Draining: 1e-3}
FORCES = [p for p in PAIRS if {"string", "device", "law", "turn"} & set(ROLES[p[0]])]


# whose shear is in exact equilibrium instead of the slope of an energy, see test_bending_in_space
SPATIAL = (SpatialBending, BendingDamping, FlexJoint, FadingMoment)
BESIDE_BENDING_IN_SPACE = {*((kind, 3) for kind in SPATIAL), (InnerFlexJoint, 3)}


def test_every_registered_effect_has_a_case_and_a_plain_version():
    assert set(CASES) == set(ROLES)
    assert set(PLAIN) | set(MOTIONS) == set(ROLES)


@pytest.mark.parametrize("pair", [p for p in PAIRS if p[0] in PLAIN], ids=name)
def test_the_kernel_agrees_with_the_plain_version(pair):
    kind, d = pair
    rig = Rig(kind, d)
    shape_of(rig.model.programs, rig.model.state)
    for roles, version in PLAIN[kind]:
        rig.s.pull[:] = 1e5, 2e5
        expected = version(rig.record, rig.s)
        if "pull" in expected:  # what a law adds
            expected["pull"] = rig.s.pull + expected["pull"]
        for target in set(expected) & {"force", "turn", "water", "water_rate"}:
            if kind is not Waterline:  # which takes water away
                getattr(rig.s, target)[:] = 0.0
        rig.s.segment[:] = 0.0
        for role in roles.split():
            one_call(assemble([(ROLES[kind][role], rig.frozen_record())], rig.model.state), rig.model.state)
        rig.s.force[:, : N + 1] += nodes(rig.s.segment)
        for target, value in expected.items():
            # a few roundings of the largest term; rates of what turns are differences here
            by_differences = target in ("reach_rate", "carried")
            limit = 1e-10 if by_differences else SAMPLED.get(kind, 1e-12)
            assert relative(getattr(rig.s, target), value) < limit, (roles, target)


def test_small_turning_angles_agree_with_the_plain_version_too():
    rig = Rig(Bending, 2)
    place = np.append(0.0, np.cumsum(rig.s.l0))
    rig.s.r[:] = 0.3 * place + 1e-4 * place**2, 0.95 * place  # turns by 2e-3 rad a node
    rig.s.moment[:] = 0.0
    turn = rig.evaluate()[0]
    # angles of 0.3 rad are known to 5e-17, their differences not better
    np.testing.assert_allclose(turn, bending(rig.record, rig.s)["turn"][0], atol=1e-15)


@pytest.mark.parametrize("pair", [p for p in PAIRS if p[0] in MOTIONS], ids=name)
@pytest.mark.parametrize("time", [0.7, 2.9, 4.3, 9.9, 11.3, 20.0])
def test_platform_motions_agree_with_the_plain_version_and_its_derivatives(pair, time):
    kind, d = pair
    rig = Rig(kind, d)
    rig.s.platform[:] = 0.0
    rig.s.clock[0] = time
    one_call(rig.model.programs.value.motion, rig.model.state)
    plain = MOTIONS[kind]
    h = 1e-3
    five = [plain(rig.record, time + k * h) for k in (-2, -1, 0, 1, 2)]
    assert relative(rig.s.platform[0], five[2]) < 1e-12
    velocity = (five[0] - 8 * five[1] + 8 * five[3] - five[4]) / (12 * h)
    bend = (-five[0] + 16 * five[1] - 30 * five[2] + 16 * five[3] - five[4]) / (12 * h * h)
    # rounding of 1e-15 over h and h squared
    np.testing.assert_allclose(rig.s.platform[1], velocity, atol=1e-10)
    np.testing.assert_allclose(rig.s.platform[2], bend, atol=1e-7)


@pytest.mark.parametrize("pair", [p for p in WITH["potential"] if p not in BESIDE_BENDING_IN_SPACE], ids=name)
def test_the_force_is_minus_the_slope_of_the_energy(pair):
    rig = Rig(*pair)
    rig.s.v[:] = 0.0  # the energy is that of the elastic part alone, and nothing drags
    rig.s.clock[1] = 0.0
    slope = differences(rig.potential, rig.s.r, 1e-3)
    rig.settle_moments()
    force = rig.evaluate()[rig.m :].ravel()
    assert relative(-slope[0], force) < DIFFERENCES


@pytest.mark.long
@pytest.mark.parametrize("pair", FORCES, ids=name)
def test_the_tangent_is_the_slope_of_the_force_by_position(pair):
    kind, d = pair
    rig = Rig(kind, d)
    rig.evaluate()
    tangent = dense_tangent(rig.s)
    if kind is WaveForce:  # left out of the stiffness altogether, as its file says
        assert not tangent.any()
        return
    if kind in OF_VORTICES:
        split = rig.m * (N + 1)
        slope = slope_with_phases_held(rig, OF_VORTICES[kind])
        assert relative(-tangent[split:, split:], slope) < DIFFERENCES
        return
    if kind in (Drag, DragOverDepth):
        split = rig.m * (N + 1)
        assert relative(-tangent[split:, split:], slope_of_drag(rig)) < DIFFERENCES
        return
    check_blocks(rig, tangent, differences(rig.evaluate, rig.s.r, 1e-3))


@pytest.mark.parametrize("pair", FORCES, ids=name)
def test_the_tangent_is_the_slope_of_the_force_by_velocity_too(pair):
    rig = Rig(*pair)
    rig.evaluate()
    still = dense_tangent(rig.s)
    rig.s.rate[0] = 7.0
    rig.evaluate()
    moving = dense_tangent(rig.s)
    check_blocks(rig, moving - still, 7.0 * differences(rig.evaluate, rig.s.v, 1e-3))


def slope_of_drag(rig):
    """Slope of the force where loads turn with the pipe on their own nodes, as the effect's file says."""
    s, record = rig.s, copied(rig.record)
    held, water, v = at_nodes(s), s.water.copy(), s.v.copy()

    def moved():
        shape_of(rig.model.programs, rig.model.state)
        return drag(rig.record, s, held)["force"]

    def turned():
        measured = s._replace(water=water, v=v)
        return lump(record.low, pressed(record, measured), record.up)

    return differences(moved, s.r, 1e-3) + differences(turned, s.r, 1e-3)


OF_VORTICES = {VortexLift: vortex_lift, VortexDrag: vortex_drag}


def slope_with_phases_held(rig, version):
    """Slope of the force with the pipe's directions and the phases held, as the effect's file says."""
    s, record = rig.s, copied(rig.record)
    held, phases = at_nodes(s), s.internal.copy()

    def moved():
        shape_of(rig.model.programs, rig.model.state)
        s.internal[:] = phases
        return version(record, s, held)["force"]

    return differences(moved, s.r, 1e-3)


@pytest.mark.parametrize("kind", [Drag, DragOverDepth, AddedMass])
@pytest.mark.parametrize("d", [2, 3])
def test_what_acts_horizontally_acts_on_horizontal_motion_alone(kind, d):
    """Kernel, plain version and derivatives agree, and heave changes nothing."""
    rig = Rig(kind, d, horizontal=1)
    force = rig.inertial_forces() if kind is AddedMass else rig.evaluate()[rig.m :]
    [(_, version)] = PLAIN[kind]
    assert relative(force, version(rig.record, rig.s)["force"]) < SAMPLED.get(kind, 1e-12)
    assert not force[-1].any()
    if kind is not AddedMass:
        slope = differences(rig.evaluate, rig.s.r, 1e-3)
        rig.evaluate()
        assert relative(-dense_tangent(rig.s)[:, rig.m * (N + 1) :], slope) < DIFFERENCES
    rig.s.v[-1] += 1.0
    rig.s.a[-1] += 1.0
    again = rig.inertial_forces() if kind is AddedMass else rig.evaluate()[rig.m :]
    np.testing.assert_array_equal(again, force)


MOMENTS = [
    *((kind, 2) for kind in (Bending, BendingDamping, Foreshortening, FlexJoint)),
    *((kind, 3) for kind in (*SPATIAL, Foreshortening)),
]


@pytest.mark.parametrize("pair", MOMENTS, ids=name)
def test_the_tangent_is_the_slope_by_moments(pair):
    rig = Rig(*pair)
    rig.evaluate()
    split = rig.m * (N + 1)
    tangent = dense_tangent(rig.s)[:, :split]
    slope = differences(rig.evaluate, rig.s.moment, 1e4)
    assert relative(-tangent[split:], slope[split:]) < DIFFERENCES
    assert relative(-tangent[:split], slope[:split]) < DIFFERENCES


POWERED = [
    p
    for p in PAIRS
    if {"potential", "power"} & set(ROLES[p[0]])
    and p not in BESIDE_BENDING_IN_SPACE
    # contents that leave take kinetic energy with them, see test_draining
    and p not in ((Draining, 2), (Draining, 3))
]


@pytest.mark.parametrize("pair", POWERED, ids=name)
@pytest.mark.parametrize("seed", range(3))
def test_what_the_force_does_is_stored_dissipated_or_supplied(pair, seed):
    """Force times velocity = supplied - dissipated - rate of the energy stored, platform moving."""
    rig = Rig(*pair, seed=seed)
    s = rig.s
    place, platform, time = s.r.copy(), s.platform.copy(), s.clock[0]

    def stored_at(t):
        s.r[:] = place + t * s.v
        s.platform[0] = platform[0] + t * platform[1]
        s.clock[0] = time + t
        return rig.potential() if "potential" in roles_beside(rig) else 0.0

    h = 1e-4
    four = [stored_at(k * h) for k in (-2, -1, 1, 2)]
    rate = (four[0] - 8.0 * four[1] + 8.0 * four[2] - four[3]) / (12.0 * h)
    stored_at(0.0)
    rig.settle_moments()
    force = rig.evaluate()[rig.m :]
    dissipated, supplied = rig.flow()
    assert dissipated >= 0.0
    terms = np.array([(force * s.v).sum(), rate, dissipated, supplied])
    # rounding of energies up to 1e7 J over h
    assert abs(terms @ [1.0, 1.0, 1.0, -1.0]) <= 1e-6 * np.abs(terms).max()


def roles_beside(rig):
    return {role for e in rig.model.effects for role in ROLES[type(e.record)]}


@pytest.mark.parametrize("kind", [Bending, BendingDamping, FlexJoint])
def test_moments_do_the_work_that_the_shear_does(kind):
    """Virtual work: forces from moments = - d (sum of moments times turning angles) / d r."""
    rig = Rig(kind, 2)
    force = rig.evaluate()[1:].ravel()
    kept = rig.s.moment.copy()
    rig.s.v[:] = 0.0  # turning angles, not their rates

    def work():
        rig.s.moment[:] = 0.0
        turn = rig.evaluate()[0]
        rig.s.moment[:] = kept
        return np.array([(kept[0] * turn).sum()])

    assert relative(-differences(work, rig.s.r, 1e-3)[0], force) < DIFFERENCES


@kernel
def solve_once(s, out, work, fixed):
    """The solver of linear equations, for callers in Python."""
    return solve(s, out, work, fixed)


@pytest.mark.parametrize("pair", MOMENTS, ids=name)
def test_the_block_solver_solves_the_dense_system(pair):
    rig = Rig(*pair)
    s, d = rig.s, rig.d
    size = rig.m + d
    rig.evaluate()
    s.rate[:] = 3.0, 10.0
    right = rig.evaluate()
    s.k_node[:, :: d + 1] += 1e6  # something to stand on
    fixed = np.array([[0, size - 2], [0, size - 1], [N, 0], [N, 1]])
    tangent = dense_tangent(s).reshape(size, N + 1, size, N + 1)
    out = np.ascontiguousarray(right.T)
    for node, unknown in fixed:
        tangent[unknown, node] = 0.0
        tangent[unknown, node, unknown, node] = 1.0
        right[unknown, node] = 0.0
    dense = tangent.reshape(size * (N + 1), -1)
    expected = np.linalg.solve(dense, right.ravel()).reshape(size, N + 1)
    for node, unknown in fixed:
        out[node, unknown] = 5.0  # whatever stands there
    solve_once(rig.model.state, out, np.zeros((N + 1, size**2)), fixed)
    for u in range(size):
        # condition about 1e6 after scaling
        assert relative(out[:, u], expected[u]) < 1e-9


@given(seed=st.integers(0, 10_000), d=st.sampled_from([1, 2, 3]))
def test_drag_never_drives_the_pipe_through_still_water(seed, d):
    rig = Rig(Drag, d, seed)
    rig.s.clock[1] = 0.0
    force = rig.evaluate()[rig.m :]
    dissipated, supplied = rig.flow()
    assert supplied == 0.0
    assert (force * rig.s.v).sum() == pytest.approx(-dissipated, rel=1e-12, abs=1e-9)
    assert dissipated >= 0.0


@pytest.mark.parametrize("speed", [0.0, 1e-320, 1e-200])
@pytest.mark.parametrize("kind, d", [(Drag, 2), (Drag, 3), (DragOverDepth, 2)])
def test_drag_has_a_slope_at_speeds_whose_square_is_no_number(kind, d, speed):
    rig = Rig(kind, d)
    rig.s.clock[1] = 0.0
    rig.s.v[:] = speed
    assert np.all(np.isfinite(rig.evaluate()))
    assert np.all(np.isfinite(dense_tangent(rig.s)))


def test_water_speed_is_continuous_and_held_beyond_the_table():
    rig = Rig(Current, 2)
    rig.s.clock[:] = 100.0, 1.0
    for z in rig.record.elevation:
        low, up = [], []
        for side in (-1e-9, 1e-9):
            rig.s.r[1] = z + side
            rig.s.water[:] = 0.0
            one_call(rig.model.programs.value.drive, rig.model.state)
            (low if side < 0 else up).append(rig.s.water[0, 0])
        assert low[0] == pytest.approx(up[0], abs=1e-9)
    rig.s.r[1] = 1e4
    rig.s.water[:] = 0.0
    one_call(rig.model.programs.value.drive, rig.model.state)
    np.testing.assert_array_equal(rig.s.water[0], rig.record.speed[-1])
