# What there is to do: read once from config/, checked before any job.

from pathlib import Path

from snakemake.exceptions import WorkflowError

from riserstudy.errors import InputError
from riserstudy.workplan import Workplan

try:
    PLAN = Workplan(Path("config"), config)
except InputError as error:
    raise WorkflowError(str(error))

FIGURES = PLAN.figure_files()
