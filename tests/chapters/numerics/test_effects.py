"""What effects change and cost: told for every scene, and no more than is true."""

import json
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from numba import njit

from chapters.numerics.answers import never, ranking
from chapters.numerics.figures.effects import ordered
from chapters.numerics.measured.effects import effects, kernels
from chapters.numerics.models import Family
from chapters.numerics.scenes import bases
from riserstudy.chapters.draw import draw
from riserstudy.errors import InputError
from riserstudy.scene.load import read_scene
from riserstudy.simulation.compile_times import while_compiling
from riserstudy.study.measured import Setting
from riserstudy.study.read import read_studies, read_study

CONFIG = Path(__file__).parents[3] / "config"
SURGE = read_scene(CONFIG / "scenes/hard/surge.yaml")
BRIEF = {"analysis.duration": "20 s", "analysis.step": "0.2 s", "analysis.mesh.elements": 20}
SHORT = SURGE.with_values(BRIEF, "")
AGAINST = read_scene(CONFIG / "scenes/liu2017/ref_180.yaml").with_values(
    {"analysis.duration": "20 s", "analysis.step": "0.5 s", "analysis.mesh.elements": 20}, ""
)


def test_every_kind_of_scene_that_options_make_is_there_once():
    studies = [
        read_study(CONFIG, "mao_hangoff", name, "standard", None) for name in ("hangoff_ref", "steady")
    ]
    found = dict(bases(studies, "standard"))
    variants = ["hangoff_ref_heave", "hangoff_ref_xdrag"]  # another mass alone is the same kind
    options = [f"mao_hangoff/hangoff_ref: {name}" for name in variants]
    assert sorted(found) == ["mao_hangoff/hangoff_ref", *options, "mao_hangoff/steady"]
    assert found[options[0]].resolved().platform.heave
    assert not found["mao_hangoff/hangoff_ref"].resolved().platform.heave
    assert len(list(bases(studies, "preview"))) == 2


@pytest.mark.long
@pytest.mark.parametrize("tier", ["preview", "standard", "reference"])
def test_every_kind_of_scene_of_the_chapters_is_a_whole_scene(tier):
    """Before its axes set anything: what the step alone sets must be written in the study, too."""
    files = {path.stem: read_studies(CONFIG, path.stem) for path in (CONFIG / "studies").iterdir()}
    studies = [
        read_study(CONFIG, paper, name, tier, None) for paper, file in files.items() for name in file.studies
    ]
    for _, file in bases(studies, tier):
        file.resolved()


@pytest.mark.long
def test_scenes_of_the_study_itself_have_effects_that_no_chapter_has():
    study = read_studies(CONFIG, "numerics").measured["effects"]
    slow = {"standard": ["without bending"]}  # whose kernels no other test needs
    bent = study.replaced(left_out=slow)
    found = effects(bent, Setting(CONFIG, "standard", 1, (), Path("not noted")))
    assert found["scene"].values.tolist() == ["vibration in a current"]
    lost = found.sel(scene="vibration in a current")
    alone = lost.sel(change="without vortex-induced vibration")
    in_line = lost.sel(change="without in-line vortex-induced vibration")
    assert float(alone["moment_change"]) < float(in_line["moment_change"]) < -0.01
    assert float(lost["time_share"].sel(effect="vortex-induced vibration")) > 0.0


def test_the_dataset_and_its_figure_name_every_scene(tmp_path):
    model = read_studies(CONFIG, "numerics").measured["effects"].replaced(scenes={})
    studies = [read_study(CONFIG, "bench", name, "preview", "1 %") for name in ("s1", "s3")]
    found = effects(model, Setting(CONFIG, "preview", 1, studies, tmp_path / "no marker"))
    assert list(found["scene"].values) == ["bench/s3", "bench/s1"]
    assert np.isnan(found.attrs["cold_compile_seconds"])
    assert found.attrs["compiled_functions"] > 0
    figure = draw("numerics", "effects", {"effects": found})
    rows = [label.get_text() for label in figure.axes[0].get_yticklabels()]
    assert rows == [one.name for one in ordered(ranking(found))]
    removed = [n for n in map(str, found["change"].values) if n.startswith("without ")]
    known = found["displacement_change"].notnull().any("scene")
    # motions are shown as those of the platform
    shown = {f"without {part}" for name in rows for part in (name, name.removeprefix("platform "))}
    assert shown >= {n for n in removed if known.sel(change=n)}


