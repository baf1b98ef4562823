include: "workflow/Snakefile"


# What a plain `snakemake` makes: a file that is included sets none.
workflow.default_target = "all"
