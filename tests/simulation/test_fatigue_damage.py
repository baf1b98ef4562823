"""Fatigue damage: counts and curves against what others print, runs against closed forms and one another."""

import json
import math
import subprocess
import sys
from collections import Counter
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from fatigued_rigs import INSIDE, WELD, fatigued, listed
from random_rigs import moving, written
from scipy.special import gamma, gammainc, gammaincc

from riserstudy.errors import InputError, SimulationError
from riserstudy.scene.fatigue import StandardCurve, sn_curves
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.fatigue_damage import YEAR, Cycles, damage, rainflow, turning_points
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import single
from riserstudy.simulation.simulate import simulate
from riserstudy.simulation.starting_mesh import coarsest_mesh

SEA, AIR = "seawater with cathodic protection", "air"


def curve(detail_class="D", environment=SEA):
    return StandardCurve(detail_class=detail_class, environment=environment).numbers


def arrays_of(tree, *details):
    return run(SceneFile("rig.yaml", tree).resolved(), estimated=False).arrays


# Counts and curves


def test_rainflow_counts_the_sequence_of_the_standard():
    """ASTM E1049: its worked example."""
    counts = Counter()
    for size, count in zip(*rainflow(np.array([-2.0, 1, -3, 5, -1, 3, -4, 4, -2])), strict=True):
        counts[float(size)] += float(count)
    assert counts == {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}


def test_counting_loses_nothing_of_the_way_that_stress_goes():
    """Each cycle goes its range up and down: the sum of all is the way from turn to turn."""
    draw = np.random.default_rng(2)
    for _ in range(50):
        values = np.round(draw.normal(size=int(draw.integers(2, 400))), 1)
        cycles = rainflow(values)
        assert 2.0 * (cycles.ranges * cycles.counts).sum() == pytest.approx(np.abs(np.diff(values)).sum())
        assert cycles.ranges.max(initial=0.0) == pytest.approx(np.ptp(values))


def test_turning_points_are_where_values_turn():
    values = np.array([0.0, 0.0, 1.0, 1.0, 0.5, 0.5, 0.5, 2.0, 3.0, 3.0])
    assert turning_points(values).tolist() == [0.0, 1.0, 0.5, 3.0]
    assert turning_points(np.zeros(5)).tolist() == [0.0]


def test_a_sine_of_20_mpa_lasts_as_long_as_the_curve_says():
    time = np.arange(0.0, 1000.0, 0.01)
    cycles = rainflow(1e7 * np.sin(2.0 * np.pi * time))
    found = damage(cycles, curve(), 1.0, 0.025)
    assert cycles.counts.sum() / found == pytest.approx(1.26139e9, rel=2e-3)  # ends of the record
    assert 1.0 / damage(Cycles(np.array([2e7]), np.ones(1)), curve(), 1.0, 0.025) == pytest.approx(
        1.26139e9, rel=1e-5
    )


@pytest.mark.parametrize("environment, year", [(SEA, 0.0586867), (AIR, 0.0515202)])
def test_a_narrow_band_has_the_damage_of_its_closed_form(environment, year):
    """10 MPa root mean square, a period of 8 s: a number computed apart, and incomplete gamma functions."""
    count, of, size = 365.25 * 86400.0 / 8.0, curve("D", environment), math.sqrt(8.0) * 10.0
    share = (np.arange(400_000) + 0.5) / 400_000
    ranges = size * np.sqrt(-np.log(share)) * 1e6  # Rayleigh's, one in each equal part
    found = damage(Cycles(ranges, np.full(len(ranges), count / len(ranges))), of, 1.0, 0.025)
    knee = (10.0 ** ((of.log_a[1] - of.log_a[0]) / 2.0) / size) ** 2
    closed = count * (
        size**5 * gamma(3.5) * gammainc(3.5, knee) / 10.0 ** of.log_a[1]
        + size**3 * gamma(2.5) * gammaincc(2.5, knee) / 10.0 ** of.log_a[0]
    )
    assert closed == pytest.approx(year, rel=5e-6)
    assert found == pytest.approx(closed, rel=1e-4)


@pytest.mark.parametrize("environment", [SEA, AIR])
@pytest.mark.parametrize("name", sn_curves()["curves"])
def test_both_lines_of_a_curve_meet_at_its_knee(name, environment):
    """As the table prints the knee, in cycles; its numbers have three decimals."""
    of = curve(name, environment)
    (first, second), (a, b) = of.exponents, of.log_a
    size = (b - a) / (second - first)
    assert a - first * size == pytest.approx(math.log10(sn_curves()["knee"][environment]), abs=3e-3)


#: MPa, a column of that table that is in no file here: edition of April 2016 as examples of fatpack cite it
LIMITS = {
    **{"B1": 106.97, "B2": 93.59, "C": 73.10, "C1": 65.50, "C2": 58.48, "D": 52.63, "E": 46.78},
    **{"F": 41.52, "F1": 36.84, "F3": 32.75, "G": 29.24, "W1": 26.32, "W2": 23.39, "W3": 21.05},
}


