"""The small study that `make test-faults` damages can be run; otherwise only a release would show it."""

import pytest
import small

pytestmark = pytest.mark.long


def test_the_small_study_makes_its_datasets_and_figure(tmp_path):
    folder = tmp_path / "study"
    small.lay_out(folder)
    status, said = small.run(folder)
    assert status == 0, said
    made = {file.stem for file in (folder / "results/bench").glob("*.nc")}
    assert made == set(small.KEPT)
    assert (folder / f"results/bench/{small.FIGURE}.png").exists()
