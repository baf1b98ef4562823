"""Scenes as decks: what comes back is the same riser at rest, and what did not go is named."""

import sys

import numpy as np
import pytest
from drawn_decks import drawn, file_of, there_and_back
from random_rigs import LAWS, at_mid_stroke, rig, written
from ruamel.yaml import YAML
from some_seeds import seeds

from riserstudy import load_scene, simulate
from riserstudy.cli import main
from riserstudy.errors import InputError
from riserstudy.export.orcaflex import write_deck
from riserstudy.importers.orcaflex import read_deck
from riserstudy.scene.load import SceneFile

MESH = {"analysis": {"mesh": {"elements": 40}}}


@pytest.mark.parametrize("seed", range(15))
def test_a_deck_read_back_is_the_same_riser_at_rest(tmp_path, seed):
    file = file_of(drawn(seed))
    back, _ = there_and_back(file, tmp_path)
    one, other = (simulate(f.with_values(MESH, "test"), progress=False) for f in (file, back))
    assert one["s"].to_numpy() == pytest.approx(other["s"].to_numpy())
    for name in ("effective_tension", "bending_moment", "x", "z"):
        a, b = one[name].to_numpy(), other[name].to_numpy()
        assert np.abs(a - b).max() < 2e-4 * np.abs(a).max(), name


@pytest.mark.parametrize("seed", seeds(20, few=8))
def test_the_table_of_a_cylinder_has_each_length_once(tmp_path, seed):
    """Mid-stroke or a row of a table may be a point of its even steps but for rounding."""
    tree = rig(seed, spatial=False, conductor=False)
    of = tree["top"]["tensioners"]
    pull = at_mid_stroke(of)
    for name in LAWS:
        of.pop(name, None)
    half = float(np.random.default_rng(seed).integers(20, 90)) / 10.0
    if seed % 2:
        of["gas"] = {"area": 0.08, "pressure": pull / 0.08, "volume": 6.0, "exponent": 1.1}
        of["stroke"] = {"shortest": -half, "longest": half, "stop_stiffness": 5e6}
    else:
        reaches = np.round(np.linspace(-half, half, 6), 2).tolist()
        of["table"] = [{"reach": x, "force": pull * (1.0 + 0.02 * x)} for x in reaches]
    file = SceneFile(
        "rig.yaml", written(tree, unit_of={"shortest": "m", "longest": "m", "stop_stiffness": "N/m"})
    )
    deck = tmp_path / "deck.yml"
    deck.write_text(write_deck(file).text)
    links = YAML(typ="safe").load(deck)["Links"]
    assert links
    for link in links:
        rows = np.array(link["SpringLength, SpringTension"])
        assert np.diff(rows[:, 0]).min() > 1e-3
    read_deck(deck)


@pytest.mark.parametrize("seed", range(5))
def test_masses_and_drag_come_back(tmp_path, seed):
    file = file_of(drawn(seed))
    scene, back = file.resolved(), there_and_back(file, tmp_path)[0].resolved()
    light = (9.9, 1.01)  # N and kg, of the ring that a deck needs where a scene has none
    for one, same, more in zip(scene.hanging, back.hanging, light, strict=True):
        assert one == pytest.approx(same, abs=more)
    for one, same in zip(scene.riser, back.riser, strict=True):
        assert one.elasticity == pytest.approx(same.elasticity)
        for name, power in (("drag", 1), ("tangential_drag", 1), ("added_mass", 2)):
            a, b = (getattr(s, name) for s in (one, same))
            assert (a is None) == (b is None)
            if a:
                assert a.coefficient * a.diameter**power == pytest.approx(b.coefficient * b.diameter**power)


@pytest.mark.parametrize("duration, ramp, stages", [(100, "20 s", [20, 80]), (15, "15 s", [15])])
def test_the_first_stage_is_the_ramp_of_the_wave_and_both_last_as_long_as_the_run(
    tmp_path, duration, ramp, stages
):
    wave = {"height": "3 m", "period": "10 s", "above_mean_level": "none", "ramp": ramp}
    time = {"duration": f"{duration} s", "output": {"interval": "0.5 s"}}
    deck = tmp_path / "deck.yml"
    deck.write_text(write_deck(file_of(drawn(1) | {"wave": wave, "analysis": time})).text)
    assert YAML(typ="safe").load(deck)["General"]["StageDuration"] == stages


