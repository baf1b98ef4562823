"""Snakemake looks for jobs when one has ended: a limit of jobs a second would wake it ever more often."""

import os

import short_study

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
