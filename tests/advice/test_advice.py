"""What effects of a scene change and cost, and the advice that follows: no more than is true."""

from pathlib import Path

import numpy as np
import pytest
from fatigued_rigs import WELD, fatigued
from random_rigs import moving, written

from riserstudy.advice.ablation import Ablation, Changed, Peaks, ablate, fixed, peaks
from riserstudy.advice.changes import fitting
from riserstudy.advice.effect_shares import priced
from riserstudy.advice.recommendations import COULD_GO, MISSING, NEEDED, NO_GAIN, advice, row
from riserstudy.effects.catalogue import changes
from riserstudy.records.numerals import percent
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import single

CONFIG = Path(__file__).parents[2] / "config"
SURGE = read_scene(CONFIG / "scenes/hard/surge.yaml")
SHORT = SURGE.with_values(
    {"analysis.duration": "20 s", "analysis.step": "0.2 s", "analysis.mesh.elements": 20}, ""
)
AGAINST = read_scene(CONFIG / "scenes/liu2017/ref_180.yaml").with_values(
    {"analysis.duration": "20 s", "analysis.step": "0.5 s", "analysis.mesh.elements": 20}, ""
)


def test_changes_of_an_ablation_have_names_of_their_own():
    labels = [change.label for change in changes()]
    assert len(set(labels)) == len(labels)


@pytest.mark.parametrize("path", sorted((CONFIG / "scenes").glob("*/*.yaml")), ids=lambda p: p.stem)
def test_some_effect_can_be_taken_out_of_every_scene(path):
    assert any(change.kind == "removed" for change, _ in fitting(read_scene(path))) or path.stem in (
        "s4a",
        "s4c",
        "s4d",
        "column",
    )


def test_only_what_is_there_is_taken_out_and_only_what_is_missing_is_put_in():
    labels = {change.label for change, _ in fitting(SURGE)}
    assert {"without drag", "without surge", "with structural damping"} <= labels
    assert not {"without wave", "with drag", "with surge", "with wave"} & labels


@pytest.mark.parametrize("seed", range(3))
def test_each_motion_of_a_platform_can_be_taken_out(seed):
    tree = moving(seed, spatial=True)
    for name in ("roll", "pitch", "yaw"):
        tree["platform"][name] = {"amplitude": 0.02, "period": 9.0, "ramp": 9.0}
    motions = {"surge", "sway", "heave", "roll", "pitch", "yaw"}
    file = SceneFile("rig.yaml", written(tree))
    left = {change.label: set(other.tree["platform"]) & motions for change, other in fitting(file)}
    for name in motions:
        assert left[f"without {name}"] == motions - {name}


def ablated(file, *labels):
    """Results of a scene and of some changes of it alone."""
    others = {change.label for change in changes()} - {*labels}
    base = ablate(file, 1, 1e6, left_out=others)
    return base, {one.change.label: one for one in base.changed}


def test_without_what_moves_it_the_riser_rests():
    base, found = ablated(SHORT, "without surge", "without drag")
    assert found["without surge"].peaks.displacement < 1e-9
    assert found["without drag"].peaks.moment > 1.05 * base.peaks.moment  # which drag damps


@pytest.mark.parametrize("file", [SHORT, AGAINST], ids=["along x", "current against x"])
def test_freedom_across_that_nothing_calls_for_changes_nothing(file):
    base, found = ablated(file, "with motion out of the plane")
    change = base.peaks.change_to(found["with motion out of the plane"].peaks)
    assert np.abs(change).max() < 1e-8


@pytest.mark.parametrize("seed", range(4))
def test_fatigue_of_a_scene_changes_nothing_of_what_is_compared(seed):
    """Its cycles count from the end of all ramps on; a scene that is cut short may end before."""
    welded = SceneFile("rig.yaml", written(fatigued(moving(seed), WELD)))
    plain = welded.with_values({"fatigue": None}, "")
    found = [ablate(file, 1, 2e3) for file in (plain, welded)]
    without, of_welded = ({one.change.label: one.peaks for one in of.changed} for of in found)
    assert found[0].peaks == found[1].peaks
    assert without == of_welded
    assert sum(peaks is not None for peaks in without.values()) > 5


