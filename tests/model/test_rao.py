"""Platforms in waves: the formula's limits, and motion from operators in every convention."""

import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import brentq

from riserstudy.errors import InputError
from riserstudy.model.platform_motion import displacement
from riserstudy.model.rao import harmonics, operator, slips
from riserstudy.model.sea import components_of
from riserstudy.records.warning import sentences
from riserstudy.scene.forcing import Platform
from riserstudy.scene.rao import Operator, Response
from riserstudy.scene.sea import RegularWave, Storm, Swell
from semisubmersible import DENSITY, GRAVITY, heave, read_units, response

UNITS = read_units(Path(__file__).parents[2] / "config/platforms/semisubmersibles.yaml")
each = pytest.mark.parametrize("unit", UNITS.values(), ids=UNITS)
LONG = 1000.0  # s


def number(period):
    return (2.0 * math.pi / period) ** 2 / GRAVITY


def test_there_are_three_platforms_of_different_size():
    volumes = [u.pontoon_volume + u.waterplane * u.column_depth for u in UNITS.values()]
    assert len(volumes) >= 3
    assert [round(DENSITY * v / 1e6) for v in volumes] == [25, 38, 52]


@each
def test_in_long_waves_the_platform_goes_with_the_water(unit):
    found = {name: complex(r[0]) for name, r in response(unit, np.array([LONG])).items()}
    assert found["heave"] == pytest.approx(1.0, abs=0.01)
    assert found["surge"] == pytest.approx(-1j, abs=0.01)
    # of cos(kx - wt) the slope at x = 0 is k sin(wt), and pitch leans the other way
    assert found["pitch"] / number(LONG) == pytest.approx(1j, abs=0.02)


@each
def test_in_short_waves_it_hardly_moves(unit):
    found = response(unit, np.array([2.0]))
    assert max(abs(found["surge"][0]), abs(found["heave"][0])) < 0.05


@each
def test_heave_cancels_shortly_before_it_resonates(unit):
    period = np.arange(12.0, 30.0, 0.05)
    size = np.abs(response(unit, period)["heave"])
    peak, natural = period[size.argmax()], heave(unit).period
    assert peak == pytest.approx(natural, abs=1.0)
    assert size.max() > 1.3
    before = period < peak
    low = np.where(before & (period > 16.0), size, np.inf).argmin()
    assert 0.8 * natural < period[low] < peak
    assert size[low] < 0.5
    assert size[low] < size[period < period[low]].max() - 0.02  # a dip, not a slope


def test_undamped_heave_cancels_where_pressure_and_inertia_balance():
    unit = UNITS["medium"].replaced(heave_damping=1e-9)
    period = np.linspace(15.0, 21.8, 100001)
    found = response(unit, period)["heave"]
    zero = float(period[np.abs(found).argmin()])
    w, k = 2.0 * math.pi / zero, number(zero)
    lift = DENSITY * GRAVITY * unit.waterplane * math.exp(-k * unit.column_depth)
    lift *= math.cos(0.5 * k * unit.column_spacing)
    mass = DENSITY * unit.pontoon_volume * (1.0 + unit.pontoon_added_mass_vertical)
    along = 0.5 * k * unit.pontoon_length
    load = mass * w**2 * math.exp(-k * unit.pontoon_depth) * math.sin(along) / along
    assert lift == pytest.approx(load, rel=1e-3)


ROWS = [
    {"period": "5 s", "heave": "0.2 m/m", "heave_phase": "170 deg"},
    {"period": "10 s", "heave": "0.5 m/m", "heave_phase": "-170 deg"},
    {"period": "20 s", "heave": "1.1 m/m", "heave_phase": "-20 deg"},
]


def made(**changes):
    return Response.model_validate({"operators": ROWS, "phases": "lead"} | changes)


def motion(found, name, t):
    chosen = np.array([m == name for m in found.motion])
    parts = [x[chosen][:, None] for x in found[1:]]
    return (parts[0] * np.sin(parts[1] * t + parts[2])).sum(axis=0)


@pytest.mark.parametrize("phases, sign", [("lead", 1.0), ("lag", -1.0)])
def test_a_regular_wave_gives_the_printed_motion(phases, sign):
    t = np.linspace(0.0, 40.0, 101)
    wave = Swell.model_validate({"height": "3 m", "period": "20 s", "phase": "30 deg"})
    found = motion(harmonics(made(phases=phases), wave), "heave", t)
    w = 2.0 * math.pi / 20.0
    lead = math.radians(-20.0 * sign)
    np.testing.assert_allclose(found, 1.5 * 1.1 * np.cos(w * t - math.radians(30.0) + lead))