@pytest.mark.parametrize("name", sn_curves()["curves"])
def test_ranges_at_ten_million_cycles_are_the_fatigue_limits_of_the_document(name):
    """Both lines in air give them there, to the three decimals of a logarithm."""
    of = curve(name, AIR)
    for slope, a in zip(of.exponents, of.log_a, strict=True):
        assert 10.0 ** ((a - 7.0) / slope) == pytest.approx(LIMITS[name], rel=8e-4)


def test_thickness_counts_above_that_of_reference_alone():
    of = curve("F")
    assert of.times(0.02) == of.times(0.025) == 1.0
    assert of.times(0.05) == pytest.approx(2.0**0.25)


@pytest.mark.parametrize("seed", range(3))
def test_a_spectral_method_from_outside_agrees_within_a_tenth(seed):
    """Dirlik's formula of FLife, on records of three hours, one slope of 3."""
    flife = pytest.importorskip("FLife")
    draw = np.random.default_rng(seed)
    rate, time = 10.0, 3.0 * 3600.0
    n = int(time * rate)
    f = np.fft.rfftfreq(n, 1.0 / rate)[1:]
    peaks = (0.08 + 0.02 * seed, 0.2 + 0.1 * seed)
    density = sum(
        np.exp(-0.5 * ((f - p) / (0.1 * p)) ** 2) / w for p, w in zip(peaks, (1.0, 3.0), strict=True)
    )
    size = np.sqrt(density) * np.exp(1j * draw.uniform(0.0, 2.0 * np.pi, len(f)))
    stress = np.fft.irfft(np.concatenate([[0.0], size]), n)
    stress *= 15e6 / stress.std()
    own = SimpleNamespace(exponents=(3.0,), log_a=(11.764,), times=lambda _: 1.0)
    found = damage(rainflow(stress), own, 1.0, 0.025) / time
    spectrum = flife.SpectralData(input={"time_history": stress / 1e6, "dt": 1.0 / rate})
    life = flife.Dirlik(spectrum).get_life(C=10.0**11.764 / 2.0**3, k=3.0)  # of amplitudes
    assert 1.0 / found == pytest.approx(life, rel=0.1)


# Runs


def test_a_regular_motion_has_the_damage_of_its_largest_range():
    """A detail by its stress per moment: one cycle a period, from the envelopes of the moment."""
    tree = moving(4, spatial=False, conductor=False)
    tree["platform"].pop("pitch", None)
    tree["current"]["profile"]["surface_speed"] = 0.0
    place = {"at": "lower end of section 0", "stress_per_moment": "0.2 MPa/kN/m"}
    detail = {k: v for k, v in WELD.items() if k != "face"} | place | {"thickness": "25 mm"}
    tree = fatigued(tree, detail)
    period = listed(tree["platform"]["surge"])["period"]
    tree["analysis"]["duration"] = 25.0 * period
    tree["analysis"]["output"]["start"] = 15.0 * period
    file = SceneFile("rig.yaml", written(tree, unit_of={"start": "s"}))
    found = run(file.resolved(), estimated=False)
    swing = (found.arrays["bending_moment_max"] - found.arrays["bending_moment_min"])[0]
    one = damage(Cycles(np.array([200.0 * swing]), np.ones(1)), curve(), 1.3, 0.025)
    assert found.arrays["damage_rate"][0, 0, 0] == pytest.approx(one * YEAR / period, rel=0.05)
    assert np.isnan(found.arrays["damage_rate"][0, :, 1:]).all()


@pytest.mark.long
def test_damage_converges_at_the_order_of_the_method():
    """Steps halved on one mesh: differences fall by four, as those of a second-order method.

    Over several rigs and halvings: rainflow pairs turning points anew, so that one fall alone is irregular.
    """
    orders = []
    for seed in range(30, 36):
        for spatial in (False, True):
            tree = fatigued(moving(seed, spatial=spatial), WELD)
            scene = SceneFile("rig.yaml", written(tree)).resolved()
            mesh, step = coarsest_mesh(scene).halved(), scene.analysis.output.interval
            runs = [single(scene, mesh, step / 2.0**k, everywhere=True) for k in range(1, 6)]
            off = [difference(a, b)["damage"] for a, b in pairwise(runs)]
            orders.append(np.log2(off[0] / off[-1]) / (len(off) - 1))
    assert np.mean(orders) == pytest.approx(2.0, abs=0.3)
    assert min(orders) > 1.0


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(30, 33))
def test_the_estimated_error_of_damage_covers_the_true_one(seed, spatial):
    tree = fatigued(moving(seed, spatial=spatial, conductor=False), WELD)
    for name in ("mesh", "step"):
        del tree["analysis"][name]
    file = SceneFile("rig.yaml", written(tree) | {})
    scene = file.with_values({"analysis.accuracy": "5 %"}, "test").resolved()
    from riserstudy.simulation.refinement import Refinement

    refinement = Refinement(scene)
    found = refinement.result()
    fine = single(scene, refinement.finest_mesh.halved().halved(), found.facts["step"] / 4.0, everywhere=True)
    told = found.facts["error_estimate"]["damage"]
    assert told <= 0.05
    assert difference(found, fine)["damage"] <= 2.0 * told