@pytest.mark.parametrize("scene, budget", [("design/recoil.yaml", 2e3), ("bench/vortices.yaml", 2e3)])
def test_what_comes_after_a_disconnect_or_ramps_is_not_cut_off(scene, budget):
    file = read_scene(CONFIG / "scenes" / scene)
    assert fixed(file, budget)[0].resolved().analysis.duration == file.resolved().analysis.duration


@pytest.mark.parametrize("seed", range(4))
def test_an_event_late_in_a_run_is_not_cut_off(seed):
    """Advice on a part of the run before it would not be on what the scene shows."""
    tree = moving(seed, spatial=bool(seed % 2))
    late = 0.95 * tree["analysis"]["duration"]
    if "tensioners" in tree["top"]:
        tree["top"]["tensioners"]["failing"] = {"at": f"{late} s", "cylinders": [0]}
    else:
        tree["top"]["telescopic_joint"].pop("tension")
        tree["top"] |= {"tension": 2e6, "z": "free"}
        tree["top"]["tension_loss"] = {"share": 0.2, "at": f"{late} s", "over": "1 s"}
        tree["top"].pop("telescopic_joint")
        tree["top"].pop("elevation")
        tree["platform"].pop("heave")
        tree["platform"].pop("pitch", None)
    cut = fixed(SceneFile("rig.yaml", written(tree)), 1e3)[0].resolved()
    assert cut.analysis.duration == pytest.approx(tree["analysis"]["duration"])


@pytest.mark.long
@pytest.mark.parametrize("phase", ["0 deg", "90 deg", "200 deg"])
@pytest.mark.parametrize("at", ["5 s", "9 s"])
def test_peaks_after_a_disconnect_are_not_those_of_a_step(at, phase, monkeypatch):
    monkeypatch.setattr("riserstudy.advice.ablation.fitting", lambda _: [])
    changed = {"disconnect.at": at, "disconnect.phase": phase}
    recoil = read_scene(CONFIG / "scenes/design/recoil.yaml").with_values(changed, "")
    base = ablate(recoil, 1, 5e5)
    fine = peaks(single(base.file.resolved(), base.mesh, 0.02))
    assert base.peaks.change_to(fine)[2] == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize("unbalanced", [False, True])
def test_advice_names_what_it_does_not_compare_and_what_its_step_is_too_long_for(unbalanced, monkeypatch):
    changed = Changed(next(iter(changes())), peaks=Peaks(1.0, 1.0, 1.0), unbalanced=unbalanced)
    limits = [
        {"output": output, "largest": largest, "mode": "drilling"}
        for output, largest in (("lfj_angle", "2 deg"), ("bending_moment", "1 MN*m"))
    ]
    file = SceneFile("rig.yaml", written(moving(0) | {"limits": limits}))
    base = Ablation(file, fixed(file, 1e3)[1], None, [changed], peaks=Peaks(1.0, 1.0, 1.0))
    monkeypatch.setattr("riserstudy.advice.recommendations.ablate", lambda *_, **__: base)
    told = advice(file).sentences
    (line,) = [text for text in told if text.startswith("Not compared: ")]
    assert line.startswith("Not compared: lfj_angle. ")
    doubt = [text for text in told if text.startswith("Energy is not balanced")]
    assert bool(doubt) == unbalanced
    assert all(changed.change.label in text for text in doubt)


@pytest.mark.long
def test_advice_on_a_scene_with_fatigue_tells_that_damage_is_not_compared():
    file = SceneFile("rig.yaml", written(fatigued(moving(3), WELD)))
    for scene, told in ((file, 1), (file.with_values({"fatigue": None}, ""), 0)):
        assert sum("damage" in line for line in advice(scene).sentences) == told