def test_between_lines_phases_cross_180_degrees_without_harm():
    middle = math.pi * (1.0 / 5.0 + 1.0 / 10.0)
    r = complex(operator(made(), "heave", np.array([middle]))[0])
    assert abs(r) == pytest.approx(0.35, rel=0.02)
    assert abs(math.degrees(np.angle(r))) > 170.0


def test_a_seed_gives_the_same_sea_to_the_last_bit_and_another_other_phases():
    def sea(seed):
        values = {"significant_height": "4 m", "peak_period": "12 s", "peak_enhancement": 2.0}
        return components_of(Storm.model_validate(values | {"components": 60, "seed": seed}))

    amplitude, frequency, phase = sea(3)
    for one, again in zip((amplitude, frequency, phase), sea(3), strict=True):
        assert one.tobytes() == again.tobytes()
    others = sea(4)
    assert others[0].tobytes() == amplitude.tobytes()
    assert others[1].tobytes() == frequency.tobytes()
    assert (others[2] != phase).all()
    assert len(set(phase)) == 60
    assert 0.0 <= phase.min() < 1.0 < 5.0 < phase.max() < 2.0 * math.pi


def test_a_sea_gives_the_variance_of_spectrum_times_operator():
    sea = Storm.model_validate(
        {
            "significant_height": "4 m",
            "peak_period": "12 s",
            "peak_enhancement": 2.0,
            "components": 60,
            "seed": 3,
        }
    )
    flat = [{"period": f"{p} s", "heave": "0.8 m/m", "heave_phase": "0 deg"} for p in (1, 60)]
    found = harmonics(made(operators=flat), sea)
    assert 4.0 * math.sqrt(0.5 * (found.amplitude**2).sum()) == pytest.approx(0.8 * 4.0)


def towards(degrees, factor):
    return [
        row | {"heading": f"{degrees} deg", "heave": f"{factor * float(row['heave'][:3])} m/m"}
        for row in ROWS
    ]


HEADED = [*towards(0, 1.0), *towards(90, 2.0), *towards(180, 3.0), *towards(-90, 2.0)]


@pytest.mark.parametrize(
    "degrees, factor",
    [(0, 1.0), (45, 1.5), (90, 2.0), (135, 2.5), (180, 3.0), (-180, 3.0), (225, 2.5), (330, 4 / 3)],
)
def test_between_headings_the_response_is_linear_all_around(degrees, factor):
    frequency = np.array([2.0 * math.pi / 10.0])
    headed = made(operators=HEADED, headings="towards")
    found = operator(headed, "heave", frequency, math.radians(degrees))
    plain = operator(made(), "heave", frequency)
    np.testing.assert_allclose(found, factor * plain, rtol=1e-12)


def test_the_wave_says_where_it_goes():
    swell = {"amplitude": "1 m", "period": "10 s"}
    to = {"operators": HEADED, "headings": "towards"}
    of_the_response = made(**to, wave=swell, heading="90 deg")
    assert harmonics(of_the_response, of_the_response.wave).amplitude[0] == pytest.approx(1.0)
    of_the_scene = RegularWave.model_validate(swell | {"heading": "180 deg", "above_mean_level": "none"})
    assert harmonics(made(**to), of_the_scene).amplitude[0] == pytest.approx(1.5)


def test_a_heading_that_the_operators_do_not_reach_is_refused():
    half = made(operators=[*towards(0, 1.0), *towards(90, 2.0)], headings="towards")
    with pytest.raises(InputError, match=r"no two headings .* enclose .* -45 deg"):
        operator(half, "heave", np.array([0.6]), math.radians(-45.0))


def test_waves_beyond_the_operators_are_refused():
    wave = Swell.model_validate({"amplitude": "1 m", "period": "25 s"})
    with pytest.raises(InputError, match=r"1 of 1 wave components \(25 s.*lie outside .*, 5 s to 20 s"):
        harmonics(made(), wave)


@pytest.mark.parametrize(
    "changes, reason",
    [
        ({"operators": [*ROWS, ROWS[0]]}, "a period occurs twice"),
        ({"symmetry": "sides"}, "have no headings"),
        ({"beyond": "guess"}, "hold"),
        ({"operators": [ROWS[0], {"period": "9 s"}]}, "different motions"),
        ({"operators": [{"period": "5 s", "heave": "1 m/m"}, ROWS[1]]}, "only one of heave and heave_phase"),
        ({"operators": [{"period": "5 s", "pitch": "1 m/m", "pitch_phase": "0 deg"}, ROWS[1]]}, "rad/m"),
        ({"motions": ["surge"]}, "no column for surge"),
        ({"motions": ["heave", "heave"]}, "heave occurs twice"),
        ({"heading": "90 deg", "wave": {"height": "3 m", "period": "12 s"}}, "operators have no headings"),
        ({"operators": [*towards(0, 1.0), *ROWS]}, "in every line or in none"),
        ({"operators": HEADED}, "'towards' or 'from'"),
        ({"operators": ROWS, "headings": "from"}, "the operators have no headings"),
        ({"operators": [ROWS[2], {"frequency": "1 Hz", "heave": "0 m/m", "heave_phase": "0 deg"}]},
         "in every line"),
        ({"operators": [ROWS[0], ROWS[1] | {"frequency": "0.1 Hz"}]}, "period or frequency is required"),
        ({"operators": [*towards(0, 1.0), *towards(90, 1.0)[1:]]}, "different periods"),
        ({"heading": "90 deg"}, "wave of the scene defines the heading"),
        ({"phases": "upwards"}, "lead"),
    ],
)  # fmt: skip
def test_operators_that_cannot_be_meant_are_refused(changes, reason):
    with pytest.raises(ValueError, match=reason):
        made(**changes)


