"""Checks of what Chang et al. 2020 claim, on invented runs."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.chang2020 import claims as checks
from chapters.chang2020.derived import reductions_open
from riserstudy.grading.grade import answers
from riserstudy.grading.words_of_size_file import read_words

WORD = read_words(Path(__file__).parents[3] / "config").word
MORE, SMALLER = WORD("increases"), WORD("smaller")


def runs(up, down, amplitudes=(0.5, 1.0, 3.0, 10.0)):
    rest = 2395.0
    return xr.Dataset(
        {
            "z_static": (("heave_amplitude", "s_node"), np.full((len(amplitudes), 1), rest)),
            "z_max": (("heave_amplitude", "s_node"), rest + np.array(up, float)[:, None]),
            "z_min": (("heave_amplitude", "s_node"), rest - np.array(down, float)[:, None]),
        },
        {"heave_amplitude": list(amplitudes), "s_node": [2394.0]},
    )


def test_asymmetry_must_grow_and_never_fall():
    grows = checks.asymmetry_grows(runs([1.0, 2.2, 6.0, 30.0], [1.0, 2.0, 4.0, 10.0]), MORE)
    assert bool(grows.true)
    assert float(grows.value) == pytest.approx(3.0)
    dips = runs([1.1, 2.0, 6.0, 30.0], [1.0, 2.0, 4.0, 10.0])
    assert not bool(checks.asymmetry_grows(dips, MORE).true)
    assert bool(checks.asymmetry_grows(dips, MORE, amplitudes=[1.0, 3.0, 10.0]).true)


def test_the_upper_side_must_be_larger_at_the_largest_amplitude_and_below_at_none():
    def found(up):
        return answers(checks.upper_side_larger(runs(up, [1, 2, 3, 4]), SMALLER)).item()

    assert found([2, 3, 4, 5]) == 1.0
    assert found([0.999, 3, 4, 5]) == 1.0  # 0.1 % is no difference
    assert found([0.9, 3, 4, 5]) == -1.0
    assert found([1, 2, 3, 4.01]) == 0.0


def law(force, stroke):
    place = ("tensioner_model", "heave_position", "cylinder")
    models = ["gas law", "linear"]
    return xr.Dataset(
        {
            "tensioner_force_static": (place, np.stack([force, force])[..., None]),
            "tensioner_stroke_static": (place, np.stack([stroke, stroke])[..., None]),
        },
        {"tensioner_model": models, "heave_position": stroke},
    )


def test_the_force_must_fall_and_be_convex():
    stroke = np.linspace(-10.0, 10.0, 41)  # the piston's X is -stroke
    assert bool(checks.falls_convex(law(np.exp(0.1 * stroke), stroke)).true)
    assert not bool(checks.falls_convex(law(np.exp(-0.1 * stroke), stroke)).true)
    assert not bool(checks.falls_convex(law(-np.exp(-0.1 * stroke), stroke)).true)


def test_a_secant_that_falls_is_told_from_one_that_rises():
    stroke = np.linspace(-10.0, 10.0, 41)
    assert bool(checks.secant_falls(law(np.exp(0.1 * stroke), stroke)).true)
    assert not bool(checks.secant_falls(law(-np.exp(-0.1 * stroke), stroke)).true)


def test_a_line_differs_from_a_curve_and_not_from_itself():
    stroke = np.linspace(-10.0, 10.0, 41)
    same = law(np.exp(0.1 * stroke), stroke)
    assert not bool(checks.line_differs(same, WORD("visible")).true)
    other = same.copy(deep=True)
    other["tensioner_force_static"].loc[{"tensioner_model": "linear"}] += 0.1
    found = checks.line_differs(other, WORD("visible"))
    assert float(found.value) == pytest.approx(0.1)
    assert bool(found.true)


def histories(amplitude, piston, riser, force):
    """Runs at rest and at one amplitude; time, the piston's X, the riser's x and the cylinder's force."""
    zero, place = 2394.0, ("heave_amplitude", "time", "cylinder")
    still = np.zeros_like(piston)

    def both(values, rest):
        return np.stack([rest + still, values])

    return xr.Dataset(
        {
            "tensioner_stroke": (place, -both(piston, 0.0)[..., None]),
            "tensioner_force": (place, both(force, 5.0)[..., None]),
            "tensioner_stroke_static": (("heave_amplitude", "cylinder"), np.zeros((2, 1))),
            "tensioner_force_static": (("heave_amplitude", "cylinder"), np.full((2, 1), 5.0)),
            "z": (("heave_amplitude", "time", "s"), zero + both(riser, 0.0)[..., None]),
            "z_static": (("heave_amplitude", "s_node"), np.full((2, 1), zero)),
        },
        {"heave_amplitude": [0.0, amplitude], "time": np.arange(len(piston)), "s": [zero], "s_node": [zero]},
    )


