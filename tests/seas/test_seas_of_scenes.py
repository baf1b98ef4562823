"""Scenes in another sea, with other phases and headings; and which of them show if a limit is met in it."""

import numpy as np
import pytest
from random_rigs import rig, written
from rigs_in_waves import in_waves

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.study.departures import check_stays
from riserstudy.study.in_sea import Sea, heading_paths, heading_values, in_sea, sea_of

CASES = [(seed, spatial) for seed in range(3) for spatial in (False, True)]
WAVE = {"significant_height": "3 m", "peak_period": "9 s", "peak_enhancement": 2.0, "components": 10}
WAVE |= {"seed": 1, "above_mean_level": "none"}
REGULAR = {"height": "2 m", "period": "8 s", "above_mean_level": "none"}
HULL = {"mass": "6e7 kg", "hull_drag": "6e5 N*s^2/m^2", "wave_drift": {"force": "1 MN"}}


def rig_in(seed, spatial, platform, wave):
    """A rig whose platform follows an irregular sea, or not, in irregular, regular or no waves."""
    tree = in_waves(seed, spatial, 31, "4 m", 10, 40.0, [0.5], [24])
    if not platform:
        del tree["platform"]["response"]
    return SceneFile("rig.yaml", written(tree) | ({"wave": wave} if wave else {}))


@pytest.mark.parametrize(
    "platform, wave", [(True, None), (True, WAVE), (True, REGULAR), (False, WAVE)], ids=str
)
@pytest.mark.parametrize("seed, spatial", CASES)
def test_all_irregular_seas_of_a_scene_become_the_other(seed, spatial, platform, wave):
    draw = np.random.default_rng(seed)
    height, period, phases = draw.uniform(1.0, 9.0), draw.uniform(6.0, 16.0), int(draw.integers(2, 99))
    file = rig_in(seed, spatial, platform, wave)
    if platform and wave is REGULAR:
        file = file.with_values({"wave.period": "9 s"}, "test")
    assert (sea_of(file).significant_height, sea_of(file).seed) == (4.0 if platform else 3.0, 1)
    scene = in_sea(file, Sea(height, period), phases).resolved()
    seas = [scene.platform.response.wave] if platform else []
    seas += [scene.wave] if wave is WAVE else []
    for sea in seas:
        assert (sea.significant_height, sea.peak_period, sea.seed) == (height, period, phases)
    if wave is REGULAR:
        assert (scene.wave.height, scene.wave.period) == (2.0, 9.0)


@pytest.mark.parametrize("seed, spatial", CASES)
def test_waves_along_the_riser_turn_and_a_platform_without_headings_does_not(seed, spatial):
    sectors = int(np.random.default_rng(seed).integers(1, 40)) if spatial else 2
    file = rig_in(seed, spatial, platform=True, wave=WAVE)
    assert heading_paths(file) == ["wave.heading"]
    for k, values in enumerate(heading_values(file, sectors)):
        scene = file.with_values(values, "test").resolved()
        assert scene.wave.heading == pytest.approx(2.0 * np.pi * k / sectors, abs=1e-9)
    assert heading_paths(rig_in(seed, spatial, platform=True, wave=None)) == []


@pytest.mark.parametrize("seed, spatial", CASES)
def test_a_scene_without_a_sea_or_without_time_is_refused(seed, spatial):
    calm = SceneFile("rig.yaml", written(rig(seed, spatial=spatial)))
    static = rig_in(seed, spatial, platform=True, wave=None)
    static = static.with_values({"analysis": {"mesh": {"elements": 24}}}, "test")
    for file, said in ((calm, "wave: .*no irregular sea"), (static, r"analysis\.duration: missing")):
        with pytest.raises(InputError, match=said):
            in_sea(file, Sea(3.0, 9.0), 1)


def thrusters(gain, sway):
    """Thrusters of a hull, by their gains (N/m); None: none in this direction."""
    if gain is None:
        return {}
    more = {} if sway is None else {"sway": {"gain": f"{sway} N/m"}}
    return {"thrusters": {"gain": f"{gain} N/m", "command": "0 m"} | more}


@pytest.mark.parametrize("along", [None, 0.0, 1e6])
@pytest.mark.parametrize("across", [None, 0.0, 1e6])
@pytest.mark.parametrize("seed", range(2))
def test_a_hull_is_held_in_each_direction_in_which_it_moves(seed, along, across):
    """It sways only in space, and only if its ``sway`` is given."""
    for spatial, sways in ((False, False), (False, True), (True, False), (True, True)):
        file = rig_in(seed, spatial, platform=True, wave=None)
        sway = {"sway": {"hull_drag": "6e5 N*s^2/m^2"}} if sways else {}
        hull = HULL | thrusters(along, across if sways else None) | sway
        file = file.with_values({"vessel": hull, "top.x": "vessel", "platform.position": None}, "test")
        if (along or 0.0) > 0.0 and (not (spatial and sways) or (across or 0.0) > 0.0):
            check_stays(file)
        else:
            with pytest.raises(InputError, match="vessel: the vessel drifts away"):
                check_stays(file)


@pytest.mark.parametrize("seed, spatial", CASES)
def test_cylinders_that_failed_before_the_run_are_no_event(seed, spatial):
    file = rig_in(seed, spatial, platform=True, wave=None)
    check_stays(file.with_values({"top.tensioners.failed": [0]}, "test"))
    failing = {"top.tensioners.failing": {"at": "5 s", "cylinders": [0]}}
    with pytest.raises(InputError, match=r"top\.tensioners\.failing: changes the tension"):
        check_stays(file.with_values(failing, "test"))


@pytest.mark.parametrize(
    "interval, side, allowed", [(3.0, "mean", True), (5.0, "mean", False), (5.0, "largest", True)]
)
@pytest.mark.parametrize("seed, spatial", CASES)
def test_outputs_that_see_few_phases_of_a_regular_motion_suffice_for_extremes_alone(
    seed, spatial, interval, side, allowed
):
    """At half a period or more between outputs, a mean depends on the phases that they see."""
    limits = [{"output": "ufj_angle", "largest": "3 deg", "mode": "drilling"}]
    limits += [{"output": "lfj_angle", side: "3 deg", "mode": "drilling"}]
    surge = {"amplitude": "1 m", "period": REGULAR["period"]}
    values = {"limits": limits, "analysis.output.interval": f"{interval} s", "platform.surge": surge}
    file = rig_in(seed, spatial, platform=True, wave=None).with_values(values, "test")
    if allowed:
        check_stays(file)
        return
    with pytest.raises(InputError, match=r"limits\[1\]: .*lfj_angle.* give an analysis.output.interval"):
        check_stays(file)


@pytest.mark.parametrize("seed, spatial", CASES)
def test_all_missing_inputs_of_a_limit_are_named(seed, spatial):
    file = rig_in(seed, spatial, platform=True, wave=None)
    first, *others = file.tree["riser"]
    half = f"{0.5 * float(first['length'].split()[0])!r} m"
    sections = [first | {"length": half, "name": name} for name in ("lower", "upper")] + others
    for section in sections[:2]:
        section.pop("contents", None)
    limit = {"output": "von_mises_stress", "largest": "9 GPa", "mode": "drilling"}
    with pytest.raises(InputError, match=r"contents of section 'lower', .*contents of section 'upper'"):
        check_stays(SceneFile("rig.yaml", file.tree | {"limits": [limit], "riser": sections}))