def test_operators_do_not_depend_on_the_order_of_lines():
    frequency = 2.0 * math.pi / np.array([6.0, 10.0, 17.0])
    shuffled = [HEADED[k] for k in np.random.default_rng(5).permutation(len(HEADED))]
    one, other = (made(operators=rows, headings="towards") for rows in (HEADED, shuffled))
    for heading in np.radians([0.0, 30.0, 200.0]):
        expected = operator(one, "heave", frequency, heading)
        np.testing.assert_array_equal(operator(other, "heave", frequency, heading), expected)


def six(heading, size):
    """All six motions in waves of one heading (deg), two periods, phases of their own."""
    shifts = {name: f"{size + k} m/m" for k, name in enumerate(("surge", "sway", "heave"))}
    turns = {name: f"{size + k} deg/m" for k, name in enumerate(("roll", "pitch", "yaw"))}
    phases = {f"{name}_phase": f"{7 * k} deg" for k, name in enumerate(shifts | turns)}
    row = {"heading": f"{heading} deg"} | shifts | turns | phases
    return [row | {"period": f"{period} s"} for period in (5, 20)]


#: signs of motions under mirrors, as displacements (polar) and rotations (axial vectors) have them
ACROSS_Y = {"surge": 1, "sway": -1, "heave": 1, "roll": -1, "pitch": 1, "yaw": -1}
ACROSS_X = {"surge": -1, "sway": 1, "heave": 1, "roll": 1, "pitch": -1, "yaw": -1}


@pytest.mark.parametrize("headings", ["towards", "from"])
@pytest.mark.parametrize("motion", ACROSS_Y)
def test_symmetry_gives_the_headings_that_are_not_there(motion, headings):
    rows = [*six(0, 1.0), *six(30, 2.0), *six(90, 3.0)]
    found = made(operators=rows, headings=headings, symmetry="sides and ends")
    frequency = np.array([2.0 * math.pi / 10.0])
    turn = math.pi if headings == "from" else 0.0

    def r(degrees):
        return operator(found, motion, frequency, math.radians(degrees) + turn)

    across_y, across_x = ACROSS_Y[motion], ACROSS_X[motion]
    np.testing.assert_allclose(r(-30), across_y * r(30))
    np.testing.assert_allclose(r(150), across_x * r(30))
    np.testing.assert_allclose(r(210), across_x * across_y * r(30))


def test_what_stands_in_the_table_is_not_mirrored():
    rows = [*towards(0, 1.0), *towards(90, 2.0), *towards(-90, 5.0), *towards(180, 1.0)]
    found = made(operators=rows, headings="towards", symmetry="sides")
    frequency = np.array([2.0 * math.pi / 10.0])
    right, left = (operator(found, "heave", frequency, h) for h in (-0.5 * math.pi, 0.5 * math.pi))
    assert right == pytest.approx(2.5 * left)


def sea(**changes):
    storm = {
        "significant_height": "4 m", "peak_period": "8 s", "peak_enhancement": 1.0,
        "components": 100, "seed": 3,
    }  # fmt: skip
    return Storm.model_validate(storm | changes)


def test_components_beyond_the_operators_hold_or_have_no_motion():
    storm = sea()
    periods = 2.0 * math.pi / components_of(storm)[1]
    inside = (periods >= 5.0) & (periods <= 20.0)
    assert 0 < inside.sum() < 100
    with pytest.raises(InputError, match=f"{(~inside).sum()} of 100 wave components"):
        harmonics(made(beyond="refuse"), storm)
    zero, hold = (harmonics(made(beyond=rule), storm) for rule in ("zero", "hold"))
    assert not zero.amplitude[~inside].any()
    np.testing.assert_array_equal(zero.amplitude[inside], hold.amplitude[inside])
    short = periods < 5.0
    each = 4.0 / math.sqrt(8.0 * 100)  # Hs = 4 sqrt(sum a^2 / 2)
    np.testing.assert_allclose(hold.amplitude[short], 0.2 * each)


