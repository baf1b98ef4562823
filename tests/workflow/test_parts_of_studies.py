"""Parts of a study that several jobs simulate: people read their numbers, so these are counted from 1."""

import random
from pathlib import Path

import pytest

from riserstudy.jobs.workplan import Workplan

CONFIG = Path(__file__).parents[2] / "config"


def numbers(files):
    """Number of each part and of all parts, from the names of the markers of the jobs."""
    return [tuple(map(int, Path(file).name.split("-of-"))) for file in files]


@pytest.mark.parametrize("seed", range(3))
def test_parts_are_counted_from_1_and_have_all_points_of_their_study(seed):
    per_job = random.Random(seed).randint(2, 6)
    settings = {"tier": "preview", "papers": ["chang2020"], "points_per_job": per_job}
    plan = Workplan.read(CONFIG, settings)
    studies = [name for name in plan.files["chang2020"].studies if plan.shards("chang2020", name) > 1]
    assert studies
    for name in studies:
        parts = numbers(plan.shard_files("chang2020", name))
        count = len(parts)
        assert parts == [(k + 1, count) for k in range(count)]
        found = [plan.shard("chang2020", name, str(k), str(n)) for k, n in parts]
        assert sorted(p.index for points in found for p in points) == [
            p.index for p in plan.study("chang2020", name).plan
        ]
