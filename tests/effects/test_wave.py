"""The wave's water: it obeys the equations it is derived from, and ends where it should."""

import numpy as np
import pytest
from rig import Rig
from surroundings import N

from riserstudy.effects.waterline import Waterline
from riserstudy.effects.wave import CONSTANT, NONE, STRETCHED, Wave
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.model.sea import components, components_of, jonswap, wave_number
from riserstudy.scene.sea import IrregularSea
from riserstudy.solve.evaluate import shape_of


class Sea:
    """Water at one place and time, through the kernel."""

    def __init__(self, **changes):
        self.rig = Rig(Wave, 2)
        frozen = self.rig.frozen_record()
        self.record = frozen.value._replace(above=NONE, ramp=0.0, **changes)
        model = self.rig.model
        model.effects[:] = [e._replace(record=self.record) for e in model.effects]
        self.model = Model(Unknowns(model.s.l0, 2, 0, (0.5, 0.0)), model.effects)

    def at(self, x, z, t):
        s = self.model.s
        s.r[0], s.r[1] = x + 1e-3 * np.arange(N + 1), z
        s.clock[0] = t
        shape_of(self.model.programs, self.model.state)
        return s.water[:, 0].copy(), s.water_rate[:, 0].copy(), s.shear[:, 0].copy()


@pytest.mark.parametrize("depth", [20.0, 60.0, 4000.0])
def test_the_flow_is_that_of_a_potential_over_a_bed(depth):
    """Free of divergence and curl, no flow through the bed, and the rates are its derivatives."""
    one = {"amplitude": np.array([1.0]), "frequency": np.array([0.9]), "phase": np.array([0.4])}
    number = np.array([wave_number(0.9, depth, 9.81)])
    sea = Sea(depth=depth, number=number, heading=np.array([1.0]), **one)
    x, z, t, h = 3.0, 45.0 - 8.0, 5.2, 1e-3

    def slope(change):
        a, b, c, d = (sea.at(*np.add((x, z, t), k * h * np.array(change)))[0] for k in (-2, -1, 1, 2))
        return (a - 8.0 * b + 8.0 * c - d) / (12.0 * h)

    by_x, by_z, by_t = slope((1, 0, 0)), slope((0, 1, 0)), slope((0, 0, 1))
    _, rate, shear = sea.at(x, z, t)
    assert by_x[0] + by_z[1] == pytest.approx(0.0, abs=1e-10)
    assert by_x[1] - by_z[0] == pytest.approx(0.0, abs=1e-10)
    np.testing.assert_allclose(by_t, rate, atol=1e-10)
    np.testing.assert_allclose(by_z, shear, atol=1e-10)
    assert sea.at(x, 45.0 - depth, t)[0][1] == pytest.approx(0.0, abs=1e-12)


def test_a_deep_wave_is_the_textbook_s():
    """8 s over 2000 m: 99.9 m long, surface speed pi H / T, e^-pi at half a length."""
    number = wave_number(2.0 * np.pi / 8.0, 2000.0, 9.81)
    assert 2.0 * np.pi / number == pytest.approx(9.81 * 64.0 / (2.0 * np.pi), rel=1e-12)
    w = np.array([2.0 * np.pi / 8.0])
    sea = Sea(amplitude=np.array([3.0]), frequency=w, number=np.array([number]), depth=2000.0,
              phase=np.zeros(1), heading=np.array([1.0]))  # fmt: skip
    speed = np.hypot(*sea.at(0.0, 45.0, 1.3)[0])
    assert speed == pytest.approx(np.pi * 6.0 / 8.0, rel=1e-9)
    below = np.hypot(*sea.at(0.0, 45.0 - np.pi / number, 1.3)[0])
    assert below == pytest.approx(speed * np.exp(-np.pi), rel=1e-9)


