"""A plain `snakemake` makes everything, by the root's Snakefile and by the workflow's."""

import pytest
from planning import dry_run, jobs_in

pytestmark = pytest.mark.long


@pytest.mark.parametrize("arguments", [(), ("--snakefile", "workflow/Snakefile")])
def test_a_plain_snakemake_plans_everything(laid_out, arguments):
    planned = []
    for target in ((), ("all",)):
        status, said = dry_run(laid_out.folder, laid_out.environment, *arguments, *target)
        assert status == 0, said
        planned.append(jobs_in(said))
    assert planned[0] == planned[1]
    assert any("chang2020/fig14" in job for job in planned[0])
