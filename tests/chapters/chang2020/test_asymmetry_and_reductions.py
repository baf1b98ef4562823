"""Asymmetry and reductions of Chang et al. 2020, of risers whose displacement is a known function."""

import numpy as np
import pytest
import xarray as xr

from chapters.chang2020.derived import asymmetry, reductions

ZERO, RISEN = 2394.0, 1.0  # m, elevation of the unstretched top, and its rise at rest
AMPLITUDES = (1.0, 2.5, 5.0, 10.0)
READINGS = ("steady", "from_rest", "quasi_static")
LAWS = ["gas law", "linear"]


def place(a, linear, bend):
    """Displacement of the riser's top (m) where the platform is at a."""
    return linear * a + bend * a**2


def held(linear, bend):
    """Equilibria with the platform at rest; the second law has no bend."""
    at = np.linspace(-10.0, 10.0, 81)
    rise = np.stack([place(at, linear, bend), place(at, linear, 0.0)])[..., None]
    dims = ("tensioner_model", "heave_position", "s_node")
    return xr.Dataset(
        {"z_static": (dims, ZERO + RISEN + rise), "effective_tension_static": (dims, 4e6 + 1e5 * rise)},
        {"tensioner_model": LAWS, "heave_position": at, "s_node": [ZERO]},
    )


def swinging(linear, bend, late=0.0, zero=ZERO + RISEN):
    """Two whole periods of 20 s, both ends included; the second law has no bend."""
    time = np.arange(0.0, 40.01, 0.5)
    a = np.array(AMPLITUDES)[:, None]
    follow = a * np.sin(2.0 * np.pi * time / 20.0 - late)
    rise = np.stack([place(follow, linear, bend), place(follow, linear, 0.0)])[..., None]
    ends = np.stack([place(a, linear, of) for of in (bend, 0.0)])
    lows = np.stack([place(-a, linear, of) for of in (bend, 0.0)])
    over = ("tensioner_model", "heave_amplitude")
    return xr.Dataset(
        {
            "z": ((*over, "time", "s"), zero + rise),
            "z_max": ((*over, "s_node"), zero + ends),
            "z_min": ((*over, "s_node"), zero + lows),
            "effective_tension": ((*over, "time", "s"), 4e6 + 1e5 * rise),
            "effective_tension_max": ((*over, "s_node"), 4e6 + 1e5 * ends),
            "effective_tension_min": ((*over, "s_node"), 4e6 + 1e5 * lows),
        },
        {"tensioner_model": LAWS, "heave_amplitude": list(AMPLITUDES), "time": time,
         "s": [ZERO], "s_node": [ZERO]},
    )  # fmt: skip


def test_the_asymmetry_of_a_parabola_is_that_of_its_slopes():
    """x = c a + q a^2 rises by c a + q a^2 and falls by c a - q a^2, from rest at whatever elevation."""
    c, bends = 0.4, {"steady": 0.02, "from_rest": 0.03, "quasi_static": 0.01}
    runs = [swinging(c, bends[name]) for name in READINGS[:2]]
    found = asymmetry(*runs, held(c, bends["quasi_static"]))
    assert list(found["reading"].values) == list(READINGS)
    for name, q in bends.items():
        for law, bend in (("gas law", q), ("linear", 0.0)):
            for a in AMPLITUDES:
                of = found.sel(reading=name, tensioner_model=law, heave_amplitude=a)
                up, down = float(of["displacement_up"]), float(of["displacement_down"])
                assert up + down == pytest.approx(2.0 * c * a)
                assert up - down == pytest.approx(2.0 * bend * a**2)
                assert float(of["asymmetry_index"]) == pytest.approx((c + bend * a) / (c - bend * a))


def test_a_riser_that_follows_by_a_share_is_reduced_by_the_rest():
    """Whole periods count once: a lag of the riser behind the platform changes no deviation."""
    shares = {"steady": 0.7, "from_rest": 0.6}
    runs = [swinging(share, 0.0, late=0.7, zero=ZERO) for share in shares.values()]
    bare = swinging(1.0, 0.0, zero=ZERO).isel(tensioner_model=0, drop=True)
    found = reductions(*runs, held(0.5, 0.0), bare)["reduction"]
    for height, a in (("H is the amplitude", 5.0), ("H is twice the amplitude", 2.5)):
        for name, share in (shares | {"quasi_static": 0.5}).items():
            of = found.sel(height=height, reading=name)
            for quantity in ("heave", "tension"):
                for measure in ("peak-to-peak range", "standard deviation"):
                    value = float(of.sel(quantity=quantity, measure=measure))
                    assert value == pytest.approx(1.0 - share, rel=1e-9), (quantity, measure)
            # of the peaks, above the unstretched top and above no tension
            higher = share * a + (RISEN if name == "quasi_static" else 0.0)
            assert float(of.sel(quantity="heave", measure="peak")) == pytest.approx(1.0 - higher / a)
            peak = (4e6 + 1e5 * share * a) / (4e6 + 1e5 * a)
            assert float(of.sel(quantity="tension", measure="peak")) == pytest.approx(1.0 - peak)


def test_the_quasi_static_deviation_is_the_mean_square_over_a_turn():
    """Of c a sin + q a^2 sin^2 the variance is c^2 a^2 / 2 + q^2 a^4 / 8."""
    c, q, a = 0.5, 0.04, 5.0
    bare = swinging(1.0, 0.0, zero=ZERO).isel(tensioner_model=0, drop=True)
    table = reductions(swinging(0.7, 0.0), swinging(0.7, 0.0), held(c, q), bare)["reduction"]
    found = table.sel(quantity="heave", height="H is the amplitude", reading="quasi_static")
    left = 1.0 - float(found.sel(measure="standard deviation"))
    assert left**2 == pytest.approx(c**2 + q**2 * a**2 / 4.0, rel=1e-9)
    assert 1.0 - float(found.sel(measure="peak-to-peak range")) == pytest.approx(c, rel=1e-9)
