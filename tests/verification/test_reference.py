"""The references themselves: closed forms against their equations, stored files against their scenes."""

import numpy as np
import pytest
import reference as ref
import reference_heave
from reference_rod import Rod
from scipy.integrate import quad, solve_bvp

RISER = ref.Riser()


def test_section_properties_are_the_scenes():
    assert pytest.approx(8.3505393e9, rel=1e-8) == ref.EA
    assert pytest.approx(2.7004512e8, abs=5.0) == ref.EI  # the scene's last digit
    assert RISER.added_mass == pytest.approx(1198.2113, rel=1e-7)
    assert RISER.weight == pytest.approx(141.264, rel=1e-12)
    assert RISER.straight_height() == pytest.approx(533.14281, abs=5e-6)


def test_the_rod_in_a_current_does_not_depend_on_the_tolerance():
    s = np.linspace(0.0, 533.0, 42)
    loose, tight = ref.static_current(s, tolerance=1e-6), ref.static_current(s, tolerance=1e-9)
    for field in ("x", "z", "theta", "tension", "moment", "top_force"):
        a, b = getattr(loose, field), getattr(tight, field)
        np.testing.assert_allclose(a, b, rtol=0.0, atol=2e-9 * np.abs(b).max(), err_msg=field)


@pytest.mark.long
def test_the_rod_in_a_current_is_found_by_elements_too():
    s = np.linspace(0.0, 533.0, 42)
    exact, model = ref.static_current(s), Rod(RISER, 160, hold=False, still=False)
    x, z, moment = model.fields(model.statics(model.straight()), s)
    np.testing.assert_allclose(x, exact.x, rtol=0.0, atol=2e-10 * np.abs(exact.x).max())
    np.testing.assert_allclose(z, exact.z, rtol=0.0, atol=1e-10)
    # the element's own curvature; fourth order, 8.0e-5, 5.6e-6, 3.6e-7 at 80, 160, 320 elements
    np.testing.assert_allclose(moment, exact.moment, rtol=0.0, atol=1e-5 * np.abs(exact.moment).max())


def test_holding_the_static_height_gives_the_same_shape_as_holding_the_force():
    s = np.linspace(0.0, 533.0, 42)
    free = ref.static_current(s)
    held = ref.static_current(s, top_height=float(free.z[-1]))
    np.testing.assert_allclose(held.x, free.x, atol=1e-8)
    assert free.z[-1] == pytest.approx(533.09169, abs=5e-6)  # variant S1c as the scene states it
    assert held.top_force[1] == pytest.approx(RISER.top_force, rel=1e-9)


def test_support_and_drag_balance_in_a_current():
    """Moments about the bottom and vertical forces, from the shape alone."""
    s = np.linspace(0.0, 533.0, 20001)
    r = ref.static_current(s)
    normal = np.clip(r.z, 0.0, 533.0) / 533.0 * np.cos(r.theta)
    drag = RISER.drag * normal * np.abs(normal)
    fx, fz = drag * np.cos(r.theta), -drag * np.sin(r.theta) - RISER.weight
    load = np.trapezoid(fx * r.z - fz * r.x, s)
    assert load + r.top_force[0] * r.z[-1] == pytest.approx(0.0, abs=2e-8 * load)
    vertical = r.tension[0] * np.cos(r.theta[0])  # less the shear's share, second order in theta
    assert r.top_force[1] + np.trapezoid(fz, s) == pytest.approx(vertical, rel=1e-3)


