"""Numbers of the design chapter: recoil by phase, watch circles, and the effect of one input."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from chapters.design.derived import recoil, seas, sensitivity, watch_circles
from riserstudy.design import operability

STROKE = SimpleNamespace(shortest=-7.0, longest=8.0)
RIG = SimpleNamespace(top=SimpleNamespace(tensioners=SimpleNamespace(stroke=STROKE)), limits=[])
PRESSURES, PHASES, HEAVES = [60.0, 64.0, 68.0, 72.0], [0.0, 120.0, 240.0], [1.0, 3.0]
TIME = np.arange(6.0)


def disconnects(lifts, reaches):
    """Over heave, pressure and phase: largest lift (m), and lift at the end; largest reach (m)."""
    shape = (len(HEAVES), len(PRESSURES), len(PHASES))
    axes = ("heave_amplitude", "gas_pressure", "phase")
    rise = np.zeros((*shape, len(TIME)))
    rise[..., 2], rise[..., 3], rise[..., 4:] = 5.0, 4.0, np.broadcast_to(lifts, shape)[..., None]
    reach = np.zeros((*shape, 2, len(TIME)))
    reach[..., 3] = np.broadcast_to(reaches, shape)[..., None]
    force = np.empty((*shape, 2))
    force[:] = 1e4 * np.array(PRESSURES)[:, None, None] * np.array([1.0, 2.0])
    force[1], force[:, :, 1:] = 9e9, 9e9  # not at rest
    coords = {"heave_amplitude": HEAVES, "gas_pressure": PRESSURES, "phase": PHASES, "time": TIME}
    data = {
        "point_key": (axes, np.full(shape, "k")),
        "lift": ((*axes, "time"), rise),
        "lift_rate": ((*axes, "time"), np.broadcast_to([0.0, 3.0, 1.0, -4.0, 0.0, 0.0], rise.shape)),
        "tensioner_stroke": ((*axes, "cylinder", "time"), reach),
        "smallest_tension": (axes, np.full(shape, 1e5)),
        "tensioner_force_static": ((*axes, "cylinder"), force),
    }
    return xr.Dataset(data, coords)


def over(**values):
    """Values by pressure, and phase: 2 everywhere else."""
    made = np.full((len(HEAVES), len(PRESSURES), len(PHASES)), 2.0)
    for place, value in values.items():
        heave, pressure, phase = (int(k) for k in place[1:])
        made[heave, pressure, phase] = value
    return made


def test_one_phase_that_comes_down_or_strokes_out_decides_a_setting(monkeypatch):
    """With small heave the lowest pressure comes down at one phase, the highest strokes out at another."""
    monkeypatch.setattr(recoil, "scenes_of", lambda _: iter([({}, RIG)]))
    runs = disconnects(over(_001=0.0, _101=0.0, _112=0.0), over(_032=8.5, _120=8.5, _130=-7.5, _110=7.9))
    found = recoil.recoil_outcome(runs)
    verdict = found["recoil_verdict"]
    assert verdict.sel(heave_amplitude=1.0).values.tolist() == [1, 0, 0, 2]
    assert verdict.sel(heave_amplitude=3.0).values.tolist() == [1, 1, 2, 2]
    settings = 3e4 * np.array(PRESSURES)  # sum of both cylinders
    calm = found.sel(heave_amplitude=1.0)
    limits = [float(calm[f"recoil_{name}"]) for name in ("below", "minimum", "maximum", "above")]
    np.testing.assert_allclose(limits, settings)
    assert found["recoil_minimum"].sel(heave_amplitude=3.0).isnull().all()
    assert (found["lift_max"] == 5.0).all()
    assert (found["lift_rate_max"] == 3.0).all()
    assert float(found["clearance_min"].min()) == 0.0


def test_a_setting_that_fails_in_both_ways_has_the_verdict_of_both(monkeypatch):
    monkeypatch.setattr(recoil, "scenes_of", lambda _: iter([({}, RIG)]))
    found = recoil.recoil_failures_outcome(disconnects(over(_000=0.0), over(_001=8.5)))
    assert found["recoil_verdict"].sel(heave_amplitude=1.0).values.tolist() == [3, 0, 0, 0]
    assert "recoil_minimum" not in found


@pytest.mark.parametrize("force, mass", [(2e6, 5e7), (5e5, 8e7)])
def test_a_vessel_without_drag_reaches_a_limit_by_its_acceleration(force, mass, monkeypatch):
    """x = F t^2 / 2 M: the limit at 60 m, red alarms 30 and 60 s before, yellow 90 s before these."""
    limits = [SimpleNamespace(mode="disconnect"), SimpleNamespace(mode="drilling")]
    seen = []
    scene = SimpleNamespace(limits=limits, replaced=lambda **update: update)
    monkeypatch.setattr(watch_circles, "scenes_of", lambda _: iter([({"surface_speed": 0.0}, scene)]))

    def offsets(of_mode, reach, allowances):
        seen.append((of_mode["limits"], reach, allowances))
        return [operability.Offsets(low=-5.0, high=80.0), operability.Offsets(low=-9.0, high=60.0)]

    monkeypatch.setattr(operability, "offsets", offsets)
    rests = xr.Dataset({"point_key": ("surface_speed", ["k"])}, {"surface_speed": [0.0]})
    hull = {"mass": f"{mass} kg", "drag": "1e-3 N*s^2/m^2", "force": f"{force} N"}
    allowances = {"lfj_angle": "1 deg"}
    found = watch_circles.watch_circles(rests, "200 m", allowances, ["30 s", "60 s"], "90 s", **hull)
    found = found.isel(surface_speed=0)
    last = np.sqrt(2.0 * mass * 60.0 / force)
    assert float(found["limit_offset"]) == 60.0
    assert float(found["disconnect_time"]) == pytest.approx(last, rel=1e-3)
    for k, eds in enumerate((30.0, 60.0)):
        for name, before in (("red", eds), ("yellow", eds + 90.0)):
            radius = 0.5 * force / mass * max(last - before, 0.0) ** 2
            assert float(found[f"{name}_circle_radius"][k]) == pytest.approx(radius, abs=0.02)
    ((modes, reach, allowed),) = seen
    assert ([limit.mode for limit in modes], reach) == (["disconnect"], 200.0)
    assert allowed["lfj_angle"] == pytest.approx(np.pi / 180.0)


def test_the_room_of_an_input_is_between_the_nearest_offsets_of_drilling(monkeypatch):
    """Named settings change the base alone; an allowance of one output leaves the others."""
    base, light = (
        SimpleNamespace(name=name, limits=[SimpleNamespace(mode="drilling"), SimpleNamespace(mode="x")])
        for name in ("base", "light")
    )
    rows = [({"varied_input": "base"}, base), ({"varied_input": "light"}, light)]
    monkeypatch.setattr(sensitivity, "scenes_of", lambda _: iter(rows))
    gaps = {"base": 5.0, "light": 7.0}
    monkeypatch.setattr(
        sensitivity,
        "window_of",
        lambda of, own, failed: SimpleNamespace(gap=gaps[of.name] - own["weight"] - failed),
    )
    monkeypatch.setattr(operability, "AtRest", lambda scene, reach: scene)

    def offsets_at(at, limits, reach, allowances):
        assert [limit.mode for limit in limits] == ["drilling"]
        near = 40.0 - np.rad2deg(allowances["lfj_angle"]) - np.rad2deg(allowances["ufj_angle"])
        if at.name == "light":
            near = -60.0
        return [operability.Offsets(low=-50.0, high=near), operability.Offsets(low=-30.0, high=70.0)]

    monkeypatch.setattr(operability, "offsets_at", offsets_at)
    settings = {"failed": 1, "weight": 2.0, "reach": "100 m",
                "allowances": {"lfj_angle": "1 deg", "ufj_angle": "2 deg"}}  # fmt: skip
    varied = {"heavy": {"weight": 3.0}, "still": {"allowances": {"ufj_angle": "0.5 deg"}}}
    found = sensitivity.sensitivity(xr.Dataset(), varied, **settings)
    assert found["varied_input"].values.tolist() == ["base", "light", "heavy", "still"]
    assert found["setting_gap"].values.tolist() == [2.0, 4.0, 1.0, 2.0]
    assert found["drilling_room"].values == pytest.approx([67.0, 0.0, 67.0, 68.5])


def test_offsets_of_a_limit_that_none_keeps_leave_no_room(monkeypatch):
    monkeypatch.setattr(operability, "AtRest", lambda scene, reach: scene)
    none = [operability.Offsets(low=np.nan, high=np.nan), operability.Offsets(low=-1.0, high=1.0)]
    monkeypatch.setattr(operability, "offsets_at", lambda *_: none)
    assert sensitivity._room(RIG, {"reach": "100 m", "allowances": {}}) == 0.0


def test_each_sea_narrows_the_offsets_by_its_own_addition(monkeypatch):
    """Seeds that add 1 and 2 deg: offsets of 100 m, less ten a degree."""
    time, rows = np.arange(3.0), np.ones((2, 5, 3))
    degrees = np.deg2rad([1.0, 2.0])[:, None, None] * np.array([0.5, 1.0, -0.5]) + 0.1
    over_all = ("significant_height", "seed", "time")
    noise = 1e-9 * np.arange(5)[:, None]
    data = {"lfj_angle": (over_all, rows * degrees + noise * np.array([0.0, 1.0, 0.0]))}
    data["ufj_angle"], data["joint_stroke"] = data["lfj_angle"], data["lfj_angle"]
    data |= {f"{name}_static": (over_all[:2], 0.1 * rows[..., 0]) for name in (*seas.ANGLES, "joint_stroke")}
    for name in ("von_mises_stress_max", "von_mises_stress_static", "effective_tension_min",
                 "effective_tension_static"):  # fmt: skip
        data[name] = ((*over_all[:2], "s_node"), rows + noise * (1.0 if name.endswith("max") else -1.0))
    runs = xr.Dataset(data, {"significant_height": [3.0, 6.0], "time": time, "s_node": np.arange(3.0)})
    limit = SimpleNamespace(mode="drilling", output="lfj_angle", at=None, place="", side="largest")
    scene = SimpleNamespace(limits=[limit], borders=[0.0, 2.0], riser=[SimpleNamespace(name="riser")])
    monkeypatch.setattr(seas, "scenes_of", lambda _: iter([({}, scene)]))
    monkeypatch.setattr(operability, "AtRest", lambda scene, reach: reach)

    def offsets_of(at, limit, reach, added):
        return -at + 10.0 * np.rad2deg(added), at - 10.0 * np.rad2deg(added), ""

    monkeypatch.setattr(operability, "offsets_of", offsets_of)
    rests = xr.Dataset({"point_key": ("mud_weight", ["k"])}, {"mud_weight": [1440.0]})
    found = seas.operability_in_seas(rests, runs, "100 m").isel(mud_weight=0)
    envelope = found["envelope_offset"].sel(operation="drilling")
    np.testing.assert_allclose(envelope.sel(offset_side="high"), [90.0, 80.0], rtol=1e-4)
    np.testing.assert_allclose(envelope.sel(offset_side="low"), [-90.0, -80.0], rtol=1e-4)


@pytest.mark.parametrize("seed", range(12))
def test_an_allowance_in_any_current_is_one_of_its_simulated_neighbours_and_no_smaller(seed):
    draw = np.random.default_rng(seed)
    speeds = np.sort(draw.choice(np.arange(0.0, 2.0, 0.1).round(1), int(draw.integers(1, 5)), replace=False))
    of = xr.DataArray(
        draw.uniform(0.1, 1.0, (len(speeds), 2)), {"surface_speed": speeds, "place": ["a", "b"]}
    )
    for speed in [*speeds, *draw.uniform(-0.2, 2.2, 9)]:
        found = seas._in_current(of, float(speed))
        lower, upper = (speeds[speeds <= speed][-1:], speeds[speeds >= speed][:1])
        near = [of.sel(surface_speed=one) for one in (*lower, *upper)]
        for place in ("a", "b"):
            values = [float(one.sel(place=place)) for one in near]
            assert float(found.sel(place=place)) == max(values)
    assert seas._in_current(of.isel(surface_speed=0, drop=True), 0.7).equals(
        of.isel(surface_speed=0, drop=True)
    )
