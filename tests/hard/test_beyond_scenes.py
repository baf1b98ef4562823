"""What no scene asks for: free flight, a full circle, a load that is lost mid-run, a restart."""

import numpy as np
import pytest
from scenes import COLUMN, changed, from_file

from riserstudy.model.mesh import even
from riserstudy.model.model import Model, Unknowns
from riserstudy.simulation.equilibrium import settle
from riserstudy.solve.evaluate import energies, move_to
from riserstudy.solve.implicit import Method, generalised_alpha, march
from riserstudy.solve.newton import Tolerance
from riserstudy.solve.record import new_record
from riserstudy.solve.statics import find_equilibrium
from riserstudy.solve.sums import DONE, new_sums

LENGTH = 100.0
ROD = {
    "riser": [COLUMN["riser"][0] | {"mass": "1000 kg/m"}],
    "top": {"x": "free", "z": "free", "rotation": "free", "lateral_force": "0 N"},
    "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "fixed"},
}


def stepped(model, rho, step, count, sums):
    """March on from where a model is."""
    start = model.s.clock[0]
    record = new_record([start + count * step], [0], model.s)
    method = Method(*generalised_alpha(rho), step, count, Tolerance(1e-9 * LENGTH, 1e-4), 12, 6, 0)
    done = march(model.programs, model.state, model.spare, method, model.fixed, record, sums)
    assert done == DONE
    return record.value


def like(model, fixed, left_out=()):
    """The same model, held in other places and without some of its effects."""
    effects = [effect for effect in model.effects if effect.name not in left_out]
    d, m = len(model.s.dim), len(model.s.dof) - len(model.s.dim)
    other = Model(Unknowns(model.s.l0, d, m, tuple(model.s.share)), effects, fixed)
    other.s.r[:] = model.s.r
    return other


@pytest.fixture
def beam():
    """A cantilever of 100 m without load, on 40 segments."""
    scene = changed(ROD | {"title": "beam", "analysis": {"mesh": {"elements": 40}}}).resolved()
    return settle(scene, even(scene, 40))[0]


def turning(s):
    """Momentum, and angular momentum about the middle of mass, by lumped masses."""
    mass = 1000.0 * LENGTH / 40 * np.r_[0.5, np.ones(39), 0.5]
    middle = (s.r * mass).sum(axis=1) / mass.sum()
    own = s.r - middle[:, None]
    return (s.v * mass).sum(axis=1), float((mass * (own[1] * s.v[0] - own[0] * s.v[1])).sum())


def test_a_rod_in_free_flight_keeps_energy_momentum_and_angular_momentum(beam):
    ends = [(0, 0), (40, 0)]  # no moments at the ends, nothing held
    rod = like(beam, ends, left_out=("support",))
    s = rod.s
    middle = s.r.mean(axis=1)
    s.v[0] = 3.0 - 0.5 * (s.r[1] - middle[1])
    s.v[1] = 1.0 + 0.5 * (s.r[0] - middle[0])
    s.v[0] += 0.3 * np.cos(2.0 * np.pi * (s.r[1] - s.r[1, 0]) / LENGTH)  # it also vibrates
    move_to(rod.programs, rod.state, 0.0)
    before, momentum, spin = sum(energies(rod.programs, rod.state)), *turning(s)
    sums = new_sums()
    stepped(rod, 1.0, 0.01, 6000, sums)  # 60 s, almost five turns
    after, momentum1, spin1 = sum(energies(rod.programs, rod.state)), *turning(s)
    assert after == pytest.approx(before, rel=1e-5)
    assert momentum1 == pytest.approx(momentum, rel=1e-12)
    assert spin1 == pytest.approx(spin, rel=1e-5)


def test_an_end_moment_bends_a_beam_into_a_full_circle(beam):
    bending = 206e9 * np.pi / 64.0 * (0.5334**4 - 0.4826**4)
    around = 2.0 * np.pi * bending / LENGTH
    s = beam.s
    for share in np.linspace(0.05, 1.0, 20):
        s.moment[0, -1] = share * around
        find_equilibrium(beam.programs, beam.state, beam.fixed_at_rest, 1e-10 * LENGTH, False)
    assert s.moment[0] == pytest.approx(around, rel=1e-6)
    # a regular polygon: its end comes back to where it began
    assert np.hypot(*(s.r[:, -1] - s.r[:, 0])) < 1e-9 * LENGTH
    wide = s.r[0].max() - s.r[0].min()
    assert wide == pytest.approx(LENGTH / np.pi, rel=2e-3)


def surge():
    scene = from_file("hard/surge", analysis__mesh={"elements": 20}, analysis__step="0.1 s").resolved()
    model = settle(scene, even(scene, 20))[0]
    move_to(model.programs, model.state, 0.0)
    return model


def test_half_the_tension_lost_mid_run_is_survived_and_accounted_for():
    model = surge()
    sums = new_sums()
    before = sum(energies(model.programs, model.state))
    whole = stepped(model, 0.8, 0.05, 400, sums)
    pull = next(e.record for e in model.effects if e.name == "constant tension")
    lost = sum(energies(model.programs, model.state))
    pull.load[:] *= 0.5
    lost -= sum(energies(model.programs, model.state))  # the dead load's own potential
    half = stepped(model, 0.8, 0.05, 800, sums)
    after = sum(energies(model.programs, model.state))
    held, given, dissipated, numerical, exchanged = sums.work
    unexplained = held + given - dissipated - numerical - (after - before + lost)
    tension = [record.history[-1, 2, 0] for record in (whole, half)]  # at the lower end
    weight = 141.264 * 533.0
    assert tension[0] == pytest.approx(2275e3 - weight, rel=0.02)
    assert tension[1] == pytest.approx(0.5 * 2275e3 - weight, rel=0.1)  # it rings on, undamped
    assert abs(unexplained) < 2e-3 * exchanged


def test_a_restart_from_a_saved_state_is_bitwise_the_same(tmp_path):
    model = surge()
    stepped(model, 0.8, 0.1, 100, new_sums())
    s = model.s
    np.savez(tmp_path / "state.npz", r=s.r, v=s.v, a=s.a, moment=s.moment, clock=s.clock)
    stepped(model, 0.8, 0.1, 100, new_sums())
    again = surge()
    with np.load(tmp_path / "state.npz") as saved:
        for name in saved.files:
            getattr(again.s, name)[:] = saved[name]
    stepped(again, 0.8, 0.1, 100, new_sums())
    for name in ("r", "v", "a", "moment"):
        assert (getattr(again.s, name) == getattr(s, name)).all()
