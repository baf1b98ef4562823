# What there is to do: read once from config/, checked before any job. `--config tier=preview` and its
# like win over config/config.yaml.

from pathlib import Path

from snakemake.exceptions import WorkflowError

from riserstudy.errors import InputError
from riserstudy.workplan import Workplan

try:
    PLAN = Workplan.read(Path("config"), config)
except InputError as error:
    raise WorkflowError(f"riserstudy: {error}")

DATASETS = PLAN.dataset_files()
FIGURES = PLAN.figure_files()
