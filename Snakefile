"""The whole study: simulate grids, derive datasets, draw figures, grade what papers printed, report."""

from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/common.smk"
include: "workflow/rules/simulate.smk"
include: "workflow/rules/measure.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/grade.smk"
include: "workflow/rules/database.smk"
include: "workflow/rules/report.smk"


rule all:
    default_target: True
    input:
        DATASETS,
        FIGURES,
        PLAN.joined_tables(),
        "results/results.sqlite",
        "results/report.html",
    localrule: True
