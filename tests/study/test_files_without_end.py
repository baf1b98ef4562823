"""Pipes and devices in the place of tables are refused, and never waited for."""

import json

import pytest
from test_edits_of_a_study import SCENE
from without_end import KINDS, soon

from riserstudy.errors import InputError
from riserstudy.inputs.validate import check
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel

WATER = {"density": "1025 kg/m^3", "surface": "490 m"}
PLACES = {"current": {"profile": {"file": "table.csv"}}, "platform": {"heave": {"file": "table.csv"}}}
PULL = {"path": "top.tension", "unit": "MN", "values": [1, 2]}
MAKE = KINDS | {
    "nothing": lambda path: None,
    "larger than memory": lambda path: path.open("wb").truncate(2**42),
}


@pytest.mark.parametrize("kind", MAKE)
@pytest.mark.parametrize("place", PLACES)
def test_only_a_file_of_bounded_size_is_a_table_of_a_study(tmp_path, place, kind):
    (tmp_path / "hung.yaml").write_text(json.dumps(SCENE))
    MAKE[kind](tmp_path / "table.csv")
    entry = {"scene": "hung.yaml", "caption": "pulled", "axes": {"pull": PULL}}
    entry["set"] = {place: PLACES[place], "water": WATER}
    study = Study("own", "pull", check(StudyModel, entry, "own"), tmp_path, "standard", None, {})
    with pytest.raises(InputError, match=r"table\.csv"):
        soon(lambda: (study.plan_digest, study.plan))