def test_piston_and_riser_are_told_apart_where_force_is_large():
    """The riser is highest where the piston is pushed in: what holds of X fails of x."""
    piston = np.array([0.0, -2.0, 0.0, 3.0])
    riser = np.array([0.0, 1.5, 0.0, -1.0])
    runs = histories(10.0, piston, riser, force=np.array([5.0, 9.0, 5.0, 3.0]))
    found = checks.pushed_in_harder(runs, SMALLER, amplitudes=[10.0])
    assert found.true.sel(displacement="piston, X").item()
    assert not found.true.sel(displacement="riser, x").item()
    assert float(found.value.sel(displacement="piston, X")) == pytest.approx(2.0)
    assert float(found.value.sel(displacement="riser, x")) == pytest.approx(-0.5)


def test_the_law_that_keeps_more_tension_is_found():
    def smallest(values):
        tension = xr.DataArray(values, dims=("heave_amplitude", "s_node"))
        return tension.assign_coords(heave_amplitude=[3.0, 10.0]).to_dataset(name="effective_tension_min")

    gas, line = smallest([[2e6, 3e6], [-1e6, 1e6]]), smallest([[2.5e6, 3e6], [-4e6, 1e6]])
    more = checks.keeps_more_tension(gas, line, [3.0, 10.0], MORE)
    assert more.true.values.tolist() == [False, True]
    assert float(more.value.sel(heave_amplitude=10.0)) == pytest.approx(3.0)


def test_asymmetry_is_the_law_s_only_if_a_line_has_none():
    bent = runs([1.0, 2.0, 4.0, 22.0], [1.0, 2.0, 3.0, 10.0])
    straight = runs([1.0, 2.0, 3.0, 10.0], [1.0, 2.0, 3.0, 10.0])
    limits = {"asymmetric": WORD("asymmetric"), "symmetric": WORD("the same"), "amplitude": 10.0}
    found = checks.caused_by_the_law(bent, straight, **limits)
    assert bool(found.true)
    assert float(found.value) == pytest.approx(2.2)
    assert not bool(checks.caused_by_the_law(bent, bent, **limits).true)
    assert not bool(checks.caused_by_the_law(straight, straight, **limits).true)


def test_a_smaller_gas_volume_must_raise_asymmetry_and_never_lower_it():
    def volumes(up):
        found = runs(up, [1.0, 1.0, 1.0], amplitudes=(2.4, 3.2, 6.4))
        return found.rename(heave_amplitude="gas_volume")

    assert bool(checks.grows_with_the_bend(volumes([3.0, 2.0, 1.5]), MORE).true)
    found = checks.grows_with_the_bend(volumes([3.0, 2.0, 1.5]), MORE)
    assert float(found.value) == pytest.approx(2.0)
    assert not bool(checks.grows_with_the_bend(volumes([2.0, 3.0, 1.5]), MORE).true)