def test_the_tensioned_beam_s_closed_form_solves_its_equation():
    k = np.sqrt(RISER.top_force / ref.EI)
    s, h = np.linspace(1.0, 532.0, 60), 1e-3
    w, rotation, moment = ref.uniform_load(s, 533.0, RISER.top_force, ref.EI, 500.0)
    up, down = (ref.uniform_load(s + d, 533.0, RISER.top_force, ref.EI, 500.0) for d in (h, -h))
    np.testing.assert_allclose((up[0] - down[0]) / (2 * h), rotation, atol=1e-9)
    np.testing.assert_allclose(ref.EI * (up[1] - down[1]) / (2 * h), moment, rtol=1e-6, atol=0.1)
    second = (up[2] - 2.0 * moment + down[2]) / h**2
    np.testing.assert_allclose(second - RISER.top_force / ref.EI * moment, 500.0, atol=0.05)
    ends = ref.uniform_load(np.array([0.0, 533.0]), 533.0, RISER.top_force, ref.EI, 500.0)
    np.testing.assert_allclose(ends[0], 0.0, atol=1e-12)
    np.testing.assert_allclose(ends[2], 0.0, atol=1e-9)
    slope = 500.0 / RISER.top_force * (533.0 / 2.0 - np.tanh(k * 533.0 / 2.0) / k)
    assert ends[1][0] == pytest.approx(slope, rel=1e-12)


def test_the_elastica_s_tip_is_found_by_collocation_too():
    load = 3.0 * ref.EI / 50.0**2
    assert load == pytest.approx(324054.15, rel=1e-7)

    def slope(s, y):  # theta from the undeformed axis, EI theta', along, across; s in units of L
        return np.array([y[1], -3.0 * np.cos(y[0]), np.cos(y[0]), np.sin(y[0])])

    def ends(a, b):
        return np.array([a[0], b[1], a[2], a[3]])

    mesh = np.linspace(0.0, 1.0, 50)
    found = solve_bvp(slope, ends, mesh, np.array([mesh, 1.0 - mesh, mesh, mesh**2]), tol=1e-10)
    along, across = ref.cantilever_tip(50.0, ref.EI, load)
    np.testing.assert_allclose(50.0 * found.y[2:, -1], [along, across], rtol=1e-9)


def test_the_elastica_becomes_the_linear_cantilever_under_a_small_load():
    along, across = ref.cantilever_tip(50.0, ref.EI, 1000.0)
    linear = 1000.0 * 50.0**3 / 3.0 / ref.EI
    assert across == pytest.approx(linear, rel=2e-5)
    assert along == pytest.approx(50.0 - 0.6 * linear**2 / 50.0, abs=1e-6)


def test_a_bar_s_frequencies_satisfy_its_frequency_equation():
    c = np.sqrt(ref.EA / 318.0)
    free = ref.axial_frequencies(4, 1800.0, ref.EA, 318.0)
    np.testing.assert_allclose(np.cos(free * 1800.0 / c), 0.0, atol=1e-12)
    loaded = ref.axial_frequencies(4, 1800.0, ref.EA, 318.0, 140e3)
    beta = loaded * 1800.0 / c
    np.testing.assert_allclose(beta * np.tan(beta), 318.0 * 1800.0 / 140e3, rtol=1e-11)
    assert (loaded < free).all()


def test_a_catenary_balances_and_reaches_its_ends():
    s = np.linspace(0.0, 850.0, 851)
    cable = ref.catenary(s)
    np.testing.assert_allclose([cable.x[-1], cable.z[-1]], [700.0, 300.0], rtol=1e-12)
    vertical = np.sign(np.gradient(cable.z)) * np.sqrt(cable.tension**2 - cable.horizontal**2)
    assert vertical[-1] - vertical[0] == pytest.approx(850.0 * 1000.0, rel=1e-9)
    # the shape again, by quadrature of dr/ds = (1/EA + 1/T) (H, V)
    first = vertical[0]

    def rate(at, horizontal):
        v = first + 1000.0 * at
        t = np.hypot(cable.horizontal, v)
        return (cable.horizontal if horizontal else v) * (1.0 / 5e8 + 1.0 / t)

    assert quad(rate, 0.0, 850.0, args=(True,), epsabs=1e-10)[0] == pytest.approx(700.0, rel=1e-10)
    assert quad(rate, 0.0, 850.0, args=(False,), epsabs=1e-10)[0] == pytest.approx(300.0, rel=1e-10)
    below = 300.0 / 700.0 * cable.x - cable.z
    assert cable.sag == pytest.approx(below.max(), abs=2e-3)
    assert cable.sag >= below.max()