def test_what_a_deck_cannot_say_is_named(tmp_path):
    scene = drawn(0)
    scene["limits"] = [{"output": "lfj_angle", "largest": "4 deg", "mode": "drilling"}]
    scene["platform"]["heave"] = {"amplitude": "1 m", "period": "10 s", "ramp": "20 s"}
    scene["analysis"] = {"duration": "100 s", "output": {"interval": "0.5 s"}, "accuracy": "1 %"}
    scene["riser"][0]["lateral_load"] = "3 N/m"
    left = there_and_back(file_of(scene), tmp_path)[1]
    paths = {line.partition(":")[0] for line in left}
    assert {"limits.output", "platform.heave", "analysis.accuracy", "riser.lateral_load"} <= paths


@pytest.mark.parametrize("path", ["limits", "platform.sway", "wave.phase", "top.tension_loss.at"])
def test_a_line_that_nobody_writes_cannot_go_missing(tmp_path, path):
    """Whatever is put into a scene beyond what a deck says is in the list."""
    more = {
        "limits": [{"output": "effective_tension", "smallest": "0 N", "mode": "drilling"}],
        "platform.sway": {"amplitude": "1 m", "period": "10 s", "ramp": "20 s"},
        "wave.phase": "30 deg",
        "top.tension_loss.at": "50 s",
    }[path]
    extra = {path: more, "analysis.duration": "100 s", "analysis.output": {"interval": "0.5 s"}}
    if path.startswith("wave"):
        extra |= {
            "wave.height": "3 m",
            "wave.period": "10 s",
            "wave.above_mean_level": "none",
            "wave.ramp": "20 s",
        }
    if path.startswith("top"):
        extra |= {"top.tension_loss.share": 0.2, "top.tension_loss.over": "5 s"}
    left = write_deck(file_of(drawn(1)).with_values(extra, "test")).left_out
    assert any(line.startswith(path.rpartition(".")[0] or path) for line in left)


@pytest.mark.parametrize(
    "change, said",
    [
        (
            {"bottom": {"hold": "free"}, "platform": None}
            | {"top": {"x": "held", "z": "held", "elevation": "0 m"}},
            "bottom.hold",
        ),
        ({"water": {"density": "1025 kg/m^3", "seabed": "-912 m"}, "current": None}, "water.surface"),
        ({"top": {"x": "free", "z": "free", "tension": "2 MN", "rotation": "free"}}, "top.x"),
        (
            {"top": {"x": "platform", "z": "platform", "held_at_tension": "2 MN", "rotation": "free"}},
            "held_at_tension",
        ),
    ],
)
def test_what_would_be_another_riser_is_refused(change, said):
    file = file_of(drawn(0)).with_values(change, "test")
    with pytest.raises(InputError, match="drawn") as refused:
        write_deck(file)
    assert said in str(refused.value)


def test_the_command_writes_the_deck_and_prints_what_is_not_in_it(tmp_path, capsys):
    scene, deck = tmp_path / "scene.yaml", tmp_path / "deck.yml"
    with scene.open("w") as file:
        YAML().dump(drawn(3), file)
    sys.argv = ["riserstudy", "export", str(scene), "-o", str(deck)]
    main()
    said = capsys.readouterr().out
    assert "left out: top.telescopic_joint" in said
    assert f"{deck} is written" in said
    assert read_deck(deck).tree["top"]["telescopic_joint"]["tension"].endswith("kN")
    assert load_scene(scene)


@pytest.mark.parametrize("seed", range(8))
def test_a_crest_that_comes_at_another_time_is_named_with_its_phase(tmp_path, seed):
    """In OrcaFlex a crest is at the origin when the build-up ends, in a scene when it begins."""
    draw = np.random.default_rng(seed)
    period = float(draw.integers(6, 14))
    whole, share = int(draw.integers(1, 4)), 0.25 * int(draw.integers(0, 4)) if seed else 0.25
    ramp = (whole + share) * period
    wave = {"height": "3 m", "period": f"{period} s", "above_mean_level": "none", "ramp": f"{ramp} s"}
    time = {"duration": "100 s", "output": {"interval": "0.5 s"}}
    left = write_deck(file_of(drawn(seed) | {"wave": wave, "analysis": time})).left_out
    said = [line for line in left if line.startswith("wave.period")]
    assert bool(said) == bool(share)
    assert all(f"{360.0 * share:.0f}°" in line for line in said)