PITCHED = [
    {"period": f"{p} s", "pitch": f"{a} {{unit}}/m", "pitch_phase": f"{e} {{unit}}"}
    for p, a, e in ((6, 0.4, 80.0), (10, 1.2, 95.0), (18, 0.6, 91.0))
]


@pytest.mark.parametrize("unit, count", [("deg", 0), ("rad", 2)])
def test_degrees_under_a_heading_of_radians_are_told_by_their_size(unit, count):
    rows = [{key: text.format(unit=unit) for key, text in row.items()} for row in PITCHED]
    told = sentences(slips(made(operators=rows), 9.81))
    assert len(told) == count
    assert all("radians" in line for line in told)


def test_the_order_of_warnings_does_not_depend_on_the_hashes_of_names():
    """An unordered set of both names would have either order, by the hash seed of the process."""
    rows = [{key: text.format(unit="rad") for key, text in row.items()} for row in PITCHED]
    rows = [row | {key.replace("pitch", "roll"): text for key, text in row.items()} for row in rows]
    told = [one["values"]["name"] for one in slips(made(operators=rows), 9.81) if "name" in one["values"]]
    assert told == ["roll", "pitch"]


def test_radians_under_a_heading_of_degrees_are_told_by_their_phases():
    rows = [row | {"heave_phase": f"{x} deg"} for row, x in zip(ROWS, (3.0, -2.9, 1.5), strict=True)]
    assert "radians, although" in sentences(slips(made(operators=rows), 9.81))[0]


def test_an_operator_knows_its_motions():
    assert Operator.model_validate(ROWS[0]).motions == {"heave"}


@pytest.mark.parametrize("sails", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_in_the_wave_of_the_scene_a_platform_goes_with_the_water_at_its_position(seed, sails):
    draw = np.random.default_rng(seed)
    x, y, offset = draw.uniform(-80.0, 80.0, 3).tolist()
    period, phase, heading = draw.uniform((6.0, 0.0, 0.0), (15.0, 6.0, 6.0)).tolist()
    rows = [{"period": f"{p} s", "heave": "1 m/m", "heave_phase": "0 deg"} for p in (4, 20)]
    surface = {"amplitude": "2 m", "period": f"{period!r} s", "phase": f"{phase!r} rad"}
    wave = {**surface, "heading": f"{heading!r} rad", "above_mean_level": "none"}
    times = np.linspace(0.0, 40.0, 81)
    k = brentq(lambda k: 9.81 * k * math.tanh(533.0 * k) - (math.tau / period) ** 2, 1e-6, 1.0, xtol=1e-15)
    speed, course, ramp = draw.uniform((-2.0, 0.0, 5.0), (2.0, 6.0, 20.0)).tolist()
    cruise = {"speed": f"{speed!r} m/s", "heading": f"{course!r} rad", "ramp": f"{ramp!r} s"}
    sailed = np.where(times < ramp, 0.5 * times**2 / ramp, times - 0.5 * ramp)
    sailed *= sails * speed * math.cos(course - heading)  # with the wave
    for own in (False, True):
        response = {"operators": rows, "phases": "lead"} | ({"wave": surface} if own else {})
        position = {"surge": f"{x!r} m", "sway": f"{y!r} m"}
        platform = {"position": position, "response": response}
        platform |= {"cruise": cruise} if sails else {}
        scene = SimpleNamespace(
            platform=Platform.model_validate(platform),
            top=SimpleNamespace(offset=offset),
            wave=None if own else RegularWave.model_validate(wave),
            water=SimpleNamespace(surface=0.0, seabed=-533.0),
            gravity=9.81,
        )
        along = 0.0 if own else (x + offset) * math.cos(heading) + y * math.sin(heading) + sailed
        expected = 2.0 * np.cos(k * along - math.tau * times / period + phase)
        np.testing.assert_allclose(displacement(scene, times)[:, 2], expected, atol=1e-8)


@pytest.mark.parametrize("seed", range(5))
def test_headings_in_the_wrong_unit_cause_a_warning(seed):
    """As degrees, 180 rad would be a heading of 233 deg; as radians, 3.14 deg would be the bow."""
    draw = np.random.default_rng(seed)
    degrees = np.sort(draw.choice(np.arange(15.0, 345.0, 15.0), 4, replace=False))

    def told(numbers, unit):
        rows = [
            {"heading": f"{h!r} {unit}", "period": f"{t} s", "heave": "0.5 m/m", "heave_phase": "40 deg"}
            for h in numbers.tolist()
            for t in (8, 14)
        ]
        return sentences(slips(made(operators=rows, headings="towards"), 9.81))

    assert told(degrees, "deg") == []
    assert told(np.radians(degrees), "rad") == []
    assert "headings reach" in told(degrees, "rad")[0]
    assert "no heading is above" in told(np.radians(degrees), "deg")[0]
