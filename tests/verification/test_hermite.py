"""The Hermite beam against closed forms, its own orders and the exact rod."""

import numpy as np
import pytest
import reference as ref
from reference_heave import ramped_sine
from reference_rod import Rod
from scipy.interpolate import CubicHermiteSpline

from riserstudy.effects.catalogue import catalogue
from riserstudy.errors import SimulationError
from riserstudy.simulation.hermite_run import LARGE_ANGLES, SUPPORTED, effects_of
from riserstudy.simulation.warm_up import scenes
from riserstudy.solve.hermite import dynamics, frequencies, statics
from riserstudy.solve.hermite_beam import Beam, End, HermiteError, Stepping

RISER = ref.Riser()
T = RISER.top_force


def beam(elements: int, **changes) -> Beam:
    """S4's beam, pinned at both ends, in vacuum unless changed."""
    length, tension = changes.pop("length", 533.0), changes.pop("tension", T)
    one = np.ones(elements)
    values = {
        "s": np.linspace(0.0, length, elements + 1),
        "bending_stiffness": np.full((elements, 2), ref.EI),
        "tension": np.full((elements, 2), tension),
        "mass": 1006.0 * one,
        "added_mass": 0.0 * one,
        "drag": 0.0 * one,
        "load": np.zeros((elements, 2)),
    }
    return Beam(**(values | changes))


def surge(t):
    return ramped_sine(t, 2.0, 15.0)


def riser(elements: int, top: End = End(motion=surge), **changes) -> Beam:
    """S1 and S2 in small-angle form."""
    s = np.linspace(0.0, RISER.length, elements + 1)
    tension = T - RISER.weight * (RISER.length - s)
    wet = {
        "tension": np.column_stack([tension[:-1], tension[1:]]),
        "bending_stiffness": np.full((elements, 2), ref.EI),
        "added_mass": np.full(elements, RISER.added_mass),
        "drag": np.full(elements, RISER.drag),
        "top": top,
    }
    return beam(elements)._replace(**(wet | changes))


