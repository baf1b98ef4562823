"""Fatigue by vortex-induced vibration: closed form of a sinusoid, and its share of the damage over years."""

import numpy as np
import pytest
from short_riser import riser, simulated

from riserstudy import sweep
from riserstudy.errors import InputError
from riserstudy.fatigue.occurrence import of_table
from riserstudy.fatigue.vibration_share import shares
from riserstudy.fatigue.years import axes_of, over_years

SPEEDS = (0.45, 0.5)  # m/s, which lock in to the first mode
CURVE = {
    "slopes": [{"exponent": 3.0, "log_a": 12.0}, {"exponent": 5.0, "log_a": 15.6}],
    "reference_thickness": "50 mm",
    "thickness_exponent": 0.1,
}
YEAR = 365.25 * 86400.0


@pytest.mark.parametrize("speed", SPEEDS)
def test_damage_of_one_mode_is_that_of_its_sinusoid(speed):
    """Stress range by the curvature of the displacement, cycles by its frequency, N by the S-N line."""
    found = simulated(riser(speed, CURVE))
    late = found.arrays["time"] >= found.facts["vibration_since"]
    y, s = found.arrays["y"][late], found.arrays["s"]
    away = y - y.mean(axis=0)
    amplitude = np.sqrt(2.0) * away.std(axis=0)
    curvature = np.gradient(np.gradient(away, s, axis=1), s, axis=1)
    middle = int(amplitude.argmax())
    swing = 2.0 * np.sqrt(2.0) * curvature[:, middle].std() * 210e9 * 0.5 * 0.5334 / 1e6
    cycles = 10.0 ** max(a - m * np.log10(swing) for m, a in ((3.0, 12.0), (5.0, 15.6)))
    expected = YEAR * found.facts["vibration_frequency"] / cycles
    rates = found.arrays["damage_rate"][0]
    assert amplitude.max() > 0.2 * 0.5334
    across = rates[rates.shape[0] // 4, middle]  # the side of +y
    # seen: -1.0 and -1.6 %, +1.8 and +1.2 %; half a per cent of stress is some two of damage
    assert across == pytest.approx(expected, rel=0.03)
    assert np.nanmax(rates) == pytest.approx(expected, rel=0.03)
    along = rates[0, middle]  # the side of +x, bent by drag that is steady but for twice the frequency
    assert along < 0.05 * across


@pytest.mark.long
def test_the_estimate_of_damage_covers_the_true_error():
    wanted = {"analysis.mesh": None, "analysis.step": None, "analysis.accuracy": "10 %"}
    found = simulated(riser(0.5, CURVE).with_values(wanted, "test"), estimated=True)
    elements, step = found.facts["elements"], found.facts["step"]
    finer = {"analysis.mesh": {"elements": 3 * elements}, "analysis.step": f"{step / 3.0} s"}
    fine = simulated(riser(0.5, CURVE).with_values(finer, "test"))
    true = abs(np.nanmax(found.arrays["damage_rate"]) / np.nanmax(fine.arrays["damage_rate"]) - 1.0)
    assert true <= 1.5 * found.facts["error_estimate"]["damage"] + 1e-3
    assert found.facts["error_estimate"]["damage"] <= 0.1


def study_of(file):
    """The scene in several currents."""
    return sweep(file, {"current.profile.surface_speed": [0.0, *SPEEDS]}, keep=["damage_rate"])


def studies(file):
    """The same currents with vortices and without."""
    return [study_of(file), study_of(file.with_values({"riser[0].viv": None}, "test"))]


@pytest.mark.long
def test_in_steady_current_vibration_brings_all_of_the_damage(tmp_path):
    path = tmp_path / "currents.csv"
    path.write_text("current_profile_surface_speed (m/s),share (%)\n0.45,30\n0.5,10\n0,60\n")
    with_it, without = studies(riser(0.5, CURVE))
    years, rest = (over_years(of, of_table(path, of, axes_of(of)), {}) for of in (with_it, without))
    [one] = shares(years, rest)
    assert one.share == pytest.approx(1.0, abs=1e-6)
    alone = [simulated(riser(speed, CURVE)).arrays["damage_rate"] for speed in SPEEDS]
    expected = 0.3 * alone[0] + 0.1 * alone[1]
    assert years.worst[0].rate == pytest.approx(float(np.nanmax(expected)), rel=1e-6)


@pytest.mark.long
def test_studies_that_cannot_be_compared_are_refused(tmp_path):
    """A share of vibration needs vibration in the first study only, at the same places of the wall."""
    path = tmp_path / "currents.csv"
    path.write_text("current_profile_surface_speed (m/s),share (%)\n0.5,100\n")
    file = riser(0.5, CURVE).with_values({"analysis.duration": "120 s"}, "test")
    coarser = file.with_values({"riser[0].viv": None, "fatigue.angles": 20}, "test")
    renamed = file.with_values({"riser[0].viv": None, "fatigue.details[0].name": "other"}, "test")
    with_it, without = (over_years(of, of_table(path, of, axes_of(of)), {}) for of in studies(file))
    others = [
        over_years(of, of_table(path, of, axes_of(of)), {}) for of in (study_of(coarser), study_of(renamed))
    ]
    for pair, said in (
        ((with_it, with_it), "with vortex-induced vibration"),
        ((without, with_it), "with vortex-induced vibration"),
        ((without, without), "no vortex-induced vibration"),
        ((with_it, others[0]), "fatigue.angles"),
        ((with_it, others[1]), "no fatigue detail"),
    ):
        with pytest.raises(InputError, match=said):
            shares(*pair)


@pytest.mark.long
def test_in_waves_the_rest_is_that_of_the_same_seas_without(tmp_path):
    """Damage is compared at one place, and what is left is that of a run without vortices."""
    waves = {
        "height": "4 m",
        "period": "9 s",
        "heading": "90 deg",
        "ramp": "20 s",
        "above_mean_level": "none",
    }
    file = riser(0.5, CURVE).with_values({"wave": waves}, "test")
    without = simulated(file.with_values({"riser[0].viv": None}, "test"))
    path = tmp_path / "currents.csv"
    path.write_text("current_profile_surface_speed (m/s),share (%)\n0.5,100\n")
    found = [over_years(of, of_table(path, of, axes_of(of)), {}) for of in studies(file)]
    [one] = shares(*found)
    years = found[0]
    node = int(np.argmin(abs(years.s - one.of.s)))
    angle = round(one.of.angle / (360.0 / years.rates.shape[1]))
    assert one.without == pytest.approx(without.arrays["damage_rate"][0, angle, node], rel=1e-6)
    assert 0.0 < one.share < 1.0
    assert one.largest_without >= one.without
