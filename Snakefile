"""The whole study: simulate grids, derive datasets, draw figures, grade what papers printed, report."""

from snakemake.utils import min_version

min_version("9.0")


configfile: "config/config.yaml"


container: None


include: "workflow/rules/common.smk"
include: "workflow/rules/simulate.smk"
include: "workflow/rules/figures.smk"


rule all:
    default_target: True
    input:
        FIGURES,
    localrule: True