def test_wave_numbers_solve_the_dispersion_relation_at_any_depth():
    for depth in (0.5, 10.0, 100.0, 5000.0):
        for w in (0.01, 0.3, 0.8, 3.0):
            k = wave_number(w, depth, 9.81)
            assert 9.81 * k * np.tanh(k * depth) == pytest.approx(w * w, rel=1e-10)
    assert wave_number(0.01, 1.0, 9.81) == pytest.approx(0.01 / np.sqrt(9.81), rel=1e-4)  # shallow


@pytest.mark.parametrize("above", [NONE, CONSTANT, STRETCHED])
def test_above_the_surface_there_is_no_wave(above):
    sea = Sea()
    crest = sea.record._replace(
        above=above, amplitude=np.array([2.0, 0.0]), phase=np.zeros(2), heading=np.array([1.0])
    )
    line = Waterline(45.0, np.ones((3, N)), np.ones(N), *np.ones((4, N)))
    effects = [Effect("wave", crest, ""), Effect("waterline", line, "")]
    sea.model = Model(Unknowns(sea.model.s.l0, 2, 0, (0.5, 0.0)), effects)
    t = 2.0 * np.pi / 0.8  # the crest passes x = 0
    inside = {NONE: 0.0, CONSTANT: 1.0, STRETCHED: 1.0}[above]
    at_level, below = (sea.at(0.0, 45.0 + dz, t)[0][0] for dz in (0.0, -1e-9))
    assert at_level == pytest.approx(below, rel=1e-6)
    between = sea.at(0.0, 46.5, t)[0][0]
    assert (between > 0.0) == bool(inside)
    if above == CONSTANT:
        assert between == pytest.approx(at_level)
    if above == STRETCHED:  # the profile's top value stands at the crest
        k, d = 0.07, 60.0
        assert sea.at(0.0, 47.0 - 1e-9, t)[0][0] == pytest.approx(1.6 / np.tanh(k * d), rel=1e-6)
    assert sea.at(0.0, 47.1, t)[0][0] == 0.0


def test_the_sea_is_calm_at_rest_and_before():
    sea = Sea()
    for t in (-1.0, 0.0):
        assert not np.any(sea.at(1.0, 30.0, t))
    assert np.any(sea.at(1.0, 30.0, 1e-6)[0])


@pytest.mark.parametrize("enhancement", [1.0, 3.3])
def test_an_irregular_sea_has_its_height_and_its_spectrum(enhancement):
    sea = IrregularSea.model_validate({
        "significant_height": "7 m", "peak_period": "12 s", "peak_enhancement": enhancement,
        "components": 400, "seed": 3, "above_mean_level": "none",
    })  # fmt: skip
    frequency, amplitude = components(sea)
    assert 4.0 * np.sqrt(0.5 * (amplitude**2).sum()) == pytest.approx(7.0, rel=1e-12)
    assert np.all(np.diff(frequency) > 0.0)
    peak = 2.0 * np.pi / 12.0
    if enhancement == 1.0:  # Pierson-Moskowitz: mean frequency Gamma(3/4) (5/4)^(1/4) times the peak's
        # 400 shares of equal energy cut the tail of the fifth power
        assert frequency.mean() == pytest.approx(1.2254167 * 1.25**0.25 * peak, rel=5e-3)
    else:
        w = peak * np.linspace(0.5, 2.0, 3001)
        assert abs(w[jonswap(w, peak, enhancement).argmax()] / peak - 1.0) < 1e-3


#: JONSWAP of waveresponse 1.4.1 (Hs 5 m, Tp 10 s, m2 s/rad), scaled by DNV's 1 - 0.287 ln(gamma)
OTHERS_FREQUENCY = np.array([0.4, 0.5, 0.55, 0.6, 0.66, 0.7, 0.8, 1.0, 1.5, 2.5])  # rad/s
OTHERS = {
    1.0: [5.89103390e-02, 1.72553630, 2.87790580, 3.48265284, 3.48248478, 3.21833224,
          2.30938288, 1.00207688, 1.54290940e-01, 1.24063344e-02],
    2.0: [4.71911604e-02, 1.39592295, 2.65714378, 4.90065226, 5.04504132, 3.51641541,
          1.86279279, 8.02730479e-01, 1.23597344e-01, 9.93830211e-03],
    3.3: [3.87244378e-02, 1.15363800, 2.41598108, 6.04153664, 6.35161696, 3.61088102,
          1.53622925, 6.58709477e-01, 1.01422263e-01, 8.15523262e-03],
    7.0: [2.60103872e-02, 7.83180361e-01, 1.89303923, 7.47745540, 8.11324921, 3.39639409,
          1.03961328, 4.42440780e-01, 6.81231203e-02, 5.47769176e-03],
}  # fmt: skip