def test_reductions_of_a_sample_are_those_of_its_own_record():
    """A riser that follows with half the platform's motion, and one whose record ends early."""
    time = np.arange(0.0, 40.0, 0.1)
    swings = np.sin(2.0 * np.pi * time / 20.0)[None, None, :] * np.array([2.5, 5.0])[None, :, None]
    platform = np.repeat(swings, 2, axis=0)
    platform[1, :, 200:] = np.nan
    share = np.array([0.5, 0.25])[:, None, None]
    dims = ("sample", "heave_amplitude", "time")
    runs = xr.Dataset(
        {
            "z": ((*dims, "s"), (2394.0 + share * platform)[..., None]),
            "tensioner_stroke": ((*dims, "cylinder"), ((1.0 - share) * platform)[..., None]),
            **{f"z_{end}": ((*dims[:2], "s_node"), (2394.0 + of(share * platform, axis=2))[..., None])
               for end, of in (("max", np.nanmax), ("min", np.nanmin))},
        },
        {"sample": [0, 1], "heave_amplitude": [2.5, 5.0], "time": time, "s": [2394.0], "s_node": [2394.0]},
    )  # fmt: skip
    found = reductions_open(runs)["reduction"]
    assert set(found.dims) == {"quantity", "sample", "measure", "height"}
    for sample, expected in ((0, 0.5), (1, 0.75)):
        np.testing.assert_allclose(found.sel(sample=sample), expected, rtol=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_reductions_include_the_peaks_that_outputs_miss(seed):
    """A riser that oscillates freely at 2.63 s; outputs are 0.25 s apart, as in the samples."""
    draw = np.random.default_rng(seed)
    late, size, share = draw.uniform(0.0, 6.0), draw.uniform(0.5, 2.0), draw.uniform(0.1, 0.5)
    period = draw.uniform(10.0, 25.0)

    def riser(time, amplitude):
        heave = share * amplitude * np.sin(2.0 * np.pi * time / period)
        return heave + size * np.cos(2.0 * np.pi * time / 2.63 - late)

    time, dense = np.arange(0.0, 2.0 * period, 0.25), np.linspace(0.0, 2.0 * period, 100001)
    amplitudes = np.array([2.5, 5.0])
    z = np.stack([riser(time, a) for a in amplitudes])
    platform = amplitudes[:, None] * np.sin(2.0 * np.pi * time / period)
    exact = np.stack([riser(dense, a) for a in amplitudes])
    dims = ("heave_amplitude", "time")
    runs = xr.Dataset(
        {
            "z": ((*dims, "s"), (2394.0 + z)[..., None]),
            "tensioner_stroke": ((*dims, "cylinder"), (platform - z)[..., None]),
            "z_max": ((dims[0], "s_node"), 2394.0 + exact.max(axis=1, keepdims=True)),
            "z_min": ((dims[0], "s_node"), 2394.0 + exact.min(axis=1, keepdims=True)),
        },
        {"heave_amplitude": amplitudes, "time": time, "s": [2394.0], "s_node": [2394.0]},
    )
    found = reductions_open(runs)["reduction"].sel(quantity="heave", drop=True)
    for name, amplitude, motion in zip(
        ("H is twice the amplitude", "H is the amplitude"), amplitudes, exact, strict=True
    ):
        of = found.sel(height=name)
        expected = 1.0 - np.ptp(motion) / (2.0 * amplitude), 1.0 - motion.max() / amplitude
        told = float(of.sel(measure="peak-to-peak range")), float(of.sel(measure="peak"))
        # outputs of the platform miss at most 0.3 % of its slowest peak: 1 - cos(pi 0.25 s / 10 s)
        np.testing.assert_allclose(1.0 - np.array(told), 1.0 - np.array(expected), rtol=0.0032)


@pytest.mark.parametrize("seed", range(12))
def test_both_oscillations_must_be_reduced(seed):
    obvious = WORD("obvious")
    values = np.random.default_rng(seed).uniform(-0.1, 0.2, (2, 30))
    found = checks.reduced(
        xr.Dataset({"reduction": (("quantity", "sample"), values)}, {"quantity": ["heave", "tension"]}),
        obvious,
    )
    assert found.value.values == pytest.approx(values.min(axis=0))
    assert found.true.values.tolist() == (values >= obvious.bound).all(axis=0).tolist()
