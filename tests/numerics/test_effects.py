"""What effects change and cost: told for every scene, and no more than is true."""

import json
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from numba import njit

from riserstudy.chapters.draw import draw
from riserstudy.chapters.numerics.answers import never, ranking
from riserstudy.effects.catalogue import changes
from riserstudy.numerics.ablation import Ablation, Changed, Peaks, ablate
from riserstudy.numerics.advice import COULD_GO, MISSING, NEEDED, NO_GAIN, advice, row
from riserstudy.numerics.changes import fitting
from riserstudy.numerics.effect_shares import priced
from riserstudy.numerics.effects import effects, kernels
from riserstudy.numerics.scenes import Setting, bases
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.simulation.compile_times import while_compiling
from riserstudy.study.read import read_studies, read_study

CONFIG = Path(__file__).parents[2] / "config"
SURGE = read_scene(CONFIG / "scenes/hard/surge.yaml")
SHORT = SURGE.with_values(
    {"analysis.duration": "20 s", "analysis.step": "0.2 s", "analysis.mesh.elements": 20}, ""
)
AGAINST = read_scene(CONFIG / "scenes/liu2017/ref_180.yaml").with_values(
    {"analysis.duration": "20 s", "analysis.step": "0.5 s", "analysis.mesh.elements": 20}, ""
)


def test_changes_have_names_of_their_own():
    labels = [change.label for change in changes()]
    assert len(set(labels)) == len(labels)


@pytest.mark.parametrize("path", sorted((CONFIG / "scenes").glob("*/*.yaml")), ids=lambda p: p.stem)
def test_some_effect_can_be_taken_out_of_every_scene(path):
    assert any(
        change.kind == "removed" for change, _ in fitting(read_scene(path))
    ) or path.stem in ("s4a", "s4c", "s4d", "column")


def test_every_kind_of_scene_that_options_make_is_there_once():
    studies = [
        read_study(CONFIG, "mao_hangoff", name, "standard", None)
        for name in ("hangoff_ref", "steady")
    ]
    found = dict(bases(studies, "standard"))
    variants = ["hangoff_ref_heave", "hangoff_ref_xdrag"]  # another mass alone is the same kind
    options = [f"mao_hangoff/hangoff_ref: {name}" for name in variants]
    assert sorted(found) == ["mao_hangoff/hangoff_ref", *options, "mao_hangoff/steady"]
    assert found[options[0]].resolved().platform.heave
    assert not found["mao_hangoff/hangoff_ref"].resolved().platform.heave
    assert len(list(bases(studies, "preview"))) == 2


@pytest.mark.parametrize("tier", ["preview", "standard", "reference"])
def test_every_kind_of_scene_of_the_chapters_is_a_whole_scene(tier):
    """Before its axes set anything: what the step alone sets must be written in the study, too."""
    files = {path.stem: read_studies(CONFIG, path.stem) for path in (CONFIG / "studies").iterdir()}
    studies = [
        read_study(CONFIG, paper, name, tier, None)
        for paper, file in files.items()
        for name in file.studies
    ]
    for _, file in bases(studies, tier):
        file.resolved()


def test_only_what_is_there_is_taken_out_and_only_what_is_missing_is_put_in():
    labels = {change.label for change, _ in fitting(SURGE)}
    assert {"without drag", "without surge", "with structural damping"} <= labels
    assert not {"without wave", "with drag", "with surge", "with wave"} & labels


def test_without_what_moves_it_the_riser_rests():
    base = ablate(SHORT, 1, 1e6)
    found = {one.change.label: one for one in base.changed}
    assert found["without surge"].peaks.displacement < 1e-9
    assert found["without drag"].peaks.moment > 1.05 * base.peaks.moment  # which drag damps


@pytest.mark.parametrize("file", [SHORT, AGAINST], ids=["along x", "current against x"])
def test_freedom_across_that_nothing_calls_for_changes_nothing(file):
    base = ablate(file, 1, 1e6)
    found = {one.change.label: one for one in base.changed}
    change = base.peaks.change_to(found["with motion out of the plane"].peaks)
    assert np.abs(change).max() < 1e-8


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


def test_the_dataset_and_its_figure_name_every_scene(tmp_path):
    model = read_studies(CONFIG, "numerics").measured.effects
    studies = [read_study(CONFIG, "bench", name, "preview", "1 %") for name in ("s1", "s3")]
    found = effects(model, Setting(CONFIG, "preview", 1, studies, tmp_path / "no marker"))
    assert list(found["scene"].values) == ["bench/s3", "bench/s1"]
    assert np.isnan(found.attrs["cold_compile_seconds"])
    assert found.attrs["compiled_functions"] > 0
    figure = draw("numerics", "effects", {"effects": found})
    rows = [label.get_text() for label in figure.axes[0].get_yticklabels()]
    assert rows == [one.name for one in ranking(found)]
    removed = [n for n in map(str, found["change"].values) if n.startswith("without ")]
    known = found["displacement_change"].notnull().any("scene")
    assert {f"without {name}" for name in rows} >= {n for n in removed if known.sel(change=n)}


def changes_of(size, count):
    """A dataset in which the absence of effect k changes the answer by ``size[k]`` in each of its scenes."""
    sizes = np.full((max(count), len(size)), np.nan)
    for k, (values, scenes) in enumerate(zip(size, count, strict=True)):
        sizes[:scenes, k] = values
    names = ("displacement_change", "moment_change", "tension_change", "time_change")
    coords = {"change": [f"without e{k}" for k in range(len(size))]}
    return xr.Dataset(dict.fromkeys(names, (("scene", "change"), sizes)), coords)


def test_the_ranking_prefers_what_is_sure_and_counts_scenes():
    """Forty scenes of forty are surer than two of two; what changes nothing comes last."""
    ranked = ranking(changes_of([0.5, 0.5, 0.5e-2, -0.4], [2, 40, 50, 30]))
    assert [one.name for one in ranked] == ["e1", "e3", "e0", "e2"]
    assert [(one.changed, one.scenes) for one in ranked] == [(40, 40), (30, 30), (2, 2), (0, 50)]
    assert [one.name for one in never(ranked)] == ["e2"]
    assert all(0.0 <= one.low <= one.changed / one.scenes for one in ranked)


def test_what_compiling_takes_is_told_kernel_by_kernel():
    @njit
    def inner(x):
        return x + 1

    @njit
    def outer(x):
        return inner(x) * 2

    def work():
        outer(1)
        outer(1.0)

    started = time.perf_counter()
    rows = while_compiling(work)
    spent = time.perf_counter() - started
    names = [row.kernel.rpartition(".")[2] for row in rows]
    assert sorted(names) == ["inner", "inner", "outer", "outer"]
    assert all(row.seconds > 0.0 for row in rows)
    assert sum(row.seconds for row in rows) <= spent
    assert while_compiling(work) == []


def test_the_dataset_tells_signatures_and_times_of_kernels(tmp_path):
    marker = tmp_path / "compiled"
    rows = [["solve.march", 2.0], ["solve.march", 3.0], ["solve.move", 0.5]]
    marker.write_text(json.dumps({"cold_seconds": 6.0, "kernels": rows}))
    found = kernels(marker)
    assert found["compile_seconds"][1] == [5.0, 0.5]
    assert found["signatures"][1] == [2, 1]


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
