"""Mao's studies, small."""

from pathlib import Path

from riserstudy.grading.words_of_size_file import read_words
from riserstudy.scene.load import read_scene
from riserstudy.scene.replaced_values import set_later
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

CONFIG = Path(__file__).parents[3] / "config"
PAPER = "mao_hangoff"
WORD = read_words(CONFIG).word
FILE = read_studies(CONFIG, PAPER)
WEIGHTS = FILE.readings["riser_weight"]


def planned(name, **changes):
    model = FILE.studies[name].replaced(**changes)
    return Study(PAPER, name, model, CONFIG, "preview", None, FILE.readings)


def small(name, **settings):
    """A dataset on a coarse mesh with few outputs."""
    coarse = {
        "analysis.accuracy": None,
        "analysis.mesh": {"elements": 20},
        "analysis.step": "0.5 s",
        "analysis.output": {"interval": "10 s"},
    }
    sets = set_later(FILE.studies[name].set, coarse | settings)
    study = planned(name, set=sets, preview={})
    return dataset_of(study, results_of(study, 1, lambda text: None)[0])


def hung_off(length, mass, more=None):
    sets = {"riser[0].length": f"{length} m", "bottom.body.mass": f"{mass} t"}
    scene = read_scene(CONFIG / "scenes" / PAPER / "hang_off.yaml")
    return scene.with_values(sets | (more or {}), "test").resolved()


def small_steady():
    axes = dict(FILE.studies["steady"].axes)
    axes["riser_length"] = axes["riser_length"].replaced(preview=[1200.0])
    study = planned("steady", axes=axes, set={"analysis.mesh": {"elements": 40}})
    return dataset_of(study, results_of(study, 1, lambda text: None)[0])