@pytest.mark.parametrize("enhancement", OTHERS)
def test_the_spectrum_is_that_of_another_library(enhancement):
    """Shape to nine digits; and a share of energy that DNV's factor has right to its own accuracy."""
    peak = 2.0 * np.pi / 10.0
    scale = OTHERS[enhancement] / jonswap(OTHERS_FREQUENCY, peak, enhancement)
    np.testing.assert_allclose(scale, scale[0], rtol=2e-8)  # the digits given
    w = peak * np.geomspace(0.2, 60.0, 200_001)
    energy = np.trapezoid(scale[0] * jonswap(w, peak, enhancement), w)
    # exact for 1 (Pierson-Moskowitz: Hs^2/16); the logarithm is a fit for 1 to 7
    assert energy == pytest.approx(5.0**2 / 16.0, rel=1e-6 if enhancement == 1.0 else 0.02)


@pytest.mark.parametrize("enhancement", [2.0, 3.3, 7.0])
def test_the_peak_stands_over_that_of_pierson_and_moskowitz_by_the_enhancement(enhancement):
    w = np.array([0.7])
    assert jonswap(w, 0.7, enhancement) / jonswap(w, 0.7, 1.0) == pytest.approx(enhancement)


def summed_directly(wave, x, z, t):
    """Velocity, rate and shear of a sea, (2,) each, by the formulas and the library's functions."""
    k, w, a = wave.number, wave.frequency, wave.amplitude * wave.frequency
    angle = k * x - w * t + wave.phase
    height = z - wave.surface + wave.depth
    u = a * np.exp(k * (height - wave.depth)) * (1 + np.exp(-2 * k * height))
    v = a * np.exp(k * (height - wave.depth)) * (1 - np.exp(-2 * k * height))
    u, v = (b / (1 - np.exp(-2 * k * wave.depth)) for b in (u, v))
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([
        [(u * cosine).sum(), (v * sine).sum()],
        [(w * u * sine).sum(), (-w * v * cosine).sum()],
        [(k * v * cosine).sum(), (k * u * sine).sum()],
    ])  # fmt: skip


@pytest.mark.parametrize("depth", [15.0, 1000.0])
@pytest.mark.parametrize("t", [3.0, 10_800.0])
def test_two_hundred_components_are_the_direct_sum(depth, t):
    storm = IrregularSea.model_validate({
        "significant_height": "7 m", "peak_period": "12 s", "peak_enhancement": 3.3,
        "components": 200, "seed": 3, "above_mean_level": "none",
    })  # fmt: skip
    amplitude, frequency, phase = components_of(storm)
    number = np.array([wave_number(w, depth, 9.81) for w in frequency])
    sea = Sea(amplitude=amplitude, frequency=frequency, number=number, phase=phase, depth=depth,
              heading=np.array([1.0]), scratch=np.zeros((3, 200)))  # fmt: skip
    for x, share in ((0.0, 0.0), (-17.3, 0.01), (250.0, 0.3), (4.0, 0.999)):
        z = 45.0 - share * depth
        flow = np.array(sea.at(x, z, t))
        exact = summed_directly(sea.record, x, z, t)
        size = abs(summed_directly(sea.record, 0.0, 45.0, t)).max(axis=1, keepdims=True)
        assert (abs(flow - exact) / size).max() < 1e-10  # phases of 1e5 rad are known to 1e-11
