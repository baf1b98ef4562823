# What there is to do: read once from config/, checked before any job. `--config tier=preview` and its
# like win over config/config.yaml.

import sys
from pathlib import Path

from riserstudy.blas import use_one_thread
from riserstudy.errors import InputError
from riserstudy.files.chapters import chapter_files
from riserstudy.jobs import SHARED
from riserstudy.jobs.begin import begin, describe_results
from riserstudy.jobs.start_server import (
    refuse_quoted_python,
    start_server,
    use_this_python,
)
from riserstudy.jobs.workplan import ALL_CORES, KERNELS, Workplan

# A job on a cluster starts Snakemake again; all points were checked before it was submitted.
checked = None if workflow.is_main_process else []
try:
    PLAN = Workplan.read(Path("config"), config, only=checked)
except InputError as error:
    print(f"riserstudy: {error}", file=sys.stderr)
    sys.exit(
        error.exit_code
    )  # which Snakemake lets pass, and an exception of ours it would not


def of(question):
    """What the plan says of the paper and the dataset or figure that a rule's wildcards name."""

    def requested(wildcards):
        begin_once()
        return question(*wildcards)

    return requested


def code(question):
    """Files of a chapter that a rule runs. What counts in them is in its digest, so their age does not."""
    requested = of(question)
    return lambda wildcards: [
        ancient(file) for file in chapter_files(wildcards.paper, requested(wildcards))
    ]


def of_any_age(question):
    """Files whose age does not count: records, whose content is in a digest, and marks of compiled kernels,
    which another run may write again."""
    requested = of(question)
    return lambda wildcards: [ancient(file) for file in requested(wildcards)]


def half(question):
    """Threads that a job claims: on this machine half of the cores that it uses. While one job plans its
    points or writes its dataset, on one core, another then uses the rest."""
    requested = of(question)
    return lambda wildcards: (
        max(1, min(requested(wildcards), workflow.cores or ALL_CORES) // SHARED)
        if workflow.local_exec
        else requested(wildcards)
    )


begun = []


def begin_once():
    """When jobs are first planned: what is damaged will be made again, whatever its time says."""
    if begun or not workflow.is_main_process:
        return
    begun.append(True)
    at_work = workflow.executor_plugin and not (workflow.dryrun or workflow.touch)
    damaged, notes = begin(PLAN.papers, PLAN.outputs(), at_work, PLAN.tier)
    workflow.dag.forcefiles.update(damaged)
    if at_work and workflow.local_exec:
        # A limit of jobs per second makes Snakemake look again after a second, forever, and once more for
        # every job that has ended: hundreds of times a second in the end, a sixth of a core. Its command
        # line knows no way to have none.
        workflow.scheduling_settings.max_jobs_per_timespan = None
    PLAN.write_point_counts(Path(".cache/points.json"))
    for note in notes:
        print(f"riserstudy: note: {note}", file=sys.stderr)
    for warning in PLAN.warnings:
        print(f"riserstudy: warning: {warning}", file=sys.stderr)


# Jobs use the Python that runs Snakemake, whether or not its environment was activated.
use_this_python()
use_one_thread()


onstart:
    if workflow.local_exec:
        start_server(workflow.cores)
    elif workflow.is_main_process:
        try:
            refuse_quoted_python(sys.executable)
        except InputError as error:
            print(f"riserstudy: {error}", file=sys.stderr)
            sys.exit(error.exit_code)


onsuccess:
    describe_results()


DATASETS = PLAN.dataset_files()
FIGURES = PLAN.figure_files()
PAPERS = [f"--paper={paper}" for paper in PLAN.papers]  # as options of a job
