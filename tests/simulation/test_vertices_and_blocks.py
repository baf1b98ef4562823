"""Peaks between uneven steps, errors by blocks of outputs, and half waves of sections, by closed forms."""

import math

import numpy as np
import pytest
from scipy.stats import sem

from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile
from riserstudy.simulation import half_waves
from riserstudy.simulation.sampling_error import floor, of_two_runs, standard_error
from riserstudy.simulation.step_peaks import peaks_of


@pytest.mark.parametrize("seed", range(30))
def test_the_peak_of_parabolas_is_their_vertex_on_any_steps(seed):
    """Of several columns the highest counts; the other extreme is at the first or the last step."""
    draw = np.random.default_rng(seed)
    time = np.cumsum(draw.uniform(0.1, 1.0, 30))
    columns, sign = int(draw.integers(1, 4)), draw.choice([-1.0, 1.0])
    at, top = draw.uniform(time[3], time[-4], columns), draw.uniform(-5.0, 5.0, columns)
    values = sign * (top - draw.uniform(0.05, 0.5, columns) * (time[:, None] - at) ** 2)
    found = peaks_of(time, {"stroke": values})["stroke"]
    k = int(top.argmax())
    extreme = (found.largest, found.largest_time) if sign > 0 else (found.smallest, found.smallest_time)
    assert extreme == (pytest.approx(sign * top[k]), pytest.approx(at[k]))
    end = (found.smallest, found.smallest_time) if sign > 0 else (found.largest, found.largest_time)
    step = time[(sign * values).min(axis=1).argmin()]
    assert end == (pytest.approx((values * sign).min() * sign), step)


@pytest.mark.parametrize("seed", range(10))
def test_a_magnitude_has_no_peak_below_zero(seed):
    """Its parabola is below zero between steps, where the quantity itself turns about."""
    draw = np.random.default_rng(seed)
    time = np.arange(20.0)
    values = (time - draw.uniform(5.25, 5.33)) ** 2 - 0.05
    assert peaks_of(time, {"angle": values})["angle"].smallest == 0.0
    assert peaks_of(time, {"angle": values - 0.1})["angle"].smallest == pytest.approx(-0.15)


@pytest.mark.parametrize("seed", range(20))
def test_the_error_of_a_mean_is_the_largest_of_those_by_blocks(seed):
    """Standard errors of the means of 4, 8 and 16 blocks of eight outputs or more."""
    draw = np.random.default_rng(seed)
    count, least = int(draw.integers(20, 400)), int(draw.choice([0, 20]))
    values = np.cumsum(draw.normal(size=(count, 3)), axis=0)
    found = standard_error(lambda part: values[part].mean(axis=0), count, least)
    errors = [
        sem([values[k * size : (k + 1) * size].mean(axis=0) for k in range(blocks)])
        for blocks in (4, 8, 16)
        if (size := count // blocks) >= 8 and (size >= least or blocks == 4)
    ]
    assert found == pytest.approx(np.max(errors, axis=0) if errors else math.inf)
    one = {"moment": draw.uniform(0.0, 1.0)}
    pairs = draw.normal(scale=one["moment"], size=(2, 20000))
    assert of_two_runs(one)["moment"] == pytest.approx((pairs[0] - pairs[1]).std(), rel=0.03)
    assert floor(one)["moment"] == pytest.approx(2.0 * of_two_runs(one)["moment"])


@pytest.mark.parametrize("seed", range(12))
def test_half_waves_of_sections_solve_the_equation_of_a_beam(seed, monkeypatch):
    """Mass of pipe, contents and added water; the smallest tension of the section's segments."""
    draw = np.random.default_rng(seed)
    period = draw.uniform(2.0, 12.0)
    monkeypatch.setattr(half_waves, "shedding_period", lambda _: period)
    facts, parts = [], []
    for k in range(3):
        mass, bore, density, added = draw.uniform((300.0, 0.2, 900.0, 0.3), (900.0, 0.5, 1800.0, 0.9))
        bending, coefficient = 10.0 ** draw.uniform(6.0, 8.5), draw.uniform(0.8, 1.2)
        parts.append(
            {"name": f"part {k}", "length": f"{draw.uniform(100.0, 400.0)} m", "mass": f"{mass} kg/m",
             "inner_diameter": f"{bore} m", "outer_diameter": "1 m", "axial_stiffness": "3e9 N",
             "submerged_weight": "1 kN/m",
             "bending_stiffness": f"{bending} N*m^2",
             "contents": {"density": f"{density} kg/m^3"},
             "added_mass": {"coefficient": coefficient, "diameter": f"{added} m"}}
        )  # fmt: skip
        rho = density * bore**2 + 1025.0 * coefficient * added**2
        facts.append((bending, mass + 0.25 * math.pi * rho))
    tree = {
        "title": "riser", "gravity": "9.81 m/s^2", "water": {"density": "1025 kg/m^3"}, "riser": parts,
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "held", "offset": "1 m", "z": "free", "tension": "2 MN"}, "analysis": {},
    }  # fmt: skip
    scene = SceneFile("riser.yaml", tree).resolved()
    mesh = even(scene, 30)
    tension = draw.uniform(2e5, 3e6, len(mesh.l0))
    found = half_waves.half_wave(scene, mesh, tension)
    longest = sum(section.total_length for section in scene.riser)
    for k, (bending, mass) in enumerate(facts):
        pull = tension[mesh.section == k].min()
        roots = np.roots([bending, 0.0, pull, 0.0, -mass * (2.0 * math.pi / period) ** 2])
        number = roots[(abs(roots.imag) < 1e-12) & (roots.real > 0.0)].real
        assert found[k] == pytest.approx(max(math.pi / float(number[0]), longest / 250.0))