def test_ramped_sine_s_derivatives_are_its_own():
    t, h = np.linspace(0.1, 29.9, 200), 1e-5
    x, v, a = reference_heave.ramped_sine(t, 2.0, 15.0)
    up, down = (reference_heave.ramped_sine(t + d, 2.0, 15.0) for d in (h, -h))
    np.testing.assert_allclose((up[0] - down[0]) / (2.0 * h), v, atol=1e-8)
    np.testing.assert_allclose((up[1] - down[1]) / (2.0 * h), a, atol=1e-5)


@pytest.mark.parametrize("name", ["S2", "S2c"])
def test_stored_surge_belongs_to_its_scene(name):
    with np.load(ref.DATA / f"{name}.npz") as data:
        np.testing.assert_allclose(data["time"], 0.05 * np.arange(3001), atol=1e-12)
        np.testing.assert_array_equal(data["s"], [133.0, 233.0, 333.0, 433.0])
        assert data["x"].shape == data["z"].shape == (3001, 4)
        assert data["moment"].shape == (data["moment_time"].size, data["moment_s"].size)
        assert all(np.isfinite(data[field]).all() for field in data.files if field != "about")
        weight = RISER.top_force - RISER.weight * RISER.length
        s = data["s"]
        straight = s + (weight * s + 0.5 * RISER.weight * s**2) / ref.EA
        np.testing.assert_allclose(data["z"][0], straight, rtol=1e-12)
        assert not data["x"][0].any()
        np.testing.assert_allclose(data["top_force"][0], [0.0, RISER.top_force], rtol=1e-9, atol=1e-6)
        if name == "S2":
            np.testing.assert_allclose(data["top_force"][:, 1], RISER.top_force, rtol=1e-9)
        else:  # the scene: 43 % higher when the height is held
            assert data["top_force"][:, 1].max() / RISER.top_force == pytest.approx(1.43, abs=0.005)
        inside = (data["moment"].max(axis=0), data["moment"].min(axis=0))
        fine = np.interp(data["moment_s"], data["envelope_s"], data["moment_max"])
        assert (np.abs(inside[0] - fine) < 0.1 * fine.max()).all()


@pytest.mark.parametrize("name", ["S2", "S2c"])
def test_stored_surge_is_found_again_in_its_first_seconds(name):
    """A coarse run: 40 elements and a step of 0.1 s reach 1e-6 of the surge in eight seconds."""
    with np.load(ref.DATA / f"{name}.npz") as data:
        model = Rod(RISER, 40, hold=name == "S2c", still=True)
        found = model.run(model.straight(), 8.0, 0.1, 1, data["s"])
        np.testing.assert_allclose(found.x, data["x"][:161:2], atol=2e-6)
        np.testing.assert_allclose(found.z, data["z"][:161:2], atol=2e-6)


def test_stored_heave_is_found_again_by_elements():
    with np.load(ref.DATA / "S3.npz") as data:
        times = data["time"]
        np.testing.assert_allclose(times, 0.05 * np.arange(2001), atol=1e-12)
        static = reference_heave.Hang().static_top_tension()
        assert static == pytest.approx(2712.2463 * 1800.0 + 1194070.7, rel=1e-8)
        assert data["top_tension"][0] == pytest.approx(static, rel=1e-12)
        found = reference_heave.by_spectral_elements(times[:401], elements=20, tolerance=1e-6)
        peak = np.abs(data["top_tension"] - static).max()
        np.testing.assert_allclose(found.bottom, data["bottom"][:401], atol=2e-5)
        np.testing.assert_allclose(found.top_tension, data["top_tension"][:401], atol=1e-3 * peak)