# What is refused, and what is left alone


def scene_with(**changes):
    tree = fatigued(moving(4, spatial=False, conductor=False), WELD)
    return SceneFile("rig.yaml", written(tree)).with_values(changes, "test")


@pytest.mark.parametrize(
    "changes, said",
    [
        ({"analysis.output.interval": "3 s"}, "outputs miss peaks of stress"),
        ({"riser[0].contents": None, "riser[0].inner_diameter": None}, "young_modulus"),
        ({"fatigue.details[0].at": "nowhere"}, "no section 'nowhere'"),
        ({"fatigue.details[0].curve.detail_class": "Z"}, "detail_class 'Z' is not a class"),
        ({"fatigue.details[0].stress_per_moment": "1 MPa/kN/m"}, "face or stress_per_moment is required"),
        ({"fatigue.angles": 6}, "fatigue.angles"),
        ({"fatigue.details[0].safety_factor": None}, "missing"),
        ({"analysis.duration": None, "analysis.output": None, "analysis.step": None}, "no stress cycles"),
    ],
)
def test_a_scene_that_tells_too_little_is_refused(changes, said):
    with pytest.raises(InputError, match=said):
        scene_with(**changes).resolved()


def test_a_run_that_ends_within_its_ramps_is_refused():
    file = scene_with(**{"platform.surge.ramp": "500 s"})
    with pytest.raises(SimulationError, match="cycles are counted after the ramps, from 500 s"):
        run(file.resolved(), estimated=False)


@pytest.mark.long
def test_a_scene_without_fatigue_does_not_count():
    """Neither the library nor any output or error of it."""
    tree = moving(4, spatial=False, conductor=False)
    found = simulate(SceneFile("rig.yaml", written(tree)), progress=False)
    assert "damage_rate" not in found
    assert "damage" not in json.loads(found.attrs["error_estimate"])
    code = "import sys, riserstudy.simulation.refine; sys.exit('fatpack' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_other_numbers_of_a_run_do_not_change():
    tree = fatigued(moving(4, spatial=False, conductor=False), WELD)
    plain = arrays_of(written({name: part for name, part in tree.items() if name != "fatigue"}))
    found = arrays_of(written(tree))
    for name, values in plain.items():
        assert np.array_equal(values, found[name], equal_nan=True), name


def test_a_dataset_names_details_and_places():
    found = simulate(SceneFile("rig.yaml", written(fatigued(moving(4), WELD, INSIDE))), progress=False)
    assert found["damage_rate"].dims == ("detail", "wall_angle", "s_node")
    assert found["detail"].values.tolist() == ["weld", "inside"]
    assert found["wall_angle"].values.tolist() == [45.0 * k for k in range(8)]
    rows = json.loads(found.attrs["fatigue"])
    most = found["damage_rate"].max(("wall_angle", "s_node"))
    assert [row["largest_rate"] for row in rows] == most.values.tolist()
    assert "damage" in json.loads(found.attrs["error_estimate"])


def vibrating(details, seed=4, spatial=False):
    """A run of a rig in a current without waves, whose riser vibrates by its vortices."""
    vortices = {"model": "synchronisation", "diameter": 1.0, "coefficient": 1.2}
    vortices |= {"frequencies": [0.11, 0.18, 0.26], "memory": 20.0, "seed": 3, "ramp": 30.0}
    tree = moving(seed, spatial=spatial, conductor=False)
    tree["platform"] = {"position": {"surge": 0.0}, "centre_of_rotation": {"elevation": 0.0}}
    for section in tree["riser"]:
        section["viv"] = vortices
    tree["analysis"] |= {"duration": 300.0, "output": {"interval": 0.5}}
    tree["fatigue"] = {"angles": 8, "details": details}
    tree["analysis"]["step"] = 0.25
    return run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False)


def test_cycles_of_vortices_count_once_their_vibration_is_built_up():
    """Damage from the time on at which the vibration is judged."""
    found = vibrating([WELD])
    (row,) = found.facts["fatigue"]
    assert row["since"] == found.facts["vibration_since"] == 165.0
    assert row["since"] + row["time"] == pytest.approx(300.0, abs=0.5)
    assert row["largest_rate"] == np.nanmax(found.arrays["damage_rate"])


@pytest.mark.parametrize("seed, spatial", [(3, False), (6, False), (3, True), (9, True)])
def test_the_chance_of_several_details_is_that_of_the_most_uncertain(seed, spatial):
    """One detail in each section: each alone, and all together in either order."""
    names = [section["name"] for section in moving(seed, spatial=spatial, conductor=False)["riser"]]
    details = [WELD | {"name": f"weld of {name}", "at": name} for name in names]
    alone = [vibrating([one], seed, spatial).facts["sampling_error"]["damage"] for one in details]
    assert max(alone) > 1.01 * min(alone) > 0.0
    for order in (details, details[::-1]):
        together = vibrating(order, seed, spatial).facts["sampling_error"]["damage"]
        assert together == pytest.approx(max(alone), rel=1e-12)
