"""When jobs start, and beside which others.

Snakemake looks for jobs when one has ended: a limit of jobs a second would wake it ever more often.
"""

import os
import re
from pathlib import Path

import pytest
import short_study
from planning import dry_run

pytestmark = pytest.mark.long

RULES = Path(__file__).parents[2] / "workflow/rules"
HANDLER = """

onstart:
    print("limit of jobs:", workflow.scheduler.job_rate_limiter)
"""


def test_jobs_on_this_machine_are_not_limited_by_time(tmp_path):
    short_study.lay_out(tmp_path)
    with (tmp_path / "Snakefile").open("a") as file:
        file.write(HANDLER)
    status, said = short_study.snakemake(
        tmp_path, os.environ, "results/example/tension.nc", "--max-jobs-per-timespan", "7/1s"
    )
    assert status == 0, said
    assert "limit of jobs: None" in said


@pytest.mark.parametrize("cores", [1, 2, 3, 4, 8])
def test_a_large_study_leaves_half_of_the_cores_to_another(tmp_path, cores):
    """It begins and ends on one core, while another study then works on the rest."""
    short_study.lay_out(tmp_path)
    study = tmp_path / "config/studies/example.yaml"
    text = study.read_text()
    study.write_text(text.replace("stop: 3450, step: 50", "stop: 3450, step: 5"))
    status, said = dry_run(tmp_path, os.environ, "results/example/tension.nc", "--cores", str(cores), "-p")
    assert status == 0, said
    assert "simulate example/tension" in said
    claimed = max((int(n) for n in re.findall(r" --threads (\d+)", said)), default=1)
    assert claimed == max(1, cores // 2)


def test_kernels_that_are_compiled_anew_make_no_job_run_again():
    """Their marks, which another run may write, have times in them: no rule looks at their age."""
    text = "".join(file.read_text() for file in RULES.glob("*.smk"))
    uses = re.findall(r"(\w+)\(PLAN\.kernels(?:_of_seas)?\)", text)
    assert len(uses) >= 5
    assert set(uses) == {"of_any_age"}
