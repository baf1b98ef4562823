"""Coarser settings that a study has in the preview tier: they change that tier alone, and no physics."""

import random

import pytest
from pydantic import ValidationError

from riserstudy.folders import PACKAGE
from riserstudy.scene.origin import plain_values
from riserstudy.scene.paths import within
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study
from riserstudy.study.study_model import SETTINGS, StudyModel

CONFIG = PACKAGE.parents[1] / "config"
COARSE = {"analysis.mesh.elements": 60, "analysis.step": "0.5 s"}


def made(tier, **more):
    """A study of a scene of a paper, with values set on top."""
    about = {"scene": "scenes/liu2020/system.yaml", "caption": "any", "axes": {}} | more
    return Study("own", "any", StudyModel.model_validate(about), CONFIG, tier, "1 %")


def fine():
    """A mesh and a step for a riser whose platform heaves."""
    heave = {"amplitude": "1 m", "period": "10 s"}
    run = {"duration": "10 s", "output": {"interval": "1 s"}}
    settings = {"mesh": {"elements": 120}, "step": "0.25 s"}
    return {"platform.heave": heave, "analysis": run | settings}


@pytest.mark.parametrize("tier", ["standard", "reference"])
def test_other_tiers_are_the_same_with_and_without(tier):
    with_it, without = made(tier, set=fine(), preview=COARSE), made(tier, set=fine())
    assert [p.key for p in with_it.plan] == [p.key for p in without.plan]
    assert with_it.digest == without.digest


def test_a_preview_is_what_a_study_of_these_settings_is():
    previewed = made("preview", set=fine(), preview=COARSE)
    written = made("preview", set=fine() | COARSE)
    assert [p.key for p in previewed.plan] == [p.key for p in written.plan]
    assert [p.key for p in previewed.plan] != [p.key for p in made("preview", set=fine()).plan]


def test_a_preview_may_give_up_prescribed_settings_for_the_accuracy_of_the_tier():
    given_up = made("preview", set=fine(), preview={"analysis.mesh": None, "analysis.step": None})
    assert given_up.base.tree["analysis"]["accuracy"] == "1 %"


@pytest.mark.parametrize("seed", range(40))
def test_a_preview_of_another_riser_is_refused(seed):
    """Any plain value of the scene, but of mesh, step, method and accuracy."""
    base = made("standard").base
    paths = sorted(p for p, _ in plain_values(base.tree, base.origins) if p != "title")
    path = random.Random(seed).choice(
        [p for p in paths if not any(within(p, setting) for setting in SETTINGS)]
    )
    with pytest.raises(ValidationError, match="not a setting of the analysis"):
        made("preview", preview={path: 1.0})


@pytest.mark.parametrize(
    "axis",
    [
        {"path": "analysis.step", "unit": "s", "values": [0.1, 0.2]},
        {"fine": {"analysis.mesh.elements": 200}, "finer": {"analysis.mesh.elements": 400}},
        {"fine": {"analysis.mesh": {"elements": 200}}},
    ],
)
def test_what_an_axis_would_replace_is_refused(axis):
    with pytest.raises(ValidationError, match="which axis 'settings' also sets"):
        made("preview", preview=COARSE, axes={"settings": axis})


def test_no_preview_of_the_studies_here_asks_for_more_than_other_tiers():
    """A step or a mesh that is finer in the preview would be a slip."""
    compared = 0
    for path in sorted((CONFIG / "studies").glob("*.yaml")):
        for name, model in read_studies(CONFIG, path.stem).studies.items():
            if not model.preview:
                continue
            coarse, usual = (
                Study(path.stem, name, model, CONFIG, tier).base.resolved().analysis
                for tier in ("preview", "standard")
            )
            if coarse.step and usual.step:
                assert coarse.step >= usual.step, f"{path.stem}/{name}"
            if coarse.mesh and usual.mesh:
                assert coarse.mesh.elements <= usual.mesh.elements, f"{path.stem}/{name}"
            compared += 1
    assert compared > 20