def changes_of(size, count):
    """A dataset in which the absence of effect k changes the answer by ``size[k]`` in each of its scenes."""
    sizes = np.full((max(count), len(size)), np.nan)
    for k, (values, scenes) in enumerate(zip(size, count, strict=True)):
        sizes[:scenes, k] = values
    names = ("displacement_change", "moment_change", "tension_change", "time_change")
    effects = [f"e{k}" for k in range(len(size))]
    of_changes = {"changed_effect": ("change", effects), "is_added": ("change", [False] * len(effects))}
    coords = {"change": [f"without {name}" for name in effects]}
    return xr.Dataset(dict.fromkeys(names, (("scene", "change"), sizes)) | of_changes, coords)


def test_the_ranking_prefers_what_is_sure_and_counts_scenes():
    """Forty scenes of forty are surer than two of two; what changes nothing comes last."""
    ranked = ranking(changes_of([0.5, 0.5, 0.5e-2, -0.4], [2, 40, 50, 30]))
    assert [one.name for one in ranked] == ["e1", "e3", "e0", "e2"]
    assert [(one.changed, one.scenes) for one in ranked] == [(40, 40), (30, 30), (2, 2), (0, 50)]
    assert [one.name for one in never(ranked)] == ["e2"]
    assert all(0.0 <= one.low <= one.changed / one.scenes for one in ranked)


def test_rows_are_ordered_by_the_share_that_the_figure_shows_and_few_scenes_come_last():
    rows = ordered(ranking(changes_of([0.5, 0.5, 0.5e-2, -0.4], [4, 40, 50, 30])))
    assert [one.name for one in rows] == ["e1", "e3", "e2", "e0"]
    some = changes_of([0.5, 0.5], [40, 30])
    for name in ("displacement_change", "moment_change", "tension_change"):
        some[name][:2, 0] = 1e-3  # 38 of 40 scenes are still the most
    assert [one.name for one in ordered(ranking(some))] == ["e1", "e0"]
    figure = draw("numerics", "effects", {"effects": some})
    assert figure.get_suptitle() == "E1 affects 30 of 30 scenes"


def test_a_share_of_run_time_is_pale_where_the_middle_half_of_scenes_includes_zero():
    some = changes_of([0.5, 0.5], [8, 8])
    some["time_change"][:, 0] = [-0.2, 0.1] * 4
    some["time_change"][:, 1] = [-0.2, -0.1] * 4
    unsure, sure = ordered(ranking(some))
    assert unsure.middle[0] < 0.0 < unsure.middle[1]
    assert 0.0 < sure.middle[0] < sure.share < sure.middle[1]
    bars = draw("numerics", "effects", {"effects": some}).axes[1].patches
    assert bars[0].get_alpha() < bars[1].get_alpha()


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


def test_a_tier_leaves_out_named_changes_and_no_others():
    study = read_studies(CONFIG, "numerics").measured["effects"]
    one = {"surge": Family(scene="scenes/hard/surge.yaml", set=BRIEF)}
    short = study.replaced(scenes=one, budget={"standard": 2e3}, left_out={})

    def made(left_out):
        of_tiers = short.replaced(left_out=left_out)
        found = effects(of_tiers, Setting(CONFIG, "standard", 1, (), Path("not noted")))
        return set(found["change"].values[found["moment_change"].notnull().any("scene")].tolist())

    every = made({})
    first, second, *rest = sorted(every)
    assert made({"preview": [first], "standard": [second]}) == {first, *rest}
    with pytest.raises(InputError, match=r"left_out\.preview: without legs; allowed are without"):
        made({"preview": ["without legs"]})