def order(sizes, errors) -> float:
    """Slope of the errors over the sizes, in logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


def test_consistency_with_closed_form_frequencies_of_a_tensioned_beam():
    exact = ref.lateral_frequencies(5, 533.0, T, ref.EI, 1006.0)
    omega, modes = frequencies(beam(80), 5)
    np.testing.assert_allclose(omega, exact, rtol=2e-7)
    shape = np.sin(np.outer(np.arange(1, 6), beam(80).s) * np.pi / 533.0)
    np.testing.assert_allclose(np.abs(modes), np.abs(shape), atol=2e-3)


def test_frequencies_converge_with_fourth_order():
    exact = ref.lateral_frequencies(5, 533.0, T, ref.EI, 1006.0)[4]
    sizes = np.array([20, 28, 40, 56])
    errors = [frequencies(beam(n), 5)[0][4] / exact - 1.0 for n in sizes]
    assert order(1.0 / sizes, errors) == pytest.approx(4.0, abs=0.1)
    assert errors[-1] < 1e-6


def test_clamped_free_frequencies_are_the_cantilever_s():
    loose = beam(20, tension=0.0, bottom=End(rotation_stiffness=np.inf), top=End(held=False))
    beta = np.array([1.8751040687119611, 4.694091132974175, 7.854757438237613])
    exact = (beta / 533.0) ** 2 * np.sqrt(ref.EI / 1006.0)
    # the cubic's error is (beta h / L)^4 / 1440 of the frequency
    error = frequencies(loose, 3)[0] / exact - 1.0
    np.testing.assert_allclose(error, (beta / 20.0) ** 4 / 1440.0, rtol=0.1)


def test_a_point_mass_on_a_light_cantilever_is_an_oscillator():
    end = beam(
        4, length=50.0, tension=0.0, mass=np.full(4, 0.1),
        bottom=End(rotation_stiffness=np.inf), top=End(held=False, mass=1000.0),
    )  # fmt: skip
    # Rayleigh's share of the arm, 33/140 of its mass; exact to second order in the mass ratio
    exact = np.sqrt(3.0 * ref.EI / 50.0**3 / (1000.0 + 33.0 / 140.0 * 5.0))
    np.testing.assert_allclose(frequencies(end, 1)[0], exact, rtol=1e-6)


def test_consistency_with_the_closed_form_under_uniform_load():
    loaded = beam(160, load=np.full((160, 2), 500.0))
    w, rotation, moment = ref.uniform_load(loaded.s, 533.0, T, ref.EI, 500.0)
    found = statics(loaded)
    np.testing.assert_allclose(found.displacement, w, atol=1e-7)
    np.testing.assert_allclose(found.rotation, rotation, atol=2e-8)
    np.testing.assert_allclose(found.moment, moment, atol=3e-6 * np.abs(moment).max())
    end_shear = 500.0 / np.sqrt(T / ref.EI) * np.tanh(np.sqrt(T / ref.EI) * 533.0 / 2.0)
    assert found.shear[0] == pytest.approx(end_shear, rel=1e-5)


def test_statics_converge_with_the_declared_order():
    sizes, errors = [60, 85, 120, 170], []
    for n in sizes:
        loaded = beam(n, load=np.full((n, 2), 500.0))
        w, _, moment = ref.uniform_load(loaded.s, 533.0, T, ref.EI, 500.0)
        found = statics(loaded)
        errors.append(
            (np.abs(found.displacement - w).max() / w.max(),
             np.abs(found.moment - moment).max() / np.abs(moment).max())
        )  # fmt: skip
    displacement, moment = np.array(errors).T
    for error in (displacement, moment):
        assert order(1.0 / np.array(sizes), error) == pytest.approx(4.0, abs=0.1)
    assert moment[-1] < 2e-6
    assert displacement[-1] < 7e-9


def test_consistency_with_the_linear_cantilever():
    clamp, tip = End(rotation_stiffness=np.inf), End(held=False, force=1000.0)
    arm = beam(5, length=50.0, tension=0.0, bottom=clamp, top=tip)
    found = statics(arm)
    s = arm.s
    exact = 1000.0 * s**2 * (150.0 - s) / 6.0 / ref.EI
    np.testing.assert_allclose(found.displacement, exact, rtol=1e-12)
    np.testing.assert_allclose(found.moment, 1000.0 * (50.0 - s), atol=1e-6)
    np.testing.assert_allclose(found.shear, 1000.0, rtol=1e-9)
    curvature = np.diff(found.displacement, 2) / 10.0**2  # exact for a cubic
    np.testing.assert_allclose(ref.EI * curvature, found.moment[1:-1], atol=1e-6)


def test_a_rotational_spring_turns_by_moment_over_stiffness():
    k = 5e6
    sprung, tip = End(rotation_stiffness=k), End(held=False, force=1000.0)
    found = statics(beam(5, length=50.0, tension=0.0, bottom=sprung, top=tip))
    assert found.rotation[0] == pytest.approx(50e3 / k, rel=1e-10)
    exact = 1000.0 * 50.0**3 / 3.0 / ref.EI + 50.0 * 50e3 / k
    assert found.displacement[-1] == pytest.approx(exact, rel=1e-10)


def test_consistency_with_a_taper_s_closed_form():
    """Cantilever with EI linear in s under a tip force: u'' = P (L - s)/EI(s), integrated."""
    n, length, ratio = 40, 50.0, 3.0
    s = np.linspace(0.0, length, n + 1)
    ei = ref.EI * (1.0 + (ratio - 1.0) * s / length)
    taper = np.column_stack([ei[:-1], ei[1:]])
    clamp, tip = End(rotation_stiffness=np.inf), End(held=False, force=1000.0)
    found = statics(beam(n, length=length, tension=0.0, bending_stiffness=taper, bottom=clamp, top=tip))
    b = (ratio - 1.0) / length
    rotation = 1000.0 / ref.EI * ((length + 1.0 / b) * np.log(1.0 + b * s) / b - s / b)
    np.testing.assert_allclose(found.rotation, rotation, rtol=2e-7, atol=1e-15)


def test_consistency_with_the_exact_rod_in_a_current_is_within_small_angle_error():
    current = riser(200, top=End(), current=lambda s: s / 533.0)
    exact = ref.static_current(current.s)
    found = statics(current)
    # the load and the axial stretch of the deformed rod change a small-angle shape by 2e-4 to 1e-3
    assert np.abs(found.displacement - exact.x).max() < 1e-3 * np.abs(exact.x).max()
    assert np.abs(found.moment - exact.moment).max() < 2e-3 * np.abs(exact.moment).max()


@pytest.mark.parametrize("drag,expected", [("newton", 2.0), ("picard", 2.0), ("lagged", 1.0)])
def test_newmark_converges_with_the_declared_order_under_drag(drag, expected):
    times = np.arange(31.0)
    model = riser(8)  # so coarse that the steps resolve its highest mode, which nothing damps
    fine = dynamics(model, times, 1.0 / 1280)
    steps = 1.0 / np.array([40, 57, 80, 113])
    errors = []
    for step in steps:
        found = dynamics(model, times, step, Stepping(drag=drag))
        errors.append(
            (np.abs(found.displacement - fine.displacement).max() / 2.0,
             np.abs(found.moment - fine.moment).max() / np.abs(fine.moment).max())
        )  # fmt: skip
    displacement, moment = np.array(errors).T
    assert order(steps, displacement) == pytest.approx(expected, abs=0.1)
    assert order(steps, moment) == pytest.approx(expected, abs=0.1)
    assert displacement[-1] < (1e-5 if expected == 2.0 else 1e-3)


def test_surge_converges_with_fourth_order_in_the_element_length():
    # damping proportional to the stiffness, as modes that no step resolves would hide the order
    times, sizes = np.arange(0.0, 20.5, 0.5), np.array([41, 82, 164])
    damped = 0.00625, Stepping(rayleigh=(0.0, 0.01))
    fine = dynamics(riser(656), times, *damped)
    errors = []
    for n in sizes:
        found, every = dynamics(riser(int(n)), times, *damped), 656 // int(n)
        errors.append(
            (np.abs(found.displacement - fine.displacement[:, ::every]).max() / 2.0,
             np.abs(found.moment - fine.moment[:, ::every]).max() / np.abs(fine.moment).max())
        )  # fmt: skip
    displacement, moment = np.array(errors).T
    assert order(1.0 / sizes, displacement) == pytest.approx(4.0, abs=0.1)
    assert order(1.0 / sizes, moment) == pytest.approx(4.0, abs=0.1)
    assert displacement[-1] < 1e-7
    assert moment[-1] < 5e-6


def test_newton_and_picard_find_the_same_motion():
    times = np.arange(0.0, 31.0, 0.5)
    a, b = (dynamics(riser(50), times, 0.1, Stepping(drag=drag)) for drag in ("newton", "picard"))
    np.testing.assert_allclose(a.displacement, b.displacement, atol=1e-8)
    assert a.iterations < b.iterations


def test_consistency_of_surge_with_a_refined_run():
    times = 0.1 * np.arange(1501)
    coarse = dynamics(riser(82), times, 0.025)
    fine = dynamics(riser(328), times, 0.00625)
    error = np.abs(coarse.displacement - fine.displacement[:, ::4]).max() / 2.0
    moment = np.abs(coarse.moment - fine.moment[:, ::4]).max() / np.abs(fine.moment).max()
    assert error < 1e-4  # second order in the step: 3.1e-4 at 0.05 s, 7.6e-5 at 0.025 s
    assert moment < 8e-4


def test_consistency_of_surge_with_the_exact_rod_is_within_small_angle_error():
    times = 0.1 * np.arange(1501)
    model = riser(164)
    found = dynamics(model, times, 0.025)
    stations = np.array([133.0, 233.0, 333.0, 433.0])
    shape = CubicHermiteSpline(model.s, found.displacement.T, found.rotation.T)
    with np.load(ref.DATA / "S2.npz") as exact:
        x, peak = exact["x"][::2], np.abs(exact["moment"]).max()
    # slopes reach 0.03, and theta squared over two is 5e-4
    assert np.abs(shape(stations).T - x).max() < 1.2e-3 * 2.0
    assert np.abs(found.moment).max() == pytest.approx(peak, rel=1e-3)


@pytest.mark.long
def test_consistency_of_a_small_surge_with_the_exact_rod():
    """Without axial strain and with slopes of 1e-3 the exact rod has to be the small-angle one."""
    amplitude, times = 0.02, 0.5 * np.arange(41)
    stiff = RISER._replace(axial_stiffness=1e13)
    rod = Rod(stiff, 80, hold=False, still=True)
    stations = np.linspace(0.0, 533.0, 42)
    exact = rod.run(rod.straight(), 20.0, 0.05, 10, stations, amplitude=amplitude)
    moving = End(motion=lambda t: ramped_sine(t, amplitude, 15.0))
    found = dynamics(riser(328, top=moving), times, 0.00625)
    np.testing.assert_allclose(found.displacement[:, ::8], exact.x, atol=1e-5 * amplitude)
    peak = np.abs(exact.moment).max()  # 80 elements leave 8e-5 of the moment, see make_references
    np.testing.assert_allclose(found.moment[:, ::8], exact.moment, atol=1e-4 * peak)


@pytest.mark.parametrize(
    "changes,message",
    [
        ({"tension": np.full((8, 2), -1e6)}, "unstable"),
        ({"tension": np.full((8, 2), np.nan)}, "tension"),
        ({"mass": np.full(7, 1006.0)}, "mass"),
        ({"drag": np.full(8, -1.0)}, "drag"),
        ({"s": np.zeros(9)}, "ascending"),
        ({"current": lambda s: np.full_like(s, np.inf)}, "current"),
        ({"top": End(motion=lambda t: (t * np.nan, t, t))}, "motion"),
        ({"bottom": End(held=False), "top": End(held=False)}, "unstable"),
        ({"top": End(rotation_stiffness=-1.0)}, "negative"),
    ],
)
def test_a_beam_that_cannot_be_solved_is_refused_with_the_reason(changes, message):
    with pytest.raises(HermiteError, match=message):
        statics(riser(8, **changes))


def test_an_unstable_choice_of_newmark_s_parameters_ends_in_an_error():
    with pytest.raises(HermiteError, match="reduce the step"):
        dynamics(riser(50), np.arange(301.0), 0.1, Stepping(beta=0.0))


def test_too_few_iterations_are_an_error_that_names_the_time():
    with pytest.raises(HermiteError, match="t = "):
        dynamics(riser(50), np.arange(31.0), 0.1, Stepping(drag="picard", iterations=2))


def test_still_water_and_still_ends_leave_the_beam_exactly_at_rest():
    found = dynamics(riser(50, top=End()), np.arange(11.0), 0.1)
    assert not found.displacement.any()
    assert not found.moment.any()


def test_what_the_beam_has_not_is_refused_by_name_and_what_it_has_is_told():
    """Of the effects of lumped masses, each is either supported, refused, or no part of small angles."""
    assert set(catalogue()) >= SUPPORTED | LARGE_ANGLES
    refused = set()
    for scene in [scene for group in scenes().values() for scene in group]:
        analysis = scene.analysis.replaced(solver="hermite")
        try:
            told = effects_of(scene.replaced(analysis=analysis))
        except SimulationError as error:
            refused.add(str(error).split("hermite cannot simulate ")[1].split(" (")[0])
        else:
            assert {"bending", "drag", "weight"} <= set(told) <= SUPPORTED
    assert refused
    assert not refused & SUPPORTED