def test_shares_of_time_are_shares_and_absent_effects_have_none():
    prices = priced(SHORT)
    assert {"drag", "added mass", "bending"} <= set(prices.share)
    assert "wave" not in prices.share
    assert all(share >= 0.0 for share in prices.share.values())
    assert sum(prices.share.values()) < 1.1
    assert "(platform.surge)" in prices.sentences[1]


def test_advice_keeps_what_decides_and_lets_go_what_does_not():
    light = SHORT.with_values({"riser[0].submerged_weight": "0.1 N/m"}, "")
    verdicts = {row.label: row.verdict for row in advice(light).rows}
    assert verdicts["without weight"] in (COULD_GO, NO_GAIN)  # as the time of so short a run has it
    assert verdicts["without drag"] == NEEDED
    assert verdicts["with current"] == MISSING


@pytest.mark.parametrize(
    "seconds, verdict", [(0.8, COULD_GO), (0.99, NO_GAIN), (1.0, NO_GAIN), (1.2, NO_GAIN)]
)
def test_what_saves_no_time_is_not_advised_to_go(seconds, verdict):
    alike = Peaks(1.0, 1.0, 1.0)
    without = next(change for change in changes() if change.kind == "removed")
    base = Ablation(SHORT, None, None, peaks=alike, times=[0.98, 1.0, 1.02])
    changed = Changed(without, peaks=alike, times=[seconds])
    assert row(base, changed, (0.01, 0.01, 0.01)).verdict == verdict


def test_a_scene_that_cannot_run_has_a_ledger_without_times():
    falling = SHORT.with_values({"top.tension": "1 kN"}, "")
    prices = priced(falling)
    assert prices.share == {}
    assert prices.sentences[0].startswith("no times: ")


@pytest.mark.parametrize("first, last", [(-5.7, 9.0), (-12.0, 4.0), (-20.0, 20.0)])
def test_stops_are_put_in_where_a_table_of_tensioners_ends(first, last):
    table = [{"reach": f"{r} m", "force": f"{800 + 10 * r} kN"} for r in (first, 0.0, last)]
    file = SceneFile(
        "rig.yaml",
        {
            "title": "rig", "gravity": "9.81 m/s^2",
            "riser": [{"name": "r", "length": "500 m", "axial_stiffness": "5e9 N", "mass": "500 kg/m",
                       "submerged_weight": "2 kN/m"}],
            "bottom": {"hold": "wellhead", "elevation": "-500 m"},
            "top": {
                "z": "free",
                "tensioners": {"count": 4, "mid_stroke": "riser unstretched", "table": table},
            },
            "platform": {"heave": {"amplitude": "1 m", "period": "10 s", "ramp": "10 s"}},
            "analysis": {"duration": "20 s", "output": {"interval": "1 s"}},
        },
    )  # fmt: skip
    (changed,) = [scene for change, scene in fitting(file) if change.label == "with end stops"]
    stroke = changed.resolved().top.tensioners.stroke
    assert (stroke.shortest, stroke.longest) == (max(first, -7.5), min(last, 7.5))


@pytest.mark.parametrize("seed", range(3))
def test_advice_tells_how_certain_its_percentages_are(seed, monkeypatch):
    """By the estimated errors of the scene on the same mesh, which decrease on a finer one."""
    monkeypatch.setattr("riserstudy.advice.ablation.fitting", lambda _: [])
    tree, told = moving(seed, spatial=bool(seed % 2)), []
    tree["analysis"] |= {"duration": 20.0, "output": {"interval": 0.25}}
    for elements, step in ((24, 0.2), (96, 0.05)):
        tree["analysis"] |= {"mesh": {"elements": elements}, "step": step}
        file = SceneFile("rig.yaml", written(tree))
        (line,) = [text for text in advice(file).sentences if text.startswith("Estimated errors")]
        errors = run(file.resolved()).facts["error_estimate"]
        for name in ("displacement", "moment", "tension"):
            assert f"{name} {percent(errors[name])}" in line
        told.append(errors["moment"])
    assert told[1] < told[0]
